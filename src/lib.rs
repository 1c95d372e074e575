//! Motion capture to Japanese limited animation (リミテッドアニメーション).
//!
//! A motion-capture clip has one pose per frame. A limited animation has a few drawings per second, and each is held
//! for several koma (コマ, 1/24 s). This crate finds the key drawings (genga, 原画) of a clip, puts inbetweens (中割り)
//! between them with spacing (詰め), leaves out the fastest (naka-nashi, 中無し) and holds the slowest (koma-dori, コマ撮り).
//! The result is a [`Sheet`](sheet::Sheet): which drawing is on screen on which koma.
//!
//! The crate implements and chains two papers: Kuroda & Tokoi 2011 \[KT11\], "An Editing method of MOCAP Data for the
//! Cell Animation", and Kitamura, Kanamori, Mitani, Fukui & Tsuruno \[KKMFT\], "Motion Frame Omission for
//! Cartoon-like Effects". `docs/method.md` gives every formula, `docs/decisions.md` every reason.
//!
//! # Modules
//!
//! Data flows one way. A module imports only from modules to its left, or from the shared plain data: [`error`],
//! [`knob`], [`time`], [`sheet`] and [`edits`].
//!
//! ```text
//! read        measure      choose      time
//! motion  →   signal   →   keys   →    timing
//! Clip        Signals      LayerKeys   Sheet
//! ```
//!
//! [`pipeline`] runs them in order from a [`Recipe`](recipe::Recipe) and a person's [`Edits`](edits::Edits). It
//! returns a [`Breakdown`](pipeline::Breakdown) of every intermediate result. Before the speeds are measured,
//! [`exaggerate`] may change the motion (誇張). [`target`] finds recipes that reach a wanted result.
//!
//! Other crates read more formats (`genga-read`), draw pictures (`genga-plot`), write files (`genga-files`), study
//! and judge recipes (`genga-lab`) and run trials with people (`genga-trial`). `genga-studio` and `genga-cli` are the
//! user interfaces.
//!
//! # Example
//!
//! ```
//! use genga::edits::Edits;
//! use genga::motion::bvh;
//! use genga::pipeline::Engine;
//! use genga::recipe::Recipe;
//! use genga::sheet::Role;
//!
//! # fn main() -> Result<(), genga::Error> {
//! let bytes = std::fs::read("data/kick.bvh").expect("the sample is part of the repository");
//! let clip = bvh::read(&bytes)?.clip;
//! let mut engine = Engine::new(clip)?;
//!
//! let mut recipe = Recipe::default();
//! recipe.set("spacing.on", "3")?;
//! let breakdown = engine.run(&recipe, &Edits::default())?;
//!
//! let layer = &breakdown.sheet.layers[0];
//! assert_eq!(layer.length(), 92);
//! for (koma, exposure) in layer.timed() {
//!     let drawing = &layer.drawings[exposure.drawing];
//!     if drawing.role == Role::Genga {
//!         println!("koma {}: source frame {}", koma + 1, drawing.source.place());
//!     }
//! }
//! # Ok(())
//! # }
//! ```
//!
//! The directory `examples` has more, each at most 40 lines long: `cargo run --example keys` shows the genga of a
//! clip with their reasons. `ARCHITECTURE.md` lists what each file does.
//!
//! # Conventions
//!
//! - **Frames** keep their number from the file, counted from 0, even after a lead-in or a trim. **Koma**
//!   count from 0 in code and from 1 in tables and on paper. A *place* is an instant of the source as a
//!   fractional frame number.
//! - Frames are instants: F of them last (F − 1)/rate. Koma are slots: T of them last T/24 s.
//! - `f64` throughout; radians in code, degrees in files and for people; lengths in the file's own unit.
//! - A position channel *replaces* the joint's offset on its axis; rotations multiply in the order
//!   listed.
//! - The same input gives the same bytes.

// Tests may use the standard library's functions as a reference.
#![cfg_attr(test, allow(clippy::disallowed_methods))]

pub mod edits;
pub mod error;
pub mod exaggerate;
pub mod keys;
pub mod knob;
#[doc(hidden)]
pub mod maths;
pub mod motion;
pub mod pipeline;
pub mod recipe;
pub mod sanitize;
pub mod sheet;
pub mod signal;
pub mod slate;
pub mod target;
pub mod time;
pub mod timing;

#[cfg(test)]
#[path = "../tests/cases/mod.rs"]
mod cases;
#[cfg(test)]
#[path = "../tests/real/mod.rs"]
mod real;

pub use error::{Error, Warning};
/// The vectors and rotations of skeletons and poses.
pub use glam;
