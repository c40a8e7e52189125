//! Feeds bytes to [`afp_fuzz::world`].
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| afp_fuzz::world(data));
