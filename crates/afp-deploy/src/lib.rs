//! Puts a plan on a robot, and back again.
//!
//! `afpc deploy` is a [`client`]. It talks to an [`agent`] on the robot over two byte streams, which
//! `ssh` provides ([`wire`]). A [`manifest::Manifest`] lists the files of a release with their
//! hashes. The agent asks for the files that the robot lacks, checks the plan there, and switches
//! the [`store`] to the new release with one rename.
//!
//! Invariants:
//!
//! - The folder is valid after each operation of the file system. If the agent is killed, or the
//!   disk is full, the link `current` still names a complete release.
//! - Nothing from the other side becomes a part of a command line or a path without a check, and
//!   every length has a limit.
//! - Times are never compared: the clock of a robot may be in 1970.
//!
//! The crate starts no program and opens no connection. [`agent::Host`] is the robot's side of that.

#[cfg(unix)]
pub mod agent;
pub mod client;
#[cfg(unix)]
pub mod disk;
mod hash;
#[cfg(unix)]
pub mod logs;
pub mod manifest;
#[cfg(unix)]
pub mod store;
pub mod wire;

pub use hash::sha256;
