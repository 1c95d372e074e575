//! Undo and redo (元に戻す). A drag is one step.

use egui::util::undoer::{Settings, Undoer};

use super::document::Document;

/// The history of documents.
#[derive(Debug)]
pub(super) struct History(Undoer<Document>);

impl History {
    /// Starts a history with a document.
    pub(super) fn new(document: &Document) -> Self {
        // A step ends when the pointer is released, never by the clock.
        let never = f32::INFINITY;
        let settings = Settings { max_undos: 500, stable_time: never, auto_save_interval: never };
        let mut undoer = Undoer::with_settings(settings);
        undoer.add_undo(document);
        Self(undoer)
    }

    /// Records the document of a frame. All changes during a drag become one step.
    pub(super) fn settle(&mut self, document: &Document, is_held: bool) {
        self.0.feed_state(0.0, document);
        if !is_held {
            self.0.add_undo(document);
        }
    }

    pub(super) fn undo(&mut self, document: &Document) -> Option<Document> {
        self.0.undo(document).cloned()
    }

    pub(super) fn redo(&mut self, document: &Document) -> Option<Document> {
        self.0.redo(document).cloned()
    }

    pub(super) fn can_undo(&self, document: &Document) -> bool {
        self.0.has_undo(document)
    }

    pub(super) fn can_redo(&self, document: &Document) -> bool {
        self.0.has_redo(document)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn on(koma: &str) -> Document {
        let mut document = Document::default();
        document.recipe.set("spacing.on", koma).unwrap();
        document
    }

    #[test]
    fn a_drag_is_one_step_however_many_values_it_passes() {
        let mut history = History::new(&on("2"));
        for koma in ["3", "4", "5"] {
            history.settle(&on(koma), true);
        }
        history.settle(&on("5"), false);
        assert_eq!(history.undo(&on("5")), Some(on("2")));
        assert!(!history.can_undo(&on("2")));
        assert_eq!(history.redo(&on("2")), Some(on("5")));
    }

    #[test]
    fn a_change_after_an_undo_forgets_what_was_undone() {
        let mut history = History::new(&on("2"));
        history.settle(&on("3"), false);
        assert_eq!(history.undo(&on("3")), Some(on("2")));
        history.settle(&on("4"), false);
        assert!(!history.can_redo(&on("4")));
        assert_eq!(history.undo(&on("4")), Some(on("2")));
    }
}
