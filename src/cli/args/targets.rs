//! What a sheet is to be, asked on the command line.

use clap::Args;

/// What the sheet is to be, instead of the settings that make it so.
#[derive(Debug, Args)]
pub(in crate::cli) struct TargetArgs {
    /// So many genga on the sheet, pins and what stays by itself (ends of rests) with them, the clip's two ends without; over
    /// keys.min_price and keys.per_second.
    #[arg(long, value_name = "N", value_parser = genga, allow_negative_numbers = true)]
    pub(in crate::cli) keys: Option<usize>,
    /// Few keys with which the body, slerped from key to key, is nowhere further off than that share
    /// of its height: 5%; over keys.min_price and keys.per_second.
    #[arg(long, value_name = "P%", value_parser = percent, allow_negative_numbers = true, conflicts_with = "keys")]
    pub(in crate::cli) max_error: Option<f64>,
    /// So many drawings a second: found with koma-dori, then spacing.on, naka-nashi and the number of keys
    /// where that is not asked for.
    #[arg(long, value_name = "X", value_parser = drawings, allow_negative_numbers = true)]
    pub(in crate::cli) drawings_per_second: Option<f64>,
}

/// A share of body height. Without its % a number below 1 might be a fraction.
fn percent(text: &str) -> Result<f64, String> {
    let (number, has_sign) = match text.trim().strip_suffix('%') {
        Some(number) => (number.trim_end(), true),
        None => (text.trim(), false),
    };
    let share: f64 = number
        .parse()
        .map_err(|_| format!("expected a share of body height (5%), found \"{text}\""))?;
    if !has_sign && share > 0.0 && share < 1.0 {
        let hundredfold = (share * 1e8).round() / 1e6;
        return Err(format!(
            "{number} may mean {number}% or {hundredfold}% of the body's height; write the one you mean with its %"
        ));
    }
    Ok(share)
}

fn genga(text: &str) -> Result<usize, String> {
    let wrong =
        || format!("expected a whole number of genga, 0 or more, as in 24, found \"{text}\"");
    text.trim().parse().map_err(|_| wrong())
}

fn drawings(text: &str) -> Result<f64, String> {
    let wrong = || format!("expected drawings a second, above 0, as in 8 or 6.5, found \"{text}\"");
    text.trim().parse().map_err(|_| wrong())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_share_of_body_height_has_its_sign_where_it_could_be_a_fraction() {
        for (text, share) in [("5%", 5.0), ("5", 5.0), (" 0.5 % ", 0.5), ("1", 1.0), ("0", 0.0)] {
            assert_eq!(percent(text), Ok(share), "{text}");
        }
        assert!(percent("0.02").unwrap_err().contains("0.02% or 2% of"));
        for wrong in ["2%%", "%", "", "5 %x"] {
            assert!(percent(wrong).unwrap_err().contains("(5%)"), "{wrong}");
        }
    }
}
