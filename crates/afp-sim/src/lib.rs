//! The simulated Carbot: a planar rapier world in virtual time.
