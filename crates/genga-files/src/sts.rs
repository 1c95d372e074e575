//! The sheet as STS (ShiraheiTimeSheet): a small binary file that older timesheet programs read.

use encoding_rs::SHIFT_JIS;

use genga::error::{Error, Warning};
use genga::sheet::{Layer, Number, Sheet};

use crate::xdts::unsaid_rate;

/// The signature: a length byte, and the name.
const SIGNATURE: &[u8; 18] = b"\x11ShiraheiTimeSheet";
/// Zeros after the length field.
const RESERVED: [u8; 2] = [0; 2];

/// Writes the sheet with the number of the drawing on every koma, or 0 where it is blank. The format has whole numbers
/// only, so a drawing with letters gets the next number that is free. Layer names are Shift-JIS, cut at 255 bytes.
///
/// # Errors
/// [`Error::Sheet`] for a sheet without koma, with more than 255 layers, or with more than 65,535 koma or drawings;
/// also as [`Sheet::check`].
pub fn sts(sheet: &Sheet) -> Result<Vec<u8>, Error> {
    sheet.check()?;
    let layers = u8::try_from(sheet.layers.len()).ok().filter(|layers| *layers > 0);
    let length = u16::try_from(sheet.cut_length()).ok().filter(|length| *length > 0);
    let columns: Vec<Vec<usize>> = sheet.layers.iter().map(whole_numbers).collect();
    let highest = columns.iter().flatten().max().copied().unwrap_or(0);
    let fits = u16::try_from(highest).is_ok();
    let (Some(layers), Some(length), true) = (layers, length, fits) else {
        return Err(Error::sheet(
            "STS holds 1 to 255 layers and 1 to 65535 koma and drawings; split the clip",
        ));
    };
    let mut bytes = SIGNATURE.to_vec();
    bytes.push(layers);
    bytes.extend(length.to_le_bytes());
    bytes.extend(RESERVED);
    for (layer, numbers) in sheet.layers.iter().zip(&columns) {
        let numbers = layer.koma().map(|drawing| numbers[drawing] as u16);
        let before = sheet.blank.before;
        let after = sheet.cut_length() - before - layer.length();
        let blank = |koma| std::iter::repeat_n(0, koma);
        let numbers = blank(before).chain(numbers).chain(blank(after));
        bytes.extend(numbers.flat_map(u16::to_le_bytes));
    }
    for layer in &sheet.layers {
        let name = name(&layer.name);
        bytes.push(name.len() as u8);
        bytes.extend(name);
    }
    Ok(bytes)
}

/// Says which numbers the drawings with letters get.
pub(crate) fn notes(sheet: &Sheet) -> Vec<Warning> {
    let of_layer = |layer: &Layer| {
        let numbers = layer.numbers().into_iter().zip(whole_numbers(layer));
        let changed = numbers.filter(|(number, _)| !number.letters().is_empty());
        let changed: Vec<String> =
            changed.map(|(number, whole)| format!("{number} is {whole}")).collect();
        let message =
            format!("STS holds whole numbers alone: of {} {}", layer.name, changed.join(", "));
        (!changed.is_empty()).then(|| Warning::new("W_STS_NUMBERS", message))
    };
    unsaid_rate("sts", sheet).into_iter().chain(sheet.layers.iter().filter_map(of_layer)).collect()
}

/// The number of each drawing, and for one with letters a number behind all that the layer ever had.
fn whole_numbers(layer: &Layer) -> Vec<usize> {
    let numbers = layer.numbers();
    let all = numbers.iter().chain(layer.gone.iter().map(|gone| &gone.drawing));
    let mut last = all.map(Number::whole).max().unwrap_or(0);
    let whole = |number: &Number| match number.letters() {
        "" => number.whole(),
        _ => {
            last += 1;
            last
        }
    };
    numbers.iter().map(whole).collect()
}

/// Encodes a name in Shift-JIS, cut at whole characters, with `_` for characters it does not have.
fn name(text: &str) -> Vec<u8> {
    let mut bytes = Vec::new();
    for letter in text.chars() {
        let mut own = [0; 4];
        let (letter, _, is_unknown) = SHIFT_JIS.encode(letter.encode_utf8(&mut own));
        let letter: &[u8] = if is_unknown { b"_" } else { &letter };
        if bytes.len() + letter.len() > usize::from(u8::MAX) {
            break;
        }
        bytes.extend(letter);
    }
    bytes
}
