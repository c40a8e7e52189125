//! A trap for the system calls that a control thread must not make.

use seccompiler::{
    BpfProgram, SeccompAction, SeccompCmpArgLen, SeccompCmpOp, SeccompCondition, SeccompFilter,
    SeccompRule, apply_filter,
};

/// Discards the output queue of a terminal, so that a stop overtakes it: `TCFLSH` of `ioctl`.
const FLUSH: u64 = 0x540b;

/// Allows this thread only the clock, sleep, a device (read, write, flush) and waking another
/// thread. From here on, the system kills the program for any other call. Waiting for a lock is such
/// a call.
///
/// # Panics
/// The system refuses the filter.
pub fn trap_system_calls() {
    let only = |argument: u8, operation: SeccompCmpOp, value: u64| {
        let is_it = SeccompCondition::new(argument, SeccompCmpArgLen::Dword, operation, value);
        vec![SeccompRule::new(vec![is_it.unwrap()]).unwrap()]
    };
    // Operations on a futex are compared without their flags.
    let wakes = only(1, SeccompCmpOp::MaskedEq(0x7f), libc::FUTEX_WAKE as u64);
    let flushes = only(1, SeccompCmpOp::Eq, FLUSH);
    // Most machines read the clock without a call.
    let all = [libc::SYS_clock_gettime, libc::SYS_clock_nanosleep, libc::SYS_read, libc::SYS_write];
    let rules = all.map(|call| (call, Vec::new())).into_iter();
    let rules = rules.chain([(libc::SYS_futex, wakes), (libc::SYS_ioctl, flushes)]).collect();
    let arch = std::env::consts::ARCH.try_into().unwrap();
    let (others, these) = (SeccompAction::KillProcess, SeccompAction::Allow);
    let filter = SeccompFilter::new(rules, others, these, arch).unwrap();
    apply_filter(&BpfProgram::try_from(filter).unwrap()).unwrap();
}
