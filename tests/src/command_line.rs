//! The few options of this crate's programs; `cargo xtask` checks and explains them.

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
}
