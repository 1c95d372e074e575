//! The page that the tables stand in: text by hand, tables between markers.

use crate::Outcome;

const END: &str = "<!-- end -->";

/// The page with every table between its `<!-- made: NAME -->` and the next `<!-- end -->`.
pub(crate) fn filled(page: &str, tables: &[(&str, String)]) -> Outcome<String> {
    let mut page = page.to_owned();
    for (name, table) in tables {
        let marker = format!("<!-- made: {name} -->");
        let (before, rest) =
            page.split_once(&marker).ok_or_else(|| format!("the page has no {marker}"))?;
        let (_, after) =
            rest.split_once(END).ok_or_else(|| format!("no {END} follows {marker}"))?;
        page = format!("{before}{marker}\n\n{}\n\n{END}{after}", table.trim_end());
    }
    let markers = page.matches("<!-- made: ").count();
    if markers != tables.len() {
        return Err(format!("the page has {markers} markers for {} tables", tables.len()).into());
    }
    Ok(page)
}
