//! Room for an engine's steps between the ends of a grid and the dead points beside it.
//!
//! A run of a prescribed motion begins some steps before the first instant and ends some after the last one. Near a
//! limit of rotation only a small step leaves room for them.

use analytic::range::{ASIDE, Extent, reachable};
use linkage::case::Case;
use linkage::engine::Engine;
use linkage::math::KeepNan;
use linkage::work::limited;

/// The largest step (s) for which a run of this engine stays within the crank angles that can be reached; infinite for
/// a full turn, and where forces decide the motion.
pub(super) fn room(case: &Case, engine: &dyn Engine) -> f64 {
    let steps = engine.overrun();
    let Some([from, to]) = limits(case).filter(|_| steps > 0.0) else { return f64::INFINITY };
    let drive = case.crank();
    let at = |t: f64| {
        let own = drive.at(t);
        // To the limit that lies ahead, in either sense of time.
        let distance = (own.value - from).abs().smaller((to - own.value).abs());
        distance / own.rate.abs() / steps
    };
    let times = case.grid.times.iter();
    let [first, last] = times.fold([0.0f64; 2], |[first, last], &t| [first.smaller(t), last.larger(t)]);
    // Of a drive at rest there is no speed to judge by.
    [first, last].map(at).into_iter().filter(|step| step.is_finite()).fold(f64::INFINITY, f64::smaller)
}

/// Crank angles (rad) between which a prescribed motion of one drive stays; `None` if nothing limits it, and
/// where that is not known after some work: the engine then says itself where it cannot go on.
fn limits(case: &Case) -> Option<[f64; 2]> {
    if case.is_free() || case.drives.len() > 1 {
        return None;
    }
    match limited(ASIDE, || reachable(case)).0 {
        Ok(Extent::Limited(ends)) => Some(ends.map(|end| end.crank)),
        Ok(Extent::FullTurn(_)) | Err(_) => None,
    }
}
