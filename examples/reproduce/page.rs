//! Fills a hand-written page with results: tables between markers, numbers before their markers.

use crate::Outcome;
use crate::part::Part;

const END: &str = "<!-- end -->";
const NUMBER: &str = "<!--=";

/// Returns the page with each of its tables and numbers filled in. A table with times is kept as it is in the page
/// unless `times` asks to renew it.
pub(crate) fn filled(page: &str, part: &Part, times: bool) -> Outcome<String> {
    let mut page = page.to_owned();
    for (name, table) in &part.tables {
        page = between(&page, &format!("<!-- made: {name} -->"), |_| Ok(table.clone()))?;
    }
    for (name, table) in &part.measured {
        page = between(&page, &format!("<!-- measured: {name} -->"), |there| {
            if times {
                return Ok(table.clone());
            }
            match first_column(there) == first_column(table) {
                true => Ok(there.to_owned()),
                false => {
                    Err(format!("the times of {name} are of other rows: make them again").into())
                }
            }
        })?;
    }
    numbered(&page, part)
}

/// Checks that each marker of the page has a result. Only useful once everything was made.
pub(crate) fn all_is_made(page: &str, part: &Part) -> Outcome<()> {
    let names = [("made", &part.tables), ("measured", &part.measured)];
    for (word, made) in names {
        let begin = format!("<!-- {word}: ");
        for piece in page.split(&begin).skip(1) {
            let name = piece.split(" -->").next().unwrap_or_default();
            if !made.iter().any(|(made, _)| made == name) {
                return Err(format!("{begin}{name} -->: nothing of that name was made").into());
            }
        }
    }
    for piece in page.split(NUMBER).skip(1) {
        let name = piece.split("-->").next().unwrap_or_default();
        if !part.numbers.iter().any(|(made, _)| made == name) {
            return Err(format!("{NUMBER}{name}-->: no number of that name was made").into());
        }
    }
    Ok(())
}

/// Replaces the text between a marker and the next [`END`].
fn between(page: &str, marker: &str, make: impl Fn(&str) -> Outcome<String>) -> Outcome<String> {
    let (before, rest) =
        page.split_once(marker).ok_or_else(|| format!("the page has no {marker}"))?;
    let (there, after) =
        rest.split_once(END).ok_or_else(|| format!("no {END} follows {marker}"))?;
    let made = make(there.trim())?;
    Ok(format!("{before}{marker}\n\n{}\n\n{END}{after}", made.trim_end()))
}

fn first_column(table: &str) -> Vec<&str> {
    table.lines().filter_map(|line| line.split('|').nth(1)).map(str::trim).collect()
}

/// Replaces every number that stands before a marker.
fn numbered(page: &str, part: &Part) -> Outcome<String> {
    let mut pieces = page.split(NUMBER);
    let mut text = pieces.next().unwrap_or_default().to_owned();
    for piece in pieces {
        let (name, after) =
            piece.split_once("-->").ok_or_else(|| format!("{NUMBER}{piece}: no end"))?;
        if let Some((_, value)) = part.numbers.iter().find(|(made, _)| made == name) {
            text.truncate(begin_of_word(&text));
            text.push_str(value);
        }
        text.push_str(&format!("{NUMBER}{name}-->{after}"));
    }
    Ok(text)
}

/// Index at which the last word of a text begins.
fn begin_of_word(text: &str) -> usize {
    text.rfind(|c: char| c.is_whitespace() || "([*|".contains(c))
        .map_or(0, |at| at + text[at..].chars().next().map_or(0, char::len_utf8))
}

/// Finds words of the prose that contain a digit but are neither made nor part of a name (Table 1, Fig. 3, §3.4,
/// `code`, a link): numbers written by hand, which nothing would check.
pub(crate) fn loose_numbers(page: &str) -> Vec<String> {
    let prose = without(page, "<!-- made: ", END);
    let prose = without(&prose, "<!-- measured: ", END);
    // Numbers about files that are not kept were checked once, by hand.
    let prose = without(&prose, "<!-- by hand -->", END);
    let prose = without(&without(&prose, "```", "```"), "`", "`");
    let prose = without(&prose, "](", ")");
    let mut loose = Vec::new();
    let mut before = "";
    for word in
        prose.lines().filter(|line| !line.starts_with("    ")).flat_map(str::split_whitespace)
    {
        let names_it = ["Fig.", "Figs", "Figure", "Table", "Algorithm", "to", "and"]
            .contains(&before)
            && word.trim_matches(|c: char| !c.is_ascii_digit()).len() <= 2;
        let is_named = names_it || word.contains(NUMBER) || word.contains('§');
        if word.contains(|c: char| c.is_ascii_digit()) && !is_named && !word.starts_with("[K") {
            loose.push(word.to_owned());
        }
        before = word;
    }
    loose
}

/// Removes the text from `begin` to the next `end`, everywhere.
fn without(text: &str, begin: &str, end: &str) -> String {
    let mut kept = String::new();
    let mut rest = text;
    while let Some((before, after)) = rest.split_once(begin) {
        kept.push_str(before);
        kept.push(' ');
        rest = after.split_once(end).map_or("", |(_, rest)| rest);
    }
    kept + rest
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::table::Table;

    fn part() -> Part {
        let mut part = Part::default();
        let mut table = Table::new(&["clip", ">keys"]);
        table.row(&["kick".into(), "22".into()]);
        part.table("keys", table);
        let mut times = Table::new(&["clip", ">ms"]);
        times.row(&["kick".into(), "0.4".into()]);
        part.measured("times", times);
        part.number("keys.kick", 22);
        part
    }

    const PAGE: &str = "Found (7<!--=keys.kick-->) keys in Table 1.\n\n\
        <!-- made: keys -->\n<!-- end -->\n\n\
        <!-- measured: times -->\n\n| clip | ms |\n| --- | ---: |\n| kick | 9.9 |\n\n<!-- end -->\n";

    #[test]
    fn tables_and_numbers_are_filled_in_and_times_kept() {
        let page = filled(PAGE, &part(), false).unwrap();
        assert!(page.starts_with("Found (22<!--=keys.kick-->) keys"), "{page}");
        assert!(page.contains("| kick | 22 |"), "{page}");
        assert!(page.contains("| kick | 9.9 |"), "{page}");
        assert_eq!(filled(&page, &part(), false).unwrap(), page, "once more is the same");
        assert!(filled(PAGE, &part(), true).unwrap().contains("| kick | 0.4 |"));
        all_is_made(&page, &part()).unwrap();
    }

    #[test]
    fn what_is_not_made_or_not_asked_for_is_told() {
        let error = |page: &str| filled(page, &part(), false).unwrap_err().to_string();
        assert!(error("nothing").contains("no <!-- made: keys -->"));
        assert!(error(&PAGE.replace("| kick | 9.9", "| jump | 9.9")).contains("other rows"));
        let unmade = |page: &str| all_is_made(page, &part()).unwrap_err().to_string();
        assert!(unmade("7<!--=keys.jump-->").contains("keys.jump"));
        assert!(unmade("<!-- made: jumps -->").contains("jumps"));
    }

    #[test]
    fn a_number_by_hand_is_found() {
        let bound = "Figs 7 to 10, Table 1, [KT11 §3.2], §3.4, `--set a=5`, [a](b1.svg), \
            22<!--=keys-->.\n\n    genga run 7\n\n<!-- made: a -->\n| 5 |\n<!-- end -->\n";
        assert_eq!(loose_numbers(bound), Vec::<String>::new());
        assert_eq!(loose_numbers("It has 22 keys, 4.5 a second."), ["22", "4.5"]);
        assert_eq!(loose_numbers("and 496 frames"), ["496"]);
    }
}
