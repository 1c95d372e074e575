//! Computes the line and column of a byte.

/// A cursor that counts lines between places, which must be requested in ascending order. Lines end in LF,
/// CRLF or CR.
pub(super) struct Places<'a> {
    text: &'a [u8],
    at: usize,
    line: usize,
    start: usize,
}

impl<'a> Places<'a> {
    /// Creates a cursor at the beginning of the text.
    pub(super) fn from_text(text: &'a [u8]) -> Self {
        Self { text, at: 0, line: 1, start: 0 }
    }

    /// Line and column of a byte, both counted from 1.
    pub(super) fn place(&mut self, at: usize) -> (usize, usize) {
        let at = at.min(self.text.len());
        for (index, &byte) in self.text[..at].iter().enumerate().skip(self.at) {
            let ends = match byte {
                b'\n' => true,
                b'\r' => self.text.get(index + 1) != Some(&b'\n'),
                _ => false,
            };
            if ends {
                (self.line, self.start) = (self.line + 1, index + 1);
            }
        }
        self.at = at;
        (self.line, at - self.start + 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_end_in_lf_crlf_or_cr_and_columns_are_bytes() {
        let mut lines = Places::from_text(b"a\nb\r\nc\rd e");
        let places = [0, 1, 2, 3, 5, 7, 9].map(|at| lines.place(at));
        assert_eq!(places, [(1, 1), (1, 2), (2, 1), (2, 2), (3, 1), (4, 1), (4, 3)]);
    }
}
