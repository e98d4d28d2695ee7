#![no_main]
//! Tables of rays, `.npy`.

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| rayproof_fuzz::rays("fuzzed.npy", bytes));
