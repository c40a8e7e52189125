//! What was drawn last.

use std::collections::VecDeque;
use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

use afp_draw::Scene;

/// Scenes that are kept; who enters more plans than this comes back to a drawing from scratch.
const MOST: usize = 32;

/// The scenes that were drawn last, of each plan of each document.
///
/// The part that a new drawing shares with the last one takes no time; no box moves because of it. Servers share these
/// drawings: a page that reloads, a second page, a plan that is shown again.
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

    /// Keeps a drawing in place of the one before.
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
