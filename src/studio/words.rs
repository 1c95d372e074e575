//! What the studio says, in English or in Japanese (日本語).

/// A language of the labels.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Language {
    /// English.
    #[default]
    English,
    /// 日本語. Where no font has its letters, English is shown instead.
    Japanese,
}

/// Letters of which a Japanese font has all.
const LETTERS: &str = "原画中割りコマ撮尺";

/// Chooses among the labels.
#[derive(Debug, Clone, Copy)]
pub(super) struct Words {
    /// What is wanted.
    pub(super) language: Language,
    /// Whether there is a font for it.
    pub(super) has_japanese: bool,
}

impl Words {
    pub(super) fn of(language: Language, context: &egui::Context) -> Self {
        let font = egui::FontId::default();
        // A browser draws the letters that no font of the window has.
        let has_japanese = cfg!(target_family = "wasm")
            || context.fonts_mut(|fonts| fonts.has_glyphs(&font, LETTERS));
        Self { language, has_japanese }
    }

    /// The label in the language that can be shown.
    pub(super) fn say<'a>(self, english: &'a str, japanese: &'a str) -> &'a str {
        match self.language {
            Language::Japanese if self.has_japanese => japanese,
            _ => english,
        }
    }

    /// Whether Japanese is shown.
    pub(super) fn is_japanese(self) -> bool {
        self.language == Language::Japanese && self.has_japanese
    }
}
