#![no_main]
//! `.glb`.

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| rayproof_fuzz::scene("fuzzed.glb", bytes));
