//! Several errors found at once. The first error contains all further errors.

use super::{Advice, Error};
use crate::sentences;
use std::collections::BTreeSet;

/// Upper limit of the number of different causes. Errors with any further cause are only counted.
const MOST: usize = 20;

/// Upper limit of the number of errors that are kept.
const MOST_PLACES: usize = 200;

impl Error {
    /// Combines errors into one: the first error carries all further errors. `None` if the list is empty.
    ///
    /// At most 200 errors of at most twenty causes are kept.
    /// Errors beyond these limits are only counted.
    #[must_use]
    pub fn all(errors: impl IntoIterator<Item = Error>) -> Option<Error> {
        let mut kept: Vec<Error> = Vec::new();
        let mut causes = BTreeSet::new();
        let mut left_out = 0;
        for mut error in errors {
            left_out += std::mem::take(&mut error.0.left_out);
            let further = std::mem::take(&mut error.0.further);
            for own in [error].into_iter().chain(further) {
                let cause = own.cause();
                if kept.len() < MOST_PLACES && (causes.len() < MOST || causes.contains(&cause)) {
                    causes.insert(cause);
                    kept.push(own);
                } else {
                    left_out += 1;
                }
            }
        }
        let mut kept = kept.into_iter();
        let mut first = kept.next()?;
        (first.0.further, first.0.left_out) = (kept.collect(), left_out);
        Some(first)
    }

    /// This error, followed by the errors found together with it.
    pub fn each(&self) -> impl Iterator<Item = &Error> {
        [self].into_iter().chain(&self.0.further)
    }

    /// The text that is equal for all errors of one cause.
    /// The text is the message. If the last name of the key ends with a unit, only the unit is left of that name.
    fn cause(&self) -> String {
        let key = self.scenario_key().map(|key| key.rsplit('.').next().unwrap_or(key).to_string());
        let Some(key) = key else { return self.message().into() };
        let unit = key.find('_').map(|at| &key[at..]);
        unit.map_or_else(|| self.message().into(), |unit| self.message().replace(&format!("`{key}`"), unit))
    }

    /// The errors grouped by cause. The groups are in the order of their first errors.
    #[must_use]
    pub fn by_cause(&self) -> Vec<Vec<&Error>> {
        let mut groups: Vec<(String, Vec<&Error>)> = Vec::new();
        for error in self.each() {
            let cause = error.cause();
            match groups.iter_mut().find(|(own, _)| *own == cause) {
                Some((_, group)) => group.push(error),
                None => groups.push((cause, vec![error])),
            }
        }
        groups.into_iter().map(|(_, group)| group).collect()
    }

    /// Number of errors that were only counted.
    #[must_use]
    pub fn left_out(&self) -> usize {
        self.0.left_out
    }

    /// Sentence that says how many errors were only counted; `None` if all errors are kept.
    #[must_use]
    pub fn rest(&self) -> Option<String> {
        match self.0.left_out {
            0 => None,
            1 => Some(sentences::MORE_MISTAKE_IS_NOT_SHOWN.into()),
            many => Some(sentences::more_mistakes_are_not_shown(&many)),
        }
    }

    /// Applies `change` to every error and sorts the results by their position in the file.
    pub fn each_in_order(mut self, change: impl FnMut(Error) -> Error) -> Error {
        let left_out = std::mem::take(&mut self.0.left_out);
        let further = std::mem::take(&mut self.0.further);
        let mut all: Vec<Error> = [self].into_iter().chain(further).map(change).collect();
        // The sort is stable: errors with equal positions keep the order in which they were found, and so do errors
        // without a position.
        all.sort_by_key(|error| error.place().map_or(0, |place| place.span.start));
        let mut first = Error::all(all).expect("one error at least");
        first.0.left_out = left_out;
        first
    }

    /// All errors, one per line, as in `Display`. `tell` puts each piece of advice into words.
    #[must_use]
    pub fn lines_by(&self, tell: impl Fn(&Advice) -> String) -> String {
        let lines = self.each().map(|error| error.line_by(&tell));
        lines.chain(self.rest()).collect::<Vec<_>>().join("\n")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::ErrorKind;

    #[test]
    fn errors_beyond_a_maximum_are_only_counted() {
        let one = |k: usize| Error::new(ErrorKind::Input, format!("mistake {k}"));
        assert!(Error::all([]).is_none());
        let pair = Error::all([one(1), one(2)]).unwrap();
        assert_eq!(pair.to_string(), "mistake 1\nmistake 2");
        let many = Error::all((0..30).map(one)).unwrap();
        // `many` already contains errors that were only counted. The new count includes them.
        let more = Error::all([pair, many]).unwrap();
        let told = more.to_string();
        assert!(
            told.starts_with("mistake 1\nmistake 2\nmistake 0\n")
                && told.ends_with("\nmistake 19\n10 more mistakes are not shown")
        );
        assert_eq!((more.each().count(), more.left_out()), (MOST + 2, 10));
        let unit =
            |key: &str| Error::new(ErrorKind::Input, format!("`{key}` has a wrong unit")).key(format!("ground.{key}"));
        let inches = Error::all(["x_in", "y_in", "x_lb"].map(unit)).unwrap();
        assert_eq!(inches.by_cause().iter().map(Vec::len).collect::<Vec<_>>(), [2, 1]);
        let named = more.each_in_order(|error| error.key("k"));
        assert!(named.each().all(|error| error.scenario_key() == Some("k")) && named.left_out() == 10);
    }
}
