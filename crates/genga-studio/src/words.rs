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

    /// An arrow from a value to the next, or a word if no font has one.
    pub(super) fn arrow(self) -> &'static str {
        if self.has_japanese { "→" } else { "to" }
    }

    /// A text in English, without its words in Japanese if no font has their letters.
    pub(super) fn english(self, text: &str) -> String {
        if self.has_japanese { text.to_owned() } else { without_japanese(text) }
    }

    /// Whether labels are shown in Japanese.
    pub(super) fn is_japanese(self) -> bool {
        self.language == Language::Japanese && self.has_japanese
    }
}

/// Leaves out what stands in parentheses in Japanese.
fn without_japanese(text: &str) -> String {
    let (mut english, mut rest) = (String::with_capacity(text.len()), text);
    while let Some((before, inside)) = rest.split_once(" (") {
        english += before;
        match inside.split_once(')') {
            Some((word, after)) if !word.is_ascii() => rest = after,
            _ => {
                english += " (";
                rest = inside;
            }
        }
    }
    english + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_in_japanese_are_left_out_with_their_parentheses() {
        let text = "On twos (2コマ打ち), slow (0 is off), and held (止め).";
        assert_eq!(without_japanese(text), "On twos, slow (0 is off), and held.");
        assert_eq!(without_japanese("an end ("), "an end (");
    }
}
