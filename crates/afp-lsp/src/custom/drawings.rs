//! A cache of recent drawings.

use std::collections::VecDeque;
use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

use afp_draw::Scene;

/// The most plans kept; a plan beyond this is drawn from scratch.
const MOST: usize = 32;

/// The last scene of each plan of each document.
///
/// A new drawing reuses the unchanged part of the last one, which also keeps its boxes in place.
/// All servers of a process share these scenes, for reloads, second pages and repeated views.
#[derive(Clone, Default)]
pub struct Drawings(Arc<Mutex<VecDeque<Kept>>>);

struct Kept {
    path: String,
    plan: String,
    scene: Arc<Scene>,
}

impl Drawings {
    /// The last drawing of a plan of a document.
    pub(super) fn of(&self, path: &str, plan: &str) -> Option<Arc<Scene>> {
        let all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        all.iter().find(|kept| kept.is(path, plan)).map(|kept| Arc::clone(&kept.scene))
    }

    pub(super) fn keep(&self, path: &str, plan: &str, scene: &Arc<Scene>) {
        let mut all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        all.retain(|kept| !kept.is(path, plan));
        all.push_back(Kept {
            path: path.to_owned(),
            plan: plan.to_owned(),
            scene: Arc::clone(scene),
        });
        if all.len() > MOST {
            all.pop_front();
        }
    }
}

impl Kept {
    fn is(&self, path: &str, plan: &str) -> bool {
        self.path == path && self.plan == plan
    }
}

impl fmt::Debug for Drawings {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Drawings").finish_non_exhaustive()
    }
}
