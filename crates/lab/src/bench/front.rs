//! Pareto fronts: points that no other point dominates. A point dominates another point if neither its cost nor its
//! error is larger than that of the other point, and at least one of the two is smaller.

use super::point::BenchPoint;
use linkage::trajectory::Stage;

linkage::words! {
    /// Quantity that measures the cost of a point.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum CostAxis: name {
        /// Shortest time.
        Time = "time",
        /// Solutions of the whole mechanism.
        Solutions = "solutions",
        /// Inner work: sweeps, factorisations, iterations or placed groups.
        Inner = "inner",
    }
}

impl CostAxis {
    /// Cost of a point on this axis: seconds, or a count.
    pub fn of(self, point: &BenchPoint) -> Option<f64> {
        let effort = || point.run().map(|run| &run.effort);
        match self {
            CostAxis::Time => point.seconds(),
            CostAxis::Solutions => effort()?.solutions().map(|count| count as f64),
            CostAxis::Inner => effort()?.inner().map(|count| count as f64),
        }
    }
}

/// Indices of the points on the front of a stage, the cheapest first.
/// Only one of several points with equal cost and error is kept.
/// An error below the floor is replaced by the floor, because errors below the floor cannot be ranked.
pub fn front(
    points: &[BenchPoint],
    stage: Stage,
    axis: CostAxis,
    floor: f64,
    of: &dyn Fn(&BenchPoint) -> bool,
) -> Vec<usize> {
    let place = |index: usize| {
        let point = Some(&points[index]).filter(|point| of(point))?;
        let error = point.error(stage)?.max;
        Some((axis.of(point)?, if error > floor { error } else { floor }, index))
    };
    let mut placed: Vec<(f64, f64, usize)> = (0..points.len()).filter_map(place).collect();
    placed.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let mut best = f64::INFINITY;
    let mut front = Vec::new();
    for (_, error, index) in placed {
        if error < best {
            best = error;
            front.push(index);
        }
    }
    front
}

#[cfg(test)]
mod tests {
    use super::super::point::RunEffort;
    use super::super::point::{AnsweredRun, BenchOutcome, Errors, MethodOwner};
    use super::*;

    fn point(seconds: f64, error: f64) -> BenchPoint {
        let errors = Errors { max: error, rms: error, is_limited: false };
        let run = AnsweredRun {
            errors: [Some(errors); 5],
            failed: Vec::new(),
            without: Vec::new(),
            seconds: vec![seconds],
            effort: RunEffort::default(),
        };
        BenchPoint {
            program: "p".into(),
            party: MethodOwner::Peer,
            way: String::new(),
            resolution: String::new(),
            settings: None,
            is_usual: false,
            outcome: BenchOutcome::Answered(run),
        }
    }

    /// The test compares the front with its definition.
    /// By definition, no point dominates a point on the front.
    #[test]
    fn the_front_holds_the_undominated_points() {
        let mut state = 1u64;
        let mut random = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            ((state >> 40) % 20) as f64 + 1.0
        };
        for _ in 0..50 {
            let places: Vec<[f64; 2]> = (0..12).map(|_| [random(), random()]).collect();
            let points: Vec<BenchPoint> = places.iter().map(|&[seconds, error]| point(seconds, error)).collect();
            let found = front(&points, Stage::Positions, CostAxis::Time, 0.0, &|_| true);
            let beaten =
                |own: [f64; 2]| places.iter().any(|other| other[0] <= own[0] && other[1] <= own[1] && *other != own);
            let mut expected: Vec<[f64; 2]> = places.iter().copied().filter(|&own| !beaten(own)).collect();
            expected.sort_by(|a, b| a[0].total_cmp(&b[0]));
            expected.dedup();
            assert_eq!(found.iter().map(|&index| places[index]).collect::<Vec<_>>(), expected);
        }
    }

    #[test]
    fn errors_below_the_floor_count_as_equal() {
        let points = [point(1.0, 1e-9), point(2.0, 1e-15), point(3.0, 1e-16)];
        assert_eq!(front(&points, Stage::Positions, CostAxis::Time, 1e-14, &|_| true), [0, 1]);
        assert!(front(&points, Stage::Positions, CostAxis::Solutions, 0.0, &|_| true).is_empty());
    }
}
