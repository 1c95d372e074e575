//! What a timesheet from another program holds and [`read`](super::read()) does not understand.

use std::collections::BTreeMap;

use serde_json::Value;

use super::read::signed;
use super::{
    BLANK, CAMERA, CELS, CIRCLED, CONTINUED, INBETWEEN, REVERSE, SPEECH, TDTS_CELL, TDTS_SIGNATURE,
};
use genga::error::Error;

/// Names what of an XDTS or TDTS file is not understood and passed over, a phrase each: camera work and other fields,
/// further time tables, unknown signs and members. Empty if everything is understood.
///
/// # Errors
/// [`Error::Sheet`] if the file is no timesheet, as [`read`](super::read()).
pub fn unread(bytes: &[u8]) -> Result<Vec<String>, Error> {
    // Reports what is wrong with the file in the words of the reader.
    super::read(bytes)?;
    let (signature, json) = signed(bytes)?;
    let root: Value = serde_json::from_str(json).unwrap_or_default();
    let mut found = Found::default();
    found.members(
        "the file",
        &root,
        &["header", "subversion", "timeTables", "timeSheets", "version"],
    );
    let sheets = list(&root["timeSheets"]);
    let tables = match list(&root["timeTables"]) {
        [] => sheets.first().map_or(&[][..], |sheet| list(&sheet["timeTables"])),
        tables => tables,
    };
    if sheets.len() > 1 {
        found.add(format!("{} more time sheets", sheets.len() - 1), None);
    }
    if tables.len() > 1 {
        found.add(format!("{} more time tables", tables.len() - 1), None);
    }
    if let Some(sheet) = sheets.first() {
        found.members("the time sheet", sheet, &["header", "timeTables"]);
    }
    for header in [&root["header"], &sheets.first().unwrap_or(&Value::Null)["header"]] {
        found.members("the header", header, &["cut", "scene", "episode"]);
    }
    if let Some(table) = tables.first() {
        found.table(table, signature == TDTS_SIGNATURE);
    }
    Ok(found.phrases())
}

/// What was found, each with the koma on which it comes first, from 1.
#[derive(Default)]
struct Found(BTreeMap<String, Option<i64>>);

impl Found {
    fn add(&mut self, what: String, koma: Option<i64>) {
        let first = self.0.entry(what).or_insert(koma);
        *first = (*first).min(koma);
    }

    /// Adds the members of an object that are not known.
    fn members(&mut self, of: &str, object: &Value, known: &[&str]) {
        let Some(object) = object.as_object() else { return };
        let unknown = object
            .iter()
            .filter(|(name, value)| !known.contains(&name.as_str()) && !is_empty(value));
        unknown.for_each(|(name, _)| self.add(format!("{name} of {of}"), None));
    }

    fn table(&mut self, table: &Value, is_tdts: bool) {
        let known = ["duration", "fields", "name", "timeTableHeaders"];
        self.members("the time table", table, &known);
        for field in list(&table["fields"]) {
            let id = field["fieldId"].as_u64().unwrap_or_default();
            let is_cel = id == u64::from(CELS) || (is_tdts && id == u64::from(TDTS_CELL));
            let tracks = list(&field["tracks"]);
            if is_cel {
                let name = if id == u64::from(CELS) { "" } else { " (CELL)" };
                tracks.iter().for_each(|track| self.track(table, id, track, name));
            } else if id != u64::from(SPEECH) && tracks.iter().any(is_used) {
                let name = if id == u64::from(CAMERA) {
                    "CAMERA (camera work)".into()
                } else {
                    format!("field {id}")
                };
                let frames = tracks.iter().flat_map(|track| list(&track["frames"]));
                let first = frames.filter_map(|entry| entry["frame"].as_i64()).min();
                self.add(name, first.map(|koma| koma + 1));
            }
        }
    }

    /// Adds what is not understood of a column of cels.
    fn track(&mut self, table: &Value, field: u64, track: &Value, kind: &str) {
        let headers = list(&table["timeTableHeaders"]).iter();
        let mut names = headers.filter(|header| header["fieldId"].as_u64() == Some(field));
        let at = track["trackNo"].as_u64().unwrap_or_default() as usize;
        let name = names.find_map(|header| header["names"][at].as_str());
        let column = match name {
            Some(name) => format!("column {name}{kind}"),
            None => format!("column {}{kind}", at + 1),
        };
        self.members(&column, track, &["frames", "trackNo"]);
        for entry in list(&track["frames"]) {
            let koma = entry["frame"].as_i64().map(|koma| koma + 1);
            for (further, datum) in list(&entry["data"]).iter().enumerate() {
                for what in unknown(datum, further > 0) {
                    self.add(format!("{what} in {column}"), koma);
                }
            }
        }
    }

    fn phrases(self) -> Vec<String> {
        let phrase = |(what, koma): (String, Option<i64>)| match koma {
            Some(koma) => format!("{what}, first on koma {koma}"),
            None => what,
        };
        self.0.into_iter().map(phrase).collect()
    }
}

/// What is not understood of an entry of a column of cels; a `further` one of a koma not at all.
fn unknown(datum: &Value, further: bool) -> Vec<String> {
    if further {
        return vec!["a second entry of one koma".into()];
    }
    let signs = [INBETWEEN, REVERSE, BLANK, CONTINUED];
    let values = list(&datum["values"]).iter().filter_map(Value::as_str);
    let is_sign = |value: &&str| value.starts_with("SYMBOL_") && !signs.contains(value);
    let mut found: Vec<String> = values.filter(is_sign).map(String::from).collect();
    let options = list(&datum["options"]).iter().filter_map(Value::as_str);
    found.extend(options.filter(|option| *option != CIRCLED).map(String::from));
    let known = ["id", "values", "options", "fontColorId"];
    let members = datum.as_object().into_iter().flatten();
    let members =
        members.filter(|(name, value)| !known.contains(&name.as_str()) && !is_empty(value));
    found.extend(members.map(|(name, _)| name.clone()));
    found
}

fn is_used(track: &Value) -> bool {
    !list(&track["frames"]).is_empty()
}

fn list(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}

/// Whether a value says nothing: null, false, an empty text or list, or an object of such.
fn is_empty(value: &Value) -> bool {
    match value {
        Value::Null | Value::Bool(false) => true,
        Value::String(text) => text.is_empty(),
        Value::Array(items) => items.iter().all(is_empty),
        Value::Object(members) => members.values().all(is_empty),
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn timesheet(table: &str) -> Vec<String> {
        let file = format!(
            "exchangeDigitalTimeSheet Save Data\n{{\"version\":5,\"timeTables\":[{{\"duration\":24,\"name\":\"a\",\
             \"timeTableHeaders\":[{{\"fieldId\":0,\"names\":[\"A\"]}}],{table}}}]}}"
        );
        unread(file.as_bytes()).unwrap()
    }

    fn cels(data: &str) -> Vec<String> {
        timesheet(&format!(
            "\"fields\":[{{\"fieldId\":0,\"tracks\":[{{\"trackNo\":0,\"frames\":[{{\"frame\":4,\"data\":[{data}]}}]}}]}}]"
        ))
    }

    #[test]
    fn what_the_reader_passes_over_is_named_with_its_koma() {
        assert_eq!(cels(r#"{"id":0,"values":["1"],"options":["OPTION_KEYFRAME"]}"#), [""; 0]);
        assert_eq!(
            cels(r#"{"id":0,"values":["1"],"options":["OPTION_REFERENCEFRAME"],"memo":"!"}"#),
            [
                "OPTION_REFERENCEFRAME in column A, first on koma 5",
                "memo in column A, first on koma 5"
            ]
        );
        assert_eq!(
            cels(r#"{"id":0,"values":["SYMBOL_WAVE"]},{"id":1,"values":["x"]}"#),
            [
                "SYMBOL_WAVE in column A, first on koma 5",
                "a second entry of one koma in column A, first on koma 5"
            ]
        );
        let camera = r#""frameRate":24,"fields":[
            {"fieldId":5,"tracks":[{"trackNo":0,"frames":[{"frame":11,"data":[{"id":0,"values":["PAN"]}]}]}]},
            {"fieldId":3,"tracks":[]},{"fieldId":2,"tracks":[]}]"#;
        assert_eq!(
            timesheet(camera),
            ["CAMERA (camera work), first on koma 12", "frameRate of the time table"]
        );
    }
}
