//! Calls from a plan or a sweep into Python that the end of the interpreter cannot break.
//!
//! Before Python 3.14, a thread that wants the interpreter while it ends is exited by unwinding its
//! stack. In frames of Rust that runs destructors which use the interpreter, and aborts. A guard
//! next to the call makes the thread sleep instead, until the process ends.

#![allow(unsafe_code, reason = "the call itself, declared so that it may unwind")]

use std::hint::black_box;
use std::{mem, thread};

use pyo3::ffi::{self, PyObject};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

type Call = unsafe extern "C" fn(*mut PyObject, *mut PyObject, *mut PyObject) -> *mut PyObject;
type Unwinding =
    unsafe extern "C-unwind" fn(*mut PyObject, *mut PyObject, *mut PyObject) -> *mut PyObject;

/// Sleeps forever if the thread is exited. A panic passes.
struct Sleep;

impl Drop for Sleep {
    fn drop(&mut self) {
        while !thread::panicking() {
            thread::park();
        }
    }
}

/// Runs code that calls Python, and sleeps if the thread is exited in the middle.
pub fn guarded<T>(run: impl FnOnce() -> T) -> T {
    let guard = Sleep;
    let ran = run();
    mem::forget(guard);
    ran
}

/// The arguments of a call.
pub trait Arguments<'py>:
    IntoPyObject<'py, Target = PyTuple, Output = Bound<'py, PyTuple>>
{
}

impl<'py, T> Arguments<'py> for T where
    T: IntoPyObject<'py, Target = PyTuple, Output = Bound<'py, PyTuple>>
{
}

/// Calls a Python function.
///
/// # Errors
/// Its exception.
pub fn call<'py>(
    function: &Bound<'py, PyAny>,
    with: impl Arguments<'py>,
) -> PyResult<Bound<'py, PyAny>> {
    let py = function.py();
    let arguments = with.into_pyobject(py).map_err(Into::into)?;
    let call: Call = ffi::PyObject_Call;
    // Safety: the two types differ only in unwinding, which the callee does when its thread exits.
    let call: Unwinding = unsafe { mem::transmute::<Call, Unwinding>(call) };
    // The compiler assumes that the declared function never unwinds.
    let call = black_box(call);
    let returned = guarded(|| {
        // Safety: the thread is attached, and both objects are alive during the call.
        unsafe { call(function.as_ptr(), arguments.as_ptr(), std::ptr::null_mut()) }
    });
    // Safety: the function returns a new reference, or null with an exception set.
    unsafe { Bound::from_owned_ptr_or_err(py, returned) }
}
