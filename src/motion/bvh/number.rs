//! Parses a decimal number from bytes, correctly rounded.

/// Powers of ten that an `f64` holds exactly.
const EXACT_POWERS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16,
    1e17, 1e18, 1e19, 1e20, 1e21, 1e22,
];

/// Every whole number up to this is exact as an `f64`.
const EXACT_WHOLE: u64 = 1 << 53;

/// Any number of this many digits fits a `u64`.
const SAFE_DIGITS: usize = 19;

/// Number of bytes that [`short`] reads, after a sign.
const WINDOW: usize = 24;

/// Parses a number in the usual style of motion capture at the start of `text`, and returns it with its
/// length in bytes: up to four digits, a dot, more digits, perhaps `e-06`, then a space, a tab or LF.
/// `None` means that [`scan`] must decide.
///
/// It handles only numbers that need a single exact operation, on a window of fixed size, so it needs no
/// bounds checks and no table but the powers of ten. Four decimals, which most files have, are parsed at
/// once.
#[inline(always)]
pub(super) fn short(text: &[u8]) -> Option<(f64, usize)> {
    match text {
        [b'-', rest @ ..] => {
            let (size, length) = short_size(rest.first_chunk()?)?;
            Some((-size, length + 1))
        }
        _ => short_size(text.first_chunk()?),
    }
}

#[inline(always)]
fn short_size(window: &[u8; WINDOW]) -> Option<(f64, usize)> {
    let mut mantissa = digit(window[0])?;
    let mut at = 1;
    while at < 4
        && let Some(digit) = digit(window[at])
    {
        mantissa = 10 * mantissa + digit;
        at += 1;
    }
    let mut places = 0;
    if window[at] == b'.' {
        at += 1;
        let begin = at;
        if let Some(digits) = four_digits(window, at) {
            mantissa = 10_000 * mantissa + digits;
            at += 4;
        }
        while at < 16
            && let Some(digit) = digit(window[at])
        {
            mantissa = 10 * mantissa + digit;
            at += 1;
        }
        places = at - begin;
    }
    if window[at] | 0x20 == b'e' {
        if window[at + 1] != b'-' {
            return None;
        }
        places += (10 * digit(window[at + 2])? + digit(window[at + 3])?) as usize;
        at += 4;
    }
    // CR is not accepted: alone it ends a line, and the caller must see it.
    if !matches!(window[at], b' ' | b'\t' | b'\n') {
        return None;
    }
    // There are at most 15 digits, so both operands are exact and the one operation rounds once, as a
    // correct parser must.
    Some((mantissa as f64 / EXACT_POWERS.get(places)?, at))
}

#[inline(always)]
fn digit(byte: u8) -> Option<u64> {
    let digit = byte.wrapping_sub(b'0');
    (digit <= 9).then_some(u64::from(digit))
}

/// Parses the four bytes from `at` on, if all are digits. Neighbours are joined to pairs and the pairs to
/// the whole, all within one machine word.
#[inline(always)]
fn four_digits(window: &[u8; WINDOW], at: usize) -> Option<u64> {
    let bytes = window.get(at..)?.first_chunk::<4>()?;
    let digits = u32::from_le_bytes(*bytes) ^ 0x3030_3030;
    let is_odd = (digits.wrapping_add(0x7676_7676) | digits) & 0x8080_8080 != 0;
    let pairs = (digits.wrapping_mul(10 << 8 | 1) >> 8) & 0x00ff_00ff;
    let whole = pairs.wrapping_mul(100 << 16 | 1) >> 16;
    (!is_odd).then_some(u64::from(whole))
}

/// Parses the number at the start of `text` and returns it with its length in bytes. The result equals that
/// of `str::parse` bit for bit, except that `inf` and `nan` are not accepted. `None` unless a blank, a
/// brace or the end of the text follows.
#[inline]
pub(super) fn scan(text: &[u8]) -> Option<(f64, usize)> {
    let (negative, unsigned) = match text {
        [b'-', rest @ ..] => (true, rest),
        [b'+', rest @ ..] => (false, rest),
        _ => (false, text),
    };
    let (whole, rest) = take_digits(unsigned, 0);
    let mut digits = unsigned.len() - rest.len();
    let (mut mantissa, mut exponent, mut rest) = (whole, 0i64, rest);
    if let [b'.', fraction @ ..] = rest {
        (mantissa, rest) = take_digits(fraction, whole);
        let places = fraction.len() - rest.len();
        digits += places;
        exponent = -(places as i64);
    }
    if digits == 0 {
        return None;
    }
    if let [b'e' | b'E', power @ ..] = rest {
        let (power, after) = take_exponent(power)?;
        exponent += power;
        rest = after;
    }
    if !rest.first().is_none_or(|&byte| ends_a_word(byte)) {
        return None;
    }
    let length = text.len() - rest.len();
    if digits > SAFE_DIGITS || mantissa > EXACT_WHOLE || exponent.unsigned_abs() > 22 {
        return Some((parse_any(&text[..length])?, length));
    }
    // Both operands are exact, so the one operation rounds once, as a correct parser must.
    let power = EXACT_POWERS[exponent.unsigned_abs() as usize];
    let size = if exponent < 0 { mantissa as f64 / power } else { mantissa as f64 * power };
    Some((if negative { -size } else { size }, length))
}

/// Whether a byte is a blank between tokens: space, tab or any line end.
#[inline]
pub(super) fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t'..=b'\r')
}

/// Whether a byte separates words: a blank or a brace.
#[inline]
pub(super) fn ends_a_word(byte: u8) -> bool {
    is_blank(byte) || matches!(byte, b'{' | b'}')
}

/// Appends digits to `value`, which wraps on overflow.
#[inline]
fn take_digits(mut text: &[u8], mut value: u64) -> (u64, &[u8]) {
    while let [digit @ b'0'..=b'9', rest @ ..] = text {
        value = value.wrapping_mul(10).wrapping_add(u64::from(digit - b'0'));
        text = rest;
    }
    (value, text)
}

/// Parses the exponent after an `e`. It is clamped, because all exponents far beyond the range of `f64` are
/// equivalent.
fn take_exponent(text: &[u8]) -> Option<(i64, &[u8])> {
    let (sign, digits) = match text {
        [b'-', rest @ ..] => (-1, rest),
        [b'+', rest @ ..] => (1, rest),
        _ => (1, text),
    };
    let (mut power, mut rest) = (0i64, digits);
    while let [digit @ b'0'..=b'9', after @ ..] = rest {
        power = (power * 10 + i64::from(digit - b'0')).min(1 << 32);
        rest = after;
    }
    (rest.len() < digits.len()).then_some((sign * power, rest))
}

#[cold]
fn parse_any(text: &[u8]) -> Option<f64> {
    std::str::from_utf8(text).ok()?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn bits(text: &str) -> Option<u64> {
        scan(text.as_bytes()).map(|(value, length)| {
            assert_eq!(length, text.len(), "{text}");
            value.to_bits()
        })
    }

    fn bits_by_std(text: &str) -> Option<u64> {
        text.parse::<f64>().ok().map(f64::to_bits)
    }

    #[test]
    fn hard_numbers_are_what_std_makes_of_them() {
        for text in [
            "0",
            "-0",
            "+1",
            "5.",
            ".0083333",
            "-.5",
            "1e-06",
            "1E+05",
            "5.1e-06",
            "1e22",
            "1e23",
            "9007199254740993",
            "9007199254740992",
            "9007199254740993e-3",
            "18446744073709551616",
            "0.1e-22",
            "123456789012345678901234567890",
            "2.2250738585072011e-308",
            "5e-324",
            "1.7976931348623159e308",
            "1e99999999999999999999",
            "1e-99999999999999999999",
            "0.000000000000000000000000000000000000001",
            "00000000000000000000012.5",
            "179769313486231580793728971405301e277",
            "8.5e-23",
        ] {
            assert_eq!(bits(text), bits_by_std(text), "{text}");
            assert!(bits(text).is_some(), "{text}");
        }
    }

    /// The result of `short`, or that of `scan` if `short` declines.
    fn short_bits(text: &str) -> Option<u64> {
        let table = format!("{text} {}", "7".repeat(WINDOW));
        match short(table.as_bytes()) {
            Some((value, length)) => {
                assert_eq!(length, text.len(), "{text}");
                Some(value.to_bits())
            }
            None => bits(text),
        }
    }

    #[test]
    fn numbers_as_motion_capture_writes_them_are_read_the_quick_way() {
        for text in [
            "0",
            "-0",
            "-0.0",
            "7",
            "-12",
            "1234",
            "0.5",
            "12.25",
            "-123.456",
            "1.2345",
            "0.0000",
            "-9999.9999",
            "90.00001",
            "114.384995",
            "3.",
            "5.1e-06",
            "-1.81236e-13",
            "2E-09",
            "1.23456789012",
        ] {
            let table = format!("{text} {}", "7".repeat(WINDOW));
            assert!(short(table.as_bytes()).is_some(), "{text}");
            assert_eq!(short_bits(text), bits_by_std(text), "{text}");
        }
        for (text, why) in [
            ("12345.5 ", "five digits"),
            (".5 ", "no digit before the dot"),
            ("1.5", "the end of the text is near"),
            ("1.5x ", "no blank after it"),
            ("1.5} ", "a brace is for the long way"),
            ("1.123456789012345 ", "more digits than are exact"),
            ("9999.999999999999 ", "sixteen digits"),
            ("1e-23 ", "a power that is not exact"),
            ("1.5e+03 ", "no common exponent"),
            ("1.5e-7 ", "an exponent of one digit"),
            ("- 5 ", "a sign alone"),
            ("1.5\r", "CR may be a line end of its own"),
        ] {
            let after =
                if text.ends_with([' ', '\r']) { "7".repeat(WINDOW) } else { String::new() };
            assert_eq!(short(format!("{text}{after}").as_bytes()), None, "{why}");
        }
    }

    #[test]
    fn four_bytes_are_four_digits_or_none() {
        let window = |bytes: &[u8]| {
            let mut window = [b'9'; WINDOW];
            window[3..3 + bytes.len()].copy_from_slice(bytes);
            window
        };
        for number in 0..10_000 {
            let text = format!("{number:04}");
            assert_eq!(four_digits(&window(text.as_bytes()), 3), Some(number));
        }
        for at in 0..4 {
            for byte in (0..=255u8).filter(|byte| !byte.is_ascii_digit()) {
                let mut bytes = *b"1234";
                bytes[at] = byte;
                assert_eq!(four_digits(&window(&bytes), 3), None, "{bytes:?}");
            }
        }
        assert_eq!(four_digits(&[b'0'; WINDOW], WINDOW - 3), None, "the window ends");
    }

    #[test]
    fn what_is_no_number_is_none() {
        for text in
            ["", "-", "+", ".", "e5", "1e", "1e+", "1.2.3", "--1", "nan", "inf", "1x", "1,5"]
        {
            assert_eq!(bits(text), None, "{text}");
        }
    }

    #[test]
    fn a_number_ends_at_a_blank_or_a_brace() {
        for text in ["1.5 2", "1.5\t", "1.5\r\n", "1.5}", "1.5{"] {
            assert_eq!(scan(text.as_bytes()), Some((1.5, 3)), "{text}");
        }
    }

    proptest! {
        #[test]
        fn any_text_of_number_letters_reads_as_std_reads_it(text in "[-+]?[0-9]{0,22}(\\.[0-9]{0,25})?([eE][-+]?[0-9]{0,3})?") {
            prop_assert_eq!(bits(&text), bits_by_std(&text), "{}", text);
            prop_assert_eq!(short_bits(&text), bits_by_std(&text), "{}", text);
        }

        #[test]
        fn short_numbers_read_as_std_reads_them(text in "-?[0-9]{1,5}(\\.[0-9]{0,14})?([eE]-[0-9]{1,3})?") {
            prop_assert_eq!(short_bits(&text), bits_by_std(&text), "{}", text);
        }

        #[test]
        fn garbage_of_number_letters_reads_as_std_reads_it(text in "[-+.eE0-9]{0,12}") {
            prop_assert_eq!(bits(&text), bits_by_std(&text), "{}", text);
            prop_assert_eq!(short_bits(&text), bits_by_std(&text), "{}", text);
        }

        #[test]
        fn every_printed_number_reads_back(value in proptest::num::f64::ANY.prop_filter("finite", |v| v.is_finite())) {
            prop_assert_eq!(bits(&format!("{value}")), Some(value.to_bits()));
            prop_assert_eq!(bits(&format!("{value:e}")), Some(value.to_bits()));
        }
    }
}
