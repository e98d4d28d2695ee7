#![no_main]
//! `.ply`.

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| rayproof_fuzz::scene("fuzzed.ply", bytes));
