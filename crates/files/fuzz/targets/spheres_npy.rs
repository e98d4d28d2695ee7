#![no_main]
//! Tables of spheres, `.npy`.

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| rayproof_fuzz::spheres("fuzzed.npy", bytes));
