//! Feeds bytes to [`afp_fuzz::ugv`].
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| afp_fuzz::ugv(data));
