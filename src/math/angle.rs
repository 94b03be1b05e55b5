//! Angles that keep their turns.

use std::f64::consts::TAU;

/// The angle congruent to `angle` (modulo one turn) that lies nearest to `near`; both in rad.
#[inline]
fn nearest(angle: f64, near: f64) -> f64 {
    angle + TAU * ((near - angle) / TAU).round()
}

/// `angle` brought into (-pi, pi], in rad.
#[must_use]
pub fn wrapped(angle: f64) -> f64 {
    let wrapped = nearest(angle, 0.0);
    if wrapped <= -TAU / 2.0 { wrapped + TAU } else { wrapped }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nearest_keeps_whole_turns() {
        assert!((nearest(0.1, 4.0 * TAU) - (4.0 * TAU + 0.1)).abs() < 1e-12);
        assert!((nearest(3.0, -3.0) - (3.0 - TAU)).abs() < 1e-12);
    }

    #[test]
    fn wrapped_stays_in_one_turn() {
        for k in -20..20 {
            let a = wrapped(0.7 * f64::from(k));
            assert!(a > -TAU / 2.0 && a <= TAU / 2.0);
            assert!((a.sin() - (0.7 * f64::from(k)).sin()).abs() < 1e-12);
        }
    }
}
