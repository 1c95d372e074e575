//! Long work beside Python: without its lock, and ended by Ctrl-C.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

/// How often it is looked whether somebody wants to end it.
const LOOK: Duration = Duration::from_millis(30);

/// Does work on a thread of its own, while other threads of Python run. `KeyboardInterrupt` comes out at once; the
/// work is told by the flag that it is given, and what it has begun is finished and thrown away.
pub fn done<T: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce(&AtomicBool) -> T + Send + 'static,
) -> PyResult<T> {
    let (send, receive) = channel();
    let receive = Mutex::new(receive);
    let is_ended = Arc::new(AtomicBool::new(false));
    let told = Arc::clone(&is_ended);
    std::thread::spawn(move || {
        // Nobody listens any more where it was ended.
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
                    "the work ended without a result: a fault of genga",
                ));
            }
        }
    }
}
