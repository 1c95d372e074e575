//! The line layout of the file: outer containers are broken into lines, inner ones take one line each.

use std::io::{self, Write};

use serde_json::ser::Formatter;

use crate::number;

/// Indentation per enclosing container.
const INDENT: &[u8] = b"  ";

/// Objects down to this depth have a line for each field.
const OPEN_OBJECTS: usize = 3;
/// Lists at these depths (the layers, and the lists in each layer) have a line for each item.
const OPEN_LISTS: [usize; 2] = [2, 4];

/// A JSON formatter for files that a person edits: one drawing or exposure per line. Numbers are written as in
/// tables: the shortest form that reads back as the same value, whole ones without a decimal point.
#[derive(Debug, Default)]
pub(super) struct Lines {
    /// For each unfinished container: whether it is broken into lines, and whether it has an item yet.
    within: Vec<(bool, bool)>,
}

impl Lines {
    fn begin<W: ?Sized + Write>(
        &mut self,
        writer: &mut W,
        sign: &[u8],
        open: bool,
    ) -> io::Result<()> {
        self.within.push((open, false));
        writer.write_all(sign)
    }

    fn item<W: ?Sized + Write>(&mut self, writer: &mut W, first: bool) -> io::Result<()> {
        let depth = self.within.len();
        let Some((open, filled)) = self.within.last_mut() else { return Ok(()) };
        *filled = true;
        if !first {
            writer.write_all(if *open { b"," } else { b", " })?;
        }
        if *open { break_line(writer, depth) } else { Ok(()) }
    }

    fn end<W: ?Sized + Write>(&mut self, writer: &mut W, sign: &[u8]) -> io::Result<()> {
        if self.within.pop() == Some((true, true)) {
            break_line(writer, self.within.len())?;
        }
        writer.write_all(sign)
    }
}

fn break_line<W: ?Sized + Write>(writer: &mut W, depth: usize) -> io::Result<()> {
    writer.write_all(b"\n")?;
    (0..depth).try_for_each(|_| writer.write_all(INDENT))
}

impl Formatter for Lines {
    fn begin_array<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        let open = OPEN_LISTS.contains(&(self.within.len() + 1));
        self.begin(writer, b"[", open)
    }

    fn begin_array_value<W: ?Sized + Write>(
        &mut self,
        writer: &mut W,
        first: bool,
    ) -> io::Result<()> {
        self.item(writer, first)
    }

    fn end_array<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.end(writer, b"]")
    }

    fn begin_object<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        let open = self.within.len() < OPEN_OBJECTS;
        self.begin(writer, b"{", open)
    }

    fn begin_object_key<W: ?Sized + Write>(
        &mut self,
        writer: &mut W,
        first: bool,
    ) -> io::Result<()> {
        self.item(writer, first)
    }

    fn begin_object_value<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        writer.write_all(b": ")
    }

    fn end_object<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.end(writer, b"}")
    }

    fn write_f64<W: ?Sized + Write>(&mut self, writer: &mut W, value: f64) -> io::Result<()> {
        writer.write_all(number(value).as_bytes())
    }
}
