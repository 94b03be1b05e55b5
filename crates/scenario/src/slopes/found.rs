//! The keys of a file, and the derivatives of the numbers of the case by these keys.

use std::collections::{BTreeMap, BTreeSet};

use super::slope::Slope;
use linkage::case::CaseNumber;
use linkage::drive::Course;

linkage::words! {
    /// Meaning of a key of a file.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
    pub enum KeySort: name {
        /// A parameter.
        Parameter = "parameter",
        /// A length or an angle of the mechanism.
        Dimension = "dimension",
        /// A mass or a moment of inertia.
        Mass = "mass",
        /// A number of a motion law.
        Law = "law",
        /// A number of a load.
        Load = "load",
        /// Another number: a component of gravity, the start of a motion, the zero of an input, or an input in the
        /// table of a load.
        Other = "other",
    }
}

/// A number of a file by which numbers of the case can be differentiated.
#[derive(Clone, Debug, PartialEq)]
pub struct CaseKey {
    /// The key of a parameter, or the path of a number.
    pub name: String,
    /// Meaning of the key.
    pub sort: KeySort,
    /// The number, in the unit of its key.
    pub value: f64,
    /// Unit, as in the ending of the key; empty for a number without a unit.
    pub unit: &'static str,
}

/// The derivatives of all numbers of a case by the keys of its file.
#[derive(Clone, Debug)]
pub struct CaseSlopes {
    /// The keys: parameters first, then numbers in the order in which the sections use them.
    pub keys: Vec<CaseKey>,
    /// The numbers of the case with their derivatives by the keys, per unit of the key.
    pub numbers: BTreeMap<CaseNumber, Slope>,
    /// Derivatives of the tables of loads, by the index of the load and the index of the table. The derivative of a
    /// table by a key is a table.
    pub tables: BTreeMap<(usize, usize), Vec<(usize, Course)>>,
    /// Keys without a known derivative, each with the part of the file that uses it.
    pub untold: Vec<(usize, String)>,
    /// Whether the file gives its grid by inputs (crank angles or slides) rather than by times.
    pub by_input: bool,
}

impl CaseSlopes {
    /// The index of the key with this name.
    #[must_use]
    pub fn key(&self, name: &str) -> Option<usize> {
        self.keys.iter().position(|key| key.name == name)
    }

    /// The keys on which a number of the case depends.
    #[must_use]
    pub fn used(&self) -> BTreeSet<usize> {
        let numbers = self.numbers.values().flat_map(|slope| slope.by.keys().copied());
        let tables = self.tables.values().flatten().map(|(key, _)| *key);
        numbers.chain(tables).chain(self.untold.iter().map(|(key, _)| *key)).collect()
    }

    /// Indices of the keys for a user who names no keys.
    /// These keys are the parameters on which the case depends, because the author of a file makes the free dimensions
    /// parameters.
    /// If the case depends on no parameter, these keys are all other keys on which the case depends, except those of
    /// the sort [`KeySort::Other`].
    #[must_use]
    pub fn usual(&self) -> Vec<usize> {
        let used = self.used();
        let of = |is_wanted: &dyn Fn(KeySort) -> bool| -> Vec<usize> {
            used.iter().copied().filter(|key| is_wanted(self.keys[*key].sort)).collect()
        };
        let parameters = of(&|sort| sort == KeySort::Parameter);
        match parameters.is_empty() {
            true => of(&|sort| sort != KeySort::Other),
            false => parameters,
        }
    }
}
