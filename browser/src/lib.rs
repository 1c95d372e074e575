//! The studio as a page of a browser: what a window of the system does elsewhere.
//!
//! ```text
//! shell     the page's canvas, with the studio in it
//! desk      files as a page has them: given by hand, kept in the browser's storage, given back as downloads
//! clip      a clip, from the bytes of a file
//! export    the files of a run, as one archive
//! worker    an export beside the page
//! page      what is asked of the browser
//! places    what is on screen, for whoever asks by name
//! ```
//!
//! `main.rs` is no part of it: it builds the page.

#![cfg(target_family = "wasm")]

mod clip;
mod desk;
mod export;
mod page;
pub mod places;
mod shell;
pub mod worker;

use eframe::{WebOptions, WebRunner};
use wasm_bindgen::JsValue;
use wasm_bindgen::prelude::wasm_bindgen;
use web_sys::HtmlCanvasElement;

use shell::Shell;

/// Starts the studio on a canvas.
///
/// # Errors
/// Why nothing can be drawn there.
#[wasm_bindgen]
pub async fn start(canvas: HtmlCanvasElement) -> Result<(), JsValue> {
    let make = |context: &eframe::CreationContext<'_>| {
        Ok(Box::new(Shell::new(&context.egui_ctx)) as Box<dyn eframe::App>)
    };
    WebRunner::new().start(canvas, WebOptions::default(), Box::new(make)).await
}
