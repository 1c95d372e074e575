//! Ctrl-C and SIGTERM (中断): what is unfinished goes, and what is just taking its place is finished first.

use std::collections::BTreeSet;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, Once, PoisonError};

/// The exit code of a program that was stopped, as shells have it.
const STOPPED: i32 = 130;

/// Folders of unfinished files, as absolute paths.
static UNFINISHED: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());
static WATCHED: Once = Once::new();

fn unfinished() -> MutexGuard<'static, BTreeSet<PathBuf>> {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Makes a folder that is removed when the program is stopped, until it is [cleared](clear).
pub(super) fn remember(make: impl FnOnce() -> io::Result<PathBuf>) -> io::Result<PathBuf> {
    // Where nobody can be asked to tell of a signal the next run removes the folder.
    WATCHED.call_once(|| drop(ctrlc::set_handler(stop)));
    let mut unfinished = unfinished();
    let folder = make()?;
    unfinished.insert(folder.clone());
    Ok(folder)
}

/// Removes such a folder, if it is still there.
pub(super) fn clear(folder: &Path) {
    let mut unfinished = unfinished();
    let _ = fs::remove_dir_all(folder);
    unfinished.remove(folder);
}

/// Does what must not be stopped half-way. A signal waits until then.
pub(super) fn undisturbed<T>(work: impl FnOnce() -> T) -> T {
    let _turn = unfinished();
    work()
}

/// Whether a signal asks for a pause first, and whether one has.
static GENTLE: AtomicBool = AtomicBool::new(false);
static ASKED: AtomicBool = AtomicBool::new(false);

/// From now on the first signal only [asks](is_asked) for an end; the second is one.
pub(super) fn gently() {
    GENTLE.store(true, Ordering::SeqCst);
}

/// Whether an end was asked for.
pub(super) fn is_asked() -> bool {
    ASKED.load(Ordering::SeqCst)
}

fn stop() {
    if GENTLE.load(Ordering::SeqCst) && !ASKED.swap(true, Ordering::SeqCst) {
        return;
    }
    // Held to the end: whoever would write next waits for ever.
    let folders = unfinished();
    for folder in folders.iter() {
        let _ = fs::remove_dir_all(folder);
    }
    process::exit(STOPPED);
}
