//! Properties that hold for any sheet and any bytes.

use proptest::prelude::*;

use super::sheets::sheet;
use super::writing::holds;
use crate::cases::cases;
use crate::xdts::read;
use genga::sheet::{Blank, Drawing, Exposure, Layer, Role, Sheet, Source, Why};

/// Drawings whose first and last are ends.
fn any_drawings() -> impl Strategy<Value = Vec<Drawing>> {
    prop::collection::vec(prop::bool::weighted(0.3), 1..30).prop_map(|genga| {
        let last = genga.len() - 1;
        let role = |at: usize, genga: bool| match at {
            at if at == 0 || at == last => Role::End,
            _ if genga => Role::Genga,
            _ => Role::Inbetween,
        };
        let drawing =
            |(at, genga)| Drawing::new(Source::At(at as f64), role(at, genga), Why::default());
        genga.into_iter().enumerate().map(drawing).collect()
    })
}

/// Exposures: the koma of each drawing in order, or edited ones that pick any drawing.
#[derive(Debug, Clone)]
enum Exposures {
    InOrder(Vec<usize>),
    Edited(Vec<(prop::sample::Index, usize)>),
}

/// A layer as the program makes it, with every drawing once and in order, or as edited by a person:
/// drawings shown again, moved or left out.
fn any_layer() -> impl Strategy<Value = Layer> {
    let edits = prop::collection::vec((any::<prop::sample::Index>(), 1..8usize), 1..40);
    let lengths = prop::collection::vec(1..8usize, 30);
    let shown =
        prop_oneof![lengths.prop_map(Exposures::InOrder), edits.prop_map(Exposures::Edited)];
    (any_drawings(), shown, "[A-FS][0-9]?|腕|").prop_map(|(drawings, shown, name)| {
        let count = drawings.len();
        let exposures = match shown {
            Exposures::InOrder(lengths) => {
                lengths.into_iter().take(count).enumerate().collect::<Vec<_>>()
            }
            Exposures::Edited(edited) => {
                edited.into_iter().map(|(at, koma)| (at.index(count), koma)).collect()
            }
        };
        let exposure = |(drawing, koma)| Exposure { drawing, koma };
        let exposures = exposures.into_iter().map(exposure).collect();
        Layer { name, joints: vec![], drawings, exposures, gone: vec![] }
    })
}

pub(in crate::xdts) fn any_sheet() -> impl Strategy<Value = Sheet> {
    let blank = (0..30_usize, 0..30_usize).prop_map(|(before, after)| Blank { before, after });
    let blank = prop_oneof![Just(Blank::default()), blank];
    let layers = prop::collection::vec(any_layer(), 1..4);
    (layers, blank).prop_map(|(layers, blank)| sheet(layers).with_blank(blank))
}

proptest! {
    #![proptest_config(cases(40, 200))]

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
        let mut file = crate::xdts::Xdts::default().write(&sheet, "c1").unwrap().genga.into_bytes();
        let at = 34 + at.index(file.len() - 34);
        let end = (at + bytes.len()).min(file.len());
        file.splice(at..end, bytes);
        if let Ok(read) = read(&file) {
            for column in &read.columns {
                prop_assert_eq!(column.on_koma(read.length).count(), read.length);
                prop_assert_eq!(column.changes[0].koma, 0);
            }
        }
    }
}
