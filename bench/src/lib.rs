//! Benchmarks against peers, outside the default members.
