//! The fast reader of a regular motion table: one frame per line, plain numbers, nothing else.
//!
//! Nearly every file is regular, so this path is optimised for speed. It returns `None` on anything
//! unusual; the caller then starts again with the reader in `careful`, which can say what is wrong.

use std::fs::File;
use std::ops::Range;

use memchr::memchr;

use super::file::{self, Blocks};
use super::number::{self, is_blank};
use super::threads;

/// Reads all values of a table, frame after frame. Every line must be blank or one frame of `channels`
/// finite numbers. `said` is the number of frames that the file declares; it need not be true.
pub(super) fn read(text: &[u8], channels: usize, said: usize) -> Option<Vec<f64>> {
    let mut table = Growing::new(channels, said, text.len())?;
    table.take(text)?;
    table.finish()
}

/// Like [`read`], for a table whose first lines are in memory and whose other lines are still in the file.
pub(super) fn read_on(
    first: &[u8],
    mut blocks: Blocks,
    channels: usize,
    said: usize,
) -> Option<Vec<f64>> {
    let mut table = Growing::new(channels, said, first.len() + blocks.left()?)?;
    table.take(first)?;
    loop {
        match blocks.next()? {
            [] => return table.finish(),
            lines => table.take(lines)?,
        }
    }
}

/// Like [`read`], for a part of a file, with one thread for each of `parts`. The lines before a part
/// determine where its thread writes, so the number of lines must equal the declared number of frames.
pub(super) fn read_parts(
    file: &File,
    range: Range<u64>,
    channels: usize,
    said: usize,
    parts: usize,
) -> Option<Vec<f64>> {
    let most = most_values(usize::try_from(range.end - range.start).ok()?);
    let parts = file::split_at_lines(file, range, parts)?;
    let lines = threads::all(parts.iter().map(|part| || file::lines(file, part.clone())));
    let lines: Vec<usize> = lines.into_iter().collect::<Option<_>>()?;
    if lines.iter().sum::<usize>() != said || said.saturating_mul(channels) > most {
        return None;
    }
    let mut values = vec![0.0; said * channels];
    let mut left = &mut values[..];
    let targets = lines.iter().map(|lines| {
        let (target, after) = std::mem::take(&mut left).split_at_mut(lines * channels);
        left = after;
        target
    });
    let jobs = parts
        .into_iter()
        .zip(targets)
        .map(|(part, target)| || read_part(Blocks::new(file, part), channels, target));
    threads::all(jobs).into_iter().all(|is_read| is_read.is_some()).then_some(values)
}

/// Reads a part whose lines must be exactly the rows of `values`.
fn read_part(mut blocks: Blocks, channels: usize, values: &mut [f64]) -> Option<()> {
    let mut rows = values.chunks_exact_mut(channels);
    loop {
        let text = blocks.next()?;
        if text.is_empty() {
            return rows.next().is_none().then_some(());
        }
        let mut lines = Rows { text };
        while lines.has_more() {
            lines.next(rows.next()?)?;
        }
    }
}

/// Upper bound of the values in a text, whatever the file declares: a value and its blank take two bytes.
fn most_values(bytes: usize) -> usize {
    bytes / 2 + 1
}

/// A table that grows frame by frame, because the declared number of frames may be wrong.
struct Growing {
    values: Vec<f64>,
    channels: usize,
}

impl Growing {
    /// Creates a table; `None` if not even one frame fits in that many bytes.
    fn new(channels: usize, said: usize, bytes: usize) -> Option<Self> {
        let most = most_values(bytes);
        let values = Vec::with_capacity(said.saturating_mul(channels).min(most));
        (channels <= most).then_some(Self { values, channels })
    }

    /// Adds the frames of some whole lines.
    fn take(&mut self, lines: &[u8]) -> Option<()> {
        let mut rows = Rows { text: lines };
        while rows.has_more() {
            let begin = self.values.len();
            self.values.resize(begin + self.channels, 0.0);
            rows.next(&mut self.values[begin..])?;
        }
        Some(())
    }

    fn finish(self) -> Option<Vec<f64>> {
        Some(self.values).filter(|values| !values.is_empty())
    }
}

/// The lines that are still to be read.
struct Rows<'a> {
    text: &'a [u8],
}

impl Rows<'_> {
    /// Skips blank lines; returns false at the end.
    fn has_more(&mut self) -> bool {
        self.text = self.text.trim_ascii_start();
        !self.text.is_empty()
    }

    /// Reads the next line, which must hold exactly one number for each value of the row.
    fn next(&mut self, row: &mut [f64]) -> Option<()> {
        self.has_more();
        let text = self.text;
        let end = memchr(b'\n', text).unwrap_or(text.len());
        let mut at = 0;
        for value in row {
            while let Some(b' ' | b'\t') = text.get(at) {
                at += 1;
            }
            if let Some((number, length)) = number::short(&text[at..]) {
                *value = number;
                at += length + 1;
                continue;
            }
            let (number, length) = long(&text[at..])?;
            *value = number;
            at += length;
        }
        self.text = &text[end..];
        // The last value was taken with the blank after it, which may have been the line end. A cursor
        // beyond that is in the next line: this one was too short.
        let is_whole = |rest: &[u8]| rest.iter().all(|&byte| is_blank(byte));
        (at == end + 1 || text.get(at..end).is_some_and(is_whole)).then_some(())
    }
}

#[cold]
fn long(text: &[u8]) -> Option<(f64, usize)> {
    number::scan(text).filter(|(value, _)| value.is_finite())
}

#[cfg(test)]
mod tests {
    use std::io::Write;

    use proptest::prelude::*;

    use super::*;

    /// `read_parts` on a file with this text.
    fn in_parts(text: &str, channels: usize, said: usize, parts: usize) -> Option<Vec<f64>> {
        let file = file(text);
        read_parts(&file, 0..text.len() as u64, channels, said, parts)
    }

    /// `read_on` on a file with this text, of which the first bytes are already in memory.
    fn in_blocks(text: &str, first: usize, channels: usize, said: usize) -> Option<Vec<f64>> {
        let file = file(text);
        let blocks = Blocks::new(&file, first as u64..text.len() as u64);
        read_on(&text.as_bytes()[..first], blocks, channels, said)
    }

    fn file(text: &str) -> File {
        let mut file = tempfile::tempfile().unwrap();
        file.write_all(text.as_bytes()).unwrap();
        file
    }

    /// The reference: parses every word of every line with `str::parse`, slow but simple.
    fn oracle(text: &str, channels: usize) -> Option<Vec<u64>> {
        let mut values = Vec::new();
        for line in text.split('\n') {
            let line = line.trim_ascii();
            let row: Vec<f64> = line
                .split_ascii_whitespace()
                .map(|word| word.parse().ok())
                .collect::<Option<_>>()?;
            let is_plain = row.iter().all(|value| value.is_finite());
            if !row.is_empty() && (row.len() != channels || !is_plain || line.contains('\r')) {
                return None;
            }
            values.extend(row.into_iter().map(f64::to_bits));
        }
        (!values.is_empty()).then_some(values)
    }

    fn bits(values: Option<Vec<f64>>) -> Option<Vec<u64>> {
        values.map(|values| values.into_iter().map(f64::to_bits).collect())
    }

    #[test]
    fn a_regular_table_is_read_whatever_the_file_says_of_its_frames() {
        for text in [
            "1 2 3\n4 5 6\n",
            "1 2 3\n4 5 6",
            "\n\n1 2 3 \n  \n\t4\t5  6\t\n\n",
            "1 2 3\r\n4 5 6\r\n",
            "+1 .2e1 3.\n4 5e0 6\n",
        ] {
            for said in [0, 1, 2, 3, usize::MAX] {
                let values = read(text.as_bytes(), 3, said).unwrap_or_else(|| panic!("{text}"));
                assert_eq!(values, [1.0, 2.0, 3.0, 4.0, 5.0, 6.0], "{text}");
            }
        }
        assert_eq!(read(b" \n", 3, 1), None, "no frame is odd too");
    }

    #[test]
    fn whatever_is_odd_is_left_to_others() {
        for text in [
            "1 2\n3 4 5 6\n",
            "1 2 3 4\n5 6\n",
            "1 2 3\n4 5\n",
            "1 2 3\n4 5 6 7\n",
            "1 2 3 4 5 6\n",
            "1 2 nan\n",
            "1 2 1e999\n",
            "1 2 3-4\n",
            "1 2 0,5\n",
            "1 2 3}\n",
            "1\r2 3\n",
            "1 2\r3\n",
            "1 2 3\n\0",
        ] {
            assert_eq!(read(text.as_bytes(), 3, 2), None, "{text:?}");
            let long = format!("{}{text}{}", rows(9, "\n"), rows(9, "\n"));
            assert_eq!(read(long.as_bytes(), 3, 20), None, "{long:?}");
        }
    }

    /// `frames` rows of three values that encode their frame number.
    fn rows(frames: usize, end: &str) -> String {
        (0..frames).map(|frame| format!("{frame} {}.25 -0.{frame:04}{end}", frame % 1000)).collect()
    }

    #[test]
    fn from_a_file_in_blocks_or_in_parts_is_the_same_as_from_memory() {
        for end in ["\n", "\r\n", " \n"] {
            let text = rows(20_000, end);
            let whole = read(text.as_bytes(), 3, 20_000);
            assert!(whole.is_some());
            let first_lines = text.find('\n').unwrap() + 1;
            for said in [0, 1, 20_000, usize::MAX] {
                assert_eq!(in_blocks(&text, first_lines, 3, said), whole);
            }
            assert_eq!(in_blocks(&text, 0, 3, 20_000), whole);
            assert_eq!(in_blocks(text.trim_end(), text.trim_end().len(), 3, 20_000), whole);
            for parts in 1..6 {
                assert_eq!(in_parts(&text, 3, 20_000, parts), whole, "{parts}");
                assert_eq!(in_parts(text.trim_end(), 3, 20_000, parts), whole, "{parts}");
            }
        }
    }

    #[test]
    fn parts_need_the_frames_that_the_file_says() {
        let text = rows(1000, "\n");
        for said in [0, 999, 1001, usize::MAX] {
            assert_eq!(in_parts(&text, 3, said, 2), None, "{said}");
        }
        let odd = text.replacen("\n600 ", "\n600,5 ", 1);
        assert_eq!(in_parts(&odd, 3, 1000, 2), None);
        let blank = text.replacen("\n600 ", "\n\n600 ", 1);
        assert_eq!(in_parts(&blank, 3, 1001, 2), None);
        let joined = text.replacen("\n600 ", " 600 ", 1);
        assert_eq!(in_parts(&joined, 3, 999, 2), None);
    }

    #[test]
    fn lines_that_cannot_hold_what_is_said_reserve_nothing() {
        let text = "\n".repeat(1 << 20);
        assert_eq!(read(text.as_bytes(), 1 << 40, 1 << 20), None);
        assert_eq!(in_parts(&text, 1 << 40, 1 << 20, 2), None);
        assert_eq!(in_blocks(&text, 0, 1 << 40, 1), None);
        assert_eq!(read(&[text.as_bytes(), b"1"].concat(), 1 << 40, 1), None);
    }

    proptest! {
        #[test]
        fn any_table_is_read_as_std_reads_it_or_left_to_others(
            words in prop::collection::vec(prop::sample::select(WORDS.to_vec()), 0..40),
            channels in 1usize..4,
            said in 0usize..20,
        ) {
            let text = words.concat();
            let read = bits(read(text.as_bytes(), channels, said));
            prop_assert_eq!(&read, &oracle(&text, channels), "{:?}", text);
            let first = text.find('\n').map_or(0, |end| end + 1);
            prop_assert_eq!(&bits(in_blocks(&text, first, channels, said)), &read);
            if let Some(by_parts) = bits(in_parts(&text, channels, said, 2)) {
                prop_assert_eq!(Some(by_parts), read);
            }
        }
    }

    const WORDS: [&str; 16] = [
        " ",
        " ",
        " ",
        "\n",
        "\n",
        "\r\n",
        "\t",
        "\r",
        "1",
        "-0.25",
        "12.3456",
        "1e3",
        ".5",
        "-",
        "90.0000 ",
        "-5.1e-06 ",
    ];
}
