//! An errand (用事): what is done on a thread of its own, so that the window does not freeze.

use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::thread;

/// Work that somebody is doing.
pub(super) struct Errand<T>(Receiver<T>);

/// What a look at it finds.
pub(super) enum Look<T> {
    Waiting,
    Done(T),
    /// Whoever did it is gone without a word.
    BrokeOff,
}

impl<T: Send + 'static> Errand<T> {
    /// Begins the work.
    pub(super) fn begin(work: impl FnOnce() -> T + Send + 'static) -> Self {
        let (send, done) = channel();
        // Nobody is left to hear it when the window was closed meanwhile.
        thread::spawn(move || drop(send.send(work())));
        Self(done)
    }

    /// Whether it is done.
    pub(super) fn look(&self) -> Look<T> {
        match self.0.try_recv() {
            Ok(done) => Look::Done(done),
            Err(TryRecvError::Empty) => Look::Waiting,
            Err(TryRecvError::Disconnected) => Look::BrokeOff,
        }
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
        let broken: Errand<usize> = Errand(channel().1);
        assert_eq!(end(&broken), None);
    }
}
