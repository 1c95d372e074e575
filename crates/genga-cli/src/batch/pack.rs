//! One archive instead of a folder per clip (梱包): `clips.zip`, or `clips-1-of-4.zip` for a part.
//!
//! A finished clip is appended to a spool, already in archive form, before its line in the journal. At the end the
//! archive is assembled from the spool and the previous archive, in the order of the list, and the spool is removed.
//! Every entry stores its file's digest in an extra field, so that a version is recognized without unpacking.

use std::collections::{BTreeMap, HashMap};
use std::fs::{self, File, OpenOptions};
use std::io::{self, BufReader, BufWriter, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use super::super::failure::Failure;
use super::super::staging::Staging;
use super::super::stop;
use super::journal::{Header, Journal};
use super::place::{CLIPS, foreign};
use super::tables;
use genga_files::zip::{Directory, Entry};

/// The archive and the spool of a part.
#[derive(Debug)]
pub(crate) struct Pack {
    archive: PathBuf,
    spool: PathBuf,
    /// The spool and the archive of an earlier batch, each with its end offset.
    files: [Option<(File, u64)>; 2],
    /// Entries by name and digest.
    known: HashMap<(String, String), Piece>,
}

/// Position of an entry.
#[derive(Debug, Clone, Copy)]
struct Piece {
    file: usize,
    begin: u64,
    entry: Entry,
}

/// File name of the archive of a whole list.
pub(crate) const ARCHIVE: &str = "clips.zip";
/// Indices into `files`.
const SPOOL: usize = 0;
const PACKED: usize = 1;

/// The entries of a clip in progress.
#[derive(Debug, Default)]
pub(crate) struct Parcel {
    bytes: Vec<u8>,
    entries: Vec<((String, String), u64, Entry)>,
}

impl Parcel {
    /// Packs a file of a clip.
    pub(crate) fn add(
        &mut self,
        clip: &str,
        file: &str,
        digest: &str,
        bytes: &[u8],
    ) -> io::Result<()> {
        let (name, begin) = (called(clip, file), self.bytes.len() as u64);
        let entry = Entry::write(&name, digest, bytes, &mut self.bytes)?;
        self.entries.push(((name, digest.to_owned()), begin, entry));
        Ok(())
    }
}

/// Name of a file in the archive: its path as it would be in the folder.
fn called(clip: &str, file: &str) -> String {
    format!("{CLIPS}/{clip}/{file}")
}

impl Pack {
    /// Opens the archive of a part for reading.
    pub(crate) fn read(folder: &Path, header: &Header) -> Result<Self, Failure> {
        let stem = match header.parts {
            1 => CLIPS.to_owned(),
            parts => format!("{CLIPS}-{}-of-{parts}", header.part),
        };
        let place = |ending: &str| folder.join(format!("{stem}.{ending}"));
        let (archive, spool) = (place("zip"), place("spool"));
        let mut pack = Self { archive, spool, files: [None, None], known: HashMap::new() };
        pack.take(PACKED)?;
        pack.take(SPOOL)?;
        Ok(pack)
    }

    /// Opens the archive of a part for writing. An incomplete last entry is cut off. An archive that no batch wrote is
    /// refused unless `is_forced`.
    pub(crate) fn open(folder: &Path, header: &Header, is_forced: bool) -> Result<Self, Failure> {
        let mut pack = Self::read(folder, header)?;
        if pack.is_foreign() && !is_forced {
            return Err(foreign(&pack.archive, "archive"));
        }
        let end = pack.files[SPOOL].take().map_or(0, |(_, end)| end);
        let open = || OpenOptions::new().read(true).append(true).create(true).open(&pack.spool);
        let file = open().and_then(|file| file.set_len(end).map(|()| file));
        pack.files[SPOOL] = Some((file.map_err(|error| Failure::io(&pack.spool, error))?, end));
        Ok(pack)
    }

    /// Whether there is an archive or a spool.
    pub(crate) fn is_there(&self) -> bool {
        self.files.iter().any(Option::is_some)
    }

    /// Whether there is an archive without a single entry of a batch.
    fn is_foreign(&self) -> bool {
        self.files[PACKED].as_ref().is_some_and(|(_, end)| *end == 0)
            && fs::metadata(&self.archive).is_ok_and(|about| about.len() > Directory::LEAST)
    }

    /// Path of the archive.
    pub(crate) fn path(&self) -> &Path {
        &self.archive
    }

    /// Indexes the entries of a file, if it exists; the later of two with the same version wins.
    fn take(&mut self, which: usize) -> Result<(), Failure> {
        let path = if which == SPOOL { &self.spool } else { &self.archive };
        let file = match File::open(path) {
            Ok(file) => file,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(()),
            Err(error) => return Err(Failure::io(path, error)),
        };
        let (mut begin, mut entries) = (0, BufReader::new(&file));
        let all = file.metadata().map_err(|error| Failure::io(path, error))?.len();
        loop {
            let read = Entry::read(&mut entries, all - begin);
            let Some((name, digest, entry)) = read.map_err(|error| Failure::io(path, error))?
            else {
                break;
            };
            self.known.insert((name, digest), Piece { file: which, begin, entry });
            begin += entry.length();
        }
        drop(entries);
        self.files[which] = Some((file, begin));
        Ok(())
    }

    /// Whether all files of a clip are in the archive, unchanged.
    pub(crate) fn has(&self, clip: &str, files: &BTreeMap<String, String>) -> bool {
        files.iter().all(|(file, digest)| self.piece(clip, file, digest).is_some())
    }

    fn piece(&self, clip: &str, file: &str, digest: &str) -> Option<&Piece> {
        self.known.get(&(called(clip, file), digest.to_owned()))
    }

    /// Appends a clip to the spool.
    pub(crate) fn add(&mut self, parcel: Parcel) -> Result<(), Failure> {
        let Some((file, end)) = &mut self.files[SPOOL] else { return Ok(()) };
        file.write_all(&parcel.bytes).map_err(|error| Failure::io(&self.spool, error))?;
        for (key, begin, entry) in parcel.entries {
            self.known.insert(key, Piece { file: SPOOL, begin: *end + begin, entry });
        }
        *end += parcel.bytes.len() as u64;
        Ok(())
    }

    fn copy(&self, piece: &Piece, to: &mut impl Write) -> io::Result<()> {
        let Some((file, _)) = &self.files[piece.file] else { return Ok(()) };
        let mut file: &File = file;
        file.seek(SeekFrom::Start(piece.begin))?;
        let copied = io::copy(&mut file.take(piece.entry.length()), to)?;
        match copied == piece.entry.length() {
            true => Ok(()),
            false => Err(io::ErrorKind::UnexpectedEof.into()),
        }
    }

    /// Removes the spool, once the archive has all of it.
    pub(crate) fn clear(self) {
        let Self { spool, files, .. } = self;
        drop(files);
        let _ = fs::remove_file(spool);
    }
}

/// An archive that is written beside its target.
pub(crate) struct Packing {
    place: PathBuf,
    staging: Staging,
    file: BufWriter<File>,
    end: u64,
    directory: Directory,
}

impl Packing {
    /// Begins an empty archive.
    pub(crate) fn begin(place: &Path) -> Result<Self, Failure> {
        let folder = place.parent().unwrap_or(Path::new("."));
        let begun = Staging::within(folder).and_then(|staging| {
            let file = BufWriter::new(File::create(staging.place("archive"))?);
            let (end, directory) = (0, Directory::default());
            Ok(Self { place: place.into(), staging, file, end, directory })
        });
        begun.map_err(|error| Failure::io(place, error))
    }

    /// Copies the files of a clip from the part that has them.
    pub(crate) fn clip(
        &mut self,
        packs: &[Pack],
        clip: &str,
        files: &BTreeMap<String, String>,
    ) -> Result<(), Failure> {
        for (file, digest) in files {
            let found = packs
                .iter()
                .find_map(|pack| pack.piece(clip, file, digest).map(|piece| (pack, piece)));
            let (pack, piece) = found.ok_or_else(|| {
                let name = called(clip, file);
                Failure::CouldNot(format!(
                    "{name} is in no archive of these parts; do them again with --pack"
                ))
            })?;
            self.directory.add(&called(clip, file), self.end, &piece.entry);
            pack.copy(piece, &mut self.file).map_err(|error| Failure::io(&pack.archive, error))?;
            self.end += piece.entry.length();
        }
        Ok(())
    }

    /// Moves the archive into its place.
    pub(crate) fn finish(mut self) -> Result<(), Failure> {
        let Self { place, staging, file, end, directory } = &mut self;
        let written = file.write_all(&directory.close(*end)).and_then(|()| file.flush());
        let put = || fs::rename(staging.place("archive"), &*place);
        written.and_then(|()| stop::undisturbed(put)).map_err(|error| Failure::io(place, error))
    }
}

/// Writes one archive of the named clips, in that order.
pub(crate) fn all<'a>(
    place: &Path,
    packs: &[Pack],
    journals: &[Journal],
    names: impl Iterator<Item = &'a str>,
) -> Result<(), Failure> {
    let mut packing = Packing::begin(place)?;
    for name in names {
        if let Some(line) = tables::line(journals, name)?.filter(|line| line.row.is_done()) {
            packing.clip(packs, name, &line.files)?;
        }
    }
    packing.finish()
}
