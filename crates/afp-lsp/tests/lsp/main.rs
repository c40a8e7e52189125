//! Conversations with the server: as data, in random order, and from random JSON.

mod cases;
mod client;
mod errors;
mod export;
mod killed;
mod others;
mod plans;
mod random;
mod still;
