//! Feeds bytes to [`afp_fuzz::map`].
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| afp_fuzz::map(data));
