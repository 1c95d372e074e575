//! What holds for any sheet, and for any bytes.

use proptest::prelude::*;

use super::sheets::sheet;
use super::writing::holds;
use crate::deliver::xdts::read;
use crate::sheet::{Drawing, Exposure, Layer, Role, Sheet, Source, Why};

/// A layer as the program makes it: every drawing once, the first and the last an end.
fn any_layer() -> impl Strategy<Value = Layer> {
    let drawing = (prop::bool::weighted(0.3), 1..8usize);
    (prop::collection::vec(drawing, 1..30), "[A-FS][0-9]?|腕|").prop_map(|(shown, name)| {
        let last = shown.len() - 1;
        let role = |at: usize, genga: bool| match at {
            at if at == 0 || at == last => Role::End,
            _ if genga => Role::Genga,
            _ => Role::Inbetween,
        };
        let drawing = |(at, &(genga, _)): (usize, &(bool, usize))| Drawing {
            source: Source::At(at as f64),
            role: role(at, genga),
            why: Why::default(),
        };
        let exposure = |(drawing, &(_, koma)): (usize, &(bool, usize))| Exposure { drawing, koma };
        Layer {
            name,
            drawings: shown.iter().enumerate().map(drawing).collect(),
            exposures: shown.iter().enumerate().map(exposure).collect(),
        }
    })
}

pub(super) fn any_sheet() -> impl Strategy<Value = Sheet> {
    prop::collection::vec(any_layer(), 1..4).prop_map(sheet)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn any_sheet_is_the_same_in_both_files(sheet in any_sheet(), cut in "[a-z0-9_カ ]{0,12}") {
        holds(&sheet, &cut);
    }

    #[test]
    fn any_bytes_after_the_signature_are_read_or_refused(
        bytes in prop::collection::vec(any::<u8>(), 0..60),
        at in any::<prop::sample::Index>(),
        sheet in any_sheet(),
    ) {
        let mut file = crate::deliver::xdts::Xdts::default().write(&sheet, "c1").unwrap().genga.into_bytes();
        let at = 34 + at.index(file.len() - 34);
        let end = (at + bytes.len()).min(file.len());
        file.splice(at..end, bytes);
        if let Ok(read) = read(&file) {
            for column in &read.columns {
                prop_assert_eq!(column.on_koma(read.length).count(), read.length);
                prop_assert_eq!(column.cells[0].koma, 0);
            }
        }
    }
}
