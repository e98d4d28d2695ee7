#![no_main]
//! `.stl`.

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| rayproof_fuzz::scene("fuzzed.stl", bytes));
