//! The order (書き出しの指定): what is exported, from where it is seen, and where it goes. It is asked for before each
//! export, and remembered.

use std::path::PathBuf;

use crate::deliver::{FORMATS, Settings};
use crate::plot::Camera;

/// Cameras that are offered, with the words of each.
pub(super) const CAMERAS: [(Camera, &str, &str); 4] = [
    (Camera::Auto, "where most is seen", "いちばん動きの見える向き"),
    (Camera::Front, "front", "正面"),
    (Camera::Side, "side", "側面"),
    (Camera::ThreeQuarter, "three-quarter", "斜め"),
];

/// What is exported beside what every export has.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Order {
    /// Names of formats, in the order of [`FORMATS`].
    pub(super) formats: Vec<&'static str>,
    pub(super) camera: Camera,
    /// What is asked of the formats beside it.
    pub(super) asked: Settings,
    pub(super) folder: PathBuf,
}

impl Order {
    /// All that is asked of the formats.
    pub(super) fn settings(&self) -> Settings {
        let mut settings = self.asked.clone();
        settings.look_from(self.camera);
        settings
    }

    /// What is remembered of it, as a text.
    pub(super) fn text(&self) -> String {
        let camera = CAMERAS.iter().find(|(camera, ..)| *camera == self.camera);
        let camera = camera.map_or("", |(_, word, _)| *word);
        format!("{}\n{camera}\n{}", self.formats.join(" "), self.asked.lines())
    }

    /// What was remembered, with the folder of a clip. What is not known any more is left out.
    pub(super) fn remembered(text: &str, folder: PathBuf) -> Self {
        let mut lines = text.lines();
        let words: Vec<&str> = lines.next().unwrap_or_default().split(' ').collect();
        let camera = lines.next().unwrap_or_default();
        let camera = CAMERAS.iter().find(|(_, word, _)| *word == camera);
        let asked = Settings::from_lines(text);
        let formats = FORMATS.iter().map(|format| format.name);
        Self {
            asked,
            formats: formats.filter(|name| words.contains(name)).collect(),
            camera: camera.map_or(Camera::Auto, |(camera, ..)| *camera),
            folder,
        }
    }

    /// With a format, or without it.
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
        order.asked.set("xsheet.title", "空 の旅").unwrap();
        order.asked.set("figures.png", "true").unwrap();
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
