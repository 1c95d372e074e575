//! Films several sheets of one motion on one stage (同じ舞台): the same figure, seen by the same camera.

use std::collections::HashMap;

use serde::Serialize;

use crate::browser::{self, PageFigure, STEPS, Steps, axes};
use crate::drawings::{composed, drawn_poses, sliding_poses};
use crate::figure::{Figure, FigureBody};
use crate::points::Posing;
use genga::error::Error;
use genga::motion::{Camera, Clip};
use genga::sheet::{Sheet, Source};

/// Data from which a page plays several sheets of one motion.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Films {
    height: f64,
    points: usize,
    figure: PageFigure,
    /// Axes of the camera: right, up, near.
    view: [[f64; 3]; 3],
    /// Distinct poses, in steps.
    poses: Vec<Vec<i32>>,
    /// Pose of each koma of each film, as indices into `poses`.
    films: Vec<Vec<usize>>,
}

impl Films {
    /// Films some sheets, each with the clip that its drawings belong to. Figure and camera are those of the
    /// source, whatever a sheet makes of it.
    ///
    /// # Errors
    /// [`Error::Sheet`] or [`Error::Picture`] if there is nothing to show.
    pub fn new(
        source: &Clip,
        sheets: &[(&Clip, &Sheet)],
        camera: Camera,
        body: FigureBody,
    ) -> Result<Self, Error> {
        let (_, first) = sheets.first().ok_or_else(|| Error::sheet("there is no sheet to show"))?;
        composed(source, first)?;
        let figure = Figure::new(source, body);
        let marks = figure.marks();
        let place = |koma| Source::At(first.clock.place_from_koma(koma));
        let moving = Posing::new(source, marks).all((0..first.length()).map(place));
        let view = camera.view(source, &moving);
        let steps = Steps::new(&figure, &view, &moving);
        let (mut poses, mut numbers) = (Vec::new(), HashMap::new());
        let mut number = |pose: Vec<i32>| {
            *numbers.entry(pose).or_insert_with_key(|pose| {
                poses.push(pose.clone());
                poses.len() - 1
            })
        };
        let mut films = Vec::with_capacity(sheets.len());
        for (clip, sheet) in sheets {
            let composite = composed(clip, sheet)?;
            let layer = composite.layer();
            let shown = sliding_poses(&composite, marks, layer.length()).unwrap_or_else(|| {
                let drawn = drawn_poses(&composite, marks, layer.drawings.len());
                layer.koma().map(|drawing| drawn[drawing].clone()).collect()
            });
            films.push(shown.iter().map(|pose| number(steps.all(&figure, pose))).collect());
        }
        Ok(Self {
            height: STEPS,
            points: browser::points(&figure, &moving[0]).len(),
            figure: PageFigure::new(&figure, &moving[0], steps.unit),
            view: axes(&view),
            poses,
            films,
        })
    }

    /// Whether two films show the same pose on every koma.
    pub fn is_same(&self, one: usize, other: usize) -> bool {
        self.films[one] == self.films[other]
    }
}
