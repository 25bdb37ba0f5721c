//! Numbers as text.

/// A number as programs write it: also `+1`, `1.`, `.5`, `1e5`, `1d5`, `nan`, `-inf`, and `1.#INF`
/// and `1.#QNAN` of old Microsoft libraries. None if it is no number.
pub(crate) fn parse(word: &[u8]) -> Option<f64> {
    let word = std::str::from_utf8(word).ok()?;
    if let Ok(number) = word.parse() {
        return Some(number);
    }
    let upper = word.to_ascii_uppercase();
    if let Some((_, special)) = upper.split_once(".#") {
        let sign = if word.starts_with('-') { -1.0 } else { 1.0 };
        return Some(if special.starts_with("INF") { sign * f64::INFINITY } else { f64::NAN });
    }
    if upper.trim_start_matches(['+', '-']).starts_with("NAN") {
        return Some(f64::NAN);
    }
    let fortran = upper.replacen('D', "E", 1);
    fortran.parse().ok()
}

/// The longest start of a word that is a number, as C's `strtod` reads it.
pub(crate) fn parse_start(word: &str) -> Option<f64> {
    let ends = word.char_indices().map(|(at, _)| at).skip(1).take(64).collect::<Vec<_>>();
    ends.into_iter().rev().find_map(|end| parse(&word.as_bytes()[..end]))
}

#[cfg(test)]
mod tests {
    use super::parse;

    #[test]
    fn spellings_of_numbers() {
        let cases: [(&str, f64); 9] = [
            ("1", 1.0),
            ("+1.5", 1.5),
            ("-.5", -0.5),
            ("2.", 2.0),
            ("1e-3", 1e-3),
            ("1.5D2", 150.0),
            ("-1.#INF", f64::NEG_INFINITY),
            ("inf", f64::INFINITY),
            ("1E+400", f64::INFINITY),
        ];
        for (word, value) in cases {
            assert_eq!(parse(word.as_bytes()), Some(value), "{word}");
        }
        for word in ["nan", "-nan(ind)", "1.#QNAN"] {
            assert!(parse(word.as_bytes()).is_some_and(f64::is_nan), "{word}");
        }
        assert_eq!(super::parse_start("3.1+e2"), Some(3.1));
        assert_eq!(super::parse_start("x1"), None);
        for word in ["", "one", "1,5", "0x1", "--1", "1.2.3"] {
            assert_eq!(parse(word.as_bytes()), None, "{word}");
        }
    }
}
