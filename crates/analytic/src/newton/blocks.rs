//! The Jacobian of all constraints, block by block.
//!
//! Ordered by driving links and groups, the Jacobian is block-triangular.
//! A driving link does not depend on the groups, and a group does not depend on later groups.
//! This structure is kept if every elimination stays within one diagonal block.
//! Results that do not depend on a group then stay accurate even if this group is near a singular pose.
//! Elimination over all rows together would carry the rounding error of the group's large accelerations into the
//! accelerations of other links, even of the crank.
//! Every block also has its own determinant.
//! The determinant of the whole matrix does not show a change of sign in two blocks at the same time.

use linkage::case::Case;
use linkage::math::KeepNan;
use linkage::math::dense::Lu;
use linkage::mechanism::{JointId, LinkId};

/// One diagonal block: a driving link, or a group.
#[derive(Clone, Debug)]
struct Block {
    rows: Vec<usize>,
    columns: Vec<usize>,
    matrix: Lu,
    /// Euclidean norm of every column of the block.
    norms: Vec<f64>,
    /// Entries of the block's rows in columns of earlier blocks.
    beside: Vec<(usize, usize, f64)>,
    right: Vec<f64>,
}

/// A block-triangular square matrix. The factorisation replaces the matrix, and the storage is reused for the next
/// matrix.
#[derive(Clone, Debug)]
pub(super) struct Blocks {
    blocks: Vec<Block>,
    /// For every row and every column: its block, and its position in this block.
    of_row: Vec<(usize, usize)>,
    of_column: Vec<(usize, usize)>,
    /// All coefficients, row by row in the order of [`Blocks::add`]; unused unless the case has friction.
    entries: Option<Vec<(usize, usize, f64)>>,
    solution: Vec<f64>,
}

impl Blocks {
    /// Storage for the equations of a case; all coefficients zero.
    pub(super) fn of(case: &Case) -> Self {
        let mut parts: Vec<(Vec<usize>, Vec<usize>)> = Vec::new();
        let rows_of = |joint: JointId| case.mechanism.rows(joint);
        let columns_of = |link: LinkId| 3 * (link.index() - 1)..3 * link.index();
        let row_of_drive = |index: usize| case.mechanism.row_of_drive(index);
        for (index, driver) in case.structure.leading() {
            let rows = rows_of(driver.joint).chain([row_of_drive(index)]).collect();
            parts.push((rows, columns_of(driver.link).collect()));
        }
        for group in &case.structure.groups {
            let given = case.drives.iter().enumerate().filter(|(_, drive)| group.given.contains(&drive.joint));
            let joints = group.outer.iter().chain(&group.inner).flat_map(|&joint| rows_of(joint));
            let trains = group.trains.iter().map(|&id| case.mechanism.row_of_transmission(id));
            let rows = joints.chain(given.map(|(index, _)| row_of_drive(index))).chain(trains).collect();
            parts.push((rows, group.links.iter().flat_map(|&link| columns_of(link)).collect()));
        }
        let n = 3 * (case.mechanism.links().len() - 1);
        let (mut of_row, mut of_column) = (vec![(0, 0); n], vec![(0, 0); n]);
        let blocks = parts.into_iter().enumerate().map(|(block, (rows, columns))| {
            debug_assert_eq!(rows.len(), columns.len(), "a block is square");
            rows.iter().enumerate().for_each(|(place, &row)| of_row[row] = (block, place));
            columns.iter().enumerate().for_each(|(place, &column)| of_column[column] = (block, place));
            let size = rows.len();
            let (matrix, zeros) = (Lu::new(size), vec![0.0; size]);
            Block { rows, columns, matrix, norms: zeros.clone(), beside: Vec::new(), right: zeros }
        });
        let entries = case.has_friction().then(Vec::new);
        Blocks { blocks: blocks.collect(), of_row, of_column, entries, solution: vec![0.0; n] }
    }

    /// Sets all coefficients to zero.
    pub(super) fn clear(&mut self) {
        self.entries.iter_mut().for_each(Vec::clear);
        for block in &mut self.blocks {
            block.matrix.clear();
            block.norms.fill(0.0);
            block.beside.clear();
        }
    }

    /// Adds `value` to the coefficient in `row`, `column`.
    #[inline]
    pub(super) fn add(&mut self, row: usize, column: usize, value: f64) {
        if let Some(entries) = &mut self.entries {
            entries.push((row, column, value));
        }
        let (block, place) = self.of_row[row];
        let (beside, local) = self.of_column[column];
        let own = &mut self.blocks[block];
        if beside == block {
            own.matrix.add(place, local, value);
            own.norms[local] = own.norms[local].hypot(value);
        } else {
            debug_assert!(beside < block, "no block depends on a later one");
            own.beside.push((place, column, value));
        }
    }

    /// All coefficients: row, column and value; empty unless the case has friction.
    pub(super) fn entries(&self) -> impl Iterator<Item = (usize, usize, f64)> + '_ {
        self.entries.iter().flatten().copied()
    }

    /// Factors all blocks. Returns `false` if a block is singular to working precision, or not finite.
    #[must_use]
    pub(super) fn factor(&mut self) -> bool {
        self.blocks.iter_mut().all(|block| block.matrix.factor())
    }

    /// For every block, the determinant is divided by the largest possible determinant; returns the smallest of these
    /// ratios.
    /// The determinant of a block would be largest if its columns kept their lengths and were orthogonal.
    /// Every column belongs to one coordinate, so the ratio does not depend on the units of the coordinates (m and
    /// rad).
    pub(super) fn smallest_share(&self) -> f64 {
        self.shares().map(f64::abs).fold(f64::INFINITY, f64::smaller)
    }

    /// For every block: ratio of its determinant to the largest possible determinant, with the determinant's sign.
    pub(super) fn shares(&self) -> impl Iterator<Item = f64> + '_ {
        self.blocks.iter().map(|block| {
            // The product of all pivots could underflow, so each pivot is divided by a column norm first.
            let pivots = block.matrix.pivots().map(f64::abs);
            let share = pivots.zip(&block.norms).map(|(pivot, norm)| pivot / norm).product::<f64>();
            share * block.matrix.determinant_sign()
        })
    }

    /// Sign of every block's determinant, +1 or -1.
    pub(super) fn signs(&self) -> impl Iterator<Item = f64> + '_ {
        self.blocks.iter().map(|block| block.matrix.determinant_sign())
    }

    /// Solves A x = b for the factored matrix; `b` is replaced by `x`.
    pub(super) fn solve(&mut self, b: &mut [f64]) {
        let Blocks { blocks, solution, .. } = self;
        for Block { rows, columns, matrix, beside, right, .. } in blocks {
            for (right, &row) in right.iter_mut().zip(&*rows) {
                *right = b[row];
            }
            for &(place, column, value) in &*beside {
                right[place] -= value * solution[column];
            }
            matrix.solve(right);
            for (&column, x) in columns.iter().zip(&*right) {
                solution[column] = *x;
            }
        }
        b.copy_from_slice(solution);
    }

    /// Solves A^T x = y for the factored matrix; `y` is replaced by `x`.
    pub(super) fn solve_transposed(&mut self, y: &mut [f64]) {
        let Blocks { blocks, solution, .. } = self;
        for Block { rows, columns, matrix, beside, right, .. } in blocks.iter_mut().rev() {
            for (right, &column) in right.iter_mut().zip(&*columns) {
                *right = y[column];
            }
            matrix.solve_transposed(right);
            for (&row, x) in rows.iter().zip(&*right) {
                solution[row] = *x;
            }
            for &(place, column, value) in &*beside {
                y[column] -= value * right[place];
            }
        }
        y.copy_from_slice(solution);
    }
}
