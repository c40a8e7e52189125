//! Feeds bytes to [`afp_fuzz::controller`].
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| afp_fuzz::controller(data));
