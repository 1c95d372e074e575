//! Long work started from Python: it releases the lock, and Ctrl-C ends it.

use std::process;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use genga::pipeline::Stop;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

/// Interval at which Ctrl-C is checked.
const LOOK: Duration = Duration::from_millis(30);

/// The threads that share work, and the process that they are in.
static CREW: Mutex<Option<(u32, &ThreadPool)>> = Mutex::new(None);

/// Runs work on a thread of its own, while other Python threads run. `KeyboardInterrupt` is raised at once, and the
/// work is asked to stop.
pub fn done<T: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce(&Stop) -> T + Send + 'static,
) -> PyResult<T> {
    done_with(py, &Arc::default(), |_: &mut (), stop| work(stop))
}

/// Like [`done`], with something that one caller at a time works on.
pub fn done_with<S: Send + 'static, T: Send + 'static>(
    py: Python<'_>,
    shared: &Arc<Mutex<S>>,
    work: impl FnOnce(&mut S, &Stop) -> T + Send + 'static,
) -> PyResult<T> {
    let crew = crew()?;
    let (send, receive) = channel();
    let receive = Mutex::new(receive);
    let (shared, stop) = (Arc::clone(shared), Stop::default());
    let told = stop.clone();
    std::thread::spawn(move || {
        // Waits here and not in the crew, whose threads take up other work while they wait.
        let Ok(mut shared) = shared.lock() else { return };
        let own: &mut S = &mut shared;
        let made = crew.install(|| work(own, &told));
        drop(shared);
        // After an interrupt nobody receives the result.
        let _ = send.send(made);
    });
    loop {
        let look = || receive.lock().ok().map(|receive| receive.recv_timeout(LOOK));
        match py.detach(look) {
            Some(Ok(made)) => return Ok(made),
            Some(Err(RecvTimeoutError::Timeout)) => {
                py.check_signals().inspect_err(|_| stop.ask())?
            }
            _ => {
                return Err(PyRuntimeError::new_err(
                    "the work ended without a result: this is a bug in genga",
                ));
            }
        }
    }
}

/// Returns the threads of this process. A fork has none of its parent's, so it gets its own: multiprocessing forks.
fn crew() -> PyResult<&'static ThreadPool> {
    let mut crew = CREW.lock().unwrap_or_else(PoisonError::into_inner);
    match *crew {
        Some((process, pool)) if process == process::id() => Ok(pool),
        _ => {
            let made = ThreadPoolBuilder::new().build();
            let made = made.map_err(|error| PyRuntimeError::new_err(error.to_string()))?;
            // Never dropped: dropping the pool of a parent would wait for threads that are not here.
            let pool: &ThreadPool = Box::leak(Box::new(made));
            *crew = Some((process::id(), pool));
            Ok(pool)
        }
    }
}
