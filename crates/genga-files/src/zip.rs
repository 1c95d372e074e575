//! ZIP archives (アーカイブ): the subset of APPNOTE.TXT 6.3 that genga needs, with ZIP64 for large archives.

use std::io::{self, Read};

use super::Manifest;

/// The MS-DOS date 1980-01-01, the earliest there is. A fixed date keeps the archive's bytes reproducible.
const DATE: u16 = 0x21;
/// General-purpose flags: file names are UTF-8.
const FLAGS: u16 = 1 << 11;
const STORED: u16 = 0;
const DEFLATED: u16 = 8;
/// Versions needed to extract: 2.0 for entries, 4.5 for ZIP64.
const VERSION: (u16, u16) = (20, 45);
/// Version made by: 4.5 on Unix, so that readers honour the file mode.
const MADE_BY: u16 = 3 << 8 | 45;
const MODE: u32 = 0o100_644 << 16;
/// ID of the extra field that holds a file's digest. Other programs skip it.
const DIGEST: u16 = 0x6767;
const LOCAL: u32 = 0x0403_4b50;
const CENTRAL: u32 = 0x0201_4b50;
const END: u32 = 0x0605_4b50;
const END_64: u32 = 0x0606_4b50;
const WHERE_64: u32 = 0x0706_4b50;
/// Marks a 32-bit field whose value is in the ZIP64 field or record instead.
const ELSEWHERE: u32 = u32::MAX;
/// Bytes of a local header before the name.
const HEAD: usize = 30;
/// Compression level, 1 to 9. Higher levels take several times as long for a few percent.
const LEVEL: u8 = 6;

/// Builds an archive of named files.
///
/// # Errors
/// The errors of [`Entry::write`].
pub fn archive<'a>(files: impl IntoIterator<Item = (&'a str, &'a [u8])>) -> io::Result<Vec<u8>> {
    let (mut to, mut directory) = (Vec::new(), Directory::default());
    for (name, bytes) in files {
        let begin = to.len() as u64;
        let entry = Entry::write(name, &Manifest::digest(bytes), bytes, &mut to)?;
        directory.add(name, begin, &entry);
    }
    let end = to.len() as u64;
    to.extend(directory.close(end));
    Ok(to)
}

/// The metadata of an archive entry.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Entry {
    method: u16,
    crc: u32,
    packed: u32,
    bytes: u32,
    /// Bytes of the local header, with name and extra field.
    head: u32,
}

impl Entry {
    /// Bytes of the entry, header included.
    pub fn length(&self) -> u64 {
        u64::from(self.head) + u64::from(self.packed)
    }

    /// Appends a file, compressed unless that makes it larger.
    ///
    /// # Errors
    /// An [`io::Error`] that says which limit of the ZIP format is exceeded.
    pub fn write(name: &str, digest: &str, bytes: &[u8], to: &mut Vec<u8>) -> io::Result<Self> {
        let mut packed = miniz_oxide::deflate::compress_to_vec(bytes, LEVEL);
        let is_smaller = packed.len() < bytes.len();
        if !is_smaller {
            packed.clear();
        }
        let body = if is_smaller { &packed[..] } else { bytes };
        let too = |what: &str| io::Error::other(format!("{name}: {what} for an archive"));
        let size = |length| u32::try_from(length).map_err(|_| too("4 GB or more is too large"));
        let short = |length| u16::try_from(length).map_err(|_| too("the name is too long"));
        let entry = Self {
            method: if is_smaller { DEFLATED } else { STORED },
            crc: crc32fast::hash(bytes),
            packed: size(body.len())?,
            bytes: size(bytes.len())?,
            head: size(HEAD + name.len() + 4 + digest.len())?,
        };
        put32(to, [LOCAL]);
        put16(to, [VERSION.0]);
        entry.put(to);
        put16(to, [short(name.len())?, short(4 + digest.len())?]);
        to.extend_from_slice(name.as_bytes());
        put16(to, [DIGEST, short(digest.len())?]);
        to.extend_from_slice(digest.as_bytes());
        to.extend_from_slice(body);
        Ok(entry)
    }

    /// Writes the fields that the local and the central header have in common.
    fn put(&self, to: &mut Vec<u8>) {
        put16(to, [FLAGS, self.method, 0, DATE]);
        put32(to, [self.crc, self.packed, self.bytes]);
    }

    /// Reads the next entry's header with its name and digest, and skips its bytes. Returns `None` if no complete
    /// entry written by genga follows. `left` is the number of remaining bytes.
    ///
    /// # Errors
    /// I/O errors of `from`.
    pub fn read<R: Read + io::Seek>(
        from: &mut io::BufReader<R>,
        left: u64,
    ) -> io::Result<Option<(String, String, Self)>> {
        let mut head = [0; HEAD];
        if left < HEAD as u64 {
            return Ok(None);
        }
        from.read_exact(&mut head)?;
        let two = |at: usize| u16::from_le_bytes([head[at], head[at + 1]]);
        let four =
            |at: usize| u32::from_le_bytes([head[at], head[at + 1], head[at + 2], head[at + 3]]);
        let (name, extra) = (usize::from(two(26)), usize::from(two(28)));
        let entry = Self {
            method: two(8),
            crc: four(14),
            packed: four(18),
            bytes: four(22),
            head: (HEAD + name + extra) as u32,
        };
        if four(0) != LOCAL || entry.length() > left || extra < 4 {
            return Ok(None);
        }
        let mut words = vec![0; name + extra];
        from.read_exact(&mut words)?;
        let field = &words[name..];
        if field[..2] != DIGEST.to_le_bytes() {
            return Ok(None);
        }
        from.seek_relative(i64::from(entry.packed))?;
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        Ok(Some((text(&words[..name]), text(&field[4..]), entry)))
    }
}

/// The central directory at the end of an archive.
#[derive(Debug, Default)]
pub struct Directory {
    bytes: Vec<u8>,
    count: u64,
}

impl Directory {
    /// Bytes of an archive without entries.
    pub const LEAST: u64 = 22;

    /// Lists an entry that begins at byte `begin`.
    pub fn add(&mut self, name: &str, begin: u64, entry: &Entry) {
        let small = u32::try_from(begin).ok().filter(|begin| *begin != ELSEWHERE);
        let to = &mut self.bytes;
        put32(to, [CENTRAL]);
        put16(to, [MADE_BY, if small.is_some() { VERSION.0 } else { VERSION.1 }]);
        entry.put(to);
        put16(to, [name.len() as u16, if small.is_some() { 0 } else { 12 }, 0, 0, 0]);
        put32(to, [MODE, small.unwrap_or(ELSEWHERE)]);
        to.extend_from_slice(name.as_bytes());
        if small.is_none() {
            put16(to, [1, 8]);
            to.extend_from_slice(&begin.to_le_bytes());
        }
        self.count += 1;
    }

    /// Returns the directory's bytes, for an archive whose entries end at byte `end`.
    pub fn close(&mut self, end: u64) -> Vec<u8> {
        let mut to = std::mem::take(&mut self.bytes);
        let size = to.len() as u64;
        let small = |number: u64| u32::try_from(number).unwrap_or(ELSEWHERE);
        let count = u16::try_from(self.count).unwrap_or(u16::MAX);
        if count == u16::MAX || small(size) == ELSEWHERE || small(end) == ELSEWHERE {
            put32(&mut to, [END_64]);
            to.extend_from_slice(&44_u64.to_le_bytes());
            put16(&mut to, [MADE_BY, VERSION.1]);
            put32(&mut to, [0, 0]);
            [self.count, self.count, size, end]
                .iter()
                .for_each(|number| to.extend_from_slice(&number.to_le_bytes()));
            put32(&mut to, [WHERE_64, 0]);
            to.extend_from_slice(&(end + size).to_le_bytes());
            put32(&mut to, [1]);
        }
        put32(&mut to, [END]);
        put16(&mut to, [0, 0, count, count]);
        put32(&mut to, [small(size), small(end)]);
        put16(&mut to, [0]);
        to
    }
}

fn put16<const N: usize>(to: &mut Vec<u8>, numbers: [u16; N]) {
    numbers.iter().for_each(|number| to.extend_from_slice(&number.to_le_bytes()));
}

fn put32<const N: usize>(to: &mut Vec<u8>, numbers: [u32; N]) {
    numbers.iter().for_each(|number| to.extend_from_slice(&number.to_le_bytes()));
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs::File;
    use std::io::{BufReader, Seek, SeekFrom, Write};
    use std::process::Command;

    /// The number of entries that Python's zipfile finds, and the last's name, text and date; `None` without Python.
    fn by_python(file: &std::path::Path) -> Option<String> {
        let program = "import sys, zipfile; z = zipfile.ZipFile(sys.argv[1]); i = z.infolist(); \
                       print(len(i), ascii(i[-1].filename), z.read(i[-1]).decode(), i[-1].date_time[:3])";
        let output = Command::new("python3").args(["-c", program]).arg(file).output().ok()?;
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        Some(String::from_utf8(output.stdout).unwrap().trim().to_owned())
    }

    /// An archive whose entries begin at byte `begin`, as a sparse file.
    fn archive(count: usize, begin: u64) -> tempfile::NamedTempFile {
        let file = tempfile::NamedTempFile::new().unwrap();
        let (mut bytes, mut directory, mut end) = (vec![], Directory::default(), begin);
        for at in 0..count {
            let (name, before) = (format!("clips/é {at}.json"), bytes.len());
            let entry = Entry::write(&name, "00ff", &[b'a'; 24], &mut bytes).unwrap();
            directory.add(&name, end, &entry);
            assert_eq!(entry.length(), (bytes.len() - before) as u64);
            end += entry.length();
        }
        bytes.extend(directory.close(end));
        let mut to: &File = file.as_file();
        to.seek(SeekFrom::Start(begin)).unwrap();
        to.write_all(&bytes).unwrap();
        file
    }

    #[test]
    fn others_read_archives_of_any_count_and_size() {
        for (count, begin) in [(1, 0), (70_000, 0), (3, 5_000_000_000)] {
            let file = archive(count, begin);
            let last = format!("clips/é {}.json", count - 1);
            match by_python(file.path()) {
                Some(said) => {
                    let last = last.replace('é', "\\xe9");
                    assert_eq!(said, format!("{count} '{last}' {} (1980, 1, 1)", "a".repeat(24)));
                }
                None => crate::real::without("python3"),
            }
            let mut entries = BufReader::new(File::open(file.path()).unwrap());
            entries.seek(SeekFrom::Start(begin)).unwrap();
            let mut left = file.as_file().metadata().unwrap().len() - begin;
            let (mut read, mut name) = (0, String::new());
            while let Some((found, digest, entry)) = Entry::read(&mut entries, left).unwrap() {
                assert_eq!(digest, "00ff");
                (read, name, left) = (read + 1, found, left - entry.length());
            }
            assert_eq!((read, name), (count, last));
        }
    }

    #[test]
    fn half_an_entry_is_none() {
        let mut bytes = Vec::new();
        Entry::write("a", "00ff", &[7; 900], &mut bytes).unwrap();
        for length in 0..bytes.len() {
            let mut from = BufReader::new(std::io::Cursor::new(&bytes[..length]));
            assert_eq!(Entry::read(&mut from, length as u64).unwrap(), None, "{length}");
        }
    }
}
