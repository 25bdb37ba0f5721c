//! Names in messages.

use std::borrow::Cow;

/// The most characters of a name that a message has.
const MOST: usize = 200;

/// A name for a message: one that is very long only begins there.
pub(crate) fn cut(name: &str) -> Cow<'_, str> {
    match name.char_indices().nth(MOST) {
        Some((end, _)) => format!("{}…", &name[..end]).into(),
        None => name.into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_long_names_are_cut() {
        let long = "ä".repeat(MOST);
        assert_eq!(cut(&long), long);
        assert_eq!(cut(&format!("{long}b")), format!("{long}…"));
    }
}
