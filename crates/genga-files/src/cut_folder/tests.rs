use std::collections::{BTreeMap, BTreeSet};

use serde_json::Value;

use super::*;
use genga::edits::Edits;
use genga::motion::bvh;
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::sheet::{Blank, Exposure, Sheet};

/// The kick's cut folder with the given layers, as small pictures.
fn folder(layers: &str) -> BTreeMap<String, Vec<u8>> {
    folder_with(layers, &[])
}

/// The same with some settings.
fn folder_with(layers: &str, own: &[(&str, &str)]) -> BTreeMap<String, Vec<u8>> {
    sheet_and_folder(layers, own, Blank::default()).1
}

/// The same with blank koma round the drawings, and its sheet.
fn sheet_and_folder(
    layers: &str,
    own: &[(&str, &str)],
    blank: Blank,
) -> (Sheet, BTreeMap<String, Vec<u8>>) {
    with_cut(layers, |cut| {
        let sheet = Sheet { blank, ..cut.sheet.clone() };
        let files = files(&Cut { sheet: &sheet, ..*cut }, own);
        (sheet, files)
    })
}

/// Calls `work` with the kick in the given layers.
fn with_cut<T>(layers: &str, work: impl FnOnce(&Cut<'_>) -> T) -> T {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/kick.bvh");
    let clip = bvh::open(path.as_ref()).unwrap().clip;
    let mut recipe = Recipe::default();
    recipe.set("layers", layers).unwrap();
    let mut engine = Engine::new(clip).unwrap();
    let breakdown = engine.run(&recipe, &Edits::default()).unwrap();
    work(&Cut {
        name: "c012",
        clip_file: "kick.bvh",
        clip: breakdown.clip,
        exaggerated: None,
        sheet: breakdown.sheet,
        spaced: None,
        splits: &[],
        made_with: None,
    })
}

/// The files of a cut, as small pictures.
fn files(cut: &Cut<'_>, own: &[(&str, &str)]) -> BTreeMap<String, Vec<u8>> {
    let mut settings = Settings::default();
    settings.set("images.width", "160").unwrap();
    settings.set("images.height", "90").unwrap();
    // Seen from the front no limb hides another.
    settings.set("images.camera", "front").unwrap();
    own.iter().for_each(|(name, value)| settings.set(name, value).unwrap());
    let mut files = BTreeMap::new();
    let mut put = |name: &str, bytes: &[u8]| {
        assert!(files.insert(name.to_owned(), bytes.to_vec()).is_none(), "{name} twice");
        Ok(())
    };
    write(cut, &settings, &mut put).unwrap();
    let whole = |name: &str, png: Vec<u8>| put(&format!("whole/{name}"), &png);
    settings.images.draw(cut.clip, cut.sheet, whole).unwrap();
    files
}

/// The cells that a drawing program derives from a sheet: each number in a column as `A/A_0001.png` beside the
/// sheet. A cell that is not a number is a mark.
fn suggested(files: &BTreeMap<String, Vec<u8>>, sheet: &str) -> BTreeSet<String> {
    let text = std::str::from_utf8(&files[sheet]).unwrap();
    let file: Value = serde_json::from_str(text.split_once('\n').unwrap().1).unwrap();
    let table = &file["timeTables"][0];
    let names = table["timeTableHeaders"][0]["names"].as_array().unwrap();
    let beside = &sheet[..sheet.rfind('/').unwrap()];
    let mut found = BTreeSet::new();
    for track in table["fields"][0]["tracks"].as_array().unwrap() {
        let name = names[track["trackNo"].as_u64().unwrap() as usize].as_str().unwrap();
        for frame in track["frames"].as_array().unwrap() {
            let value = frame["data"][0]["values"][0].as_str().unwrap();
            if let Ok(number) = value.parse::<usize>() {
                found.insert(format!("{beside}/{name}/{name}_{number:04}.png"));
            }
        }
    }
    found
}

fn pictures(files: &BTreeMap<String, Vec<u8>>, kind: &str) -> BTreeSet<String> {
    let begin = format!("c012/{kind}/");
    let is_picture = |name: &&String| name.starts_with(&begin) && name.ends_with(".png");
    files.keys().filter(is_picture).cloned().collect()
}

#[test]
fn beside_each_sheet_every_cell_finds_its_picture_and_no_picture_is_left() {
    for layers in ["body", "limbs"] {
        let files = folder(layers);
        for kind in [GENGA, DOUGA] {
            let sheet = format!("c012/{kind}/c012_{kind}_ts.xdts");
            let suggested = suggested(&files, &sheet);
            assert_eq!(suggested, pictures(&files, kind), "{layers}, {kind}");
            assert!(suggested.len() > 10);
            assert_eq!(files[&sheet], files[&format!("c012/c012_{kind}_ts.xdts")]);
        }
    }
}

/// The picture on each koma of each layer, as Krita reads TVPaint's CSV: the folder without its first part is below the
/// file's own.
fn shown_by_csv(files: &BTreeMap<String, Vec<u8>>, kind: &str) -> Vec<(String, Vec<String>)> {
    let text = std::str::from_utf8(&files[&format!("c012/{kind}/c012.csv")]).unwrap();
    let cells = |row: &str| -> Vec<String> {
        row.split(", ").skip(1).map(|cell| cell.trim_matches('"').to_owned()).collect()
    };
    let row = |head: &str| cells(text.lines().find(|row| row.starts_with(head)).unwrap());
    let mut layers: Vec<_> = row("#Layers").into_iter().map(|name| (name, vec![])).collect();
    let folders = row("#Folder");
    let frames = (0..).map_while(|koma: usize| {
        text.lines().find(|row| row.starts_with(&format!("#{koma:05}"))).map(cells)
    });
    for pictures in frames {
        for ((layer, folder), picture) in layers.iter_mut().zip(&folders).zip(pictures) {
            let below = folder.split_once('/').unwrap().1;
            let path = format!("c012/{kind}/{below}/{picture}");
            layer.1.push(if picture.is_empty() { picture } else { path });
        }
    }
    layers
}

#[test]
fn the_csv_beside_the_pictures_has_the_drawing_of_each_koma() {
    for layers in ["body", "limbs"] {
        let (sheet, files) = sheet_and_folder(layers, &[], Blank { before: 3, after: 5 });
        let douga = shown_by_csv(&files, DOUGA);
        let genga = shown_by_csv(&files, GENGA);
        assert_eq!(douga.len(), sheet.layers.len());
        // The foremost layer comes first.
        for (at, layer) in sheet.layers.iter().rev().enumerate() {
            let (numbers, keys) = (layer.numbers(), layer.genga_numbers());
            let drawings: Vec<usize> = layer.koma().collect();
            for (kind, (name, shown)) in [(DOUGA, &douga[at]), (GENGA, &genga[at])] {
                let mut wanted = vec![String::new(); 3];
                let mut key = None;
                for drawing in &drawings {
                    key = keys[*drawing].clone().or(key);
                    let number =
                        if kind == DOUGA { &numbers[*drawing] } else { key.as_ref().unwrap() };
                    wanted.push(format!("c012/{kind}/{name}/{name}_{number:04}.png"));
                }
                wanted.extend(vec![String::new(); 5]);
                assert_eq!(*shown, wanted, "{layers} {kind} {name}");
                assert!(shown.iter().all(|path| path.is_empty() || files.contains_key(path)));
            }
        }
    }
}

#[test]
fn cels_that_do_not_meet_are_told() {
    let said =
        |cut: &Cut<'_>| -> String { notes(cut).unwrap().iter().map(ToString::to_string).collect() };
    assert_eq!(with_cut("body", said), "", "one column meets nothing");
    with_cut("limbs", |cut| {
        let gap = said(cut);
        assert!(gap.contains(" % of body height off A on koma "), "{gap}");
        assert!(gap.contains("[W_CEL_GAP]"), "{gap}");
        // Cels that are drawn anew on every koma meet.
        let mut sheet = cut.sheet.clone();
        for layer in &mut sheet.layers {
            let shown: Vec<usize> = layer.koma().collect();
            layer.drawings = shown.iter().map(|own| layer.drawings[*own].clone()).collect();
            let exposures = 0..shown.len();
            layer.exposures = exposures.map(|drawing| Exposure { drawing, koma: 1 }).collect();
        }
        assert_eq!(said(&Cut { sheet: &sheet, ..*cut }), "");
    });
}

#[test]
fn a_genga_has_the_picture_of_its_drawing() {
    let files = folder("limbs");
    let contents: Value = serde_json::from_slice(&files["c012/cut.json"]).unwrap();
    let columns = contents["columns"].as_array().unwrap();
    assert_eq!((columns.len(), &contents["koma"]), (5, &92.into()));
    for column in columns {
        let folder = column["folder"].as_str().unwrap();
        let numbers = |kind: &str| -> Vec<u64> {
            column[kind].as_array().unwrap().iter().map(|number| number.as_u64().unwrap()).collect()
        };
        let count = numbers(DOUGA).len() + numbers(GENGA).len();
        let of_column = |name: &&String| name.contains(&format!("/{folder}/"));
        assert_eq!(files.keys().filter(of_column).count(), count);
        let picture = |kind: &str, number: u64| {
            &files[&format!("c012/{kind}/{folder}/{folder}_{number:04}.png")]
        };
        let all: Vec<_> = numbers(DOUGA).into_iter().map(|number| picture(DOUGA, number)).collect();
        assert!(numbers(GENGA).iter().all(|number| all.contains(&picture(GENGA, *number))));
    }
}

#[test]
fn a_column_has_its_own_joints_alone_and_all_columns_together_the_body() {
    let ink = |png: &[u8]| {
        let picture = resvg::tiny_skia::Pixmap::decode_png(png).unwrap();
        let is_ink = |at: usize| {
            // Composited over white paper.
            let pixel = picture.pixels()[at];
            u16::from(pixel.green()) + 255 - u16::from(pixel.alpha()) < 200
        };
        (0..picture.pixels().len()).filter(|at| is_ink(*at)).collect::<BTreeSet<_>>()
    };
    let limbs = folder("limbs");
    let corner =
        |png: &[u8]| resvg::tiny_skia::Pixmap::decode_png(png).unwrap().pixels()[0].alpha();
    assert_eq!(corner(&limbs["c012/genga/B/B_0001.png"]), 0, "one sees the columns below");
    assert_eq!(corner(&folder("body")["c012/genga/A/A_0001.png"]), 255);
    let whole = ink(&limbs["whole/A-E_0001.png"]);
    let columns = ["A", "B", "C", "D", "E"]
        .map(|column| ink(&limbs[&format!("c012/douga/{column}/{column}_0001.png")]));
    for (at, column) in columns.iter().enumerate() {
        assert!(!column.is_empty() && column.len() * 2 < whole.len(), "column {at}");
        let others = columns.iter().enumerate().filter(|(other, _)| *other != at);
        let overlap = others.map(|(_, other)| other.intersection(column).count()).sum::<usize>();
        assert!(overlap < column.len() / 2, "column {at}");
    }
    let together: BTreeSet<usize> = columns.into_iter().flatten().collect();
    let missing = whole.difference(&together).count();
    assert!(missing * 20 < whole.len(), "{missing} of {} are missing", whole.len());
}

#[test]
fn marked_pictures_show_the_number_that_their_sheet_has() {
    let marked = folder_with("body", &[("images.marks", "true")]);
    let picture = |name: &str| &marked[&format!("c012/{name}.png")];
    let list: Value = serde_json::from_slice(&marked["c012/cut.json"]).unwrap();
    assert_eq!(
        (&list["columns"][0]["genga"][1], &list["columns"][0]["douga"][1]),
        (&2.into(), &2.into())
    );
    // The first genga is also the first drawing. The second is a later one, and so is every number behind it.
    assert_eq!(picture("genga/A/A_0001"), picture("douga/A/A_0001"));
    let douga: Vec<_> = marked.iter().filter(|(name, _)| name.contains("/douga/A/")).collect();
    let genga: Vec<_> = marked.iter().filter(|(name, _)| name.contains("/genga/A/A_")).collect();
    assert!(genga.len() > 5 && douga.len() > genga.len());
    assert!(genga.iter().skip(1).all(|(_, own)| douga.iter().all(|(_, other)| own != other)));
    let plain = folder("body");
    let is_douga =
        |own: &Vec<u8>| plain.iter().any(|(name, other)| name.contains("/douga/") && own == other);
    assert!(
        plain.iter().filter(|(name, _)| name.contains("/genga/A/A_")).all(|(_, own)| is_douga(own))
    );
}
