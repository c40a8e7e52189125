//! Feeds bytes to [`afp_fuzz::scenario`].
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| afp_fuzz::scenario(data));
