//! MCAP logs of plans and robots.
