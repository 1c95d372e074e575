//! Integration tests of the whole program.

#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "a test")]

#[path = "../cases/mod.rs"]
mod cases; // number of cases of a heavy property test
mod clips; // reads the clips of the tests
#[path = "../stage.rs"]
mod stage; // makes a stage with a camera, a sword and a prop

mod acting; // a nod, a gaze and a fist have keys
mod actions; // a long take as its actions
mod batch; // many clips at once
mod batch_and_a_person; // what a person puts or changes in the folders of a batch
mod batch_formats; // which formats a batch writes that names none
mod batch_in_trouble; // lists of other systems, full disks, lost clips, two batches at once
mod batch_packed; // one archive instead of folders
mod batch_settings; // which settings make a clip be done again
mod bodies; // parts of a rig besides the body change no key
mod camera; // movement as seen by a camera
mod camera_work; // the CAMERA column, and what stands beside the body
mod contacts; // contacts as keys, and feet that stay where they stand
mod corrections; // corrections add up from run to run, and the summary says what each did
mod cut; // the slate, late entries, and somebody else's timesheet
mod defaults; // the method page states every default correctly
mod documented; // every format and setting is in the docs
mod eval_compare; // sheets judged, and methods side by side
mod examples; // the examples still print the same
mod filter_persistence; // filter and persistence pick the genga
mod folders; // a results folder is one run
mod fuzzed; // the checks of fuzzing on files that it found
mod gaits; // steps of left and right, and their phases
mod glitches; // single frames that fly off
mod hostile_names; // names that a spreadsheet would run or a terminal obey
mod kept_numbers; // a new run keeps the numbers of the drawings that it shares with the last
mod keyed_or_captured; // captures are not taken for drawings
mod known_keys; // keys of clips made from known keys are found again
mod layers; // layers with their own timing, and a root on ones
mod lead_ins; // the same lead-in in every dialect and at every rate
mod licences; // all dependencies have redistributable licences
mod lies; // lying files end fast
mod links; // links between the pages of the documentation
mod loops; // sheets that repeat, and the cycles of a take
mod lost_limbs; // an arm or a leg that a file will not move is reported on the first line
mod lying_files; // makes lying files
mod marked_keys; // files with marked keys that come back, as they were or edited
mod mutated; // real files with anything changed: no panic, and what is read is written
mod one_motion; // the same keys in any rig, at any rate, with noise
mod pages; // everything named on the pages for newcomers exists
mod passages; // settings of layers and passages
mod program; // the built binary, as a person or a script uses it
#[cfg(unix)]
mod readme; // README and guide show what the program does
mod real_clips; // the default recipe on every real clip
mod real_cuts; // cuts of real clips: late, repeated, filmed, in somebody's timesheet
mod rerig; // the same motion in another rig gives the same sheet
mod rests; // rests are holds, and no drawing stays for one koma
mod same_take; // a take in another format has the same keys
mod shared_clip; // a file in blocks is the file from memory
mod small_gestures; // somebody sits, stands or talks
mod studies; // one or two settings varied, as tables and pictures
mod targets; // numbers of keys and drawings on every real clip
mod targets_and_pins; // targets and corrections, as a person gives them
mod timesheets; // sheets for programs and for paper, and keys marked on them
mod tiny_clips; // the smallest clips with any recipe never panic
mod trial; // trials: people choose between two films
mod versions; // two versions side by side, and in trials
mod vocabulary; // one word each, in both languages
