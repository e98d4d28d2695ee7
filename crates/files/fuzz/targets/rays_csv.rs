#![no_main]
//! Tables of rays, `.csv`.

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| rayproof_fuzz::rays("fuzzed.csv", bytes));
