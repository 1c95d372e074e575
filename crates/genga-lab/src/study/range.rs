//! Lists of values in which an item may be a range: `5,10..60:10,90`.

/// Largest number of values on one axis; more is surely a typing error.
const MOST: usize = 10_000;

/// Returns every value of a list, with ranges expanded. An error names the fault and the expected form.
pub(super) fn values(list: &str) -> Result<Vec<String>, String> {
    let mut values = Vec::new();
    for item in list.split(',').map(str::trim) {
        match item.split_once("..") {
            None if item.is_empty() => {
                return Err("a value is missing; write a list (10,20) or a range (10..60:5)".into());
            }
            None => values.push(item.to_owned()),
            Some((from, rest)) => values.extend(range(item, from, rest)?),
        }
        if values.len() > MOST {
            return Err(format!("\"{list}\" has more than {MOST} values; take a larger step"));
        }
    }
    Ok(values)
}

/// `from..to:step`, both ends included when the step lands on them.
fn range(item: &str, from: &str, rest: &str) -> Result<Vec<String>, String> {
    let Some((to, step)) = rest.split_once(':') else {
        return Err(format!("\"{item}\" has no step; write FROM..TO:STEP, as in 10..60:5"));
    };
    let refused = |text: &str| format!("\"{}\" in \"{item}\" is no plain number", text.trim());
    let (from, unit) = Decimal::parse(from).ok_or_else(|| refused(from))?;
    let (to, unit_to) = Decimal::parse(to).ok_or_else(|| refused(to))?;
    let (step, unit_step) = Decimal::parse(step).ok_or_else(|| refused(step))?;
    if unit != unit_to || unit != unit_step {
        return Err(format!(
            "\"{item}\" mixes units; write the unit each time, as in 0.1s..0.5s:0.05s"
        ));
    }
    let places = from.places.max(to.places).max(step.places);
    let [from, to, step] = [from, to, step].map(|number| number.scaled(places));
    if step <= 0 {
        return Err(format!("the step of \"{item}\" must be above 0"));
    }
    if to < from {
        return Err(format!("\"{item}\" runs backwards; write the smaller end first"));
    }
    let count = (to - from) / step + 1;
    if count > MOST as i128 {
        return Err(format!("\"{item}\" has more than {MOST} values; take a larger step"));
    }
    let value = |at: i128| Decimal { digits: from + at * step, places }.written() + unit;
    Ok((0..count).map(value).collect())
}

/// A decimal number as written, so that 0.1 + 2 · 0.1 is 0.3 and a range ends exactly at its bound.
#[derive(Debug, Clone, Copy)]
struct Decimal {
    digits: i128,
    places: u32,
}

impl Decimal {
    /// Parses the number at the beginning of a text, at most 15 digits, and returns the unit behind it.
    fn parse(text: &str) -> Option<(Self, &str)> {
        let text = text.trim();
        let past = text.find(|c: char| !c.is_ascii_digit() && !"+-.".contains(c));
        let (number, unit) = text.split_at(past.unwrap_or(text.len()));
        let (whole, part) = number.split_once('.').unwrap_or((number, ""));
        let is_short = (1..=15).contains(&(number.len() - usize::from(number.contains('.'))));
        let is_plain = is_short && part.chars().all(|c| c.is_ascii_digit());
        let digits = is_plain.then(|| format!("{whole}{part}").parse().ok())??;
        Some((Self { digits, places: part.len() as u32 }, unit.trim()))
    }

    /// Returns the number in units of the last of `places` decimal places.
    fn scaled(self, places: u32) -> i128 {
        self.digits * 10i128.pow(places - self.places)
    }

    fn written(self) -> String {
        let sign = if self.digits < 0 { "-" } else { "" };
        let (unit, digits) = (10u128.pow(self.places), self.digits.unsigned_abs());
        let part = format!("{:0width$}", digits % unit, width = self.places as usize);
        match part.trim_end_matches('0') {
            "" => format!("{sign}{}", digits / unit),
            part => format!("{sign}{}.{part}", digits / unit),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_range_includes_its_ends_when_the_step_lands_on_them() {
        assert_eq!(values("10..30:5").unwrap(), ["10", "15", "20", "25", "30"]);
        assert_eq!(values("10..29:5").unwrap(), ["10", "15", "20", "25"]);
        assert_eq!(values("7..7:1").unwrap(), ["7"]);
        assert_eq!(
            values("0..0.3:0.1").unwrap(),
            ["0", "0.1", "0.2", "0.3"],
            "no 0.30000000000000004"
        );
        assert_eq!(values("-1..1:0.50").unwrap(), ["-1", "-0.5", "0", "0.5", "1"]);
    }

    #[test]
    fn units_are_kept_and_lists_and_ranges_mix() {
        assert_eq!(values("0.1s..0.2s:0.05s").unwrap(), ["0.1s", "0.15s", "0.2s"]);
        assert_eq!(values("0%..4%:2%").unwrap(), ["0%", "2%", "4%"]);
        assert_eq!(values("3, 10..20:10 , 1/3 ,inf").unwrap(), ["3", "10", "20", "1/3", "inf"]);
        assert_eq!(values("box,gaussian").unwrap(), ["box", "gaussian"]);
    }

    #[test]
    fn each_way_to_be_wrong_says_what_would_be_right() {
        for (wrong, says) in [
            ("", "a value is missing"),
            ("10,,20", "a value is missing"),
            ("10..60", "has no step"),
            ("10..60:0", "above 0"),
            ("10..60:-5", "above 0"),
            ("60..10:5", "runs backwards"),
            ("0.1s..0.5:0.1s", "mixes units"),
            ("0.1s..0.5s:0.1", "mixes units"),
            ("a..b:c", "\"a\" in \"a..b:c\" is no plain number"),
            ("1..:1", "\"\" in"),
            ("..5:1", "\"\" in"),
            ("1..5:", "\"\" in"),
            ("1e3..1e4:1e3", "mixes units"),
            ("1-2..5:1", "is no plain number"),
            ("1..2..3:1", "is no plain number"),
            ("0..1:0.0000000000000001", "is no plain number"),
            ("0..1:0.00001", "more than 10000"),
            ("0..999999999999999:1", "more than 10000"),
        ] {
            let said = values(wrong).unwrap_err();
            assert!(said.contains(says), "{wrong}: {said}");
        }
        let many = vec!["1"; MOST + 1].join(",");
        assert!(values(&many).unwrap_err().contains("more than 10000"));
    }
}
