//! Crank angles at which a candidate comes nearest to its precision points.

use linkage::math::KeepNan;

use crate::synthesize::evaluate::Evaluator;
use crate::synthesize::task::{PrecisionPoint, Task};

/// Crank angles (rad) of all precision points.
/// Free crank angles are chosen among the crank angles `turns` of the evaluator's last run.
/// The chosen angles ascend within one turn and have the smallest possible sum of squared deviations.
/// The last crank angle of the run is a turn after the first.
pub(super) fn nearest(task: &Task, evaluator: &Evaluator, turns: &[f64]) -> Vec<f64> {
    let count = turns.len() - 1;
    let free: Vec<&PrecisionPoint> = task.points.all().iter().filter(|point| point.turn.is_none()).collect();
    let cost = |point: &PrecisionPoint, row: usize| -> f64 {
        let (place, angle) = evaluator.position(row % count);
        task.points.squared_deviation(point, place, angle)
    };
    let costs: Vec<Vec<f64>> = free.iter().map(|point| (0..count).map(|row| cost(point, row)).collect()).collect();
    let (_, rows) = (0..count)
        .map(|first| ascend(&costs, first))
        .fold((f64::INFINITY, Vec::new()), |best, found| if found.0 < best.0 { found } else { best });
    let whole = turns[count] - turns[0];
    let mut chosen = rows.into_iter().map(|row| turns[row % count] + whole * (row / count) as f64);
    task.points.all().iter().map(|point| point.turn.or_else(|| chosen.next()).unwrap_or(0.0)).collect()
}

/// Ascending rows within one turn that begin with the row `first` and have the smallest total cost, by dynamic
/// programming.
/// `costs` contains, for every point, a list with the cost of each row.
fn ascend(costs: &[Vec<f64>], first: usize) -> (f64, Vec<usize>) {
    let Some((head, rest)) = costs.split_first() else { return (0.0, Vec::new()) };
    let count = head.len();
    // For every point, and for every upper limit of the point's row: the smallest total cost of all points up to this
    // point, and the row that this point then has.
    let mut best = vec![vec![(head[first], first); count]];
    for costs in rest {
        let before = &best[best.len() - 1];
        let mut lowest = (f64::INFINITY, first);
        let along = (0..count).map(|step| {
            let earlier = step.checked_sub(1).map_or(f64::INFINITY, |step| before[step].0);
            let total = earlier + costs[(first + step) % count];
            if total < lowest.0 {
                lowest = (total, first + step);
            }
            lowest
        });
        let along = along.collect();
        best.push(along);
    }
    let mut rows = Vec::with_capacity(best.len());
    let mut step = count - 1;
    for layer in best.iter().rev() {
        let row = layer[step].1;
        rows.push(row);
        step = (row - first).saturating_sub(1);
    }
    rows.reverse();
    (best[best.len() - 1][count - 1].0.larger(0.0), rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_ascend_with_the_smallest_total_cost() {
        // The row nearest to the second point is before the row nearest to the first point.
        let costs = vec![vec![9.0, 9.0, 0.0, 9.0], vec![9.0, 0.0, 9.0, 1.0]];
        let best = (0..4).map(|first| ascend(&costs, first)).min_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
        // Row 5 is row 1 of the next turn.
        assert_eq!(best, (0.0, vec![2, 5]));
        assert_eq!(ascend(&costs, 1), (9.0 + 1.0, vec![1, 3]));
        assert_eq!(ascend(&[], 0), (0.0, Vec::new()));
    }
}
