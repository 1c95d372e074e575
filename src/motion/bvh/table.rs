//! The motion table when it is as it should be: one frame a line, plain numbers, nothing else.
//!
//! Nearly every file is such a one, and this reads it as fast as it can. What is odd in any way is left
//! to those who can tell what is wrong with it: the answer is then `None`, and they begin again.

use memchr::{memchr, memchr_iter};

use super::number::{self, is_blank};
use super::threads;

/// All values of a table, frame after frame, when every line is one frame of `channels` finite numbers
/// or blank. `said` is what the file says of its frames; it need not be true.
///
/// Large tables are read by as many threads as the machine has cores for them.
pub(super) fn read(text: &[u8], channels: usize, said: usize) -> Option<Vec<f64>> {
    let parts = threads::parts(text.len());
    let by_parts = (parts > 1).then(|| read_parts(text, channels, said, parts)).flatten();
    by_parts.or_else(|| read_whole(text, channels, said))
}

/// One thread, frame after frame, as many as there are.
fn read_whole(text: &[u8], channels: usize, said: usize) -> Option<Vec<f64>> {
    let mut values = Vec::with_capacity(said.saturating_mul(channels).min(most_values(text)));
    let mut rows = Rows { text };
    while rows.has_more() && channels <= most_values(rows.text) {
        let begin = values.len();
        values.resize(begin + channels, 0.0);
        rows.next(&mut values[begin..])?;
    }
    (rows.text.is_empty() && !values.is_empty()).then_some(values)
}

/// So many values a text can hold, whatever the file says of it: a value and its blank are two bytes.
fn most_values(text: &[u8]) -> usize {
    text.len() / 2 + 1
}

/// A thread a part. Where each of them has to write follows from the lines before it, so this works
/// only where the file has the lines that it says.
fn read_parts(text: &[u8], channels: usize, said: usize, parts: usize) -> Option<Vec<f64>> {
    let parts = split_at_lines(text.trim_ascii(), parts);
    let lines = threads::all(parts.iter().map(|part| || 1 + memchr_iter(b'\n', part).count()));
    if lines.iter().sum::<usize>() != said || said.saturating_mul(channels) > most_values(text) {
        return None;
    }
    let mut values = vec![0.0; said * channels];
    let mut left = &mut values[..];
    let targets = lines.iter().map(|lines| {
        let (target, after) = std::mem::take(&mut left).split_at_mut(lines * channels);
        left = after;
        target
    });
    let jobs = parts.iter().zip(targets).map(|(text, target)| || read_part(text, channels, target));
    threads::all(jobs).into_iter().all(|is_read| is_read.is_some()).then_some(values)
}

fn read_part(text: &[u8], channels: usize, values: &mut [f64]) -> Option<()> {
    let mut rows = Rows { text };
    values.chunks_exact_mut(channels).try_for_each(|row| rows.next(row))
}

/// About equal parts, each of whole lines without the last line end.
fn split_at_lines(text: &[u8], parts: usize) -> Vec<&[u8]> {
    let mut rest = text;
    let mut lines = Vec::with_capacity(parts);
    for left in (2..=parts).rev() {
        let about = rest.len() / left;
        let Some(end) = memchr(b'\n', &rest[about..]) else { break };
        lines.push(&rest[..about + end]);
        rest = &rest[about + end + 1..];
    }
    lines.push(rest);
    lines
}

/// Lines still to be read.
struct Rows<'a> {
    text: &'a [u8],
}

impl Rows<'_> {
    /// Skips blank lines; false at the end.
    fn has_more(&mut self) -> bool {
        self.text = self.text.trim_ascii_start();
        !self.text.is_empty()
    }

    /// Reads the next line, which must hold a value for each of the row's and nothing else.
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
        // With the last value its blank was taken, which may have been the line's end. Further on is
        // another line: this one was too short.
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
    use proptest::prelude::*;

    use super::threads::PART;
    use super::*;

    /// Every word of every line, by `str::parse`: as slow as it is plain.
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

    /// `frames` rows of three values that tell where they stand.
    fn rows(frames: usize, end: &str) -> String {
        (0..frames).map(|frame| format!("{frame} {}.25 -0.{frame:04}{end}", frame % 1000)).collect()
    }

    #[test]
    fn parts_are_whole_lines_and_nothing_is_lost() {
        for frames in [1, 2, 3, 7, 100] {
            for parts in [1, 2, 3, 5] {
                let text = rows(frames, "\n");
                let lines = split_at_lines(text.trim_end().as_bytes(), parts);
                assert!(lines.len() <= parts && lines.len() >= parts.min(frames) / 2);
                assert_eq!(lines.join(&b'\n'), text.trim_end().as_bytes());
            }
        }
    }

    #[test]
    fn in_parts_is_the_same_as_in_one() {
        // The text begins where the line of the frame time ends.
        for (head, end, tail) in
            [("", "\n", ""), ("\n", "\n", ""), ("\r\n", "\r\n", ""), (" \n", " \n", "\n \n")]
        {
            let text = head.to_owned() + &rows(1000, end) + tail;
            let whole = read_whole(text.as_bytes(), 3, 1000);
            assert!(whole.is_some());
            for parts in 2..6 {
                assert_eq!(read_parts(text.as_bytes(), 3, 1000, parts), whole, "{parts}");
                for said in [999, 1001, usize::MAX] {
                    assert_eq!(read_parts(text.as_bytes(), 3, said, parts), None, "{said}");
                }
            }
        }
        let odd = rows(1000, "\n").replacen("\n600 ", "\n600,5 ", 1);
        assert_eq!(read_parts(odd.as_bytes(), 3, 1000, 2), None);
        let blank = rows(1000, "\n").replacen("\n600 ", "\n\n600 ", 1);
        assert_eq!(read_parts(blank.as_bytes(), 3, 1001, 2), None);
        let joined = rows(1000, "\n").replacen("\n600 ", " 600 ", 1);
        assert_eq!(read_parts(joined.as_bytes(), 3, 999, 2), None);
    }

    #[test]
    fn a_table_large_enough_for_two_threads_is_read_whole() {
        let frames = 2 * PART / rows(1, "\n").len();
        let text = rows(frames, "\n");
        assert!(text.len() > 2 * PART);
        assert!(read_parts(text.as_bytes(), 3, frames, 2).is_some());
        let values = read(text.as_bytes(), 3, frames).unwrap();
        assert_eq!(values.len(), 3 * frames);
        assert!((0..frames).all(|frame| values[3 * frame] == frame as f64));
    }

    #[test]
    fn lines_that_cannot_hold_what_is_said_reserve_nothing() {
        let text = "\n".repeat(3 * PART);
        assert_eq!(read(text.as_bytes(), 1 << 40, 3 * PART), None);
        assert_eq!(read_parts(text.as_bytes(), 1 << 40, 1, 2), None);
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
            let read = bits(read_whole(text.as_bytes(), channels, said));
            prop_assert_eq!(&read, &oracle(&text, channels), "{:?}", text);
            if let Some(by_parts) = bits(read_parts(text.as_bytes(), channels, said, 2)) {
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
