//! Makes the pictures of the documentation: every picture of figures, of a clip, into a folder.
//!
//! `cargo run --example pictures` draws `data/kick.bvh` into `docs/pictures`; with `-- CLIP.bvh FOLDER`
//! and a camera behind it draws another, as PNG beside the SVG.

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};

use genga::edits::Edits;
use genga::motion::bvh;
use genga::pipeline::{Breakdown, Engine};
use genga::plot::{
    self, Camera, ContactSheet, FlipBook, NumberedImages, OnionSkin, Preview, Strip,
};
use genga::recipe::Recipe;

type Result<T> = std::result::Result<T, Box<dyn Error>>;

fn main() -> Result<()> {
    let mut words = std::env::args().skip(1);
    let named = words.next();
    let clip = PathBuf::from(named.as_deref().unwrap_or("data/kick.bvh"));
    let folder = PathBuf::from(words.next().as_deref().unwrap_or("docs/pictures"));
    let camera = words.next().map_or(Ok(Camera::Auto), |word| word.parse())?;
    let cut = clip.file_stem().ok_or("a clip has a name")?.to_string_lossy().into_owned();
    let mut recipe = Recipe::default();
    for setting in words {
        let (name, value) = setting.split_once('=').ok_or("a setting is NAME=VALUE")?;
        recipe.set(name, value)?;
    }
    let read = bvh::read(&fs::read(&clip)?)?;
    let (motion, _) = bvh::lead_in::strip(read.clip);
    let mut engine = Engine::new(motion)?;
    let breakdown = engine.run(&recipe, &Edits::default())?;
    fs::create_dir_all(&folder)?;
    let pictures = Pictures { cut, folder, camera, all: named.is_some() };
    pictures.pages(&breakdown)?;
    pictures.moving(&breakdown)
}

/// Where the pictures go and what they show.
struct Pictures {
    cut: String,
    folder: PathBuf,
    camera: Camera,
    /// Everything, not what the documentation shows alone.
    all: bool,
}

impl Pictures {
    fn pages(&self, breakdown: &Breakdown<'_>) -> Result<()> {
        let (cut, camera) = (self.cut.as_str(), self.camera);
        let (clip, sheet) = (breakdown.clip, breakdown.sheet);
        let strip = Strip { camera, ..Strip::default() };
        self.svg("strip", &strip.draw(cut, clip, sheet)?)?;
        let contact = ContactSheet { camera, ..ContactSheet::default() };
        self.svg("contact", &contact.draw(cut, clip, sheet)?)?;
        let onion = OnionSkin { camera, ..OnionSkin::default() };
        self.svg("onion", &onion.draw(cut, clip, sheet)?)
    }

    fn moving(&self, breakdown: &Breakdown<'_>) -> Result<()> {
        let (cut, camera) = (self.cut.as_str(), self.camera);
        let (clip, sheet) = (breakdown.clip, breakdown.sheet);
        let file = fs::File::create(self.path("preview.gif"))?;
        Preview { camera, ..Preview::default() }.draw(cut, clip, sheet, file)?;
        if !self.all {
            return Ok(());
        }
        let page = FlipBook { camera }.draw(cut, clip, sheet)?;
        fs::write(self.path("flipbook.html"), page)?;
        let folder = self.path("images");
        fs::create_dir_all(&folder)?;
        let images = NumberedImages { camera, marks: true, ..NumberedImages::default() };
        images
            .draw(clip, sheet, |name, png| -> Result<()> { Ok(fs::write(folder.join(name), png)?) })
    }

    /// The pages of a picture, a file each; in the documentation the first.
    fn svg(&self, name: &str, pages: &[String]) -> Result<()> {
        for (at, page) in pages.iter().enumerate().take(if self.all { 200 } else { 1 }) {
            let number = if at == 0 { String::new() } else { format!("-{}", at + 1) };
            let path = self.path(&format!("{name}{number}.svg"));
            fs::write(&path, page)?;
            if self.all {
                fs::write(png(&path), plot::png_from_svg(page, 1.0)?)?;
            }
        }
        Ok(())
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.join(format!("{}-{name}", self.cut))
    }
}

fn png(path: &Path) -> PathBuf {
    path.with_extension("png")
}
