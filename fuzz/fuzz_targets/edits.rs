//! Feeds bytes to [`afp_fuzz::edits`].
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| afp_fuzz::edits(data));
