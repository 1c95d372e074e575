//! Motion capture to Japanese limited animation (リミテッドアニメーション).
//!
//! A motion-capture clip has a pose a frame. A limited animation has a few drawings a second, each of
//! which stays for some koma (コマ, 1/24 s). This crate finds the key drawings (genga, 原画) of a clip,
//! puts inbetweens (中割り) between them with spacing (詰め), leaves out the fastest (naka-nashi, 中無し)
//! and holds the slowest (koma-dori, コマ撮り). The result is a [`Sheet`](sheet::Sheet): which drawing
//! stands on which koma.
//!
//! Two papers are implemented and chained: Kuroda & Tokoi 2011 \[KT11\], "An Editing method of MOCAP
//! Data for the Cell Animation", and Kitamura, Kanamori, Mitani, Fukui & Tsuruno \[KKMFT\], "Motion
//! Frame Omission for Cartoon-like Effects". `docs/method.md` has every formula, `docs/decisions.md` every reason.
//!
//! # The rooms
//!
//! Data flows one way; a module imports only from rooms to its left, or from the ground: [`error`], [`knob`],
//! [`time`], [`sheet`] and [`edits`], which are plain data.
//!
//! ```text
//! read        measure      choose      time         show         hand over
//! motion  →   signal   →   keys   →    timing   →   plot     →   deliver
//! Clip        Signals      LayerKeys   Sheet        pictures     files
//! ```
//!
//! [`pipeline`] runs them in order from a [`Recipe`](recipe::Recipe) and a person's
//! [`Edits`](edits::Edits), and gives a [`Breakdown`](pipeline::Breakdown) of every intermediate
//! result; before the speeds are measured, [`exaggerate`] may change the motion (誇張); [`study`] varies recipes, [`target`] finds those that give what is wanted, and [`quality`] judges
//! what comes out; [`trial`] asks people. `studio` is the window in which all of it is tuned, and `cli` the program; no room stands on them. Both
//! use what is public here. The one exception is `plot::parts`: figures, cells and colours that the window shares with the
//! pictures.
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
//! More of them, of at most 40 lines each, are in `examples`: `cargo run --example keys` shows the genga of a clip with
//! their reasons. `ARCHITECTURE.md` says in which file what is done.
//!
//! # Conventions
//!
//! - **Frames** carry the number they have in the file, from 0, also after a lead-in or a trim. **Koma**
//!   count from 0 in code and from 1 in tables and on paper. A *place* is an instant of the source as a
//!   fractional frame number.
//! - Frames are instants, F of them last (F − 1)/rate; koma are slots, T of them last T/24 s.
//! - `f64` throughout; radians inside, degrees in files and for people; lengths in the file's own unit.
//! - A position channel *replaces* the joint's offset on its axis; rotations multiply in the order
//!   listed.
//! - Same input, same bytes.

// A test may compare with the standard library.
#![cfg_attr(test, allow(clippy::disallowed_methods))]

#[cfg(feature = "cli")]
pub mod cli;
pub mod deliver;
pub mod edits;
pub mod error;
pub mod exaggerate;
pub mod keys;
pub mod knob;
mod maths;
pub mod motion;
pub mod pipeline;
pub mod plain;
pub mod plot;
pub mod quality;
pub mod recipe;
pub mod sheet;
pub mod signal;
#[cfg(feature = "panels")]
pub mod studio;
pub mod study;
pub mod target;
pub mod time;
pub mod timing;
pub mod trial;

#[cfg(test)]
#[path = "../tests/cases/mod.rs"]
mod cases;
#[cfg(test)]
#[path = "../tests/real/mod.rs"]
mod real;

pub use error::{Error, Warning};
/// The vectors and rotations of skeletons and poses.
pub use glam;
