//! How the system schedules the control thread of a real robot: `priority` and `cpu` of `[robot.realtime]`.
//!
//! A system that refuses a setting does not end the run. A warning names the permission that is missing.

use afp_project::Realtime;

use crate::stderr::warn;

/// Applies the settings to the current thread. With a priority, the memory of the process is locked, too.
///
/// Threads that this thread starts afterwards inherit the settings.
pub(super) fn apply(realtime: Realtime) {
    if let Some(cpu) = realtime.cpu
        && let Err(why) = system::pin(cpu)
    {
        warn(&format!("the control loop cannot run on processor {cpu}: {why}"));
    }
    let Some(priority) = realtime.priority else { return };
    if let Err(why) = system::lock_memory() {
        warn(&format!(
            "the memory of the control loop is not locked: {why} (help: for a service, set 'LimitMEMLOCK=infinity'; in a shell, run 'sudo prlimit --memlock=unlimited --pid $$')"
        ));
    }
    if let Err(why) = raise(priority) {
        warn(&format!(
            "the control loop has no FIFO priority {priority}: {why} (help: for a service, set 'LimitRTPRIO=99'; in a shell, run 'sudo prlimit --rtprio=99 --pid $$')"
        ));
    }
}

/// Gives the current thread a FIFO priority from 1 to 99.
///
/// # Errors
/// The reason of the system.
pub(crate) fn raise(priority: u8) -> Result<(), String> {
    system::raise(priority)
}

#[cfg(target_os = "linux")]
mod system {
    use std::io;

    use rustix::mm::{MlockAllFlags, mlockall};
    use rustix::thread::{CpuSet, sched_setaffinity};
    use thread_priority::{
        Error, RealtimeThreadSchedulePolicy, ThreadPriority, ThreadPriorityValue,
        ThreadSchedulePolicy, set_thread_priority_and_policy, thread_native_id,
    };

    pub(super) fn raise(priority: u8) -> Result<(), String> {
        let priority = ThreadPriority::Crossplatform(ThreadPriorityValue::try_from(priority)?);
        let policy = ThreadSchedulePolicy::Realtime(RealtimeThreadSchedulePolicy::Fifo);
        set_thread_priority_and_policy(thread_native_id(), priority, policy).map_err(
            |why| match why {
                Error::OS(code) => io::Error::from_raw_os_error(code).to_string(),
                why => why.to_string(),
            },
        )
    }

    /// Later memory is not locked: a limit would then refuse it to other threads.
    pub(super) fn lock_memory() -> io::Result<()> {
        Ok(mlockall(MlockAllFlags::CURRENT)?)
    }

    pub(super) fn pin(cpu: u16) -> io::Result<()> {
        let mut only = CpuSet::new();
        only.set(usize::from(cpu).min(CpuSet::MAX_CPU - 1));
        Ok(sched_setaffinity(None, &only)?)
    }
}

#[cfg(not(target_os = "linux"))]
mod system {
    use std::io;

    pub(super) fn raise(_: u8) -> Result<(), String> {
        Err("it needs Linux".to_owned())
    }

    pub(super) fn lock_memory() -> io::Result<()> {
        Err(io::ErrorKind::Unsupported.into())
    }

    pub(super) fn pin(_: u16) -> io::Result<()> {
        Err(io::ErrorKind::Unsupported.into())
    }
}
