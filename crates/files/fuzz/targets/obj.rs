#![no_main]
//! `.obj`.

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| rayproof_fuzz::scene("fuzzed.obj", bytes));
