//! Defines the common look: colours, fonts, sizes.
//!
//! People who do not see red and green can tell the colours apart (vermilion and blue after Okabe and Ito).
//! In a black-and-white print they differ in lightness.

use plotters::style::RGBColor;

use genga::error::{Cause, Error};
use genga::motion::BodySide;
use genga::sheet::Role;

/// Keys (原画).
pub const GENGA: RGBColor = RGBColor(200, 50, 16);
/// Lines through a picture at the keys, behind its curves.
pub const GENGA_LINE: RGBColor = RGBColor(232, 158, 138);
/// Walls (壁).
pub const WALL: RGBColor = RGBColor(0, 104, 176);
/// Inbetweens (中割り).
pub(crate) const INBETWEEN: RGBColor = RGBColor(150, 156, 163);
/// First and last drawing.
pub const END: RGBColor = RGBColor(48, 52, 60);
/// Words and axes.
pub const INK: RGBColor = RGBColor(34, 37, 43);
/// Less important words.
pub const FAINT: RGBColor = RGBColor(104, 110, 118);
/// Lines to read values by.
pub(super) const GRID: RGBColor = RGBColor(228, 231, 234);
/// A curve as measured.
pub const RAW: RGBColor = RGBColor(184, 190, 197);
/// A curve after the low pass.
pub const FILTERED: RGBColor = RGBColor(44, 48, 56);
/// Limbs of the left side.
pub const LEFT: RGBColor = WALL;
/// Limbs of the right side.
pub const RIGHT: RGBColor = RGBColor(222, 130, 0);
/// The paper.
pub const PAPER: RGBColor = RGBColor(255, 255, 255);

/// Fonts, best first.
pub(super) const FONTS: &str = "\"Noto Sans CJK JP\", \"Hiragino Sans\", \"Yu Gothic\", sans-serif";

/// Width of a picture in px, unless a setting asks for another. In a print 180 mm wide, the smallest letters are 6 points.
pub(super) const WIDTH: u32 = 960;

/// Font size of a title, in px.
pub(super) const TITLE: f64 = 17.0;
/// Font size of words, in px.
pub(super) const WORDS: f64 = 13.0;
/// Font size of numbers on axes, in px.
pub(super) const SMALL: f64 = 11.5;
/// White at the edges of a picture, in px.
pub(super) const MARGIN: f64 = 24.0;
/// Radius of the circle round a number, in px.
pub(super) const BADGE: f64 = 9.5;

/// Returns half the width of the circle round a number, which is longer than high for more than two signs.
pub(super) fn badge_reach(number: &str) -> f64 {
    BADGE.max(0.5 * text_width(number, BOLDER * SMALL) + 4.5)
}

/// Width of bold letters relative to that of plain ones.
pub(super) const BOLDER: f64 = 1.06;

/// Returns the colour of a drawing by its role.
pub(super) fn of_role(role: Role) -> RGBColor {
    match role {
        Role::Genga => GENGA,
        Role::Inbetween => INBETWEEN,
        Role::End => END,
    }
}

/// Estimates the width of a text in px. It uses no font, so that the bytes do not depend on the fonts of the
/// machine.
pub(super) fn text_width(text: &str, size: f64) -> f64 {
    let em = |letter: char| match letter {
        'i' | 'l' | 'j' | 'I' | '.' | ',' | ':' | ' ' | '\'' | '|' => 0.29,
        'f' | 'r' | 't' | '(' | ')' | '/' | '-' => 0.39,
        'm' | 'w' | 'M' | 'W' => 0.9,
        letter if letter.is_ascii_uppercase() => 0.65,
        letter if letter.is_ascii() => 0.57,
        letter if (letter as u32) < 0x2e80 => 0.7,
        _ => 1.0,
    };
    text.chars().map(em).sum::<f64>() * size
}

/// Returns the text, cut off with an ellipsis if it is too wide.
pub(super) fn fitted(text: &str, size: f64, width: f64) -> String {
    if text_width(text, size) <= width {
        return text.to_owned();
    }
    let mut kept = String::new();
    for letter in text.chars() {
        kept.push(letter);
        if text_width(&kept, size) + size > width {
            kept.pop();
            break;
        }
    }
    kept + "…"
}

/// Wraps reasons, one after the other, to lines of a width. A reason wider than a line is cut off.
pub(super) fn lines(reasons: &[String], size: f64, width: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for reason in reasons {
        let longer = lines.last().map(|line| format!("{line} · {reason}"));
        match longer.filter(|line| text_width(line, size) <= width) {
            Some(longer) => *lines.last_mut().expect("there is one to be longer") = longer,
            None => lines.push(fitted(reason, size, width)),
        }
    }
    lines
}

/// Puts marks, each a place and half a width, from left to right into the first lane with room; `None` if all
/// lanes are full.
pub(super) fn lanes(
    marks: impl IntoIterator<Item = (f64, f64)>,
    lanes: usize,
) -> Vec<Option<usize>> {
    let mut ends = vec![f64::NEG_INFINITY; lanes];
    let mut free = |(place, half): (f64, f64)| {
        let lane = ends.iter().position(|end| place - half >= *end)?;
        ends[lane] = place + half;
        Some(lane)
    };
    marks.into_iter().map(&mut free).collect()
}

/// Refuses a picture size that cannot be drawn or looked at.
///
/// # Errors
/// [`Error::Setting`] if `px` is outside `least..=20000`.
pub(super) fn check_size(name: &str, px: u32, least: u32) -> Result<(), Error> {
    if (least..=20_000).contains(&px) {
        Ok(())
    } else {
        Err(Error::setting(name, format!("{px} px; it must be between {least} and 20000")))
    }
}

/// Refuses a figure height in px that is illegible.
///
/// # Errors
/// [`Error::Setting`] if `px` is outside 40 to 2000.
pub(super) fn check_figure(px: u32) -> Result<(), Error> {
    if (40..=2000).contains(&px) {
        return Ok(());
    }
    Err(Error::setting("figure_height", format!("{px} px; it must be between 40 and 2000")))
}

/// Maximum number of figures, joints or cards in a row or on a page.
pub(super) const MOST: usize = 1000;

/// Refuses a count of 0, or of more than anybody looks at.
///
/// # Errors
/// [`Error::Setting`] if `count` is outside 1 to `most`.
pub(super) fn check_count(name: &str, count: usize, most: usize) -> Result<(), Error> {
    if (1..=most).contains(&count) {
        return Ok(());
    }
    Err(Error::setting(name, format!("{count}; it must be between 1 and {most}")))
}

/// Builds an error about the contents of a picture.
pub(super) fn cannot(message: impl Into<String>) -> Error {
    Error::Picture { message: message.into(), source: None }
}

/// Wraps an error of a drawing library.
pub(super) fn failed(source: impl Into<Cause>) -> Error {
    let source = source.into();
    Error::Picture { message: source.to_string(), source: Some(source) }
}

/// Mixes a colour with a share of another, 0 to 1.
pub(super) fn mixed(color: RGBColor, other: RGBColor, share: f64) -> RGBColor {
    let mix = |a: u8, b: u8| (f64::from(a) + share * (f64::from(b) - f64::from(a))).round() as u8;
    RGBColor(mix(color.0, other.0), mix(color.1, other.1), mix(color.2, other.2))
}

/// Returns the colour of a limb by its side.
pub(crate) fn side_color(side: BodySide) -> RGBColor {
    match side {
        BodySide::Left => LEFT,
        BodySide::Right => RIGHT,
        BodySide::Trunk => INK,
    }
}
