//! What a panic said, kept for the outcome of its run instead of printed.

use std::cell::RefCell;
use std::panic::{self, PanicHookInfo};
use std::sync::Once;

thread_local! {
    /// What the last panic of this thread said; `None` while panics of this thread are printed.
    static SAID: RefCell<Option<String>> = const { RefCell::new(None) };
}

/// From now on panics of this thread are kept. Those of other threads go where they went before.
pub(crate) fn keep() {
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
    SAID.with(|said| *said.borrow_mut() = Some(String::new()));
}

/// What the last panic said since this was last asked for; empty without one.
pub(crate) fn take() -> String {
    SAID.with(|said| said.borrow_mut().as_mut().map(std::mem::take).unwrap_or_default())
}

fn message(info: &PanicHookInfo<'_>) -> String {
    let text = info.payload_as_str().unwrap_or("it did not say why");
    match info.location() {
        Some(place) => format!("{text} ({}:{})", place.file(), place.line()),
        None => text.to_owned(),
    }
}
