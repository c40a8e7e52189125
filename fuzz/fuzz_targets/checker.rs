//! Feeds bytes to [`afp_fuzz::checker`].
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| afp_fuzz::checker(data));
