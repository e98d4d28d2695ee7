#![no_main]
//! Tables of rays, `.parquet`.

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| rayproof_fuzz::rays("fuzzed.parquet", bytes));
