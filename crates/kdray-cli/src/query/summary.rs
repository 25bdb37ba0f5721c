//! What became of the rays or points, for the user.

use super::{Answer, Row};

/// Counts of what became of the rays or points.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Summary {
    /// All of them.
    pub(crate) rows: u64,
    /// Rays with a hit, or points inside.
    pub(crate) hitting: u64,
    /// Those that could not be answered.
    bad: u64,
    /// The first of these, and why.
    first: Option<(u64, String)>,
}

impl Summary {
    /// Counts a ray or point and its answer.
    pub(crate) fn add(&mut self, row: &impl Row, answer: &Answer) {
        if let Some(problem) = row.problem() {
            self.bad += 1;
            self.first.get_or_insert((self.rows, problem));
        }
        self.rows += 1;
        self.hitting += u64::from(answer.is_hit());
    }

    /// A sentence on those that could not be answered, if there were any.
    pub(crate) fn warning<R: Row>(&self) -> Option<String> {
        let (place, problem) = self.first.as_ref()?;
        let Self { bad, rows, .. } = self;
        let (one, many, if_bad) = (R::ONE, R::MANY, R::IF_BAD);
        Some(format!("{bad} of {rows} {many} {if_bad}; {one} {place}: {problem}"))
    }
}
