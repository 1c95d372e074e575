//! Long work started from Python: it releases the lock, and Ctrl-C ends it.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

/// Interval at which Ctrl-C is checked.
const LOOK: Duration = Duration::from_millis(30);

/// Runs work on a thread of its own, while other Python threads run. `KeyboardInterrupt` is raised at once. The work
/// learns of it through its flag; its result is then discarded.
pub fn done<T: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce(&AtomicBool) -> T + Send + 'static,
) -> PyResult<T> {
    let (send, receive) = channel();
    let receive = Mutex::new(receive);
    let is_ended = Arc::new(AtomicBool::new(false));
    let told = Arc::clone(&is_ended);
    std::thread::spawn(move || {
        // After an interrupt nobody receives the result.
        let _ = send.send(work(&told));
    });
    loop {
        let look = || receive.lock().ok().map(|receive| receive.recv_timeout(LOOK));
        match py.detach(look) {
            Some(Ok(made)) => return Ok(made),
            Some(Err(RecvTimeoutError::Timeout)) => {
                if let Err(interrupt) = py.check_signals() {
                    is_ended.store(true, Ordering::Relaxed);
                    return Err(interrupt);
                }
            }
            _ => {
                return Err(PyRuntimeError::new_err(
                    "the work ended without a result: this is a bug in genga",
                ));
            }
        }
    }
}
