//! Follows any mechanism of revolute and prismatic pairs from its start pose. All equations of the mechanism are solved
//! at once, in double-double numbers.

use crate::sentences;
use linkage::case::Case;
use linkage::error::{Error, Result};
use linkage::trajectory::Trajectory;

use super::Long;
use super::equations::Whole;
use super::frame::Snapshot;
use super::numbers::CaseNumbers;
use super::readings::trajectory;
use super::scalar::{Scalar, angle_of};
use super::task::{at_start, check_instants, stuck};

/// Largest change of an input in one step between requested instants: a rotation (rad), or a slide divided by the
/// mechanism's size.
const STEP: f64 = std::f64::consts::PI / 180.0;
/// Limit that replaces the smaller limit [`Scalar::SETTLED`] at steps between requested instants.
const NEAR: f64 = 1e-10;

/// Does the same as [`solve`](super::solve), by all equations at once, for mechanisms of revolute and prismatic pairs
/// with up to some tens of links.
/// From the start pose, the motion is followed in small steps. In a step, a drive rotates by at most one degree, or
/// slides by at most pi/180 of the mechanism's size.
/// At each requested instant, Newton's method is repeated until the pose changes only by rounding errors.
///
/// # Errors
/// The errors of [`solve`](super::solve).
pub fn solve(case: &Case) -> Result<Trajectory> {
    check_instants(case)?;
    let numbers = CaseNumbers::<Long>::of(case)
        .map_err(|error| Error::new(error.kind(), sentences::no_precise_numbers(&error.message())))?;
    let whole = Whole::new(case, &numbers);
    let mut instants: Vec<Option<Snapshot<Long>>> = vec![None; case.grid.len()];
    let (mut frames, mut time) = (at_start(case), 0.0);
    let mut angles: Vec<f64> = case.start.0.iter().map(|pose| pose.angle).collect();
    let speed = case.drives.iter().map(|drive| drive.top_speed().abs() / drive.input.span(case.mechanism.size()));
    let speed = speed.fold(0.0, |a: f64, b| if b > a { b } else { a });
    for row in case.grid.ascending() {
        let to = case.grid.times[row];
        let steps = (((to - time) * speed / STEP).ceil() as usize).max(1);
        let singular = || stuck(case, row, sentences::THE_POSE_IS_SINGULAR);
        for step in 1..=steps {
            let at = if step == steps { to } else { time + (to - time) * step as f64 / steps as f64 };
            let settled = if step == steps { Long::SETTLED } else { NEAR };
            let drives = whole.drive_states(Long::of(at));
            whole.close(&mut frames, &drives, settled).ok_or_else(singular)?;
            for (angle, frame) in angles.iter_mut().zip(&frames) {
                *angle = angle_of([frame.direction.x, frame.direction.y], *angle).rounded();
            }
        }
        time = to;
        let drives = whole.drive_states(Long::of(to));
        instants[row] = Some(whole.instant(&frames, &angles, &drives).ok_or_else(singular)?);
    }
    let instants: Vec<_> = instants.into_iter().map(|instant| instant.expect("every row is visited")).collect();
    trajectory(&whole, &instants)
}
