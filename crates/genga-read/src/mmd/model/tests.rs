//! Tests synthetic models, whole and damaged.

use super::*;
use crate::mmd::test_models::{Layout, Written};
use genga::error::Place;

impl Written {
    fn small() -> Self {
        let bones = vec![
            ("センター", None, [0.0, 8.0, 0.0]),
            ("左足", Some(0), [1.0, 10.0, 0.5]),
            ("左ひざ", Some(1), [1.0, 6.0, 0.5]),
            ("左足首", Some(2), [1.0, 1.0, 0.5]),
            ("左足ＩＫ", None, [1.0, 1.0, 0.5]),
        ];
        Self { bones, ik: vec![(4, vec![2, 1])] }
    }

    fn files(&self) -> Vec<Vec<u8>> {
        let layouts = [(false, 1), (true, 2), (false, 4)];
        let pmx = layouts.map(|(is_utf8, width)| self.pmx(Layout { is_utf8, width }));
        [self.pmd()].into_iter().chain(pmx).collect()
    }
}

#[test]
fn bones_and_ik_are_read_from_either_format() {
    for file in Written::small().files() {
        let model = MmdModel::read(&file).unwrap();
        assert_eq!(model.name, "人形");
        let names: Vec<&str> = model.bones().collect();
        assert_eq!(names, ["センター", "左足", "左ひざ", "左足首", "左足ＩＫ"]);
        let parents: Vec<_> = model.bones.iter().map(|bone| bone.parent).collect();
        assert_eq!(parents, [None, Some(0), Some(1), Some(2), None]);
        assert_eq!([0, 1, 2, 3, 4].map(|bone| model.depth(bone)), [0, 1, 2, 3, 0]);
        assert_eq!(model.above(3).collect::<Vec<_>>(), ["左ひざ", "左足", "センター"]);
        assert_eq!(model.bones[1].place, DVec3::new(1.0, 10.0, -0.5), "in front is +Z");
        assert_eq!(model.leg(), Some(9.0));
        assert_eq!(model.ik_of(|bone| bone == "左ひざ"), ["左足ＩＫ"]);
        assert!(model.ik_of(|bone| bone == "左足首").is_empty());
    }
}

/// Truncates the file at every byte and changes every byte: each variant must be read, or rejected with a
/// place in it.
#[test]
fn no_damage_breaks_the_reader() {
    let refused = |bytes: &[u8]| match MmdModel::read(bytes) {
        Ok(_) => false,
        Err(Error::Motion { place: Place::Byte(byte), .. }) => {
            assert!(byte <= bytes.len() as u64);
            true
        }
        Err(other) => panic!("{other}"),
    };
    for file in Written::small().files() {
        let needed = file.len() - 30;
        let early: Vec<bool> = (0..needed).map(|end| refused(&file[..end])).collect();
        assert!(early.iter().all(|refused| *refused), "{early:?}");
        for at in 0..file.len() {
            for value in [0, 1, 5, 127, 128, 255] {
                let mut other = file.clone();
                other[at] = value;
                refused(&other);
            }
        }
    }
}

/// The reader's error for a PMX with one-byte indices after a change.
fn said(change: impl Fn(&mut Vec<u8>)) -> String {
    let mut file = Written::small().pmx(Layout { is_utf8: true, width: 1 });
    change(&mut file);
    MmdModel::read(&file).unwrap_err().to_string()
}

/// Offset of the vertex count in such a file: behind its header and four texts.
const VERTICES: usize = 17 + (4 + 6) + (4 + 4) + 4 + (4 + 6);

/// Offset of a text in a file.
fn place(file: &[u8], text: &str) -> usize {
    file.windows(text.len()).position(|window| window == text.as_bytes()).unwrap()
}

#[test]
fn counts_that_lie_and_bones_that_hang_nowhere_are_refused_at_their_byte() {
    let knee = "左ひざ";
    let many = said(|file| file[VERTICES..VERTICES + 4].copy_from_slice(&u32::MAX.to_le_bytes()));
    assert!(many.starts_with("byte 49: 4294967295 vertices do not go into the "), "{many}");
    let long = said(|file| file[17..21].copy_from_slice(&9999u32.to_le_bytes()));
    assert!(long.starts_with("byte 17: 9999 bytes of its name do not go into"), "{long}");
    // The bone's name, its English name and its position come before the parent index.
    let parent = |file: &[u8]| place(file, knee) + knee.len() + 4 + 4 + 12;
    let there = parent(&Written::small().pmx(Layout { is_utf8: true, width: 1 }));
    let orphan = said(|file| file[there] = 77);
    assert_eq!(orphan, format!("byte {there}: bone 左ひざ hangs on one that is not there"));
    let ring = said(|file| file[there] = 3);
    assert!(ring.contains("hangs on itself"), "{ring}");
    let nowhere = said(|file| {
        let x = parent(file) - 12;
        file[x..x + 4].copy_from_slice(&f32::NAN.to_le_bytes());
    });
    assert_eq!(nowhere, format!("byte {}: bones stand nowhere", there - 12));
}

#[test]
fn what_is_no_model_or_another_version_is_refused() {
    for bytes in [&b""[..], b"Pm", b"PMX", b"HIERARCHY", b"glTF"] {
        let error = MmdModel::read(bytes).unwrap_err().to_string();
        assert_eq!(error, "byte 0: this is no model of MMD: no PMD and no PMX");
    }
    assert_eq!(
        MmdModel::read(b"PMX ").unwrap_err().to_string(),
        "byte 4: the file ends in its header"
    );
    let old = said(|file| file[4..8].copy_from_slice(&1f32.to_le_bytes()));
    assert_eq!(old, "byte 4: PMX 1 is not read; 2.0 and 2.1 are");
    assert!(said(|file| file[8] = 3).contains("byte 8: the header has 3 entries"));
    assert!(said(|file| file[14] = 3).contains("numbers of 3 bytes"));
    let way = VERTICES + 4 + 32 + 16;
    assert_eq!(
        said(|file| file[way] = 9),
        format!("byte {way}: a vertex hangs on bones in way 9; 0 to 4 are known")
    );
}

#[test]
fn an_ik_of_bones_that_are_not_there_is_left_out() {
    let written = Written { ik: vec![(99, vec![1]), (4, vec![99, 2])], ..Written::small() };
    let model = MmdModel::read(&written.pmd()).unwrap();
    assert_eq!(model.ik, [Ik { bone: 4, links: vec![2] }]);
}

#[test]
fn a_long_chain_of_bones_is_read_in_time() {
    const COUNT: usize = 60_000;
    // Children come first: the parent of each bone is the next one.
    let bone = |at: usize| ("骨", Some(at + 1).filter(|next| *next < COUNT), [0.0; 3]);
    let bones = (0..COUNT).map(bone).collect();
    let model = MmdModel::read(&Written { bones, ik: vec![] }.pmd()).unwrap();
    assert_eq!((model.depth(0), model.depth(COUNT - 1)), (COUNT - 1, 0));
}

#[test]
fn the_usual_figure_stands_on_legs_with_ik() {
    let usual = MmdModel::usual();
    assert!((usual.leg().unwrap() - 9.7).abs() < 1e-12);
    assert_eq!(usual.ik_of(|bone| bone == "右ひざ"), ["右足ＩＫ"]);
    assert_eq!(usual.ik_of(|bone| bone == "左足首"), ["左つま先ＩＫ"]);
    let ankle = usual.find("左足首").unwrap();
    assert_eq!(usual.depth(ankle), usual.above(ankle).count());
    assert_eq!(usual.place("左足ＩＫ"), usual.place("左足首"));
}
