//! cargo-fuzz: see the function in `tests::fuzz_targets`.

#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| tests::fuzz_targets::ascii(bytes));
