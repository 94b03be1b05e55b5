//! The equations of the tree's joints, and their order of solution.

use std::ops::Range;

use super::seam::{PAIR, Pass, Seam, Term};
use linkage::math::dense::Lu;

/// A link carried by the ground or by another link through a joint of the tree.
#[derive(Clone, Debug)]
pub(super) struct Limb {
    pub(super) seam: Seam,
    /// Index of the drive that drives the joint; `None` if the joint is not driven.
    pub(super) drive: Option<usize>,
    /// Whether the drive acts on both links of the joint. Joint and drive together then transmit any force and moment.
    pub(super) is_rigid: bool,
    /// Indices of the components that occur in the equation of the link's joint: the components in the cut joints of
    /// this link and of the links beyond it.
    pub(super) terms: Vec<usize>,
}

/// Equations that determine some of the components after the components of earlier stages are known.
#[derive(Debug)]
pub(super) enum Stage {
    /// Two equations for two components, usually the components of one cut joint. The first field has the indices of
    /// these components.
    Pair([usize; PAIR], [Row; PAIR]),
    /// All remaining components, with workspace for the system.
    All { rows: Vec<Row>, terms: Vec<usize>, values: Vec<f64>, matrix: Lu },
}

/// The equation of a joint of the tree.
/// The row stores the index of its limb and its unknown terms with their columns in the stage's matrix.
/// Known terms are stored separately.
#[derive(Debug)]
pub(super) struct Row {
    pub(super) number: usize,
    columns: Vec<(usize, usize)>,
    known: Vec<usize>,
}

impl Row {
    /// The equation of limb `number`, for the unknown `terms`.
    fn of(number: usize, limb: &Limb, terms: &[usize]) -> Self {
        let column = |term: &usize| terms.iter().position(|own| own == term);
        let columns = limb.terms.iter().filter_map(|term| Some((column(term)?, *term)));
        let known = limb.terms.iter().copied().filter(|term| column(term).is_none());
        Row { number, columns: columns.collect(), known: known.collect() }
    }

    /// Calls `put` for every column and coefficient of the equation, and returns the right-hand side.
    /// Coefficients and right-hand side follow from the limb's joint, and from the force and moment that this joint
    /// must transmit to its link.
    #[inline]
    pub(super) fn equation(
        &self,
        (pass, own): (Pass, &[Term]),
        components: &[f64],
        mut put: impl FnMut(usize, f64),
    ) -> f64 {
        let mut right = -pass.left_over(&own[own.len() - 1]);
        for &(column, term) in &self.columns {
            put(column, pass.left_over(&own[term]));
        }
        for &term in &self.known {
            right -= pass.left_over(&own[term]) * components[term];
        }
        right
    }
}

/// Order in which the components are computed.
/// Wherever two equations have only the two components of one cut joint as unknowns, this pair of components comes
/// first. In chains of dyads, all components are computed in such pairs.
/// After these pairs, all remaining components are computed together.
pub(super) fn stages(limbs: &[Limb], cut: &[Range<usize>]) -> Vec<Stage> {
    let mut left: Vec<usize> = (0..limbs.len()).rev().filter(|&number| limbs[number].drive.is_none()).collect();
    let (mut unknown, mut stages): (Vec<usize>, _) = (cut.iter().cloned().flatten().collect(), Vec::new());
    while !left.is_empty() {
        let new = |number: usize| limbs[number].terms.iter().filter(|term| unknown.contains(term));
        let left_open = cut.iter().filter(|terms| unknown.contains(&terms.start));
        let alone = left_open.cloned().find_map(|terms| {
            let rows = left.iter().copied().filter(|&number| new(number).all(|term| terms.contains(term)));
            let rows: Vec<usize> = rows.collect();
            (rows.len() == terms.len()).then(|| (rows, terms.collect()))
        });
        let (rows, terms): (Vec<usize>, Vec<usize>) = alone.unwrap_or_else(|| (left.clone(), unknown.clone()));
        left.retain(|number| !rows.contains(number));
        unknown.retain(|term| !terms.contains(term));
        let rows: Vec<Row> = rows.into_iter().map(|number| Row::of(number, &limbs[number], &terms)).collect();
        stages.push(match <[Row; PAIR]>::try_from(rows) {
            Ok(pair) => Stage::Pair([terms[0], terms[1]], pair),
            Err(rows) => {
                let (values, matrix) = (vec![0.0; terms.len()], Lu::new(terms.len()));
                Stage::All { rows, terms, values, matrix }
            }
        });
    }
    stages
}
