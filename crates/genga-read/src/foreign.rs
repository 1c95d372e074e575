//! Files that hold no motion genga can read (ほかの形式): what each is, and the way from it to a motion.

use genga::error::{Error, Place};

/// Every format that is read, as a person names them.
const READ: &str = "BVH, FBX, glTF (GLB, VRM, VRMA), VMD of MikuMikuDance and ASF/AMC";

/// A kind of file: how to recognise it, and what it is with the way out.
struct Kind {
    is: fn(&[u8]) -> bool,
    says: &'static str,
}

const KINDS: [Kind; 6] = [
    Kind {
        is: |head| head.starts_with(b"BLENDER"),
        says: "is a scene of Blender: export it there as FBX, glTF or BVH, or use the add-on of genga in Blender",
    },
    Kind {
        is: |head| head.starts_with(b"//Maya") || is_chunk(head, b"FOR4", b"Maya"),
        says: "is a scene of Maya: export it there as FBX",
    },
    Kind {
        is: |head| head.starts_with(b"#usda") || head.starts_with(b"PXR-USDC"),
        says: "is USD: export the motion as glTF or FBX from the program that wrote it, or by way of Blender",
    },
    Kind {
        is: |head| head.starts_with(b"PK\x03\x04") || head.starts_with(b"7z\xbc\xaf"),
        says: "is an archive: unpack it, and give a motion that is in it",
    },
    Kind { is: is_picture, says: "is a picture, which has no joints" },
    Kind {
        is: is_film,
        says: "is a film or a sound, which has no joints: motion capture from video makes a motion of a film",
    },
];

fn is_picture(head: &[u8]) -> bool {
    let begins: [&[u8]; 4] = [b"\x89PNG", b"\xff\xd8\xff", b"GIF8", b"%PDF"];
    begins.iter().any(|begin| head.starts_with(begin))
}

fn is_film(head: &[u8]) -> bool {
    let begins: [&[u8]; 3] = [b"\x1a\x45\xdf\xa3", b"OggS", b"ID3"];
    let is_mp4 = head.get(4..8) == Some(b"ftyp");
    is_mp4 || head.starts_with(b"RIFF") || begins.iter().any(|begin| head.starts_with(begin))
}

/// Whether the file is a chunk of a name, with contents of a kind.
fn is_chunk(head: &[u8], name: &[u8], kind: &[u8]) -> bool {
    head.starts_with(name) && head.get(8..12) == Some(kind)
}

/// Whether the first bytes are of such a file.
pub(super) fn begins(head: &[u8]) -> bool {
    KINDS.iter().any(|kind| (kind.is)(head))
}

/// Refuses such a file.
pub(super) fn refuse(bytes: &[u8]) -> Error {
    let known = KINDS.iter().find(|kind| (kind.is)(bytes));
    let says = known.map_or("is no motion", |kind| kind.says);
    Error::Motion { place: Place::Whole, message: format!("this {says}; genga reads {READ}") }
}

/// Names the formats that are read, for a file that was taken for a BVH and does not begin like one.
pub(super) fn with_formats(error: Error) -> Error {
    match error {
        Error::Motion { place, message } => {
            Error::Motion { place, message: format!("{message}; genga reads {READ}") }
        }
        other => other,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Options;

    #[test]
    fn a_file_of_another_kind_is_named_with_the_way_out_and_all_formats() {
        let said = |bytes: &[u8]| Options::default().read(bytes).unwrap_err().to_string();
        for (bytes, words) in [
            (&b"BLENDER-v300"[..], "export it there as FBX"),
            (b"//Maya ASCII 2020 scene", "a scene of Maya"),
            (b"FOR4\0\0\0\x08Maya", "a scene of Maya"),
            (b"#usda 1.0", "USD"),
            (b"PK\x03\x04", "unpack it"),
            (b"\x89PNG\r\n", "a picture"),
            (b"\0\0\0\x20ftypisom", "a film"),
            (b"Dear reader", "found \"Dear\""),
            (b"", "the end of the file"),
        ] {
            let said = said(bytes);
            assert!(said.contains(words) && said.ends_with(READ), "{said}");
        }
    }
}
