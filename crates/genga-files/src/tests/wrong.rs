//! Tests that every format rejects a sheet that contradicts itself, even if the format would not use the wrong part.

use super::*;
use crate::{FORMATS, Glb, Settings, Vmd};
use genga::error::Error;
use genga::sheet::Sheet;

type Spoil = fn(&mut Sheet);

const WRONG: [(&str, Spoil); 3] = [
    ("layer A shows drawing 3 but has 3", |sheet| sheet.layers[0].exposures[1].drawing = 3),
    ("layer A: an exposure of 0 koma", |sheet| sheet.layers[0].exposures[0].koma = 0),
    ("layer A: 18446744073709551615 koma here", |sheet| {
        sheet.layers[0].exposures[2].koma = usize::MAX;
    }),
];

fn spoilt(clip: &Clip, spoil: Spoil) -> Sheet {
    let mut sheet = Sheet::on_ones(clip.clock(24.0), 3);
    spoil(&mut sheet);
    sheet
}

#[test]
fn every_format_refuses_what_cannot_be_shown() {
    let clip = wave();
    for (words, spoil) in WRONG {
        let sheet = spoilt(&clip, spoil);
        let cut = Cut {
            name: "wave",
            clip_file: "wave.bvh",
            clip: &clip,
            exaggerated: None,
            sheet: &sheet,
            spaced: None,
            splits: &[],
            made_with: None,
        };
        for format in FORMATS {
            let put = &mut |_: &str, _: &[u8]| Ok(());
            let error = format.write(&cut, &Settings::default(), put).unwrap_err().to_string();
            assert!(error.starts_with(words), "{}: {error}", format.name);
        }
    }
}

#[test]
fn so_does_each_writer_of_the_library_by_itself() {
    let clip = wave();
    let cases =
        WRONG.into_iter().chain([("the sheet is empty", (|sheet| sheet.layers.clear()) as Spoil)]);
    for (words, spoil) in cases {
        let sheet = spoilt(&clip, spoil);
        let mut made = vec![
            limited_bvh(&clip, &sheet).map(drop),
            keys_bvh(&clip, &sheet).map(drop),
            Vmd::default().make(&clip, &sheet).map(drop),
            Glb::default().write(&clip, &sheet).map(drop),
        ];
        if !sheet.layers.is_empty() {
            let table = |rows| Drawings { cut: "wave".into(), rows }.write(&clip, &sheet);
            made.extend(
                [sheet_csv(&sheet), remap_csv(&sheet), table(Rows::All)].map(|made| made.map(drop)),
            );
        }
        for (at, made) in made.into_iter().enumerate() {
            let error = made.unwrap_err().to_string();
            assert!(error.starts_with(words), "{at}: {error}");
        }
    }
}

#[test]
fn a_table_that_cannot_be_written_is_no_fault_of_a_clip() {
    let rows = [vec!["1".to_owned(), "2".to_owned()]];
    let error = crate::csv_table(&["frame"], rows).unwrap_err();
    assert!(!matches!(error, Error::Clip { .. }), "{error:?}");
    assert!(std::error::Error::source(&error).is_some(), "{error:?}");
    assert!(error.to_string().starts_with("a table could not be written: "), "{error}");
}
