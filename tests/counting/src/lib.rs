//! An allocator that counts, for tests and measurements of code that must not allocate; and a trap
//! for system calls.
//!
//! A test that counts needs its own binary, since a program has one allocator:
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

#[cfg(target_os = "linux")]
mod trap;

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

#[cfg(target_os = "linux")]
pub use trap::trap_system_calls;

thread_local! {
    /// Counts only this thread: test harnesses allocate on others.
    static ALLOCATIONS: Cell<u64> = const { Cell::new(0) };
    /// Bytes that this thread has allocated and not freed.
    static HELD: Cell<i64> = const { Cell::new(0) };
}

#[derive(Clone, Copy, Debug)]
pub struct Counting<A = System>(pub A);

impl Counting {
    pub const SYSTEM: Counting = Counting(System);
}

/// Returns the number of allocations and reallocations on the current thread.
pub fn allocations() -> u64 {
    ALLOCATIONS.get()
}

/// Returns the bytes that the current thread has allocated and not freed; negative if it frees
/// another thread's memory.
pub fn held() -> i64 {
    HELD.get()
}

/// Counts an allocation of that many bytes.
fn count(bytes: i64) {
    ALLOCATIONS.set(ALLOCATIONS.get() + 1);
    hold(bytes);
}

fn hold(bytes: i64) {
    HELD.set(HELD.get() + bytes);
}

/// The size of an allocation, which fits any address space.
fn size(layout: &Layout) -> i64 {
    layout.size() as i64
}

// Safety: every call goes to the other allocator unchanged, and counting touches no allocated
// memory.
unsafe impl<A: GlobalAlloc> GlobalAlloc for Counting<A> {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count(size(&layout));
        // Safety: the caller upholds the same contract.
        unsafe { self.0.alloc(layout) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        count(size(&layout));
        // Safety: the caller upholds the same contract.
        unsafe { self.0.alloc_zeroed(layout) }
    }

    unsafe fn realloc(&self, at: *mut u8, layout: Layout, bytes: usize) -> *mut u8 {
        count(bytes as i64 - size(&layout));
        // Safety: the caller upholds the same contract.
        unsafe { self.0.realloc(at, layout, bytes) }
    }

    unsafe fn dealloc(&self, at: *mut u8, layout: Layout) {
        hold(-size(&layout));
        // Safety: the caller upholds the same contract.
        unsafe { self.0.dealloc(at, layout) }
    }
}
