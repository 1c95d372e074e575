//! The JSON structure of an XDTS file. Unknown members are ignored.

use serde::{Deserialize, Deserializer, Serialize, de};

/// Maximum number of koma of a time table: eleven hours. A longer duration is taken for an error.
const LONGEST: u64 = 1_000_000;

#[derive(Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Root {
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) header: Option<Header>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) subversion: Option<String>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) time_tables: Vec<TimeTable>,
    /// TDTS from version 7 on nests its time tables in time sheets.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) time_sheets: Vec<TimeSheet>,
    #[serde(default)]
    pub(super) version: u32,
}

#[derive(Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct TimeSheet {
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) header: Option<Header>,
    #[serde(default)]
    pub(super) time_tables: Vec<TimeTable>,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Header {
    #[serde(default)]
    pub(super) cut: String,
    #[serde(default)]
    pub(super) scene: String,
    /// In TDTS alone.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub(super) episode: String,
}

#[derive(Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct TimeTable {
    #[serde(deserialize_with = "duration")]
    pub(super) duration: u64,
    #[serde(default)]
    pub(super) fields: Vec<Field>,
    #[serde(default)]
    pub(super) name: String,
    #[serde(default)]
    pub(super) time_table_headers: Vec<Names>,
}

#[derive(Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Names {
    pub(super) field_id: u32,
    pub(super) names: Vec<String>,
}

#[derive(Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Field {
    pub(super) field_id: u32,
    pub(super) tracks: Vec<Track>,
}

#[derive(Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Track {
    pub(super) frames: Vec<Entry>,
    pub(super) track_no: usize,
}

#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Entry {
    #[serde(deserialize_with = "some")]
    pub(super) data: Vec<Datum>,
    /// Koma, from 0. Some programs write negative ones for content before the cut.
    pub(super) frame: i64,
}

#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Datum {
    pub(super) id: u32,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) options: Vec<String>,
    #[serde(deserialize_with = "some")]
    pub(super) values: Vec<String>,
}

fn duration<'de, D: Deserializer<'de>>(source: D) -> Result<u64, D::Error> {
    let koma = i64::deserialize(source)?;
    u64::try_from(koma).ok().filter(|koma| (1..=LONGEST).contains(koma)).ok_or_else(|| {
        de::Error::custom(format!("a duration is 1 to {LONGEST} koma, and this one is {koma}"))
    })
}

fn some<'de, D: Deserializer<'de>, T: Deserialize<'de>>(source: D) -> Result<Vec<T>, D::Error> {
    let items = Vec::deserialize(source)?;
    if items.is_empty() {
        return Err(de::Error::custom("an entry needs a value, and this list is empty"));
    }
    Ok(items)
}
