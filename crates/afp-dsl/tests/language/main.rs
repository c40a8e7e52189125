//! Cases as data: invalid texts with diagnostics, valid ones with graphs.

use afp_counting::Counting;

#[global_allocator]
static ALLOCATOR: Counting = Counting::SYSTEM;

mod errors;
mod explanations;
mod graph;
mod habits;
mod index;
mod junk;
mod limits;
mod mutations;
mod outline;
mod scale;
mod support;
mod texts;
mod timing;
mod totality;
mod watch;
mod wording;
