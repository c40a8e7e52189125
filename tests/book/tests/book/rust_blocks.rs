//! The book's Rust: it compiles here, and its tests and programs run.

use crate::blocks;

include!(concat!(env!("OUT_DIR"), "/rust.rs"));

#[test]
fn rust_blocks_are_compiled_as_a_whole() {
    for block in blocks("rust").into_iter().filter(|block| block.value("of").is_none()) {
        assert!(block.tags.is_empty(), "{}: Rust has no tags", block.place());
    }
}
