//! Labels of the studio, in English or Japanese (日本語).

/// A language of the labels.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Language {
    /// English.
    #[default]
    English,
    /// 日本語. Falls back to English if no font has its letters.
    Japanese,
}

/// Sample letters, all of which a Japanese font has.
const LETTERS: &str = "原画中割りコマ撮尺";

/// Chooses between the languages of a label.
#[derive(Debug, Clone, Copy)]
pub(super) struct Words {
    /// The language asked for.
    pub(super) language: Language,
    /// Whether a font with Japanese letters is available.
    pub(super) has_japanese: bool,
}

impl Words {
    pub(super) fn from_language(language: Language, context: &egui::Context) -> Self {
        let font = egui::FontId::default();
        // A browser draws letters that the window's fonts lack.
        let has_japanese = cfg!(target_family = "wasm")
            || context.fonts_mut(|fonts| fonts.has_glyphs(&font, LETTERS));
        Self { language, has_japanese }
    }

    /// Returns the label in the chosen language, or in English if no font has Japanese letters.
    pub(super) fn say<'a>(self, english: &'a str, japanese: &'a str) -> &'a str {
        match self.language {
            Language::Japanese if self.has_japanese => japanese,
            _ => english,
        }
    }

    /// Whether labels are shown in Japanese.
    pub(super) fn is_japanese(self) -> bool {
        self.language == Language::Japanese && self.has_japanese
    }
}
