//! The canvas of the page, and files dropped on it.

use std::sync::Arc;

use eframe::egui::{Context, RawInput, Ui};
use genga_studio::{Language, Studio};

use super::desk::Table;
use super::page;
use super::places::Places;

/// The studio, the table for its files, and the title that the page shows now.
pub(crate) struct Shell {
    studio: Studio,
    table: Arc<Table>,
    title: String,
}

impl Shell {
    pub(crate) fn new(context: &Context) -> Self {
        context.add_plugin(Places);
        let table = Arc::new(Table::new(context.clone()));
        let language = match page::speaks("ja") {
            true => Language::Japanese,
            false => Language::English,
        };
        let studio = Studio::new(Arc::clone(&table) as _, language);
        Self { studio, table, title: String::new() }
    }
}

impl eframe::App for Shell {
    /// Reads dropped files first; they reach the table once their bytes are there.
    fn raw_input_hook(&mut self, _: &Context, input: &mut RawInput) {
        for file in input.dropped_files.drain(..) {
            let table = Arc::clone(&self.table);
            wasm_bindgen_futures::spawn_local(async move {
                let bytes = file.bytes_async().await;
                table.arrive(file.path().to_owned(), bytes);
            });
        }
    }

    fn ui(&mut self, ui: &mut Ui, _: &mut eframe::Frame) {
        for path in self.table.arrived() {
            self.studio.open_any(&path);
        }
        self.studio.ui(ui);
        let title = self.studio.title();
        if title != self.title {
            page::set_title(&title);
            self.title = title;
        }
    }
}
