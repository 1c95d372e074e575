//! Pictures of figures as formats: pages of SVG, and what the program alone can make, pixels.

use serde::{Deserialize, Serialize};

use crate::deliver::{Cut, Settings, Sink};
use crate::error::Error;
use crate::knob::{knob, knobs};
use crate::plot::{self, Camera, FigureBody};

/// What all pictures of figures have in common.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct FigureSettings {
    /// A PNG beside every page of SVG; default no.
    pub png: bool,
    /// How figures are drawn; default mannequin.
    pub body: FigureBody,
}

knobs!(figures::FigureSettings {
    png: knob("PNGも", "A PNG beside every page of SVG.", "SVGの各ページにPNGも添える。"),
    body: knob(
        "人物",
        "A lay figure, where a rig has head, arms and legs, or bones alone.",
        "デッサン人形、または棒人間で描く。頭と両腕両脚のない体は棒人間になる。"
    ),
});

/// Source above, result below.
pub(super) fn strip(cut: &Cut<'_>, settings: &Settings, put: &mut Sink<'_>) -> Result<(), Error> {
    let pages = plot::Strip { body: settings.figures.body, ..settings.strip.clone() }
        .draw(cut.name, cut.clip, cut.sheet)?;
    put_pages("strip", &pages, &settings.figures, put)
}

/// The genga one by one.
pub(super) fn contact(cut: &Cut<'_>, settings: &Settings, put: &mut Sink<'_>) -> Result<(), Error> {
    let pages = plot::ContactSheet { body: settings.figures.body, ..settings.contact.clone() }
        .draw(cut.name, cut.clip, cut.sheet)?;
    put_pages("contact", &pages, &settings.figures, put)
}

/// Neighbouring drawings through each other.
pub(super) fn onion(cut: &Cut<'_>, settings: &Settings, put: &mut Sink<'_>) -> Result<(), Error> {
    let pages = plot::OnionSkin { body: settings.figures.body, ..settings.onion.clone() }
        .draw(cut.name, cut.clip, cut.sheet)?;
    put_pages("onion", &pages, &settings.figures, put)
}

/// The page that plays the sheet.
pub(super) fn flipbook(
    cut: &Cut<'_>,
    settings: &Settings,
    put: &mut Sink<'_>,
) -> Result<(), Error> {
    let page = plot::FlipBook { body: settings.figures.body, ..settings.flipbook.clone() }
        .draw(cut.name, cut.clip, cut.sheet)?;
    put("flipbook.html", page.as_bytes())
}

/// Source beside result, moving. It is packed as it is drawn; what waits in memory is the packed file.
#[cfg(feature = "pictures")]
pub(super) fn preview(cut: &Cut<'_>, settings: &Settings, put: &mut Sink<'_>) -> Result<(), Error> {
    let mut bytes = Vec::new();
    plot::Preview { body: settings.figures.body, ..settings.preview.clone() }
        .draw(cut.name, cut.clip, cut.sheet, &mut bytes)?;
    put("preview.gif", &bytes)
}

/// A picture a drawing.
#[cfg(feature = "pictures")]
pub(super) fn images(cut: &Cut<'_>, settings: &Settings, put: &mut Sink<'_>) -> Result<(), Error> {
    let each = |name: &str, png: Vec<u8>| put(&format!("images/{name}"), &png);
    plot::NumberedImages { body: settings.figures.body, ..settings.images.clone() }
        .draw(cut.clip, cut.sheet, each)
}

/// The first page has the name alone, the next `-2`, `-3` and so on.
fn put_pages(
    name: &str,
    pages: &[String],
    settings: &FigureSettings,
    put: &mut Sink<'_>,
) -> Result<(), Error> {
    for (at, page) in pages.iter().enumerate() {
        let number = if at == 0 { String::new() } else { format!("-{}", at + 1) };
        put(&format!("{name}{number}.svg"), page.as_bytes())?;
        if settings.png {
            put(&format!("{name}{number}.png"), &png(page)?)?;
        }
    }
    Ok(())
}

#[cfg(feature = "pictures")]
fn png(svg: &str) -> Result<Vec<u8>, Error> {
    crate::plot::png_from_svg(svg, 1.0)
}

#[cfg(not(feature = "pictures"))]
fn png(_: &str) -> Result<Vec<u8>, Error> {
    Err(Error::setting("figures.png", "this build has no fonts and no pixels; it writes SVG alone"))
}

impl Settings {
    /// Sets the camera of every picture of figures.
    pub fn look_from(&mut self, camera: Camera) {
        self.strip.camera = camera;
        self.contact.camera = camera;
        self.onion.camera = camera;
        self.flipbook.camera = camera;
        self.preview.camera = camera;
        self.mp4.camera = camera;
        self.images.camera = camera;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::deliver::Format;

    #[test]
    fn one_camera_for_every_picture_and_one_each_on_top() {
        let mut settings = Settings::default();
        settings.look_from(Camera::Front);
        settings.set("strip.camera", "three-quarter").unwrap();
        assert_eq!(settings.strip.camera, Camera::ThreeQuarter);
        let cameras = [settings.contact.camera, settings.onion.camera, settings.flipbook.camera];
        assert_eq!(cameras, [Camera::Front; 3]);
        assert!(settings.set("strip.camera", "top").is_err());
        assert!(settings.set("strip.rows", "0").is_err(), "settings are checked as they are set");
    }

    #[test]
    fn pages_are_numbered_from_the_second_and_have_their_png_beside_them() {
        let mut names = Vec::new();
        let pages = [
            "<svg xmlns='http://www.w3.org/2000/svg' width='8' height='8'/>".to_owned(),
            String::new(),
        ];
        let mut put = |name: &str, _: &[u8]| {
            names.push(name.to_owned());
            Ok(())
        };
        put_pages("strip", &pages, &FigureSettings::default(), &mut put).unwrap();
        // Without the program there are no pixels.
        let png = cfg!(feature = "pictures");
        put_pages(
            "onion",
            &pages[..1],
            &FigureSettings { png, ..FigureSettings::default() },
            &mut put,
        )
        .unwrap();
        let all = ["strip.svg", "strip-2.svg", "onion.svg", "onion.png"];
        assert_eq!(names, all[..3 + usize::from(png)]);
    }

    #[test]
    fn the_formats_of_figures_are_there_by_name() {
        let pixels: &[&str] = if cfg!(feature = "pictures") { &["preview", "images"] } else { &[] };
        for name in ["strip", "contact", "onion", "flipbook"].iter().chain(pixels) {
            assert_eq!(&Format::find(name).unwrap().name, name);
        }
        assert_eq!(plot::Strip::default(), Settings::default().strip);
    }
}
