//! Handles Ctrl-C and SIGTERM (中断): removes unfinished files, but lets a rename in progress finish first.

use std::collections::BTreeSet;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, Once, PoisonError};

/// Exit code of a stopped program, as in shells.
const STOPPED: i32 = 130;

/// Folders of unfinished files, as absolute paths.
static UNFINISHED: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());
static WATCHED: Once = Once::new();

fn unfinished() -> MutexGuard<'static, BTreeSet<PathBuf>> {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Makes a folder that is removed when the program is stopped, until it is [cleared](clear).
pub(super) fn remember(make: impl FnOnce() -> io::Result<PathBuf>) -> io::Result<PathBuf> {
    // If no signal handler can be set, the next run removes the folder.
    WATCHED.call_once(|| drop(ctrlc::set_handler(stop)));
    let mut unfinished = unfinished();
    let folder = make()?;
    unfinished.insert(folder.clone());
    Ok(folder)
}

/// Removes a remembered folder if it still exists.
pub(super) fn clear(folder: &Path) {
    let mut unfinished = unfinished();
    let _ = fs::remove_dir_all(folder);
    unfinished.remove(folder);
}

/// Runs work that must not be interrupted. A signal waits until it is done.
pub(super) fn undisturbed<T>(work: impl FnOnce() -> T) -> T {
    let _turn = unfinished();
    work()
}

/// Whether the first signal only asks for an end ([`gently`]), and whether one has.
static GENTLE: AtomicBool = AtomicBool::new(false);
static ASKED: AtomicBool = AtomicBool::new(false);

/// Makes the first signal only [ask](is_asked) for an end; the second ends the program.
pub(super) fn gently() {
    GENTLE.store(true, Ordering::SeqCst);
}

/// Whether a signal asked for an end.
pub(super) fn is_asked() -> bool {
    ASKED.load(Ordering::SeqCst)
}

fn stop() {
    if GENTLE.load(Ordering::SeqCst) && !ASKED.swap(true, Ordering::SeqCst) {
        return;
    }
    // Holds the lock to the end: a thread that wants to write next waits forever.
    let folders = unfinished();
    for folder in folders.iter() {
        let _ = fs::remove_dir_all(folder);
    }
    process::exit(STOPPED);
}
