//! Pages for a browser: figures that a script draws, and texts that are put together to one file.

mod figure;
mod poses;

use serde::Serialize;

use crate::error::Error;
use crate::motion::seen::view::View;
use crate::plot::style;

pub(crate) use figure::PageFigure;
pub(super) use figure::points;
pub(crate) use poses::{STEPS, Steps};

/// The script that draws figures, the class `Stage`.
pub(crate) const FIGURE: &str = include_str!("browser/figure.js");

/// Right, up and near of a view, to what a picture can show.
pub(crate) fn axes(view: &View) -> [[f64; 3]; 3] {
    let short = |value: f64| (value * 1e6).round() / 1e6 + 0.0;
    [view.right, view.up, view.near].map(|axis| axis.to_array().map(short))
}

/// Data as JSON inside a script, where no text may end it: a < can only be part of a text.
///
/// # Errors
/// [`Error::Picture`] for what cannot be JSON.
pub(crate) fn json_in_script(data: &impl Serialize) -> Result<String, Error> {
    let json = serde_json::to_string(data).map_err(style::failed)?;
    Ok(json.replace('<', "\\u003c"))
}

/// A page with each place filled, left to right: what is filled in is not looked at again.
pub(crate) fn fill(page: &str, places: &[(&str, String)]) -> String {
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
