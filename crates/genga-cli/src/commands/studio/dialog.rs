//! The system's dialogs for opening a file or a folder.

use std::path::PathBuf;
use std::pin::pin;
use std::sync::Arc;
use std::task::{Context, Poll, Wake, Waker};
use std::thread::{self, Thread};

use rfd::AsyncFileDialog;

use genga::recipe::Footage;
use genga_read::FORMATS;

/// Asks for a file and waits for the answer. `None` if the person cancels or the system has no dialog.
pub(super) fn choose() -> Option<PathBuf> {
    let endings = FORMATS.iter().flat_map(|format| format.endings);
    let endings: Vec<String> =
        endings.flat_map(|own| [(*own).into(), own.to_uppercase()]).collect();
    let beside = [&Footage::PICTURES[..], &Footage::VIDEOS, &Footage::SOUNDS].concat();
    let dialog = AsyncFileDialog::new()
        .add_filter("motion", &endings)
        .add_filter("genga", &["toml"])
        .add_filter("pictures, sound", &beside);
    waited(dialog.pick_file()).map(|file| file.path().to_owned())
}

/// Asks for a folder and waits for the answer.
pub(super) fn choose_folder() -> Option<PathBuf> {
    waited(AsyncFileDialog::new().pick_folder()).map(|folder| folder.path().to_owned())
}

/// A waker that unparks a thread.
struct Woken(Thread);

impl Wake for Woken {
    fn wake(self: Arc<Self>) {
        self.0.unpark();
    }
}

/// Blocks on a future; the thread sleeps until it is ready.
fn waited<T>(future: impl Future<Output = T>) -> T {
    let mut future = pin!(future);
    let waker = Waker::from(Arc::new(Woken(thread::current())));
    loop {
        match future.as_mut().poll(&mut Context::from_waker(&waker)) {
            Poll::Ready(done) => return done,
            Poll::Pending => thread::park(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::mpsc::channel;

    /// A future that is ready once another thread has sent a value.
    struct Later(std::sync::mpsc::Receiver<u8>, std::sync::mpsc::Sender<Waker>);

    impl Future for Later {
        type Output = u8;

        fn poll(self: std::pin::Pin<&mut Self>, context: &mut Context<'_>) -> Poll<u8> {
            self.0.try_recv().map_or_else(
                |_| {
                    self.1.send(context.waker().clone()).unwrap();
                    Poll::Pending
                },
                Poll::Ready,
            )
        }
    }

    #[test]
    fn a_thread_sleeps_until_it_is_woken() {
        let ((say, said), (give, wakers)) = (channel(), channel::<Waker>());
        thread::spawn(move || {
            let waker = wakers.recv().unwrap();
            say.send(42).unwrap();
            waker.wake();
        });
        assert_eq!(waited(Later(said, give)), 42);
    }
}
