//! Names of columns: each stands once.

use std::fmt;

/// Two columns of one name. It displays as a message.
#[derive(Clone, Debug, PartialEq)]
pub struct Twice {
    /// The name.
    pub name: String,
    /// Numbers of the two columns, from 1.
    pub columns: [usize; 2],
}

impl Twice {
    /// The way out.
    pub const HELP: &str = "give every column a name of its own, or take one of the two out";

    /// The first name that stands twice. Columns without a name are nobody's: nothing can ask for them.
    pub fn of<T: AsRef<str>>(names: impl IntoIterator<Item = T>) -> Option<Twice> {
        let mut seen = std::collections::BTreeMap::new();
        for (index, name) in names.into_iter().enumerate() {
            let name = name.as_ref().trim().to_string();
            if name.is_empty() {
                continue;
            }
            if let Some(first) = seen.insert(name.clone(), index + 1) {
                return Some(Twice { name, columns: [first, index + 1] });
            }
        }
        None
    }
}

impl fmt::Display for Twice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [first, second] = self.columns;
        write!(f, "the columns {first} and {second} of the table are both called \"{}\"", self.name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_that_stands_twice_is_told_with_both_places() {
        let twice = Twice::of(["t", "x", "", "", " t"]).unwrap();
        assert_eq!(twice.to_string(), "the columns 1 and 5 of the table are both called \"t\"");
        assert_eq!(Twice::of(["t", "T", "", ""]), None);
    }
}
