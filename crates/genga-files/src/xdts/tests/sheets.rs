//! Sheets built by hand, and their content by koma.

use super::super::read::{Column, Mark};
use genga::sheet::{Drawing, Exposure, Layer, Role, Sheet, Source, Why};
use genga::time::{Clock, Frame, FrameRate};

pub(super) fn clock() -> Clock {
    Clock { first: Frame(10), frame_rate: FrameRate::new(120.0).unwrap(), koma_rate: 24.0 }
}

/// A layer of drawings by role (`e`nd, `g`enga, `i`nbetween), with exposures as (drawing, koma).
pub(crate) fn layer(name: &str, roles: &str, shown: &[(usize, usize)]) -> Layer {
    let role = |letter| match letter {
        'e' => Role::End,
        'g' => Role::Genga,
        _ => Role::Inbetween,
    };
    let drawing = |(at, letter)| {
        Drawing::new(Source::At(10.0 + 3.0 * at as f64), role(letter), Why::default())
    };
    Layer {
        name: name.into(),
        joints: vec![],
        drawings: roles.chars().enumerate().map(drawing).collect(),
        exposures: shown.iter().map(|&(drawing, koma)| Exposure { drawing, koma }).collect(),
        gone: vec![],
    }
}

pub(crate) fn sheet(layers: Vec<Layer>) -> Sheet {
    Sheet::new(clock(), layers)
}

/// The cut of 24 koma in both examples of the format: four keys and three inbetweens, with none between the second
/// key and the third.
pub(crate) fn cut_of_24() -> Sheet {
    let shown = [(0, 6), (1, 2), (2, 2), (3, 3), (4, 3), (5, 3), (6, 5)];
    sheet(vec![layer("A", "eiiggie", &shown)])
}

/// The content of each koma of a column, spelled out: `3` for a drawing, `3o` where an inbetween begins, `x` for blank.
pub(super) fn spelled(column: &Column, length: usize) -> String {
    let mut shown = "x".to_owned();
    let mut koma = Vec::new();
    for (at, change) in column.on_koma(length).enumerate() {
        let begins = change.koma == at;
        match &change.mark {
            Mark::Drawing(number) => shown = number.clone(),
            Mark::Blank => shown = "x".into(),
            Mark::Inbetween | Mark::Reverse => {}
        }
        let tick = match change.mark {
            Mark::Inbetween if begins => "o",
            Mark::Reverse if begins => "*",
            _ => "",
        };
        koma.push(format!("{shown}{tick}"));
    }
    koma.join(" ")
}
