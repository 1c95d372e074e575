//! Words for a shell, as messages suggest them.

/// Letters that neither a POSIX shell nor that of Windows takes apart.
const PLAIN: &str = "./-_%+,:=@…";

/// Quotes a word if a shell would take it apart: with double quotes, which Windows takes too, unless a POSIX shell looks
/// into them.
pub(super) fn quoted(word: &str) -> String {
    // Between the folders of a path, on Windows.
    let is_back = |letter: char| letter == '\\' && cfg!(windows);
    let is_plain =
        |letter: char| letter.is_alphanumeric() || PLAIN.contains(letter) || is_back(letter);
    let is_seen = |letter: char| "\"$`!\\".contains(letter) && !is_back(letter);
    if !word.is_empty() && word.chars().all(is_plain) {
        word.to_owned()
    } else if word.contains(is_seen) {
        format!("'{}'", word.replace('\'', r"'\''"))
    } else {
        format!("\"{word}\"")
    }
}

#[cfg(test)]
mod tests {
    use super::quoted;

    #[test]
    fn a_word_stays_one_word_in_a_shell() {
        for (word, whole) in [
            ("clips/蹴り/kick.bvh", "clips/蹴り/kick.bvh"),
            ("shot 012/a.bvh", "\"shot 012/a.bvh\""),
            ("it's.bvh", "\"it's.bvh\""),
            ("a&b(1);*.bvh", "\"a&b(1);*.bvh\""),
            ("$HOME's", r"'$HOME'\''s'"),
            ("a\"b", "'a\"b'"),
            ("", "\"\""),
        ] {
            assert_eq!(quoted(word), whole);
        }
    }
}
