//! ZIP archives (アーカイブ), with 64-bit places where they are large: what genga needs of APPNOTE.TXT 6.3.

use std::io::{self, Read};

use super::Manifest;

/// The first day that an archive can name, so that the same files are the same bytes.
const DATE: u16 = 0x21;
/// Names are UTF-8.
const FLAGS: u16 = 1 << 11;
const STORED: u16 = 0;
const DEFLATED: u16 = 8;
/// Programs that read entries of 2.0, and large archives of 4.5.
const VERSION: (u16, u16) = (20, 45);
/// Written by Unix, where a file has modes.
const MADE_BY: u16 = 3 << 8 | 45;
const MODE: u32 = 0o100_644 << 16;
/// The field with the digest of a file; other programs pass over it.
const DIGEST: u16 = 0x6767;
const LOCAL: u32 = 0x0403_4b50;
const CENTRAL: u32 = 0x0201_4b50;
const END: u32 = 0x0605_4b50;
const END_64: u32 = 0x0606_4b50;
const WHERE_64: u32 = 0x0706_4b50;
/// A number that stands in a field of 64 bits elsewhere.
const ELSEWHERE: u32 = u32::MAX;
/// Bytes of an entry before its name.
const HEAD: usize = 30;
/// From 1 to 9: larger ones take several times as long for a few percent.
const LEVEL: u8 = 6;

/// An archive of files with their names.
///
/// # Errors
/// Those of [`Entry::write`].
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

/// What the directory says of an entry.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Entry {
    method: u16,
    crc: u32,
    packed: u32,
    bytes: u32,
    /// Bytes before the packed ones.
    head: u32,
}

impl Entry {
    /// Bytes of the entry with its head.
    pub fn length(&self) -> u64 {
        u64::from(self.head) + u64::from(self.packed)
    }

    /// Packs a file, unless it gets larger by it, and appends it.
    ///
    /// # Errors
    /// One that says which limit of such an archive is passed.
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

    /// What both heads have alike.
    fn put(&self, to: &mut Vec<u8>) {
        put16(to, [FLAGS, self.method, 0, DATE]);
        put32(to, [self.crc, self.packed, self.bytes]);
    }

    /// Reads the next entry with its name and digest, and passes over its bytes. None where no whole one of ours follows; `left` is
    /// how many bytes do.
    ///
    /// # Errors
    /// Those of `from`.
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

/// The directory at the end of an archive.
#[derive(Debug, Default)]
pub struct Directory {
    bytes: Vec<u8>,
    count: u64,
}

impl Directory {
    /// Bytes of an archive without entries.
    pub const LEAST: u64 = 22;

    /// Names an entry that begins there.
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

    /// The directory of an archive whose entries end there.
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

    /// What Python's zipfile finds, if it is here: how many entries, and the last with its text and date.
    fn by_python(file: &std::path::Path) -> Option<String> {
        let program = "import sys, zipfile; z = zipfile.ZipFile(sys.argv[1]); i = z.infolist(); \
                       print(len(i), ascii(i[-1].filename), z.read(i[-1]).decode(), i[-1].date_time[:3])";
        let output = Command::new("python3").args(["-c", program]).arg(file).output().ok()?;
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        Some(String::from_utf8(output.stdout).unwrap().trim().to_owned())
    }

    /// An archive whose entries begin at `begin`, as a sparse file.
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
