//! The cut folder (カット袋): the timesheets of a cut, and each column's pictures, numbered like their cells.

mod tvpaint;

use serde::Serialize;

use self::tvpaint::TvPaint;
use super::xdts::{self, column};
use super::{Cut, Settings, Sink, xsheet};
use genga::error::{Error, Warning};
use genga::sheet::{Layer, Number};
use genga_plot::{CelGap, ColumnPictures, NumberedImages};

/// The version of `cut.json`, stored in the file.
const SCHEMA: &str = "genga-cut-1";

/// Folders of the pictures: key drawings alone, and all drawings.
const GENGA: &str = "genga";
const DOUGA: &str = "douga";

/// `cut.json`: the contents of the folder.
#[derive(Debug, Serialize)]
struct Contents<'a> {
    schema: &'static str,
    genga: &'static str,
    cut: &'a str,
    fps: f64,
    koma: usize,
    columns: Vec<Column<'a>>,
}

/// A column of the sheets.
#[derive(Debug, Serialize)]
struct Column<'a> {
    /// Its name as in the sheets.
    name: String,
    /// Its picture folder, inside both `genga` and `douga`.
    folder: String,
    /// Names of its joints; empty for the whole body.
    joints: &'a [String],
    /// Numbers of its pictures.
    genga: Vec<Number>,
    douga: Vec<Number>,
}

/// Writes the cut's folder, named after the cut.
///
/// The XDTS sheets for drawing programs lie side by side, so that viewers pair them. Each is also copied beside its
/// pictures, where programs look for these by column and number. The CSV there names the picture of each koma.
///
/// # Errors
/// The errors of the formats in the folder.
pub(super) fn write(cut: &Cut<'_>, settings: &Settings, put: &mut Sink<'_>) -> Result<(), Error> {
    let at = |file: &str| cut.file(&format!("CUT/{file}"));
    let sheets = settings.xdts.write(cut.sheet, cut.name)?;
    for (kind, sheet) in [(GENGA, &sheets.genga), (DOUGA, &sheets.douga)] {
        let name = cut.file(&format!("CUT_{kind}_ts.xdts"));
        put(&at(&name), sheet.as_bytes())?;
        put(&at(&format!("{kind}/{name}")), sheet.as_bytes())?;
    }
    put(&at("CUT.tdts"), settings.tdts.write(cut.sheet, cut.name)?.as_bytes())?;
    let paper = xsheet(&settings.xsheet, cut.name, cut.clip, cut.sheet)?;
    put(&at("CUT_timesheet.html"), paper.html.as_bytes())?;
    let mut columns = columns(cut);
    let genga: Vec<_> = cut.sheet.layers.iter().map(Layer::genga_numbers).collect();
    let douga: Vec<_> = cut.sheet.layers.iter().map(Layer::numbers).collect();
    let folders: Vec<&str> = columns.iter().map(|column| &column.folder[..]).collect();
    let size = (settings.images.width, settings.images.height);
    let picture_of = |kind: &str, layer: usize, drawing: usize| match kind {
        GENGA => genga[layer][drawing].as_ref(),
        _ => Some(&douga[layer][drawing]),
    };
    for kind in [GENGA, DOUGA] {
        let csv = TvPaint { cut: &cut.file("CUT"), kind, columns: &folders, size };
        let csv = csv.write(cut.sheet, |layer, drawing| picture_of(kind, layer, drawing));
        put(&at(&format!("{kind}/{}", cut.file("CUT.csv"))), csv.as_bytes())?;
    }
    // Columns are stacked on each other, so their pictures need a transparent background.
    let transparent = settings.images.transparent || cut.sheet.layers.len() > 1;
    let body = settings.figures.body;
    let images = NumberedImages { transparent, body, ..settings.images.clone() };
    images.draw_columns(cut.clip, cut.sheet, |own: ColumnPictures| {
        let column = &mut columns[own.layer];
        if let (Some(number), Some(png)) = (&genga[own.layer][own.drawing], &own.genga) {
            put(&at(&picture(GENGA, &column.folder, number)), png)?;
            column.genga.push(number.clone());
        }
        let number = &douga[own.layer][own.drawing];
        column.douga.push(number.clone());
        put(&at(&picture(DOUGA, &column.folder, number)), &own.douga)
    })?;
    let (koma, fps) = (cut.sheet.cut_length(), cut.sheet.clock.koma_rate);
    let genga = env!("CARGO_PKG_VERSION");
    let contents = Contents { schema: SCHEMA, genga, cut: cut.name, fps, koma, columns };
    let failed =
        |error: serde_json::Error| Error::Encoding { what: "cut.json", source: error.into() };
    put(
        &at("cut.json"),
        (serde_json::to_string_pretty(&contents).map_err(failed)? + "\n").as_bytes(),
    )
}

/// Warns of what the sheets cannot hold, and of cels that do not meet when they are laid over each other.
///
/// # Errors
/// Those of [`CelGap::widest`].
pub(super) fn notes(cut: &Cut<'_>) -> Result<Vec<Warning>, Error> {
    let sheet = cut.sheet;
    let mut notes = xdts::notes(sheet);
    notes.extend(CelGap::widest(cut.clip, sheet)?.map(|gap| {
        let [own, on] = gap.layers.map(|layer| &sheet.layers[layer].name);
        let (koma, all) = (sheet.blank.before + gap.koma + 1, sheet.cut_length());
        let CelGap { percent, seen, .. } = gap;
        let message = format!(
            "cels of columns that are drawn at different times do not meet: {own} is {percent:.1} % of body height off \
             {on} on koma {koma}, and on {seen} of {all} koma some gap is over 2 %; move such a cel with the body or draw \
             it anew, or have one column (layers=body)"
        );
        Warning::new("W_CEL_GAP", message)
    }));
    Ok(notes)
}

/// The columns, with no pictures listed yet.
fn columns<'a>(cut: &Cut<'a>) -> Vec<Column<'a>> {
    let layers = cut.sheet.layers.iter().enumerate();
    let column = |(track, layer): (usize, &'a Layer)| {
        let name = column(track, &layer.name);
        let folder = Cut::file_of(&name, "CUT");
        Column { name, folder, joints: &layer.joints, genga: vec![], douga: vec![] }
    };
    layers.map(column).collect()
}

/// The path of a picture, where drawing programs look for it beside a sheet.
fn picture(kind: &str, folder: &str, number: &Number) -> String {
    format!("{kind}/{folder}/{}", file(folder, number))
}

/// The name of a picture.
fn file(folder: &str, number: &Number) -> String {
    format!("{folder}_{number:04}.png")
}

#[cfg(test)]
mod tests;
