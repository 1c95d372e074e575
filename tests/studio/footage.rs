//! Reference footage: pictures and sound recorded beside the motion.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::thread;
use std::time::{Duration, Instant};

use egui::{Key, Modifiers, Theme};
use egui_kittest::kittest::{NodeT, Queryable};
use genga::recipe::Footage;
use genga_studio::Language;

use crate::harness::{Table, sample};

/// Writes numbered pictures, each in its own shade.
pub(crate) fn sequence(folder: &Path, count: usize, side: [u32; 2]) -> PathBuf {
    std::fs::create_dir_all(folder).unwrap();
    for at in 0..count {
        let shade = image::Rgb([(at % 200) as u8, 90, 160]);
        let name = folder.join(format!("take_{:04}.png", at + 1));
        image::RgbImage::from_pixel(side[0], side[1], shade).save(name).unwrap();
    }
    folder.join("take_0001.png")
}

/// Writes a sound of some seconds, with a beat every half second.
pub(crate) fn beats(file: &Path, seconds: u32) {
    let spec = hound::WavSpec {
        channels: 1,
        sample_rate: 8000,
        bits_per_sample: 16,
        sample_format: hound::SampleFormat::Int,
    };
    let mut writer = hound::WavWriter::create(file, spec).unwrap();
    for at in 0..seconds * 8000 {
        let within = f64::from(at % 4000) / 8000.0;
        let tone = (within * 440.0 * std::f64::consts::TAU).sin() * (-within * 14.0).exp();
        writer.write_sample((tone * 24_000.0) as i16).unwrap();
    }
    writer.finalize().unwrap();
}

impl Table {
    pub(crate) fn footage(&self) -> &Footage {
        &self.harness.state().document().unwrap().footage
    }

    /// Waits until the sound and every wanted picture have been read.
    pub(crate) fn look(&mut self) {
        for _ in 0..4000 {
            self.harness.step();
            if !self.harness.state().is_looking() {
                self.harness.run();
                return;
            }
            thread::sleep(Duration::from_millis(5));
        }
        panic!("the pictures were not read");
    }

    /// The caption below the picture.
    fn standing(&self) -> String {
        let picture = self.harness.get_by_label("Reference");
        picture.accesskit_node().value().unwrap()
    }

    /// Opens a take in a folder of its own, and gives the studio pictures and a sound for it.
    fn with_footage(place: &Path) -> Self {
        let clip = place.join("kick.bvh");
        std::fs::copy(sample("kick.bvh"), &clip).unwrap();
        let pictures = sequence(&place.join("pictures"), 40, [64, 36]);
        let sound = place.join("take.wav");
        beats(&sound, 2);
        let mut table = Self::with(&clip, Arc::default(), Language::English, Theme::Light);
        for file in [pictures, sound] {
            table.harness.state_mut().open_any(&file);
            table.harness.run();
        }
        table.look();
        table
    }
}

#[test]
fn pictures_go_with_the_play_head_by_their_own_rate_and_an_offset() {
    let place = tempfile::tempdir().unwrap();
    let mut table = Table::with_footage(place.path());
    assert_eq!(table.footage().pictures, Path::new("pictures/take_0001.png").to_str().unwrap());
    assert_eq!(table.footage().sound, "take.wav");
    table.tap(Modifiers::NONE, Key::Escape);
    assert_eq!(table.standing(), "picture 1 / 40");
    table.go(11);
    assert_eq!(table.standing(), "picture 11 / 40");
    table.harness.get_by_label("Reference…").click();
    table.harness.run();
    table.write("First picture on koma", "3");
    table.tap(Modifiers::NONE, Key::Enter);
    table.write("pictures a second", "48");
    table.tap(Modifiers::NONE, Key::Enter);
    assert_eq!((table.footage().offset, table.footage().fps), (2, 48.0));
    assert_eq!(table.standing(), "picture 17 / 40");
    table.tap(Modifiers::NONE, Key::Escape);
    table.tap(Modifiers::NONE, Key::Escape);
    table.go(2);
    assert_eq!(table.standing(), "no picture on this koma");
    table.tap(Modifiers::COMMAND, Key::Z);
    assert_eq!((table.footage().offset, table.footage().fps), (2, 24.0), "undone one by one");
}

#[test]
fn what_stands_beside_is_found_again_and_is_no_drawing() {
    let place = tempfile::tempdir().unwrap();
    let mut table = Table::with_footage(place.path());
    let kept = table.desk.text(&place.path().join("kick.genga-autosave.toml")).unwrap();
    assert!(kept.contains("[footage]"), "{kept}");
    table.tap(Modifiers::COMMAND, Key::S);
    let desk = Arc::clone(&table.desk);
    let clip = place.path().join("kick.bvh");
    let mut again = Table::with(&clip, Arc::clone(&desk), Language::English, Theme::Light);
    assert_eq!(again.footage(), table.footage());
    again.look();
    assert_eq!(again.standing(), "picture 1 / 40");
    // Recovered as well.
    let saved = desk.text(&place.path().join("kick.genga.toml")).unwrap();
    let left = saved.replace("sound = \"take.wav\"", "sound = \"take.wav\"\nsound_offset = 5");
    desk.write_text(&place.path().join("kick.genga-autosave.toml"), &left);
    let mut third = Table::with(&clip, desk, Language::English, Theme::Light);
    third.harness.get_by_label("Recover").click();
    third.harness.run();
    assert_eq!(third.footage().sound_offset, 5);
    third.tap(Modifiers::COMMAND, Key::Z);
    assert_eq!(third.footage().sound_offset, 0);
}

#[test]
fn the_window_does_not_wait_for_a_picture() {
    let place = tempfile::tempdir().unwrap();
    let mut table = Table::with_footage(place.path());
    table.tap(Modifiers::NONE, Key::Escape);
    let desk = Arc::clone(&table.desk);
    let reading = desk.is_reading.lock().unwrap();
    let begin = Instant::now();
    table.go(30);
    (0..10).for_each(|_| table.harness.step());
    assert!(begin.elapsed() < Duration::from_secs(20), "it waited");
    assert_eq!(table.standing(), "picture 30 / 40");
    assert!(table.harness.state().is_looking());
    drop(reading);
    table.look();
}

#[test]
fn the_sound_is_played_from_where_the_play_head_is_and_ends_with_it() {
    let place = tempfile::tempdir().unwrap();
    let mut table = Table::with_footage(place.path());
    table.tap(Modifiers::NONE, Key::Escape);
    table.go(13);
    table.harness.key_press(Key::Space);
    table.harness.step();
    table.harness.step();
    let played = |table: &Table| table.desk.played.lock().unwrap().clone();
    let first = played(&table);
    assert_eq!((first.len(), &*first[0].0), (1, &*place.path().join("take.wav")));
    // Koma 13 begins half a second in; a step of the harness may come one or two koma later.
    assert!((0.5..=0.75).contains(&first[0].1), "{first:?}");
    assert_eq!(first[0].2.strong_count(), 1, "it is heard");
    table.harness.key_press(Key::Space);
    table.harness.step();
    table.harness.step();
    assert_eq!(first[0].2.strong_count(), 0, "it ends where nothing is played");
    // A machine without sound says so, once.
    *table.desk.is_silent.lock().unwrap() = true;
    table.harness.key_press(Key::Space);
    table.harness.step();
    table.harness.step();
    table.harness.get_by_label_contains("no sound is heard");
    assert_eq!(played(&table).len(), 1);
}

#[test]
fn what_cannot_be_shown_is_said_by_its_name() {
    let place = tempfile::tempdir().unwrap();
    let mut table = Table::with_footage(place.path());
    let torn = place.path().join("torn.wav");
    std::fs::write(&torn, "RIFF").unwrap();
    table.harness.state_mut().open_any(&torn);
    table.look();
    table.harness.get_by_label_contains("torn.wav: ");
    table.harness.state_mut().open_any(Path::new("/nowhere/take_0001.png"));
    table.look();
    table.harness.get_by_label_contains("take_0001.png: ");
    let mut empty = Table::empty(Arc::default(), Language::English, Theme::Light);
    empty.harness.state_mut().open_any(&torn);
    empty.harness.run();
    empty.harness.get_by_label_contains("Open a clip first");
}
