//! Draws the numbered images as pixels.

use glam::DVec3;
use rayon::prelude::*;

use super::NumberedImages;
use crate::canvas::Inks;
use crate::drawings::{columns, composed};
use crate::figure::{Drawn, Figure};
use crate::paper_point::Point;
use crate::pixels::{Digits, Pixels};
use crate::points::Showing;
use crate::stage::{Bounds, Stage};
use crate::style;
use genga::error::Error;
use genga::motion::{Clip, Composite, first_round, layer_of};
use genga::sheet::{Layer, Number, Sheet};

/// Share of the picture on each side that figures stay out of: the edge of the safe area.
const SAFE: f64 = 0.05;

/// Number of images that are drawn at once: work for many cores, and little memory.
const AT_ONCE: usize = 64;

/// The pictures of a drawing in a column of its own, as PNG.
#[derive(Debug, Clone)]
pub struct ColumnPictures {
    /// Index of its layer, from 0.
    pub layer: usize,
    /// Its own index in the layer, from 0.
    pub drawing: usize,
    /// The picture among all drawings; marks show its number in CELL.
    pub douga: Vec<u8>,
    /// The picture among the genga; marks show its number in ACTION. `None` for an inbetween.
    pub genga: Option<Vec<u8>>,
}

/// Stage, backdrop and digits of all images.
struct Easel {
    stage: Stage,
    backdrop: Pixels,
    /// End of the number's base line and its digits, if the number is written.
    number: Option<(Point, Digits)>,
}

impl Easel {
    /// Draws figures, each with its number, on all cores. Returns the PNGs in the same order.
    fn pictures(&self, figures: &[(Drawn, &Number)]) -> Result<Vec<Vec<u8>>, Error> {
        let draw = |pixels: &mut Pixels, (drawn, number): &(Drawn, &Number)| {
            self.picture(pixels, drawn, number)
        };
        figures.par_iter().map_init(|| self.backdrop.clone(), draw).collect()
    }

    /// Draws some drawings of a layer, each with its number among all drawings and among the genga.
    fn of_column(
        &self,
        layer: usize,
        poses: &[(usize, Drawn)],
        (numbers, genga): (&[Number], &[Option<Number>]),
    ) -> Result<Vec<ColumnPictures>, Error> {
        let draw = |pixels: &mut Pixels, (drawing, drawn): &(usize, Drawn)| {
            let (drawing, douga) = (*drawing, self.picture(pixels, drawn, &numbers[*drawing])?);
            let genga = match &genga[drawing] {
                None => None,
                // Without numbers both are the same picture.
                Some(_) if self.number.is_none() => Some(douga.clone()),
                Some(number) => Some(self.picture(pixels, drawn, number)?),
            };
            Ok(ColumnPictures { layer, drawing, douga, genga })
        };
        poses.par_iter().map_init(|| self.backdrop.clone(), draw).collect()
    }

    fn picture(
        &self,
        pixels: &mut Pixels,
        drawn: &Drawn,
        number: &Number,
    ) -> Result<Vec<u8>, Error> {
        pixels.copy(&self.backdrop);
        pixels.figure(drawn, Inks::Sides);
        if let Some((at, digits)) = &self.number {
            digits.write(pixels, number, *at);
        }
        pixels.png()
    }
}

/// Poses drawings on a koma that shows them. Those of a loop stand where its first round has come to: behind the seam the
/// body is a round's way further than in the file.
struct Placing<'a> {
    own: Showing<'a>,
    played: Showing<'a>,
    /// Drawing on each koma of the first round, in the sheet and as it is played out.
    on_screen: Vec<(usize, usize)>,
}

impl<'a> Placing<'a> {
    fn new(own: &'a Composite<'a>, played: &'a Composite<'a>, figure: &'a Figure) -> Self {
        let marks = figure.marks();
        let on_screen = own.layer().koma().zip(played.layer().koma()).collect();
        Self { own: Showing::new(own, marks), played: Showing::new(played, marks), on_screen }
    }

    /// Returns the points of a drawing on a koma.
    fn points(&mut self, drawing: usize, koma: usize) -> Vec<DVec3> {
        match self.on_screen.get(koma) {
            Some(&(own, played)) if own == drawing => self.played.points(played, koma),
            // A drawing that is never shown.
            _ => self.own.points(drawing, koma),
        }
    }
}

impl NumberedImages {
    /// Draws one image per drawing and passes each with its file name to `take`, in order.
    ///
    /// # Errors
    /// [`Error::Setting`] as in [`NumberedImages::validate`]; [`Error::Sheet`] or [`Error::Picture`] if clip
    /// and sheet have nothing to show; any error of `take`.
    pub fn draw<E: From<Error>>(
        &self,
        clip: &Clip,
        sheet: &Sheet,
        mut take: impl FnMut(&str, Vec<u8>) -> Result<(), E>,
    ) -> Result<(), E> {
        self.set_up(clip, sheet, |composite, easel, placing| {
            let name: String = composite.layer().name.chars().map(plain).collect();
            let drawings = drawings(composite);
            let mut numbers = composite.layer().numbers();
            // Several columns have numbers of their own. What all draw together is known by its koma.
            if columns(sheet).len() > 1 {
                let koma = |(_, koma): &(usize, usize)| (sheet.blank.before + koma + 1).into();
                numbers = drawings.iter().map(koma).collect();
            }
            for some in drawings.chunks(AT_ONCE) {
                let figure = |(at, koma): &(usize, usize)| {
                    (easel.stage.draw(&placing.points(*at, *koma)), &numbers[*at])
                };
                let figures: Vec<_> = some.iter().map(figure).collect();
                for ((at, _), picture) in some.iter().zip(easel.pictures(&figures)?) {
                    take(&format!("{name}_{:04}.png", numbers[*at]), picture)?;
                }
            }
            Ok(())
        })
    }

    /// Draws each column alone, with only the parts of the body that its joints turn. Passes the pictures of each drawing
    /// that is on screen to `take`. All images fit on each other.
    ///
    /// # Errors
    /// As [`NumberedImages::draw`].
    pub fn draw_columns<E: From<Error>>(
        &self,
        clip: &Clip,
        sheet: &Sheet,
        mut take: impl FnMut(ColumnPictures) -> Result<(), E>,
    ) -> Result<(), E> {
        self.set_up(clip, sheet, |composite, easel, placing| {
            let columns = layer_of(clip.skeleton(), sheet)?;
            let on_screen: Vec<usize> = composite.layer().koma().collect();
            for (at, layer) in sheet.layers.iter().enumerate() {
                let own = columns.iter().map(|of| *of == at).collect();
                let stage = Stage { figure: easel.stage.figure.only(own), ..easel.stage.clone() };
                let numbers = (layer.numbers(), layer.genga_numbers());
                for some in first_shown(layer).chunks(AT_ONCE) {
                    let pose = |(drawing, koma): &(usize, usize)| {
                        (*drawing, stage.draw(&placing.points(on_screen[*koma], *koma)))
                    };
                    let poses: Vec<_> = some.iter().map(pose).collect();
                    for own in easel.of_column(at, &poses, (&numbers.0, &numbers.1))? {
                        take(own)?;
                    }
                }
            }
            Ok(())
        })
    }

    /// Sets up what all images share, and lets `draw` draw them.
    fn set_up<E: From<Error>>(
        &self,
        clip: &Clip,
        sheet: &Sheet,
        draw: impl FnOnce(&Composite<'_>, &Easel, &mut Placing<'_>) -> Result<(), E>,
    ) -> Result<(), E> {
        let composite = composed(clip, sheet)?;
        let (played_clip, played) = first_round(clip, sheet);
        let played = composed(&played_clip, &played)?;
        let figure = Figure::new(clip, self.body);
        let mut placing = Placing::new(&composite, &played, &figure);
        let drawings = drawings(&composite).into_iter();
        let poses: Vec<_> = drawings.map(|(at, koma)| placing.points(at, koma)).collect();
        let easel = self.easel(clip, &figure, &poses)?;
        draw(&composite, &easel, &mut placing)
    }

    fn easel(&self, clip: &Clip, figure: &Figure, poses: &[Vec<DVec3>]) -> Result<Easel, Error> {
        self.validate()?;
        let stage = self.stage(clip, figure, poses);
        let backdrop = self.backdrop(&stage)?;
        let digits = || Digits::new(0.03 * f64::from(self.height).max(300.0), style::FAINT);
        let number = self.marks.then(|| (self.inside(0.99 - SAFE), digits()));
        Ok(Easel { stage, backdrop, number })
    }

    /// Returns the point at a share of the picture's width and height, from its upper left corner.
    fn inside(&self, share: f64) -> (f64, f64) {
        (share * f64::from(self.width), share * f64::from(self.height))
    }

    fn stage(&self, clip: &Clip, figure: &Figure, poses: &[Vec<DVec3>]) -> Stage {
        let view = self.camera.view(clip, poses);
        let bounds = Bounds::new(figure, &view, poses);
        let (wide, high) = self.inside(1.0 - 4.0 * SAFE);
        let (width, height) = self.inside(1.0);
        let floor = (1.0 - 2.0 * SAFE) * height;
        Stage::filling(figure.clone(), view, &bounds, (0.5 * width, floor), (wide, high))
    }

    /// Draws the backdrop that all images share.
    fn backdrop(&self, stage: &Stage) -> Result<Pixels, Error> {
        let size = (self.width, self.height);
        let mut pixels = if self.transparent { Pixels::clear(size)? } else { Pixels::paper(size)? };
        if self.marks {
            self.mark(&mut pixels, stage);
        }
        Ok(pixels)
    }

    /// Draws the safe area, the floor and a register mark in each corner.
    fn mark(&self, pixels: &mut Pixels, stage: &Stage) {
        let (width, height) = self.inside(1.0);
        let (x, y) = self.inside(SAFE);
        pixels.frame((x, y), (width - x, height - y), style::GRID);
        pixels.line((x, stage.at.1), (width - x, stage.at.1), style::GRID, 1.25);
        let arm = 0.02 * height;
        for x in [1.5 * arm, width - 1.5 * arm] {
            for y in [1.5 * arm, height - 1.5 * arm] {
                pixels.line((x - arm, y), (x + arm, y), style::INK, 1.0);
                pixels.line((x, y - arm), (x, y + arm), style::INK, 1.0);
                pixels.hoop((x, y), 0.5 * arm, style::INK, 1.0);
            }
        }
    }
}

/// Returns all drawings, each with the first koma that shows it.
fn drawings(composite: &Composite<'_>) -> Vec<(usize, usize)> {
    composite.first_koma().into_iter().enumerate().collect()
}

/// Returns the drawings of a layer that are on screen, each with its first koma, in the order of time.
fn first_shown(layer: &Layer) -> Vec<(usize, usize)> {
    let first = layer.first_koma().into_iter().enumerate();
    let mut shown: Vec<_> = first.filter_map(|(drawing, koma)| Some((drawing, koma?))).collect();
    shown.sort_by_key(|(_, koma)| *koma);
    shown
}

/// Replaces a letter by `_` unless every system allows it in file names.
fn plain(letter: char) -> char {
    let kept = letter.is_alphanumeric() || letter == '-';
    if kept { letter } else { '_' }
}
