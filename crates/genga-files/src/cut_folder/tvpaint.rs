//! The timing of a column's pictures as TVPaint's CSV, which Krita opens: a layer per column, a row per koma.

use std::fmt::Write;

use genga::sanitize::cell;
use genga::sheet::{Layer, Number, Sheet};

/// What stands on a koma without a drawing.
const BLANK: &str = "";

/// The pictures of a cut, and where they lie.
pub(super) struct TvPaint<'a> {
    pub(super) cut: &'a str,
    /// Folder of the columns' folders: `genga` or `douga`. Programs look beside the file for what is below it.
    pub(super) kind: &'a str,
    /// Folder of each column's pictures, backmost first.
    pub(super) columns: &'a [&'a str],
    /// Width and height of a picture in px.
    pub(super) size: (u32, u32),
}

impl TvPaint<'_> {
    /// Writes the picture on each koma. `number` gives that of a drawing of a layer; a drawing without one leaves the
    /// picture before it on screen.
    pub(super) fn write<'a>(
        &self,
        sheet: &Sheet,
        number: impl Fn(usize, usize) -> Option<&'a Number>,
    ) -> String {
        let (koma, rate) = (sheet.cut_length(), sheet.clock.koma_rate);
        let ((wide, high), layers) = (self.size, self.columns.len());
        let mut text = String::from("UTF-8, TVPaint, \"CSV 1.1\"\n");
        text += "Project Name, Width, Height, Frame Count, Layer Count, Frame Rate, Pixel Aspect Ratio, Field Mode\n";
        let name = cell(self.cut);
        let _ =
            writeln!(text, "\"{name}\", {wide}, {high}, {koma}, {layers}, {rate}, 1, Progressive");
        // The foremost layer comes first.
        let folder = |column: &&str| format!("\"{}/{column}\"", self.kind);
        row(&mut text, "#Layers", self.columns.iter().map(|column| format!("\"{column}\"")));
        row(&mut text, "#Density", self.columns.iter().map(|_| "1".into()));
        row(&mut text, "#Blending", self.columns.iter().map(|_| "\"Color\"".into()));
        row(&mut text, "#Visible", self.columns.iter().map(|_| "1".into()));
        row(&mut text, "#Folder", self.columns.iter().map(folder));
        let columns = sheet.layers.iter().zip(self.columns).enumerate();
        let cells = columns.map(|(at, (layer, column))| {
            pictures(sheet, layer, |drawing| Some(super::file(column, number(at, drawing)?)))
        });
        let cells: Vec<Vec<String>> = cells.collect();
        for at in 0..koma {
            let on_koma = cells.iter().map(|column| format!("\"{}\"", column[at]));
            row(&mut text, &format!("#{at:05}"), on_koma);
        }
        text
    }
}

/// Writes a row of cells, which are given from the backmost layer.
fn row(text: &mut String, head: &str, cells: impl DoubleEndedIterator<Item = String>) {
    *text += head;
    for cell in cells.rev() {
        *text += ", ";
        *text += &cell;
    }
    *text += "\n";
}

/// The file of the picture on each koma of the cut.
fn pictures(sheet: &Sheet, layer: &Layer, file: impl Fn(usize) -> Option<String>) -> Vec<String> {
    let mut pictures = vec![String::from(BLANK); sheet.cut_length()];
    let mut shown = String::from(BLANK);
    for (picture, drawing) in pictures[sheet.blank.before..].iter_mut().zip(layer.koma()) {
        if let Some(file) = file(drawing) {
            shown = file;
        }
        picture.clone_from(&shown);
    }
    pictures
}
