//! Builds pages for a browser: data of figures that a script draws, and texts joined into one file.

mod figure;
mod poses;

use serde::Serialize;

use crate::style;
use genga::error::Error;
use genga::motion::seen::view::View;

pub(crate) use figure::PageFigure;
pub(super) use figure::points;
pub(crate) use poses::{STEPS, Steps};

/// The script that draws figures, the class `Stage`.
pub const FIGURE: &str = include_str!("browser/figure.js");

/// Returns the axes of a view (right, up, near), rounded to the precision that a picture can show.
pub(crate) fn axes(view: &View) -> [[f64; 3]; 3] {
    let short = |value: f64| (value * 1e6).round() / 1e6 + 0.0;
    [view.right, view.up, view.near].map(|axis| axis.to_array().map(short))
}

/// Serializes data as JSON for use inside a script. No text in it can end the script: `<` occurs in JSON only
/// inside texts, and is escaped there.
///
/// # Errors
/// [`Error::Picture`] if the data cannot be JSON.
pub fn json_in_script(data: &impl Serialize) -> Result<String, Error> {
    let json = serde_json::to_string(data).map_err(style::failed)?;
    Ok(json.replace('<', "\\u003c"))
}

/// Fills the places of a page, from left to right. Filled text is not searched for places.
pub fn fill(page: &str, places: &[(&str, String)]) -> String {
    let mut filled = String::new();
    let mut rest = page;
    while let Some(begin) = rest.find("{{") {
        filled.push_str(&rest[..begin]);
        rest = &rest[begin..];
        let place = places.iter().find(|(name, _)| rest.starts_with(name));
        let (name, text) = place.map_or(("{{", "{{"), |(name, text)| (*name, text.as_str()));
        filled.push_str(text);
        rest = &rest[name.len()..];
    }
    filled + rest
}
