//! Feeds bytes to [`afp_fuzz::debugger`].
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| afp_fuzz::debugger(data));
