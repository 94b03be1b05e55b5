//! Fewer samples: the first one, then those that are due, and the last one.

use linkage::math::statistics::ascending;
use linkage::trajectory::Trajectory;

/// Share of a sample's distance by which it may come too early: grids are rounded.
const EARLY: f64 = 1e-6;

/// The trajectory with at most `hz` samples a second beside its first and its last.
pub fn thinned(trajectory: &Trajectory, hz: f64) -> Trajectory {
    let times = trajectory.times();
    let order = ascending(times);
    let mut keep = vec![false; times.len()];
    if let (Some(&first), Some(&last)) = (order.first(), order.last()) {
        (keep[first], keep[last]) = (true, true);
        let mut due = 1.0;
        for &row in &order {
            let passed = (times[row] - times[first]) * hz + EARLY;
            if passed >= due {
                keep[row] = true;
                due = passed.floor() + 1.0;
            }
        }
    }
    trajectory.at_rows(&keep)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kept(times: &[f64], hz: f64) -> Vec<f64> {
        let all = Trajectory::new(times.to_vec(), times.to_vec(), Vec::new(), Vec::new()).unwrap();
        thinned(&all, hz).times().to_vec()
    }

    #[test]
    fn the_first_the_last_and_what_is_due_stay_in_the_solvers_order() {
        let grid: Vec<f64> = (0..=10).map(|k| f64::from(k) * 0.1).collect();
        assert_eq!(kept(&grid, 5.0), [0.0, 0.2, 0.4, 0.6000000000000001, 0.8, 1.0]);
        assert_eq!(kept(&grid, 1000.0), grid);
        assert_eq!(kept(&grid, 0.1), [0.0, 1.0]);
        // Gaps do not shift what comes after them.
        assert_eq!(kept(&[0.0, 0.05, 0.95, 1.0, 1.05, 2.0], 1.0), [0.0, 1.0, 2.0]);
        assert_eq!(kept(&[2.0, 1.0, 0.0, 0.5], 1.0), [2.0, 1.0, 0.0]);
        assert_eq!(kept(&[], 1.0), [0.0; 0]);
    }
}
