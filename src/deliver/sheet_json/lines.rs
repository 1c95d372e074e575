//! How the file is broken into lines: the frame of the file is open, what stands in it is a line each.

use std::io::{self, Write};

use serde_json::ser::Formatter;

use crate::deliver::number;

/// Two blanks for each container that a line stands in.
const INDENT: &[u8] = b"  ";

/// Objects that are open to this depth have a line for each field.
const OPEN_OBJECTS: usize = 3;
/// Lists at these depths, of layers and of what is in them, have a line for each item.
const OPEN_LISTS: [usize; 2] = [2, 4];

/// A writer of JSON for a person to edit: a drawing a line, an exposure a line; numbers as tables have
/// them, the shortest that reads back as the same value, whole ones without a point.
#[derive(Debug, Default)]
pub(super) struct Lines {
    /// For every container that is begun and not ended: whether it is open, and whether it has something.
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
