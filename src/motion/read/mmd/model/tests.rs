//! Models made here, whole and damaged.

use encoding_rs::SHIFT_JIS;

use super::*;

/// A model to be written: bones with what they hang on and where they begin in MMD's axes, and IK with their links.
#[derive(Debug, Clone)]
pub(crate) struct Written {
    pub(crate) bones: Vec<(&'static str, Option<usize>, [f32; 3])>,
    pub(crate) ik: Vec<(usize, Vec<usize>)>,
}

/// How a PMX is laid out.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Layout {
    pub(crate) is_utf8: bool,
    /// Bytes of the number of a bone.
    pub(crate) width: usize,
}

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

    pub(crate) fn pmd(&self) -> Vec<u8> {
        let name = |text: &str| {
            let mut field = SHIFT_JIS.encode(text).0.into_owned();
            // What stands behind the end of a name is rubbish in many files.
            field.push(0);
            field.resize(20, 0xfd);
            field
        };
        let mut file = b"Pmd".to_vec();
        file.extend(1f32.to_le_bytes());
        file.extend(name("人形"));
        file.extend([0; 256]);
        for (count, size) in [(3u32, 38), (6, 2), (1, 70)] {
            file.extend(count.to_le_bytes());
            file.extend(vec![7; count as usize * size]);
        }
        file.extend((self.bones.len() as u16).to_le_bytes());
        for (bone, parent, place) in &self.bones {
            file.extend(name(bone));
            file.extend(parent.map_or(u16::MAX, |parent| parent as u16).to_le_bytes());
            file.extend([0; 5]);
            place.iter().for_each(|axis| file.extend(axis.to_le_bytes()));
        }
        file.extend((self.ik.len() as u16).to_le_bytes());
        for (bone, links) in &self.ik {
            file.extend((*bone as u16).to_le_bytes());
            file.extend([0; 2]);
            file.push(links.len() as u8);
            file.extend([0; 6]);
            links.iter().for_each(|link| file.extend((*link as u16).to_le_bytes()));
        }
        file.extend(b"skins, frames and more");
        file
    }

    pub(crate) fn pmx(&self, layout: Layout) -> Vec<u8> {
        let Layout { is_utf8, width } = layout;
        let text = |text: &str| {
            let units = text.encode_utf16().flat_map(u16::to_le_bytes);
            let bytes = if is_utf8 { text.as_bytes().to_vec() } else { units.collect() };
            [&(bytes.len() as u32).to_le_bytes()[..], &bytes].concat()
        };
        let number = |bone: Option<usize>| {
            let number = bone.map_or(-1, |bone| bone as i32);
            number.to_le_bytes()[..width].to_vec()
        };
        let mut file = b"PMX ".to_vec();
        file.extend(2f32.to_le_bytes());
        file.extend([8, u8::from(is_utf8), 1, 2, 1, 1, width as u8, 1, 1]);
        ["人形", "doll", "", "a doll"].iter().for_each(|word| file.extend(text(word)));
        // A vertex of each way to hang on bones.
        file.extend(5u32.to_le_bytes());
        for (way, size) in [width, 2 * width + 4, 4 * width + 16, 2 * width + 40, 4 * width + 16]
            .iter()
            .enumerate()
        {
            file.extend([9; 32 + 16]);
            file.push(way as u8);
            file.extend(vec![9; size + 4]);
        }
        file.extend(6u32.to_le_bytes());
        file.extend([0; 6 * 2]);
        file.extend(1u32.to_le_bytes());
        file.extend(text("skin.png"));
        file.extend(2u32.to_le_bytes());
        for is_shared in [0, 1] {
            ["肌", "skin"].iter().for_each(|word| file.extend(text(word)));
            file.extend([3; 65 + 3]);
            file.extend([is_shared, 0]);
            file.extend(text("memo"));
            file.extend(3u32.to_le_bytes());
        }
        file.extend((self.bones.len() as u32).to_le_bytes());
        for (at, (bone, parent, place)) in self.bones.iter().enumerate() {
            [bone, "bone"].iter().for_each(|word| file.extend(text(word)));
            place.iter().for_each(|axis| file.extend(axis.to_le_bytes()));
            file.extend(number(*parent));
            file.extend([0; 4]);
            let ik = self.ik.iter().find(|(bone, _)| *bone == at);
            // Every second bone has all that a bone can have.
            let (has_all, is_ik) = (at % 2 == 1, ik.is_some());
            let flags = if has_all { 0x2f01u16 } else { 0 } | if is_ik { 0x20 } else { 0 };
            file.extend(flags.to_le_bytes());
            // It ends where a PMD made here does: nowhere, as a bone and as a way.
            file.extend(if has_all { number(None) } else { vec![0; 12] });
            file.extend(vec![5; if has_all { (width + 4) + 12 + 24 + 4 } else { 0 }]);
            let Some((_, links)) = ik else { continue };
            file.extend(vec![5; width + 8]);
            file.extend((links.len() as u32).to_le_bytes());
            for (at, link) in links.iter().enumerate() {
                file.extend(number(Some(*link)));
                file.push((at % 2) as u8);
                file.extend(vec![5; 24 * (at % 2)]);
            }
        }
        file.extend(b"morphs and more");
        file
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

/// Where a file ends early, and where any one byte of it is another, it is read or refused with a place in it.
#[test]
fn no_damage_breaks_the_reader() {
    let refused = |bytes: &[u8]| match MmdModel::read(bytes) {
        Ok(_) => false,
        Err(Error::Model { byte, .. }) => {
            assert!(byte <= bytes.len());
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

/// What the reader says of a PMX of one-byte numbers after a change.
fn said(change: impl Fn(&mut Vec<u8>)) -> String {
    let mut file = Written::small().pmx(Layout { is_utf8: true, width: 1 });
    change(&mut file);
    MmdModel::read(&file).unwrap_err().to_string()
}

/// Where such a file says how many vertices it has: behind its header and four texts.
const VERTICES: usize = 17 + (4 + 6) + (4 + 4) + 4 + (4 + 6);

/// Where a text begins in a file.
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
    // A bone's name, its name in English, its place; then what it hangs on.
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
    // Children first: each hangs on the one behind it.
    let bone = |at: usize| ("骨", Some(at + 1).filter(|next| *next < COUNT), [0.0; 3]);
    let bones = (0..COUNT).map(bone).collect();
    let model = MmdModel::read(&Written { bones, ik: vec![] }.pmd()).unwrap();
    assert_eq!((model.depth(0), model.depth(COUNT - 1)), (COUNT - 1, 0));
}
