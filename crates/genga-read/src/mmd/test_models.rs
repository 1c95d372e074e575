//! Writes MMD models for tests.

use encoding_rs::SHIFT_JIS;

/// A model to write: bones with parent and position in MMD's axes, and IK bones with their links.
#[derive(Debug, Clone)]
pub(crate) struct Written {
    pub(crate) bones: Vec<(&'static str, Option<usize>, [f32; 3])>,
    pub(crate) ik: Vec<(usize, Vec<usize>)>,
}

/// The layout of a PMX.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Layout {
    pub(crate) is_utf8: bool,
    /// Bytes of a bone index.
    pub(crate) width: usize,
}

impl Written {
    pub(crate) fn pmd(&self) -> Vec<u8> {
        let name = |text: &str| {
            let mut field = SHIFT_JIS.encode(text).0.into_owned();
            // Many files have rubbish behind the end of a name.
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
        // Writes one vertex for each kind of skinning.
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
            // Every second bone has all optional fields.
            let (has_all, is_ik) = (at % 2 == 1, ik.is_some());
            let flags = if has_all { 0x2f01u16 } else { 0 } | if is_ik { 0x20 } else { 0 };
            file.extend(flags.to_le_bytes());
            // The bone has no end, like in the PMD written here: no end bone, and a zero vector.
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
}
