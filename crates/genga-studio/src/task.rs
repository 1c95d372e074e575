//! An errand (用事): work done in the background, so that the window does not freeze. It runs on its own thread. Browsers
//! have no threads, so there a few steps run between two frames.

#[cfg(any(target_family = "wasm", test))]
use std::cell::{Cell, RefCell};
#[cfg(not(target_family = "wasm"))]
use std::sync::mpsc::{Receiver, TryRecvError, channel};
#[cfg(not(target_family = "wasm"))]
use std::thread;
use std::time::Duration;

#[cfg(any(target_family = "wasm", test))]
use web_time::Instant;

/// Work in progress.
pub(super) struct Task<T>(Worker<T>);

#[cfg(not(target_family = "wasm"))]
type Worker<T> = Threaded<T>;
#[cfg(target_family = "wasm")]
type Worker<T> = BetweenFrames<T>;

/// Result of a look at an errand.
#[derive(Debug, PartialEq)]
pub(super) enum Look<T> {
    Waiting,
    Done(T),
    /// The worker ended without a result.
    #[cfg_attr(target_family = "wasm", allow(dead_code, reason = "only a thread can die alone"))]
    BrokeOff,
}

impl<T: Send + 'static> Task<T> {
    /// Starts work of one step.
    pub(super) fn begin(work: impl FnOnce() -> T + Send + 'static) -> Self {
        let mut work = Some(work);
        Self::in_steps(move || work.take().map(|work| work()))
    }

    /// Starts work that is done step by step, until a step returns the result.
    pub(super) fn in_steps(step: impl FnMut() -> Option<T> + Send + 'static) -> Self {
        Self(Worker::begin(step))
    }

    /// Returns the result, once it is there. Called once a frame.
    pub(super) fn look(&self) -> Look<T> {
        self.0.look()
    }
}

/// Seconds until the next look.
pub(super) const LOOK_AGAIN: f32 = if cfg!(target_family = "wasm") { 0.0 } else { 0.05 };

/// Time of a frame after which nothing more begins that can wait for the next one. Where the processor draws, a browser
/// takes about as long to show a frame, so that short work does not take a frame each.
pub(super) const BUDGET: Duration = Duration::from_millis(80);

/// Work on its own thread.
#[cfg(not(target_family = "wasm"))]
struct Threaded<T>(Receiver<T>);

#[cfg(not(target_family = "wasm"))]
impl<T: Send + 'static> Threaded<T> {
    fn begin(mut step: impl FnMut() -> Option<T> + Send + 'static) -> Self {
        let (send, done) = channel();
        // If the window was closed meanwhile, nobody receives the result.
        thread::spawn(move || {
            let done = loop {
                if let Some(done) = step() {
                    break done;
                }
            };
            drop(send.send(done));
        });
        Self(done)
    }

    fn look(&self) -> Look<T> {
        match self.0.try_recv() {
            Ok(done) => Look::Done(done),
            Err(TryRecvError::Empty) => Look::Waiting,
            Err(TryRecvError::Disconnected) => Look::BrokeOff,
        }
    }
}

/// Work that advances in looks. The first look does nothing, so that a frame can announce the work.
#[cfg(any(target_family = "wasm", test))]
struct BetweenFrames<T> {
    step: RefCell<Box<dyn FnMut() -> Option<T>>>,
    is_announced: Cell<bool>,
    budget: Duration,
}

#[cfg(any(target_family = "wasm", test))]
impl<T> BetweenFrames<T> {
    fn begin(step: impl FnMut() -> Option<T> + 'static) -> Self {
        let step = RefCell::new(Box::new(step));
        Self { step, is_announced: Cell::new(false), budget: BUDGET }
    }

    fn look(&self) -> Look<T> {
        if !self.is_announced.replace(true) {
            return Look::Waiting;
        }
        let (begin, mut step) = (Instant::now(), self.step.borrow_mut());
        loop {
            match step() {
                Some(done) => return Look::Done(done),
                None if begin.elapsed() >= self.budget => return Look::Waiting,
                None => {}
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn end<T: Send + 'static>(errand: &Task<T>) -> Option<T> {
        loop {
            match errand.look() {
                Look::Waiting => thread::yield_now(),
                Look::Done(done) => return Some(done),
                Look::BrokeOff => return None,
            }
        }
    }

    #[test]
    fn what_is_done_comes_once_and_a_thread_that_dies_is_noticed() {
        assert_eq!(end(&Task::begin(|| 42)), Some(42));
        let broken: Task<usize> = Task(Threaded(channel().1));
        assert_eq!(end(&broken), None);
    }

    /// Counts to three, one per step.
    fn counting() -> impl FnMut() -> Option<usize> + Send {
        let mut steps = 0;
        move || {
            steps += 1;
            (steps == 3).then_some(steps)
        }
    }

    #[test]
    fn steps_are_taken_until_one_gives_something() {
        assert_eq!(end(&Task::in_steps(counting())), Some(3));
    }

    #[test]
    fn without_threads_a_look_after_the_first_takes_steps_until_its_time_is_up() {
        let within = |budget| BetweenFrames { budget, ..BetweenFrames::begin(counting()) };
        let short = within(Duration::ZERO);
        let looks = [(); 4].map(|()| short.look());
        assert_eq!(looks, [Look::Waiting, Look::Waiting, Look::Waiting, Look::Done(3)]);
        let long = within(Duration::MAX);
        assert_eq!([(); 2].map(|()| long.look()), [Look::Waiting, Look::Done(3)]);
    }
}
