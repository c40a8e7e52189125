//! Feeds bytes to [`afp_fuzz::formatter`].
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| afp_fuzz::formatter(data));
