//! Feeds bytes to [`afp_fuzz::deploy`].
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| afp_fuzz::deploy(data));
