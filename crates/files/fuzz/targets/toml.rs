#![no_main]
//! `.toml`.

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| rayproof_fuzz::scene("fuzzed.toml", bytes));
