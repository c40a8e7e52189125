//! Panics of one run among many: the message becomes part of the result instead of being printed.

use std::cell::RefCell;
use std::panic::{self, AssertUnwindSafe, PanicHookInfo, catch_unwind};
use std::sync::Once;

thread_local! {
    /// The message of the last panic of this thread; `None` while panics of this thread are
    /// printed.
    static SAID: RefCell<Option<String>> = const { RefCell::new(None) };
}

/// The result of work that may panic.
#[derive(Clone, Debug)]
pub struct Caught<T> {
    /// The result; `None` after a panic.
    pub done: Option<T>,
    /// The message and place of the last panic; empty without one. A panic of a component ends only
    /// its run, so both fields may be set.
    pub said: String,
}

/// Calls a function that may panic. Panics of other threads are printed as before.
pub fn caught<T>(work: impl FnOnce() -> T) -> Caught<T> {
    hook();
    let before = SAID.replace(Some(String::new()));
    let done = catch_unwind(AssertUnwindSafe(work)).ok();
    let said = SAID.replace(before).unwrap_or_default();
    Caught { done, said }
}

/// Installs a hook that keeps the panics of threads in [`caught`], and passes on all others.
fn hook() {
    static HOOK: Once = Once::new();
    HOOK.call_once(|| {
        let before = panic::take_hook();
        panic::set_hook(Box::new(move |info| {
            let kept = SAID.try_with(|said| match &mut *said.borrow_mut() {
                Some(text) => {
                    *text = message(info);
                    true
                }
                None => false,
            });
            if kept != Ok(true) {
                before(info);
            }
        }));
    });
}

fn message(info: &PanicHookInfo<'_>) -> String {
    let text = info.payload_as_str().unwrap_or("without a message");
    match info.location() {
        Some(place) => format!("{text} ({}:{})", place.file(), place.line()),
        None => text.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_is_stored_with_its_place_for_each_nested_task() {
        let outer = caught(|| {
            let inner = caught(|| -> u8 { panic!("no {}", "seven") });
            assert!(inner.done.is_none());
            assert!(inner.said.starts_with("no seven (") && inner.said.contains("panics.rs:"));
            7
        });
        assert_eq!((outer.done, &*outer.said), (Some(7), ""));
    }
}
