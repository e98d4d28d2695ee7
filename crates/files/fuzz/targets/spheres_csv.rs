#![no_main]
//! Tables of spheres, `.csv`.

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| rayproof_fuzz::spheres("fuzzed.csv", bytes));
