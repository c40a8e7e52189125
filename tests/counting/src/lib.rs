//! An allocator that counts: for tests and measurements of what must not allocate.
//!
//! A test that counts is a binary of its own, since a program has one allocator:
//!
//! ```
//! use afp_counting::{Counting, allocations};
//!
//! #[global_allocator]
//! static ALLOCATOR: Counting = Counting::SYSTEM;
//!
//! let before = allocations();
//! let two = vec![Box::new(1)];
//! assert_eq!((allocations() - before, two.len()), (2, 1));
//! ```
#![allow(unsafe_code, reason = "a global allocator cannot be written without")]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

thread_local! {
    /// Of this thread alone: test harnesses allocate on theirs.
    static ALLOCATIONS: Cell<u64> = const { Cell::new(0) };
}

/// An allocator whose use is counted.
#[derive(Clone, Copy, Debug)]
pub struct Counting<A = System>(pub A);

impl Counting {
    /// The allocator of the system.
    pub const SYSTEM: Counting = Counting(System);
}

/// How often the current thread has allocated, or made an allocation larger or smaller.
pub fn allocations() -> u64 {
    ALLOCATIONS.get()
}

fn count() {
    ALLOCATIONS.set(ALLOCATIONS.get() + 1);
}

// Safety: every call goes to the other allocator unchanged; counting touches no memory of it.
unsafe impl<A: GlobalAlloc> GlobalAlloc for Counting<A> {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count();
        // Safety: the caller keeps the contract, which is the same.
        unsafe { self.0.alloc(layout) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        count();
        // Safety: the caller keeps the contract, which is the same.
        unsafe { self.0.alloc_zeroed(layout) }
    }

    unsafe fn realloc(&self, at: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        count();
        // Safety: the caller keeps the contract, which is the same.
        unsafe { self.0.realloc(at, layout, size) }
    }

    unsafe fn dealloc(&self, at: *mut u8, layout: Layout) {
        // Safety: the caller keeps the contract, which is the same.
        unsafe { self.0.dealloc(at, layout) }
    }
}
