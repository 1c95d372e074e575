//! An errand (用事): what is done beside the window, so that it does not freeze. It has a thread of its own; in a
//! browser there are none, and a step of it is done between two frames.

#[cfg(any(target_family = "wasm", test))]
use std::cell::{Cell, RefCell};
#[cfg(not(target_family = "wasm"))]
use std::sync::mpsc::{Receiver, TryRecvError, channel};
#[cfg(not(target_family = "wasm"))]
use std::thread;

/// Work that somebody is doing.
pub(super) struct Errand<T>(Worker<T>);

#[cfg(not(target_family = "wasm"))]
type Worker<T> = Threaded<T>;
#[cfg(target_family = "wasm")]
type Worker<T> = BetweenFrames<T>;

/// What a look at it finds.
#[derive(Debug, PartialEq)]
pub(super) enum Look<T> {
    Waiting,
    Done(T),
    /// Whoever did it is gone without a word.
    #[cfg_attr(target_family = "wasm", allow(dead_code, reason = "only a thread can die alone"))]
    BrokeOff,
}

impl<T: Send + 'static> Errand<T> {
    /// Begins work of one step.
    pub(super) fn begin(work: impl FnOnce() -> T + Send + 'static) -> Self {
        let mut work = Some(work);
        Self::in_steps(move || work.take().map(|work| work()))
    }

    /// Begins work that is done step by step, until one gives what comes of it.
    pub(super) fn in_steps(step: impl FnMut() -> Option<T> + Send + 'static) -> Self {
        Self(Worker::begin(step))
    }

    /// Whether it is done. Asked once a frame.
    pub(super) fn look(&self) -> Look<T> {
        self.0.look()
    }
}

/// Seconds after which it is looked at again.
pub(super) const LOOK_AGAIN: f32 = if cfg!(target_family = "wasm") { 0.0 } else { 0.05 };

/// Work on a thread.
#[cfg(not(target_family = "wasm"))]
struct Threaded<T>(Receiver<T>);

#[cfg(not(target_family = "wasm"))]
impl<T: Send + 'static> Threaded<T> {
    fn begin(mut step: impl FnMut() -> Option<T> + Send + 'static) -> Self {
        let (send, done) = channel();
        // Nobody is left to hear it when the window was closed meanwhile.
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

/// Work of which each look does a step. The first does none: a frame is drawn before it that says what is coming.
#[cfg(any(target_family = "wasm", test))]
struct BetweenFrames<T> {
    step: RefCell<Box<dyn FnMut() -> Option<T>>>,
    is_announced: Cell<bool>,
}

#[cfg(any(target_family = "wasm", test))]
impl<T> BetweenFrames<T> {
    fn begin(step: impl FnMut() -> Option<T> + 'static) -> Self {
        Self { step: RefCell::new(Box::new(step)), is_announced: Cell::new(false) }
    }

    fn look(&self) -> Look<T> {
        if !self.is_announced.replace(true) {
            return Look::Waiting;
        }
        let done = (self.step.borrow_mut())();
        done.map_or(Look::Waiting, Look::Done)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn end<T: Send + 'static>(errand: &Errand<T>) -> Option<T> {
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
        assert_eq!(end(&Errand::begin(|| 42)), Some(42));
        let broken: Errand<usize> = Errand(Threaded(channel().1));
        assert_eq!(end(&broken), None);
    }

    /// Counts to three, one a step.
    fn counting() -> impl FnMut() -> Option<usize> + Send {
        let mut steps = 0;
        move || {
            steps += 1;
            (steps == 3).then_some(steps)
        }
    }

    #[test]
    fn steps_are_taken_until_one_gives_something() {
        assert_eq!(end(&Errand::in_steps(counting())), Some(3));
    }

    #[test]
    fn without_threads_a_look_is_a_step_after_the_first() {
        let errand = BetweenFrames::begin(counting());
        let looks = [(); 4].map(|()| errand.look());
        assert_eq!(looks, [Look::Waiting, Look::Waiting, Look::Waiting, Look::Done(3)]);
    }
}
