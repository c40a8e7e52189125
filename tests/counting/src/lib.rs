//! An allocator that counts: for tests and measurements of what must not allocate.
//!
//! A test that counts is a binary of its own, since a program has one allocator:
//!
//! ```
//! use afp_counting::{Counting, allocations, held};
//!
//! #[global_allocator]
//! static ALLOCATOR: Counting = Counting::SYSTEM;
//!
//! let before = (allocations(), held());
//! let two = vec![Box::new(1_u64)];
//! assert_eq!((allocations() - before.0, two.len()), (2, 1));
//! assert_eq!(held() - before.1, 16);
//! drop(two);
//! assert_eq!(held(), before.1);
//! ```
#![allow(unsafe_code, reason = "a global allocator cannot be written without")]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

thread_local! {
    /// Of this thread alone: test harnesses allocate on theirs.
    static ALLOCATIONS: Cell<u64> = const { Cell::new(0) };
    /// Bytes that this thread has allocated and not freed.
    static HELD: Cell<i64> = const { Cell::new(0) };
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

/// How many bytes the current thread has allocated and not freed; less than 0 where it frees what another one has
/// allocated.
pub fn held() -> i64 {
    HELD.get()
}

/// Counts an allocation that took so many bytes more.
fn count(bytes: i64) {
    ALLOCATIONS.set(ALLOCATIONS.get() + 1);
    hold(bytes);
}

fn hold(bytes: i64) {
    HELD.set(HELD.get() + bytes);
}

/// The size of what is allocated, which no address space exceeds.
fn size(layout: &Layout) -> i64 {
    layout.size() as i64
}

// Safety: every call goes to the other allocator unchanged; counting touches no memory of it.
unsafe impl<A: GlobalAlloc> GlobalAlloc for Counting<A> {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count(size(&layout));
        // Safety: the caller keeps the contract, which is the same.
        unsafe { self.0.alloc(layout) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        count(size(&layout));
        // Safety: the caller keeps the contract, which is the same.
        unsafe { self.0.alloc_zeroed(layout) }
    }

    unsafe fn realloc(&self, at: *mut u8, layout: Layout, bytes: usize) -> *mut u8 {
        count(bytes as i64 - size(&layout));
        // Safety: the caller keeps the contract, which is the same.
        unsafe { self.0.realloc(at, layout, bytes) }
    }

    unsafe fn dealloc(&self, at: *mut u8, layout: Layout) {
        hold(-size(&layout));
        // Safety: the caller keeps the contract, which is the same.
        unsafe { self.0.dealloc(at, layout) }
    }
}
