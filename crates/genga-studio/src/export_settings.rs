//! The order (書き出しの指定): formats, camera and folder of an export. It is asked for before each export, and remembered.

use std::path::PathBuf;

use genga_files::{FORMATS, HAS_PIXELS, Settings};
use genga_plot::Camera;

/// Cameras on offer, with their English and Japanese labels.
pub(super) const CAMERAS: [(Camera, &str, &str); 4] = [
    (Camera::Auto, "auto (most motion)", "動きが最も見える向き"),
    (Camera::Front, "front", "正面"),
    (Camera::Side, "side", "側面"),
    (Camera::ThreeQuarter, "three-quarter", "斜め"),
];

/// Settings of an export. Some formats are always exported and not listed here.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Order {
    /// Names of formats, in the order of [`FORMATS`].
    pub(super) formats: Vec<&'static str>,
    pub(super) camera: Camera,
    /// Settings of the formats, apart from the camera.
    pub(super) asked: Settings,
    pub(super) folder: PathBuf,
    /// Name of the destination that was chosen. Empty for formats of its own.
    pub(super) to: String,
}

/// What stands before the destination in a remembered order.
const TO: &str = "to ";

impl Order {
    /// All settings of the formats, camera included.
    pub(super) fn settings(&self) -> Settings {
        let mut settings = self.asked.clone();
        settings.look_from(self.camera);
        settings
    }

    /// Writes the order, without its folder, as a text to be remembered.
    pub(super) fn text(&self) -> String {
        let camera = CAMERAS.iter().find(|(camera, ..)| *camera == self.camera);
        let camera = camera.map_or("", |(_, word, _)| *word);
        format!("{}\n{camera}\n{TO}{}\n{}", self.formats.join(" "), self.to, self.asked.lines())
    }

    /// Reads a remembered order, and sets its folder. Unknown names are skipped.
    pub(super) fn remembered(text: &str, folder: PathBuf) -> Self {
        let mut lines = text.lines();
        let words: Vec<&str> = lines.next().unwrap_or_default().split(' ').collect();
        let camera = lines.next().unwrap_or_default();
        let to = lines.find_map(|line| line.strip_prefix(TO)).unwrap_or_default();
        let camera = CAMERAS.iter().find(|(_, word, _)| *word == camera);
        let mut asked = Settings::from_lines(text);
        // A build without pixels does not ask for this, so nobody could take it back.
        asked.figures.png &= HAS_PIXELS;
        let formats = FORMATS.iter().map(|format| format.name);
        Self {
            asked,
            formats: formats.filter(|name| words.contains(name)).collect(),
            camera: camera.map_or(Camera::Auto, |(camera, ..)| *camera),
            folder,
            to: to.to_owned(),
        }
    }

    /// Adds a format, or removes it.
    pub(super) fn toggle(&mut self, name: &'static str, is_on: bool) {
        let is_wanted =
            |other: &&str| if *other == name { is_on } else { self.formats.contains(other) };
        let formats = FORMATS.iter().map(|format| format.name);
        self.formats = formats.filter(is_wanted).collect();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_order_is_remembered_without_its_folder() {
        let mut order = Order::remembered("\nside\n", PathBuf::from("/out/kick"));
        order.to = "OpenToonz".into();
        order.asked.set("xsheet.title", "空 の旅").unwrap();
        order.asked.set("figures.body", "sticks").unwrap();
        order.toggle("xsheet", true);
        order.toggle("xdts", true);
        order.toggle("strip", true);
        order.toggle("strip", false);
        assert_eq!(order.formats.len(), 2);
        let again = Order::remembered(&order.text(), PathBuf::from("/out/kick"));
        assert_eq!(again, order);
        let none =
            Order::remembered("no_such_format\nfrom below\nxls.bom 1\ncsv.bom ?\n", PathBuf::new());
        assert_eq!((none.formats.len(), none.camera), (0, Camera::Auto));
        assert_eq!(none.asked, Settings::default());
    }
}
