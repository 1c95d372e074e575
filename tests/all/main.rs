//! What the whole is held to.

#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "a test")]

mod acting; // a nod, a gaze and a fist have keys
mod actions; // a long take as its actions
#[cfg(feature = "cli")]
mod asked; // people asked which of two films they take
#[cfg(feature = "cli")]
mod batch; // many clips at once
#[cfg(feature = "cli")]
mod batch_in_trouble; // lists of other systems, full disks, clips that are lost, two at once
#[cfg(feature = "cli")]
mod batch_packed; // one archive in place of folders
mod bodies; // what a rig has besides the body changes no key
#[path = "../cases/mod.rs"]
mod cases; // how many cases a heavy property test takes
mod clips; // where clips come from
mod contacts; // contacts as keys, and feet that stay where they stand
mod defaults; // the method states every default as it is
mod documented; // every format and setting is in the docs
mod drawn; // captures are not taken for drawings
mod examples; // the examples print what they printed
#[cfg(feature = "cli")]
mod folders; // a results folder is one run
mod fuzzed; // what fuzzing checks and what it found
mod gaits; // steps of left and right, and their phases
mod glitches; // single frames that fly off
mod held; // rests are holds, and no drawing stays for one koma
#[cfg(feature = "cli")]
mod hostile_names; // names that a spreadsheet would run or a terminal obey
mod judged; // sheets judged, and methods side by side
mod known_keys; // clips made from known keys give them back
#[cfg(feature = "cli")]
mod layers; // layers with timing of their own, and a root on ones
mod lead_ins; // the same lead-in in every dialect and at every rate
mod licences; // what genga is built of may be handed on
mod lies; // files that say what is not so end fast
mod links; // links between the pages of the documentation
#[cfg(feature = "cli")]
mod lost_limbs; // an arm or a leg that a file will not move is said on the first line
mod lying_files; // how such files are made
mod mutated; // real files with anything changed: no panic, and what is read is written
mod one_motion; // the same keys in any rig, at any rate, with noise
mod opened; // a file in blocks is the file from memory
mod pages; // what the pages for newcomers name is there
mod picked; // filter and persistence pick the genga
#[cfg(feature = "cli")]
mod program; // the built binary, as a person or a script uses it
mod quiet; // somebody sits, stands or talks
#[cfg(all(feature = "cli", unix))]
mod readme; // README and guide show what the program does
mod real_clips; // the default recipe on every real clip
mod rerig; // the same motion in another rig gives the same sheet
mod rooms; // who may import whom
mod same_take; // one take in another format: the same keys
#[cfg(feature = "cli")]
mod seen; // movement as a camera sees it
#[cfg(feature = "cli")]
mod studies; // one or two settings varied, as tables and pictures
mod targets; // numbers of keys and drawings on every real clip
#[cfg(feature = "cli")]
mod timesheets; // sheets for programs and for paper, and keys marked on them
mod tiny_clips; // the smallest clips with any recipe never panic
#[cfg(feature = "cli")]
mod wanted; // targets and corrections, as a person gives them
