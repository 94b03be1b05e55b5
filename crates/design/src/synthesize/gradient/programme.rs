//! The nonlinear programme in the form that the optimiser requires.

use std::cell::RefCell;
use std::convert::Infallible;

use basin::{
    BoxBounds, ConstraintDescription, ConstraintJacobian, ConstraintSet, ConstraintSolveError, Constraints,
    CostFunction, DenseMatrix, Gradient, NoLinearConstraints, NoNonlinearBlock, NonlinearBlock, NonlinearBlocks,
    NonlinearInequalityValues,
};

use super::rows::{Order, Rows};
use super::sloped::Sloped;
use super::wishes::Wishes;

/// A point of the programme with the constraints at this point.
struct Visited {
    point: Vec<f64>,
    order: Order,
    constraints: Option<Vec<Sloped>>,
}

/// The programme of one candidate: minimise the largest deviation, subject to all constraints.
pub(super) struct Programme<'a, 'b> {
    wishes: &'a Wishes<'b>,
    rows: RefCell<&'a mut Rows<'b>>,
    /// Bounds of the unknowns.
    lower: Vec<f64>,
    upper: Vec<f64>,
    /// Number of constraints.
    count: usize,
    last: RefCell<Option<Visited>>,
}

impl<'a, 'b> Programme<'a, 'b> {
    /// The programme with bounds of all unknowns and `count` constraints.
    pub(super) fn new(
        wishes: &'a Wishes<'b>,
        rows: &'a mut Rows<'b>,
        [lower, upper]: [Vec<f64>; 2],
        count: usize,
    ) -> Self {
        Programme { wishes, rows: RefCell::new(rows), lower, upper, count, last: RefCell::new(None) }
    }

    /// Calls `read` with the constraints at a point, or with `None` if the candidate cannot be assembled.
    fn visit<T>(&self, point: &[f64], order: Order, read: impl FnOnce(Option<&Vec<Sloped>>) -> T) -> T {
        let mut last = self.last.borrow_mut();
        let is_known = |own: &Visited| own.point == point && (own.order == order || own.order == Order::Slopes);
        if !last.as_ref().is_some_and(is_known) {
            let turns = self.wishes.turns(point);
            let found = self.rows.borrow_mut().at(self.wishes.shares(point), &turns, order);
            let constraints = found.map(|found| self.wishes.constraints(&found, point));
            *last = Some(Visited { point: point.to_vec(), order, constraints });
        }
        read(last.as_ref().and_then(|own| own.constraints.as_ref()))
    }
}

impl Constraints for Programme<'_, '_> {
    type Set =
        ConstraintSet<BoxBounds<Vec<f64>>, NoLinearConstraints, NonlinearBlocks<NoNonlinearBlock, NonlinearBlock>>;

    fn constraints(&self) -> <Self::Set as ConstraintDescription>::Borrowed<'_> {
        let bounds = BoxBounds::new(Some(&self.lower), Some(&self.upper));
        ConstraintSet::new().with_bounds(bounds).with_nonlinear_inequalities(self.count)
    }
}

impl CostFunction for Programme<'_, '_> {
    type Param = Vec<f64>;
    type Output = f64;
    type Error = Infallible;

    fn cost(&self, point: &Vec<f64>) -> Result<f64, Infallible> {
        Ok(point[self.wishes.deviation()])
    }
}

impl Gradient for Programme<'_, '_> {
    type Gradient = Vec<f64>;

    fn gradient(&self, point: &Vec<f64>) -> Result<Vec<f64>, Infallible> {
        Ok((0..point.len()).map(|index| f64::from(u8::from(index == self.wishes.deviation()))).collect())
    }
}

impl NonlinearInequalityValues for Programme<'_, '_> {
    type Param = Vec<f64>;
    type Values = Vec<f64>;
    type Error = Infallible;

    /// A candidate that cannot be assembled gives NaN. The optimiser rejects such a point and shortens its step.
    fn nonlinear_inequalities(&self, point: &Vec<f64>) -> Result<Vec<f64>, ConstraintSolveError<Infallible>> {
        let values = |all: &Vec<Sloped>| all.iter().map(|own| own.value).collect();
        Ok(self.visit(point, Order::Values, |all| all.map_or_else(|| vec![f64::NAN; self.count], values)))
    }
}

impl ConstraintJacobian for Programme<'_, '_> {
    type Param = Vec<f64>;
    type Jacobian = DenseMatrix<f64>;
    type Error = Infallible;

    fn constraint_jacobian(&self, point: &Vec<f64>) -> Result<DenseMatrix<f64>, ConstraintSolveError<Infallible>> {
        let matrix = |all: &Vec<Sloped>| all.iter().flat_map(|own| own.slopes.iter().copied()).collect();
        let missing = || vec![f64::NAN; self.count * point.len()];
        let entries: Vec<f64> = self.visit(point, Order::Slopes, |all| all.map_or_else(missing, matrix));
        Ok(DenseMatrix::from_row_slice(self.count, point.len(), &entries))
    }
}
