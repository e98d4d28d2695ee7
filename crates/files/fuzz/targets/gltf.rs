#![no_main]
//! `.gltf`.

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| rayproof_fuzz::scene("fuzzed.gltf", bytes));
