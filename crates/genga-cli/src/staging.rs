//! Writes files so that all of them take their places together (一括). They are first written to a folder beside the
//! target, the staging. A full disk, a signal or an error leaves the old files untouched.
//!
//! A new folder appears with a single rename. In an existing folder, all files that are removed or replaced are moved
//! out before the first new one is moved in. The last file in the order of [`Bundle::add`] completes the run. If a run
//! is killed in between, the folder has files of one run only, never of two, and the next run finishes the job.

use std::collections::BTreeMap;
use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

use super::failure::Failure;
use super::stop;
use genga::error::Error;

/// Attempts to create a staging if another run removes it in between.
const TRIES: usize = 20;
/// Prefix and suffix of the names of stagings.
const NAME: (&str, &str) = (".genga-", ".tmp");
/// File that is locked as long as its run lives.
const LOCK: &str = "lock";
/// Subfolder of the new files.
const NEW: &str = "new";
/// Subfolder of the old files, until all new ones are in place.
const OLD: &str = "old";
/// File that lists which files come and go. It is written once all are ready; from then on the run is carried out, by
/// the next run if need be.
const ORDER: &str = "order.json";

/// A folder for unfinished files, beside their target. It is removed when dropped.
pub(super) struct Staging {
    path: PathBuf,
    lock: File,
}

impl Staging {
    /// Creates a staging in a folder, after removing those of dead runs.
    pub(super) fn within(folder: &Path) -> io::Result<Self> {
        sweep(folder);
        for _ in 0..TRIES {
            if let Some(staging) = Self::made(folder)? {
                return Ok(staging);
            }
        }
        Err(io::Error::other("no folder for unfinished files can be kept here"))
    }

    /// Creates a staging and locks it. Returns `None` if another run mistook it for a dead run's and removed it before
    /// it was locked.
    fn made(folder: &Path) -> io::Result<Option<Self>> {
        let (begin, end) = NAME;
        let path = stop::remember(|| {
            let folder = std::path::absolute(folder)?;
            let made = tempfile::Builder::new().prefix(begin).suffix(end).tempdir_in(folder);
            // Its own words name the staging, which a person does not know.
            Ok(made.map_err(|error| io::Error::from(error.kind()))?.keep())
        })?;
        let lock = File::create(path.join(LOCK)).and_then(|lock| {
            // On a file system without locks, the staging of a dead run is never removed.
            let _ = lock.lock();
            fs::create_dir(path.join(NEW)).map(|()| lock)
        });
        match lock {
            Ok(lock) => Ok(Some(Self { path, lock })),
            Err(error) => {
                let is_taken = !path.exists();
                stop::clear(&path);
                if is_taken { Ok(None) } else { Err(error) }
            }
        }
    }

    /// Path at which a file waits.
    pub(super) fn place(&self, name: &str) -> PathBuf {
        self.path.join(NEW).join(name)
    }

    /// Moves staged files into their places in a folder, and removes those in `go`: all of them or none.
    pub(super) fn exchange(
        &self,
        folder: &Path,
        come: Vec<String>,
        go: Vec<String>,
    ) -> Result<(), Error> {
        Order { come, go }.begin(&self.path, folder)?;
        // Carried out; the next run must not take it for unfinished.
        fs::remove_file(self.path.join(ORDER)).map_err(|source| io_error(folder, source))
    }
}

impl Drop for Staging {
    fn drop(&mut self) {
        let _ = self.lock.unlock();
        stop::clear(&self.path);
    }
}

/// Removes the stagings of dead runs from a folder, and finishes any renames that one of them had begun.
pub(super) fn sweep(folder: &Path) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for entry in entries.flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        let staging = entry.path();
        if !(name.starts_with(NAME.0) && name.ends_with(NAME.1) && staging.is_dir()) {
            continue;
        }
        // A living run holds the lock. A staging without a lock file is empty, and its run is dead or will create
        // another; or it has files, which come after the lock, and is half removed.
        let Ok(lock) = File::open(staging.join(LOCK)) else {
            let has_files = [NEW, OLD].iter().any(|inside| staging.join(inside).exists());
            let _ = match has_files && !staging.join(LOCK).exists() {
                true => fs::remove_dir_all(staging),
                false => fs::remove_dir(staging),
            };
            continue;
        };
        match lock.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock | TryLockError::Error(_)) => continue,
        }
        let order = fs::read(staging.join(ORDER)).ok();
        let order = order.and_then(|text| serde_json::from_slice::<Order>(&text).ok());
        let is_done = order.is_none_or(|order| order.carry_out(&staging, folder).is_ok());
        if is_done {
            let _ = fs::remove_dir_all(staging);
        }
        // Unlocks only after the removal, so that a run that just created this staging finds it gone.
        drop(lock);
    }
}

/// Files to be written to a folder together.
pub(super) struct Bundle<'a> {
    folder: &'a Path,
    staging: Staging,
    /// Whether the folder existed before.
    is_there: bool,
    /// The files in the order in which they come, with their digests.
    files: Vec<(String, String)>,
}

impl<'a> Bundle<'a> {
    /// Begins an empty bundle for a folder, which need not exist yet.
    pub(super) fn begin(folder: &'a Path) -> Result<Self, Failure> {
        check_folder(folder)?;
        let is_there = folder.exists();
        // A run that was killed right after the folder appeared left its staging in the parent folder.
        sweep(folder.parent().map_or(Path::new("."), there));
        let staging = Staging::within(there(folder)).map_err(|source| io_error(folder, source))?;
        Ok(Self { folder, staging, is_there, files: Vec::new() })
    }

    /// The target folder.
    pub(super) fn folder(&self) -> &Path {
        self.folder
    }

    /// The files added so far and their digests, by name.
    pub(super) fn files(&self) -> BTreeMap<String, String> {
        self.files.iter().cloned().collect()
    }

    /// Writes a file to the staging. Its name may contain folders, separated by `/`.
    pub(super) fn add(&mut self, name: &str, bytes: impl AsRef<[u8]>) -> Result<(), Error> {
        let place = self.folder.join(name);
        if place.is_dir() {
            return Err(io_error(
                &place,
                io::Error::other("is a folder in the way of a file; move it"),
            ));
        }
        let inside = Path::new(name).ancestors().skip(1).map(|inside| self.folder.join(inside));
        if let Some(file) = inside.into_iter().find(|inside| inside.is_file()) {
            return Err(io_error(
                &file,
                io::Error::other("is a file in the way of a folder; move it"),
            ));
        }
        let staged = self.staging.place(name);
        let write = || {
            staged.parent().map_or(Ok(()), fs::create_dir_all)?;
            fs::write(&staged, bytes.as_ref())
        };
        // Keeps a signal from interrupting the write or from clearing the staging meanwhile.
        stop::undisturbed(write).map_err(|source| io_error(&place, source))?;
        let digest = genga_files::Manifest::digest(bytes.as_ref());
        self.files.retain(|(other, _)| other != name);
        self.files.push((name.to_owned(), digest));
        Ok(())
    }

    /// Takes a file back, so that the one in its place stays.
    pub(super) fn leave(&mut self, name: &str) -> Result<(), Error> {
        self.files.retain(|(other, _)| other != name);
        let staged = self.staging.place(name);
        stop::undisturbed(|| fs::remove_file(&staged)).map_err(|source| io_error(&staged, source))
    }

    /// Moves all files into their places, and removes those in `gone`.
    pub(super) fn finish(self, gone: Vec<String>) -> Result<(), Failure> {
        let Self { folder, staging, is_there, files } = self;
        let order = Order { come: files.into_iter().map(|(name, _)| name).collect(), go: gone };
        let put = || match is_there {
            true => order.begin(&staging.path, folder),
            false => appear(&staging.path.join(NEW), folder),
        };
        Ok(stop::undisturbed(put)?)
    }
}

/// Returns the folder itself or its nearest existing ancestor.
fn there(folder: &Path) -> &Path {
    let is_there = |folder: &&Path| folder.as_os_str().is_empty() || folder.is_dir();
    let nearest = folder.ancestors().find(is_there).unwrap_or(folder);
    if nearest.as_os_str().is_empty() { Path::new(".") } else { nearest }
}

/// Fails if a file or a device is in the way of a folder.
pub(super) fn check_folder(folder: &Path) -> Result<(), Error> {
    let file = folder.ancestors().find(|above| above.exists() && !above.is_dir());
    let failed = |file| io_error(file, io::Error::other("is a file; name a folder"));
    file.map_or(Ok(()), |file| Err(failed(file)))
}

/// Renames the staged folder to its final name.
fn appear(staged: &Path, folder: &Path) -> Result<(), Error> {
    let rename = || {
        folder.parent().map_or(Ok(()), fs::create_dir_all)?;
        fs::rename(staged, folder)
    };
    rename().map_err(|source| io_error(folder, source))
}

/// The renames and removals that carry out a run.
#[derive(serde::Serialize, serde::Deserialize)]
struct Order {
    /// Files that come; the one that completes the run is last.
    come: Vec<String>,
    /// Files that are removed.
    go: Vec<String>,
}

impl Order {
    /// Records the order and carries it out; takes it back on failure.
    fn begin(&self, staging: &Path, folder: &Path) -> Result<(), Error> {
        self.note(staging).map_err(|source| io_error(folder, source))?;
        self.carry_out(staging, folder).inspect_err(|_| self.take_back(staging, folder))
    }

    /// Writes the order to the staging for the next run.
    fn note(&self, staging: &Path) -> io::Result<()> {
        let text = serde_json::to_vec(self).expect("names are plain data");
        fs::write(staging.join(ORDER), text)
    }

    /// Carries out the remaining renames.
    fn carry_out(&self, staging: &Path, folder: &Path) -> Result<(), Error> {
        for (from, to) in self.steps(staging, folder) {
            // A person knows the place in the folder, and not the staging.
            let place = if to.starts_with(staging) { &from } else { &to };
            shift(&from, &to).map_err(|source| io_error(place, source))?;
        }
        self.go.iter().for_each(|name| remove_empty(folder, name));
        Ok(())
    }

    /// Lists the remaining renames. Files that are removed or replaced leave first, the one that completes the run
    /// before all others; then the new files come in.
    fn steps(&self, staging: &Path, folder: &Path) -> Vec<(PathBuf, PathBuf)> {
        let (new, old) = (staging.join(NEW), staging.join(OLD));
        let place = |name: &String| behind_link(&folder.join(name));
        let comes = |name: &&String| new.join(name).exists();
        let leaves = |name: &&String| place(name).is_file() && !old.join(name).exists();
        let replaced = self.come.iter().rev().filter(comes);
        let out = replaced.chain(&self.go).filter(leaves).map(|name| (place(name), old.join(name)));
        let into = self.come.iter().filter(comes).map(|name| (new.join(name), place(name)));
        out.chain(into).collect()
    }

    fn take_back(&self, staging: &Path, folder: &Path) {
        let (new, old) = (staging.join(NEW), staging.join(OLD));
        for name in &self.come {
            if !new.join(name).exists() {
                let _ = fs::remove_file(behind_link(&folder.join(name)));
                remove_empty(folder, name);
            }
        }
        for name in self.go.iter().chain(&self.come) {
            if old.join(name).exists() {
                let _ = shift(&old.join(name), &behind_link(&folder.join(name)));
            }
        }
        let _ = fs::remove_file(staging.join(ORDER));
    }
}

/// Moves a file; copies it if a link leads to another disk.
fn shift(from: &Path, to: &Path) -> io::Result<()> {
    to.parent().map_or(Ok(()), fs::create_dir_all)?;
    match fs::rename(from, to) {
        Err(error) if error.kind() == io::ErrorKind::CrossesDevices => {
            fs::copy(from, to)?;
            fs::remove_file(from)
        }
        done => done,
    }
}

/// Removes the folders of a removed file that are now empty.
fn remove_empty(folder: &Path, name: &str) {
    let inside = Path::new(name).ancestors().skip(1);
    for inside in inside.take_while(|inside| !inside.as_os_str().is_empty()) {
        let _ = fs::remove_dir(folder.join(inside));
    }
}

/// Most links followed in a row.
const MOST_LINKS: usize = 40;

/// Resolves a symbolic link, whether its target exists or not, so that the link itself is kept. Any other path is
/// returned as it is.
pub(super) fn behind_link(path: &Path) -> PathBuf {
    let mut path = path.to_owned();
    for _ in 0..MOST_LINKS {
        let Ok(target) = fs::read_link(&path) else { break };
        path = path.parent().unwrap_or(Path::new("")).join(target);
    }
    path
}

fn io_error(path: &Path, source: io::Error) -> Error {
    Error::Io { path: path.to_owned(), source }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let mut names: Vec<_> = fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn more_files_than_can_be_open_take_their_places_together() {
        let place = tempfile::tempdir().unwrap();
        let folder = place.path().join("a/b");
        let mut bundle = Bundle::begin(&folder).unwrap();
        bundle.add("sheet.json", "{}").unwrap();
        for number in 0..3000 {
            bundle.add(&format!("images/A_{number:04}.png"), [number as u8]).unwrap();
        }
        assert!(!folder.join("sheet.json").exists(), "not before all are made");
        bundle.finish(Vec::new()).unwrap();
        assert_eq!(names(&folder), ["images", "sheet.json"]);
        assert_eq!(names(&folder.join("images")).len(), 3000);
        assert_eq!(fs::read(folder.join("images/A_0007.png")).unwrap(), [7]);
    }

    #[test]
    fn what_is_not_finished_leaves_nothing_that_was_not_there() {
        let place = tempfile::tempdir().unwrap();
        fs::write(place.path().join("taken"), "old").unwrap();
        let folder = place.path().join("a/b");
        let mut bundle = Bundle::begin(&folder).unwrap();
        bundle.add("images/A_0001.png", "new").unwrap();
        assert!(!place.path().join("a").exists());
        drop(bundle);
        assert_eq!(names(place.path()), ["taken"]);
        // An existing folder stays, with its contents.
        fs::create_dir_all(place.path().join("a/images")).unwrap();
        fs::write(place.path().join("a/sheet.json"), "old").unwrap();
        let folder = place.path().join("a");
        let mut bundle = Bundle::begin(&folder).unwrap();
        bundle.add("sheet.json", "new").unwrap();
        bundle.add("images/A_0001.png", "new").unwrap();
        assert!(bundle.add("sheet.json/A_0001.png", "new").is_err(), "a file stands there");
        assert!(bundle.add("images", "new").is_err(), "a folder stands there");
        drop(bundle);
        assert_eq!(names(&folder), ["images", "sheet.json"]);
        assert_eq!(names(&folder.join("images")), [""; 0]);
        assert_eq!(fs::read(folder.join("sheet.json")).unwrap(), b"old");
        assert!(Bundle::begin(&place.path().join("taken")).is_err());
        assert!(Bundle::begin(&place.path().join("taken/under")).is_err());
        assert_eq!(names(place.path()), ["a", "taken"]);
    }

    /// Contents of all files by name, those in subfolders too.
    fn all(folder: &Path) -> BTreeMap<String, String> {
        let mut found = BTreeMap::new();
        for name in names(folder).into_iter().filter(|name| !name.starts_with('.')) {
            let path = folder.join(&name);
            if path.is_dir() {
                let inside = all(&path).into_iter();
                found.extend(inside.map(|(file, text)| (format!("{name}/{file}"), text)));
            } else {
                found.insert(name, fs::read_to_string(path).unwrap());
            }
        }
        found
    }

    fn put(folder: &Path, files: &[&str], go: &[&str], text: &str) -> (Staging, Order) {
        let mut bundle = Bundle::begin(folder).unwrap();
        files.iter().for_each(|name| bundle.add(name, text).unwrap());
        let Bundle { staging, files, .. } = bundle;
        let come = files.into_iter().map(|(name, _)| name).collect();
        (staging, Order { come, go: go.iter().map(|name| (*name).to_owned()).collect() })
    }

    /// Creates a folder with the files of a run and one of a person, and the next run for it: two files again, one new,
    /// one removed.
    fn two_runs(place: &Path) -> (Staging, Order) {
        let (first, order) = put(place, &["a", "images/b", "c", "manifest"], &[], "old");
        order.begin(&first.path, place).unwrap();
        fs::write(place.join("mine"), "mine").unwrap();
        put(place, &["a", "d/e", "c", "manifest"], &["images/b"], "new")
    }

    #[test]
    fn a_run_that_is_killed_leaves_files_of_one_run_and_the_next_finishes_it() {
        let steps = {
            let place = tempfile::tempdir().unwrap();
            let (staging, order) = two_runs(place.path());
            order.steps(&staging.path, place.path()).len()
        };
        assert_eq!(steps, 8);
        for killed_after in 0..=steps {
            let place = tempfile::tempdir().unwrap();
            let (staging, order) = two_runs(place.path());
            order.note(&staging.path).unwrap();
            let steps = order.steps(&staging.path, place.path());
            steps[..killed_after].iter().for_each(|(from, to)| shift(from, to).unwrap());
            // A killed process does not clean up, and its lock is free.
            staging.lock.unlock().unwrap();
            std::mem::forget(staging);
            let mut left = all(place.path());
            assert_eq!(left.remove("mine").unwrap(), "mine");
            let of_one = ["old", "new"].iter().any(|run| left.values().all(|text| text == run));
            assert!(of_one, "after {killed_after}: {left:?}");
            let is_closed = left.contains_key("manifest");
            assert!(!is_closed || killed_after == 0 || killed_after == 8, "{killed_after}");
            sweep(place.path());
            let new = ["a", "c", "d/e", "manifest"].map(|name| (name.to_owned(), "new".to_owned()));
            let whole = new.into_iter().chain([("mine".to_owned(), "mine".to_owned())]);
            assert_eq!(all(place.path()), whole.collect(), "after {killed_after}");
            assert_eq!(names(place.path()), ["a", "c", "d", "manifest", "mine"]);
        }
    }

    #[test]
    fn what_fails_half_way_is_taken_back() {
        let place = tempfile::tempdir().unwrap();
        let (staging, order) = two_runs(place.path());
        let before = all(place.path());
        // A folder blocks the place of the last file.
        fs::remove_file(staging.path.join(NEW).join("d/e")).unwrap();
        fs::create_dir(staging.path.join(NEW).join("d/e")).unwrap();
        fs::write(place.path().join("d"), "mine").unwrap();
        assert!(order.begin(&staging.path, place.path()).is_err());
        fs::remove_file(place.path().join("d")).unwrap();
        assert_eq!(all(place.path()), before);
    }

    #[test]
    fn a_staging_of_a_dead_run_goes_and_one_of_a_living_run_stays() {
        let place = tempfile::tempdir().unwrap();
        let dead = Staging::within(place.path()).unwrap();
        fs::write(dead.place("half"), "ha").unwrap();
        dead.lock.unlock().unwrap();
        let path = dead.path.clone();
        std::mem::forget(dead);
        // A third run was killed while it removed its own, the lock first.
        let half = place.path().join(".genga-half.tmp");
        fs::create_dir_all(half.join(NEW)).unwrap();
        fs::write(half.join(NEW).join("half"), "ha").unwrap();
        // Another run was killed before it had its lock.
        fs::create_dir(place.path().join(".genga-dead.tmp")).unwrap();
        let living = Staging::within(place.path()).unwrap();
        sweep(place.path());
        assert!(!path.exists() && !half.exists() && living.path.exists());
        assert_eq!(names(place.path()).len(), 1);
        drop(living);
        assert_eq!(names(place.path()), [""; 0]);
    }
    #[test]
    fn runs_that_begin_together_do_not_clear_each_other_away() {
        let place = tempfile::tempdir().unwrap();
        std::thread::scope(|scope| {
            for name in 0..8 {
                let place = place.path();
                scope.spawn(move || {
                    for _ in 0..50 {
                        let staging = Staging::within(place).unwrap();
                        fs::write(staging.place("file"), [name]).unwrap();
                        fs::rename(staging.place("file"), place.join(name.to_string())).unwrap();
                    }
                });
            }
        });
        assert_eq!(names(place.path()), ["0", "1", "2", "3", "4", "5", "6", "7"]);
    }
}
