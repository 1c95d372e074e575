//! Pictures of figures as formats: SVG pages, and PNG if the build has pictures.

use serde::{Deserialize, Serialize};

use crate::{Cut, Settings, Sink};
use genga::error::{Error, Warning};
use genga::knob::{knob, knobs};
use genga_plot::{Camera, FigureBody};

/// Settings common to all pictures of figures.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct FigureSettings {
    /// Whether every SVG page gets a PNG beside it; default no.
    pub png: bool,
    /// Body style of the figures; default mannequin.
    pub body: FigureBody,
    /// Camera of the row of poses; default auto. The other pictures have their own.
    pub camera: Camera,
}

knobs!(figures::FigureSettings {
    png: knob(
        "PNGも",
        "Whether each SVG page gets a PNG beside it.",
        "SVGの各ページにPNGも添えるか。",
    ),
    body: knob(
        "人物",
        "Style of the figures: mannequin, or sticks. A rig without head, arms and legs is drawn as \
         sticks.",
        "人物の描き方。デッサン人形（mannequin）か棒人間（sticks）。\
         頭と両腕両脚のない体は棒人間になる。"
    ),
    camera: knob("カメラ", "Camera of the row of poses.", "ポーズの図のカメラ。"),
});

/// Draws the source above the result.
pub(super) fn strip(cut: &Cut<'_>, settings: &Settings, put: &mut Sink<'_>) -> Result<(), Error> {
    let pages = genga_plot::Strip { body: settings.figures.body, ..settings.strip.clone() }
        .draw(cut.name, cut.clip, cut.sheet)?;
    put_pages("strip", &pages, &settings.figures, put)
}

/// Draws a contact sheet of the genga.
pub(super) fn contact(cut: &Cut<'_>, settings: &Settings, put: &mut Sink<'_>) -> Result<(), Error> {
    let pages =
        genga_plot::ContactSheet { body: settings.figures.body, ..settings.contact.clone() }
            .draw(cut.name, cut.clip, cut.sheet)?;
    put_pages("contact", &pages, &settings.figures, put)
}

/// Draws neighbouring drawings through each other.
pub(super) fn onion(cut: &Cut<'_>, settings: &Settings, put: &mut Sink<'_>) -> Result<(), Error> {
    let pages = genga_plot::OnionSkin { body: settings.figures.body, ..settings.onion.clone() }
        .draw(cut.name, cut.clip, cut.sheet)?;
    put_pages("onion", &pages, &settings.figures, put)
}

/// Draws one picture per drawing.
#[cfg(feature = "images")]
pub(super) fn images(cut: &Cut<'_>, settings: &Settings, put: &mut Sink<'_>) -> Result<(), Error> {
    let each = |name: &str, png: Vec<u8>| put(&format!("images/{name}"), &png);
    genga_plot::NumberedImages { body: settings.figures.body, ..settings.images.clone() }
        .draw(cut.clip, cut.sheet, each)
}

/// Writes the pages. The first has the plain name, the next ones `-2`, `-3` and so on.
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

/// Whether this build writes pages in pixels: [`FigureSettings::png`], `preview`, `mp4`.
pub const HAS_PIXELS: bool = cfg!(feature = "pictures");

#[cfg(feature = "pictures")]
fn png(svg: &str) -> Result<Vec<u8>, Error> {
    genga_plot::png_from_svg(svg, 1.0)
}

/// Warns if pages are asked for in pixels and this machine has no fonts for their words.
#[cfg(feature = "pictures")]
pub(super) fn font_notes(_: &Cut<'_>, settings: &Settings) -> Result<Vec<Warning>, Error> {
    let note = settings.figures.png.then(genga_plot::font_note).flatten();
    Ok(note.into_iter().collect())
}

#[cfg(not(feature = "pictures"))]
pub(super) fn font_notes(_: &Cut<'_>, _: &Settings) -> Result<Vec<Warning>, Error> {
    Ok(Vec::new())
}

#[cfg(not(feature = "pictures"))]
fn png(_: &str) -> Result<Vec<u8>, Error> {
    let message = "this genga was built without the feature `pictures`; it writes the SVG alone";
    Err(Error::setting("figures.png", message))
}

impl Settings {
    /// Sets the camera of all pictures of figures.
    pub fn look_from(&mut self, camera: Camera) {
        self.figures.camera = camera;
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
    use crate::Format;

    #[test]
    fn one_camera_for_every_picture_and_one_each_on_top() {
        let mut settings = Settings::default();
        settings.look_from(Camera::Front);
        let all = settings.settings();
        let cameras: Vec<_> =
            all.iter().filter(|(knob, _)| knob.name.ends_with(".camera")).collect();
        assert_eq!(cameras.len(), 8, "{cameras:?}");
        assert!(cameras.iter().all(|(_, camera)| camera == "front"), "{cameras:?}");
        settings.set("strip.camera", "three-quarter").unwrap();
        assert_eq!(settings.strip.camera, Camera::ThreeQuarter);
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
        // Only builds with the `pictures` feature can make pixels.
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
        for name in ["strip", "contact", "onion", "flipbook"] {
            assert_eq!(Format::find(name).unwrap().name, name);
        }
        for (name, is_here) in
            [("images", cfg!(feature = "images")), ("preview", cfg!(feature = "pictures"))]
        {
            match Format::find(name) {
                Ok(format) => assert!(is_here && format.name == name),
                Err(error) => assert!(!is_here && error.to_string().contains("the feature `")),
            }
        }
        assert_eq!(genga_plot::Strip::default(), Settings::default().strip);
    }
}
