//! The few options of this crate's programs; `cargo xtask` explains them, and checks all but names.

use std::io::{self, Write};
use std::process::ExitCode;

/// What stands behind a program's name.
pub struct Arguments(Vec<String>);

impl Arguments {
    /// Those that this program was started with.
    pub fn of_this_program() -> Self {
        Self(std::env::args().skip(1).collect())
    }

    /// Whether `option` is given.
    pub fn has(&self, option: &str) -> bool {
        self.0.iter().any(|argument| argument == option)
    }

    /// What stands behind `option`.
    pub fn value(&self, option: &str) -> Option<&str> {
        let place = self.0.iter().position(|argument| argument == option)?;
        self.0.get(place + 1).map(String::as_str)
    }

    /// Whether `name` is in the list behind `option`; every name is if there is no list.
    pub fn chosen(&self, option: &str, name: &str) -> bool {
        self.value(option).is_none_or(|list| list.split(',').any(|chosen| chosen == name))
    }

    /// Makes sure that each name in the list behind `option` is meant for one that there is: who misspells one would
    /// test nothing, and be told that all is well.
    ///
    /// # Errors
    /// A sentence that lists those that there are.
    pub fn check_names<'a>(
        &self,
        option: &str,
        there_are: impl IntoIterator<Item = &'a str>,
        is_meant: impl Fn(&str, &str) -> bool,
    ) -> Result<(), String> {
        let Some(list) = self.value(option) else { return Ok(()) };
        let names: Vec<&str> = there_are.into_iter().collect();
        match list.split(',').find(|asked| !names.iter().any(|name| is_meant(asked, name))) {
            Some(asked) => {
                Err(format!("{option}: there is no {asked:?}; choose from: {}", names.join("; ")))
            }
            None => Ok(()),
        }
    }
}

/// Tells what is wrong of the options, for a program to end with.
///
/// # Errors
/// If that cannot be written.
pub fn refuse(why: &str) -> io::Result<ExitCode> {
    writeln!(io::stderr(), "{why}")?;
    Ok(ExitCode::FAILURE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_that_nothing_has_is_an_error() {
        let with = |list: &str| {
            let arguments = Arguments(vec!["--scenes".to_owned(), list.to_owned()]);
            arguments.check_names("--scenes", ["bunny", "dragon"], |asked, name| asked == name)
        };
        assert_eq!(with("dragon,bunny"), Ok(()));
        for list in ["dragons", "bunny,", "bunny,drag"] {
            let error = with(list).unwrap_err();
            assert!(error.contains("bunny; dragon"), "{error}");
        }
    }
}
