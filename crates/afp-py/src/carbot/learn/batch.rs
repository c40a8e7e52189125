//! Some episodes side by side, and rounds in which something is done with each of them, by several threads.

use std::hint::spin_loop;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, LockResult, Mutex, MutexGuard};
use std::thread;

use super::course::{Brief, Course, Outcome, Start};

/// Whoever waits for others looks so often before it lets other threads run.
const LOOKS: usize = 1000;

/// Some episodes of a task.
pub struct Batch {
    pub brief: Arc<Brief>,
    /// The least and the greatest of what is observed.
    pub bounds: Vec<(f32, f32)>,
    places: Vec<Mutex<Place>>,
}

/// Where an episode is, and what is to be done with it.
#[derive(Default)]
pub struct Place {
    pub course: Option<Course>,
    /// How the next episode begins, if it is to.
    pub start: Option<Start>,
    /// What to do in the next step, as [`Course::step`] takes it.
    pub action: Vec<f64>,
    /// What is observed, within the bounds.
    pub seen: Vec<f32>,
    pub outcome: Outcome,
    /// Why the episode could not begin.
    pub failed: Option<String>,
}

/// What is done with each episode.
#[derive(Clone, Copy, Debug)]
pub enum Task {
    /// Those that are about to begin do.
    Begin,
    /// The same, and all others make a step.
    Step,
}

/// A task to be done with each episode once. Several threads may work on it.
pub struct Round {
    batch: Arc<Batch>,
    task: Task,
    next: AtomicUsize,
    done: AtomicUsize,
}

impl Batch {
    /// So many places without an episode.
    pub fn new(brief: Brief, count: usize) -> Batch {
        let bounds = brief.bounds();
        let place = || Place { seen: vec![0.0; bounds.len()], ..Place::default() };
        let places = (0..count).map(|_| Mutex::new(place())).collect();
        Batch { brief: Arc::new(brief), bounds, places }
    }

    pub fn len(&self) -> usize {
        self.places.len()
    }

    /// A place; none beyond the last.
    pub fn place(&self, index: usize) -> Option<LockResult<MutexGuard<'_, Place>>> {
        Some(self.places.get(index)?.lock())
    }

    /// All places in their order. Nobody else has them between rounds.
    pub fn places(&self) -> impl Iterator<Item = LockResult<MutexGuard<'_, Place>>> {
        self.places.iter().map(Mutex::lock)
    }

    /// Does something with one episode, and looks what is observed then.
    pub fn work(&self, place: &mut Place, task: Task) {
        if let Some(start) = place.start.take() {
            place.begin(&self.brief, start);
        } else if let (Task::Step, Some(course)) = (task, &mut place.course) {
            place.outcome = course.step(&place.action);
        }
        if let Some(course) = &place.course {
            course.observe(&self.bounds, &mut place.seen);
        }
    }
}

impl Place {
    fn begin(&mut self, brief: &Arc<Brief>, start: Start) {
        self.outcome = Outcome::default();
        match Course::new(brief, start) {
            Ok(course) => self.course = Some(course),
            Err(why) => (self.course, self.failed) = (None, Some(why)),
        }
    }
}

impl Round {
    pub fn new(batch: &Arc<Batch>, task: Task) -> Round {
        let (next, done) = (AtomicUsize::new(0), AtomicUsize::new(0));
        Round { batch: Arc::clone(batch), task, next, done }
    }

    /// How many places there are.
    pub fn places(&self) -> usize {
        self.batch.len()
    }

    /// Works on places that nobody works on yet, until there are none; how many it were.
    pub fn work(&self) -> usize {
        let mut worked = 0;
        while let Some(place) = self.batch.places.get(self.next.fetch_add(1, Ordering::Relaxed)) {
            let _done = Done(&self.done);
            if let Ok(mut place) = place.lock() {
                self.batch.work(&mut place, self.task);
            }
            worked += 1;
        }
        worked
    }

    /// Waits until all places are done.
    pub fn wait(&self) {
        let mut looks = 0;
        while self.done.load(Ordering::Acquire) < self.places() {
            looks += 1;
            if looks < LOOKS { spin_loop() } else { thread::yield_now() }
        }
    }
}

/// Counts a place as done, also where its episode panics, so that nobody waits for it.
struct Done<'a>(&'a AtomicUsize);

impl Drop for Done<'_> {
    fn drop(&mut self) {
        self.0.fetch_add(1, Ordering::Release);
    }
}
