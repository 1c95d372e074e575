//! Reads a file in blocks of whole lines, small enough to stay in the CPU cache from the copy to the
//! parsing.

use std::fs::File;
use std::io;
use std::ops::Range;

use memchr::{memchr, memchr_iter, memrchr};

/// Bytes in a block.
const BLOCK: usize = 128 << 10;

/// A part of a file, read block by block.
pub(super) struct Blocks<'f> {
    file: &'f File,
    /// The byte range that has not been read yet.
    ahead: Range<u64>,
    buffer: Vec<u8>,
    /// Buffer range of the incomplete last line, which continues in the next block.
    cut: Range<usize>,
}

impl<'f> Blocks<'f> {
    /// Creates the blocks of a byte range that begins at a line start.
    pub(super) fn new(file: &'f File, range: Range<u64>) -> Self {
        let size = range.end.saturating_sub(range.start).min(BLOCK as u64);
        Self { file, ahead: range, buffer: vec![0; size as usize], cut: 0..0 }
    }

    /// Number of bytes that have not been read yet.
    pub(super) fn left(&self) -> Option<usize> {
        usize::try_from(self.ahead.end - self.ahead.start).ok()
    }

    /// Returns the next whole lines; empty at the end. `None` if reading fails or a line is longer than a
    /// block.
    pub(super) fn next(&mut self) -> Option<&[u8]> {
        self.buffer.copy_within(self.cut.clone(), 0);
        let kept = self.cut.len();
        let left = self.left()?;
        let room = &mut self.buffer[kept..];
        let size = room.len().min(left);
        read_exact_at(self.file, &mut room[..size], self.ahead.start).ok()?;
        self.ahead.start += size as u64;
        let filled = kept + size;
        let is_last = self.ahead.is_empty();
        let end = if is_last { filled } else { memrchr(b'\n', &self.buffer[..filled])? + 1 };
        self.cut = end..filled;
        Some(&self.buffer[..end])
    }
}

/// The length of a regular file; `None` for a pipe.
pub(super) fn length(file: &File) -> Option<u64> {
    let about = file.metadata().ok()?;
    about.is_file().then_some(about.len())
}

/// Splits a range that begins at a line start into about equal parts of whole lines. `None` if there are
/// too few lines for that, or if a line is too long.
pub(super) fn split_at_lines(
    file: &File,
    range: Range<u64>,
    parts: usize,
) -> Option<Vec<Range<u64>>> {
    let mut rest = range;
    let mut split = Vec::with_capacity(parts);
    for left in (2..=parts as u64).rev() {
        let about = rest.start + (rest.end - rest.start) / left;
        let mut ahead = Blocks::new(file, about..rest.end);
        let end = about + memchr(b'\n', ahead.next()?)? as u64 + 1;
        split.push(rest.start..end);
        rest.start = end;
    }
    split.push(rest);
    Some(split)
}

/// Counts the lines in a range; the last may lack a line end.
pub(super) fn lines(file: &File, range: Range<u64>) -> Option<usize> {
    let mut blocks = Blocks::new(file, range);
    let (mut lines, mut last) = (0, b'\n');
    loop {
        let block = blocks.next()?;
        let Some(&byte) = block.last() else { return Some(lines + usize::from(last != b'\n')) };
        lines += memchr_iter(b'\n', block).count();
        last = byte;
    }
}

#[cfg(unix)]
fn read_exact_at(file: &File, buffer: &mut [u8], at: u64) -> io::Result<()> {
    std::os::unix::fs::FileExt::read_exact_at(file, buffer, at)
}

#[cfg(windows)]
fn read_exact_at(file: &File, mut buffer: &mut [u8], mut at: u64) -> io::Result<()> {
    while !buffer.is_empty() {
        let read = std::os::windows::fs::FileExt::seek_read(file, buffer, at)?;
        if read == 0 {
            return Err(io::ErrorKind::UnexpectedEof.into());
        }
        buffer = &mut buffer[read..];
        at += read as u64;
    }
    Ok(())
}

#[cfg(not(any(unix, windows)))]
fn read_exact_at(_: &File, _: &mut [u8], _: u64) -> io::Result<()> {
    Err(io::ErrorKind::Unsupported.into())
}

#[cfg(test)]
mod tests {
    use std::io::Write;

    use super::*;

    fn file(text: &[u8]) -> File {
        let mut file = tempfile::tempfile().unwrap();
        file.write_all(text).unwrap();
        file
    }

    fn all(mut blocks: Blocks) -> Option<Vec<Vec<u8>>> {
        std::iter::from_fn(|| match blocks.next() {
            Some([]) => None,
            block => Some(block.map(<[u8]>::to_vec)),
        })
        .collect()
    }

    #[test]
    fn blocks_are_whole_lines_and_nothing_is_lost() {
        let line = "x".repeat(999);
        for end in ["", "\n"] {
            let text = vec![line.as_str(); 1000].join("\n") + end;
            let file = file(text.as_bytes());
            let blocks = all(Blocks::new(&file, 0..text.len() as u64)).unwrap();
            assert!(blocks.len() > 5);
            assert!(blocks.iter().rev().skip(1).all(|block| block.ends_with(b"\n")));
            assert_eq!(blocks.concat(), text.as_bytes());
            assert_eq!(lines(&file, 0..text.len() as u64), Some(1000));
            assert_eq!(lines(&file, 0..5000), Some(5), "{end:?}");
            assert_eq!(lines(&file, 0..5001), Some(6), "{end:?}");
        }
    }

    #[test]
    fn a_line_longer_than_a_block_and_a_file_that_got_shorter_are_left_to_others() {
        let long = file(&[b'x'; 2 * BLOCK]);
        assert_eq!(all(Blocks::new(&long, 0..2 * BLOCK as u64)), None);
        let short = file(b"1 2\n");
        assert_eq!(all(Blocks::new(&short, 0..5)), None);
        assert_eq!(all(Blocks::new(&short, 0..4)), Some(vec![b"1 2\n".to_vec()]));
        assert_eq!(all(Blocks::new(&short, 4..4)), Some(vec![]));
    }

    #[test]
    fn parts_are_whole_lines_and_nothing_is_lost() {
        for frames in [20, 21, 100] {
            let text: String = (0..frames).map(|frame| format!("{frame} 0.5\n")).collect();
            let file = file(text.as_bytes());
            for parts in [1, 2, 3, 5] {
                let split = split_at_lines(&file, 4..text.len() as u64, parts).unwrap();
                assert_eq!(split.len(), parts);
                assert_eq!((split[0].start, split[parts - 1].end), (4, text.len() as u64));
                for pair in split.windows(2) {
                    assert_eq!(pair[0].end, pair[1].start);
                    assert_eq!(text.as_bytes()[pair[0].end as usize - 1], b'\n');
                }
            }
        }
    }

    #[test]
    fn only_a_regular_file_has_a_length() {
        assert_eq!(length(&file(b"1 2\n")), Some(4));
        assert_eq!(length(&File::open(env!("CARGO_MANIFEST_DIR")).unwrap()), None);
    }
}
