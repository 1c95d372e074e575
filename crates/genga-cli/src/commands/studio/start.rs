//! Opens the studio's first clip or folder of takes.

use std::path::Path;

use crate::failure::Failure;
use crate::paths;
use genga_studio::Studio;

/// Refuses a folder without a clip, and a recipe for a whole folder.
pub(super) fn check(path: &Path, recipe: Option<&Path>) -> Result<(), Failure> {
    if !path.is_dir() {
        return Ok(());
    }
    let folder = path.display();
    let wrong = match (paths::first_clip(path), recipe) {
        (None, _) => format!("{folder}: there is no motion file in this folder"),
        (_, Some(_)) => {
            format!("--recipe is for one clip, and {folder} is a folder; name the clip")
        }
        (Some(_), None) => return Ok(()),
    };
    Err(Failure::AskedWrongly(wrong))
}

/// Opens a clip with its recipe, or the takes of a folder.
pub(super) fn open(studio: &mut Studio, path: &Path, recipe: Option<&Path>) {
    match path.is_dir() {
        true => studio.open_any(path),
        false => studio.open(path, recipe),
    }
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::sync::Arc;
    use std::thread::sleep;
    use std::time::Duration;

    use super::super::disk::Disk;
    use super::*;
    use clap::Parser;
    use genga_studio::{Host, Language};

    use crate::clip::Part;

    #[derive(Parser)]
    struct Line {
        #[command(flatten)]
        part: Part,
    }

    fn kick() -> Vec<u8> {
        fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/kick.bvh")).unwrap()
    }

    /// The title once a clip is on the table.
    fn title(studio: &mut Studio) -> String {
        let context = egui::Context::default();
        for _ in 0..600 {
            let mut output = context.run_ui(egui::RawInput::default(), |ui| studio.ui(ui));
            // Nothing is shown, so the font textures are dropped on purpose.
            output.textures_delta.clear();
            if studio.title() != "genga" {
                break;
            }
            sleep(Duration::from_millis(50));
        }
        studio.title()
    }

    #[test]
    fn a_folder_is_a_list_of_takes_of_which_the_first_is_opened() {
        let place = tempfile::tempdir().unwrap();
        for take in ["take-2.bvh", "take-1.bvh"] {
            fs::write(place.path().join(take), kick()).unwrap();
        }
        check(place.path(), None).unwrap();
        let mut studio = Studio::new(Arc::new(Disk::default()), Language::English);
        open(&mut studio, place.path(), None);
        let title = title(&mut studio);
        assert!(title.contains("take-1"), "{title}");
    }

    #[test]
    fn how_a_folder_is_read_is_how_its_takes_are_read() {
        let place = tempfile::tempdir().unwrap();
        let take = place.path().join("take.bvh");
        fs::write(&take, kick()).unwrap();
        let part = Line::parse_from(["genga", "--trim", "10..40"]).part;
        let desk = Disk::with_clip(Some(place.path().to_owned()), part);
        assert_eq!(desk.open(&take).unwrap().clip.len(), 30);
    }

    #[test]
    fn a_folder_without_a_clip_and_a_recipe_for_a_folder_are_refused() {
        let place = tempfile::tempdir().unwrap();
        let said = |recipe| check(place.path(), recipe).unwrap_err().to_string();
        assert!(said(None).ends_with("there is no motion file in this folder"));
        fs::write(place.path().join("take.bvh"), kick()).unwrap();
        assert!(said(Some(Path::new("r.toml"))).contains("--recipe is for one clip"));
    }
}
