//! Feeds bytes to [`afp_fuzz::frames`].
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| afp_fuzz::frames(data));
