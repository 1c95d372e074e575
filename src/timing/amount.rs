//! An amount: a plain count, or a share of a whole.

use std::fmt;
use std::str::FromStr;

use crate::knob::{Kind, Setting, as_word, by_word};

/// A number of drawings or koma: a count (`4`) or a share (`4%`, `0.04`, `1/3`), so that one recipe serves clips of
/// every length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Amount {
    /// A fixed number.
    Count(usize),
    /// A share of the whole, 0 to 1.
    Share(f64),
}

impl Amount {
    /// Returns the count out of `whole`; a share is rounded to the nearest.
    pub fn resolve(self, whole: usize) -> usize {
        match self {
            Self::Count(count) => count,
            Self::Share(share) => (share * whole as f64).round() as usize,
        }
    }

    /// Whether the amount is valid: a share must lie in 0 to 1, every count is valid.
    pub fn is_amount(self) -> bool {
        match self {
            Self::Count(_) => true,
            Self::Share(share) => (0.0..=1.0).contains(&share),
        }
    }
}

impl fmt::Display for Amount {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let share = match *self {
            Self::Count(count) => return write!(f, "{count}"),
            Self::Share(share) => share,
        };
        // People write 4% and 1/3, so these are printed as written; everything else is printed as a number.
        let percent = (share * 1e8).round() / 1e6;
        if percent / 100.0 == share {
            return write!(f, "{percent}%");
        }
        for parts in 3..10 {
            let taken = (share * f64::from(parts)).round();
            if taken / f64::from(parts) == share {
                return write!(f, "{taken}/{parts}");
            }
        }
        write!(f, "{share:?}")
    }
}

impl FromStr for Amount {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let text = text.trim();
        let number = |part: &str| part.trim().parse::<f64>().ok();
        let amount = if let Some(percent) = text.strip_suffix('%') {
            number(percent).map(|percent| Self::Share(percent / 100.0))
        } else if let Some((taken, parts)) = text.split_once('/') {
            number(taken).zip(number(parts)).map(|(taken, parts)| Self::Share(taken / parts))
        } else if let Ok(count) = text.parse() {
            Some(Self::Count(count))
        } else {
            number(text).map(Self::Share)
        };
        amount
            .filter(|amount| amount.is_amount())
            .ok_or_else(|| format!("expected a count (4) or a share (4%, 1/3), found \"{text}\""))
    }
}

impl Setting for Amount {
    const KIND: Kind = Kind::Amount;
    as_word!();
}

by_word!(Amount);

#[cfg(test)]
mod tests {
    use serde::Deserialize;

    use super::*;

    #[derive(Deserialize)]
    struct Table {
        amount: Amount,
    }

    fn from_toml(value: &str) -> Option<Amount> {
        toml::from_str(&format!("amount = {value}")).ok().map(|table: Table| table.amount)
    }

    #[test]
    fn an_amount_is_a_count_or_a_share() {
        for (text, amount) in [
            ("4", Amount::Count(4)),
            ("4%", Amount::Share(0.04)),
            (" 12.5 % ", Amount::Share(0.125)),
            ("1/3", Amount::Share(1.0 / 3.0)),
            ("0.33", Amount::Share(0.33)),
            ("1", Amount::Count(1)),
            ("1.0", Amount::Share(1.0)),
        ] {
            assert_eq!(text.parse(), Ok(amount), "{text}");
            assert_eq!(from_toml(&format!("\"{text}\"")), Some(amount), "{text}");
        }
        assert_eq!(from_toml("6"), Some(Amount::Count(6)));
        assert_eq!(from_toml("0.25"), Some(Amount::Share(0.25)));
    }

    #[test]
    fn what_is_no_amount_is_refused() {
        for wrong in ["", "%", "-1", "101%", "-4%", "1.5", "4/3", "1/0", "0/0", "nan", "inf", "x"] {
            assert!(wrong.parse::<Amount>().is_err(), "{wrong}");
        }
        for wrong in ["-1", "1.5", "nan", "true", "\"many\""] {
            assert_eq!(from_toml(wrong), None, "{wrong}");
        }
    }

    #[test]
    fn an_amount_reads_back_as_written() {
        for text in ["0", "4", "4%", "12.5%", "1/3", "2/7", "100%", "0%", "0.123456789012"] {
            assert_eq!(text.parse::<Amount>().unwrap().to_string(), text);
        }
        for share in [0.1 + 0.2, 1e-9, 0.07, 0.29, std::f64::consts::FRAC_1_PI] {
            let amount = Amount::Share(share);
            assert_eq!(amount.to_string().parse(), Ok(amount), "{amount}");
        }
    }

    #[test]
    fn a_share_is_rounded_and_a_count_is_not_bound_by_the_whole() {
        assert_eq!(Amount::Share(1.0 / 3.0).resolve(125), 42);
        assert_eq!(Amount::Share(0.04).resolve(129), 5);
        assert_eq!(Amount::Share(0.5).resolve(0), 0);
        assert_eq!(Amount::Count(9).resolve(4), 9);
    }
}
