//! The studio as a web page, in place of a native window.
//!
//! ```text
//! shell     the page's canvas, with the studio in it
//! desk      files on a page: given by hand, kept in the browser's storage, returned as downloads
//! clip      a clip, from the bytes of a file
//! export    the files of a run, as one archive
//! worker    an export on a worker
//! page      calls to the browser
//! places    the named parts of the screen, for programs
//! ```
//!
//! `main.rs`, which builds the page, does not belong to it.

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
/// An error if the canvas cannot be drawn on.
#[wasm_bindgen]
pub async fn start(canvas: HtmlCanvasElement) -> Result<(), JsValue> {
    let make = |context: &eframe::CreationContext<'_>| {
        Ok(Box::new(Shell::new(&context.egui_ctx)) as Box<dyn eframe::App>)
    };
    WebRunner::new().start(canvas, WebOptions::default(), Box::new(make)).await
}
