//! A batch of episodes, and rounds of work on it by several threads.

use std::hint::spin_loop;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, LockResult, Mutex, MutexGuard};
use std::thread;

use super::course::{Brief, Course, Outcome, Start};

/// The polls of a waiting thread before it yields.
const LOOKS: usize = 1000;

/// Episodes of a task.
pub struct Batch {
    pub brief: Arc<Brief>,
    /// Minimum and maximum of each observed number.
    pub bounds: Vec<(f32, f32)>,
    places: Vec<Mutex<Place>>,
}

/// An episode, and the input of its next task.
#[derive(Default)]
pub struct Place {
    pub course: Option<Course>,
    /// The start of the next episode, if requested.
    pub start: Option<Start>,
    /// The action of the next step, for [`Course::step`].
    pub action: Vec<f64>,
    /// The observation, clamped to the bounds.
    pub seen: Vec<f32>,
    pub outcome: Outcome,
    /// The reason why the episode could not begin.
    pub failed: Option<String>,
}

/// The task of a round.
#[derive(Clone, Copy, Debug)]
pub enum Task {
    /// Begin requested episodes.
    Begin,
    /// Begin requested episodes, and make a step in all others.
    Step,
}

/// A task for each episode once, shared by several threads.
pub struct Round {
    batch: Arc<Batch>,
    task: Task,
    next: AtomicUsize,
    done: AtomicUsize,
}

impl Batch {
    /// Makes a number of places without episodes.
    pub fn new(brief: Brief, count: usize) -> Batch {
        let bounds = brief.bounds();
        let place = || Place { seen: vec![0.0; bounds.len()], ..Place::default() };
        let places = (0..count).map(|_| Mutex::new(place())).collect();
        Batch { brief: Arc::new(brief), bounds, places }
    }

    /// Makes as many places for the same task, without episodes.
    pub fn empty_copy(&self) -> Batch {
        let place = || Mutex::new(Place { seen: vec![0.0; self.bounds.len()], ..Place::default() });
        let places = self.places.iter().map(|_| place()).collect();
        Batch { brief: Arc::clone(&self.brief), bounds: self.bounds.clone(), places }
    }

    pub fn len(&self) -> usize {
        self.places.len()
    }

    /// A place; `None` past the end.
    pub fn place(&self, index: usize) -> Option<LockResult<MutexGuard<'_, Place>>> {
        Some(self.places.get(index)?.lock())
    }

    /// All places in order. Between rounds no other thread uses them.
    pub fn places(&self) -> impl Iterator<Item = LockResult<MutexGuard<'_, Place>>> {
        self.places.iter().map(Mutex::lock)
    }

    /// Performs a task on one episode, and then observes it.
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

    /// The number of places.
    pub fn places(&self) -> usize {
        self.batch.len()
    }

    /// Works on free places until none is left, and returns the number of them.
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

/// Counts a place as done, even if its episode panics, so that no thread waits for it.
struct Done<'a>(&'a AtomicUsize);

impl Drop for Done<'_> {
    fn drop(&mut self) {
        self.0.fetch_add(1, Ordering::Release);
    }
}
