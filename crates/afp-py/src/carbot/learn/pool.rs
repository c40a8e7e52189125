//! Threads that step episodes, made when they are needed and again in a process that was forked.

use std::num::NonZeroUsize;
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;

use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};

use crate::forks;

/// The threads of this process, one for each core.
static POOL: Mutex<Option<(u32, Arc<ThreadPool>)>> = Mutex::new(None);

/// The threads of this process.
///
/// # Errors
/// The system gives no threads.
pub fn pool() -> Result<Arc<ThreadPool>, ThreadPoolBuildError> {
    let mut pool = POOL.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((process, pool)) = &*pool
        && *process == forks::process()
    {
        return Ok(Arc::clone(pool));
    }
    let cores = thread::available_parallelism().map_or(1, NonZeroUsize::get);
    let made = ThreadPoolBuilder::new().num_threads(cores).build()?;
    // Threads are not forked: whoever waited for those of the parent would wait for ever.
    std::mem::forget(pool.take());
    let made = Arc::new(made);
    *pool = Some((forks::process(), Arc::clone(&made)));
    Ok(made)
}
