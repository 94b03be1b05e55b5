//! Many poses of one case in one call.
//!
//! Several crank angles are solved at once, as many as fit into the machine's registers.
//! [`Batch::is_vectorised`] lists the conditions on the case.
//! If a case meets these conditions, each of its poses can be solved without the other poses.
//! Any other case is solved pose by pose.

mod anchors;
mod bodies;
mod chains;
mod elimination;
mod equations;
mod groups;
mod lanes;
mod loads;
mod many;
mod poses;
mod tally;

use std::f64::consts::PI;

use pulp::{Arch, Simd, WithSimd};
use wide::f64x8;

use self::anchors::Anchors;
use self::equations::Reach;
use self::groups::Groups;
use self::lanes::{AlignedNumbers, TILE, Tile};
pub use self::many::CaseBatch;
pub use self::poses::Poses;
use self::poses::{ALPHA, DIRECTION, Layout, OMEGA};
pub use self::tally::{PoseQuantity, PoseTally, rrr_sine, spans};
use crate::PoseSolver;
use linkage::case::Case;
use linkage::error::Result;
use linkage::solver::State;
use linkage::trajectory::Stage;

/// If the crank angles of two rows differ by more than this value (rad), intermediate poses are checked too.
/// The value must not exceed the step of [`PoseSolver`] in a case without higher groups.
const STEP: f64 = PI / 12.0;

/// For angles larger than this (rad), the sine and cosine of the standard library are used instead of the vector
/// functions.
/// The largest angle of a grid is 6.3e5 rad.
const FAR: f64 = 1e7;

/// Solves a case for many crank angles in one call, on the branch of its start pose.
#[derive(Debug)]
pub struct Batch<'a> {
    case: &'a Case,
    layout: Layout,
    groups: Option<Groups>,
    anchors: Option<Anchors<'a>>,
    work: AlignedNumbers,
    arch: Arch,
    /// Pose solver for the poses that are not vectorised, and for the error messages.
    poses: PoseSolver<'a>,
    /// Last crank angle reached (rad).
    crank: f64,
    /// Number of poses so far that were solved one by one.
    singly: usize,
}

impl<'a> Batch<'a> {
    /// Starts at the start pose of the case, which fixes the branch.
    ///
    /// # Errors
    /// The errors of [`PoseSolver::new`].
    pub fn of(case: &'a Case) -> Result<Self> {
        let poses = PoseSolver::new(case)?;
        // A case that passes change points is not vectorised.
        // The vectorised solution assumes that the determinant of each group keeps its sign, but the sign changes at a
        // change point.
        let groups = match case.crank().through {
            true => None,
            false => Groups::of(case, &poses.plan, Layout::of(case, false)),
        };
        let anchors = groups.as_ref().map(|groups| Anchors::of(case, groups)).transpose()?.flatten();
        Ok(Batch {
            case,
            layout: Layout::of(case, groups.is_none()),
            work: AlignedNumbers::zeros(groups.as_ref().map_or(0, |groups| groups.columns * TILE)),
            groups,
            anchors,
            arch: Arch::new(),
            poses,
            crank: case.crank().start,
            singly: 0,
        })
    }

    /// Whether several poses are solved at once.
    /// A vectorised solution requires that
    /// - all drives are cranks on the ground; if there are several, their speeds are constant,
    /// - all groups are RRR dyads or groups of four or six links on pins,
    /// - there are no transmissions, and all loads are moments of resistance,
    /// - the drive does not pass change points.
    ///
    /// If `false`, the case is solved pose by pose.
    #[must_use]
    pub fn is_vectorised(&self) -> bool {
        self.groups.is_some()
    }

    /// Number of poses so far that were solved one by one.
    /// In a vectorised case, the poses for which the vectorised solution failed; in any other case, all poses.
    #[must_use]
    pub fn solved_singly(&self) -> usize {
        self.singly
    }

    /// Solves the poses at the crank angles `cranks` (rad, as the scenario states them), up to the stage `deepest`.
    /// In all poses the crank has the angular velocity `omega` (rad/s) and the angular acceleration `alpha` (rad/s^2).
    /// Within rounding error, the poses equal the results of [`PoseSolver::solve`] called for the same crank angles in
    /// the same order.
    /// The first call starts from the start pose, later calls from the last crank angle reached.
    /// If poses are [vectorised](Batch::is_vectorised), the bits of a pose do not depend on the position of its crank
    /// angle in `cranks`.
    /// Higher groups are followed from the start pose in steps of two degrees.
    /// In a case with higher groups, poses near a dead point are solved one by one, and so are poses more than 50 000
    /// steps from the start pose.
    /// In a vectorised case without higher groups, intermediate poses are checked too if successive crank angles are
    /// more than 15 degrees apart.
    ///
    /// # Errors
    /// The errors of [`PoseSolver::solve`] at the first crank angle that cannot be reached. `out` then contains the
    /// poses before this angle.
    pub fn solve(&mut self, cranks: &[f64], omega: f64, alpha: f64, deepest: Stage, out: &mut Poses) -> Result<()> {
        out.prepare(self.layout, cranks.len());
        if let Some(groups) = &self.groups {
            let asked = Asked { cranks, omega, alpha, deepest };
            let anchors = &mut self.anchors;
            let (case, work) = (self.case, &mut self.work[..]);
            match groups.chains().next() {
                Some(_) => self.arch.dispatch(Tiles::<true> { case, groups, anchors, asked, work, out }),
                None => self.arch.dispatch(Tiles::<false> { case, groups, anchors, asked, work, out }),
            }
        }
        for (row, &crank) in cranks.iter().enumerate() {
            let is_placed = self.is_vectorised() && out.is_placed(row);
            // If the batch has anchors, they already contain the intermediate poses, so no intermediate pose is solved
            // here.
            if !(is_placed && (self.anchors.is_some() || (crank - self.crank).abs() <= STEP)) {
                let deepest = if is_placed { Stage::Positions } else { deepest };
                match self.walk(crank, omega, alpha, deepest) {
                    Ok(_) if is_placed => {}
                    Ok(state) => {
                        out.put(row, state);
                        self.singly += 1;
                    }
                    Err(error) => {
                        out.truncate(row);
                        return Err(error);
                    }
                }
            }
            self.crank = crank;
        }
        Ok(())
    }

    /// Solves a crank angle with the pose solver, starting from the last crank angle reached.
    fn walk(&mut self, crank: f64, omega: f64, alpha: f64, deepest: Stage) -> Result<&State> {
        if self.is_vectorised() {
            self.poses.solve(self.crank, omega, alpha, Stage::Positions)?;
        }
        self.poses.solve(crank, omega, alpha, deepest)
    }
}

/// Input of one call of [`Batch::solve`].
#[derive(Clone, Copy, Debug)]
struct Asked<'a> {
    cranks: &'a [f64],
    omega: f64,
    alpha: f64,
    deepest: Stage,
}

/// All tiles of a batch, solved with the widest instructions of the machine.
struct Tiles<'a, 'c, const CHAINS: bool> {
    case: &'a Case,
    groups: &'a Groups,
    anchors: &'a mut Option<Anchors<'c>>,
    asked: Asked<'a>,
    work: &'a mut [f64],
    out: &'a mut Poses,
}

/// Writes the input of one tile: directions, angular velocities and angular accelerations of the driving links.
/// `cranks` are the crank angles of the tile.
#[inline(always)]
fn drive(case: &Case, groups: &Groups, asked: Asked, cranks: &[f64], tile: &mut [f64]) {
    for (index, (drive, driver)) in case.drives.iter().zip(&groups.drivers).enumerate() {
        driver.fix(tile, asked.omega, asked.alpha);
        let columns = &mut tile[driver.body.link * TILE..];
        let mut angles = [0.0; TILE];
        for (row, &crank) in cranks.iter().enumerate() {
            angles[row] = case.crank().coordinate(crank);
            if index > 0 {
                let t = case.crank().time_of(crank);
                angles[row] = drive.coordinate(drive.at(t).value);
                let ratio = case.drives.ratios(t).nth(index).expect("every drive has a ratio");
                columns[OMEGA * TILE + row] = asked.omega * ratio;
                columns[ALPHA * TILE + row] = asked.alpha * ratio;
            }
        }
        let (cos, sin) = columns[DIRECTION * TILE..][..2 * TILE].split_at_mut(TILE);
        units(&angles[..cranks.len()], cos, sin);
    }
}

/// Writes cosines and sines of angles (rad), in groups of eight. The last group repeats the last angle.
#[inline(always)]
fn units(angles: &[f64], cos: &mut [f64], sin: &mut [f64]) {
    let (cosines, _) = cos.as_chunks_mut();
    let (sines, _) = sin.as_chunks_mut();
    for ((angles, cos), sin) in angles.chunks(8).zip(cosines).zip(sines) {
        let eight: [f64; 8] = std::array::from_fn(|row| angles[row.min(angles.len() - 1)]);
        let (s, c) = f64x8::from(eight).sin_cos();
        (*sin, *cos) = (s.to_array(), c.to_array());
        for (row, angle) in eight.into_iter().enumerate() {
            if !(angle.abs() <= FAR) {
                (sin[row], cos[row]) = angle.sin_cos();
            }
        }
    }
}

impl<const CHAINS: bool> WithSimd for Tiles<'_, '_, CHAINS> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, on: S) {
        let Tiles { case, groups, anchors, asked, work, out } = self;
        for (cranks, tile) in asked.cranks.chunks(TILE).zip(out.tiles()) {
            drive(case, groups, asked, cranks, tile);
            if let Some(anchors) = anchors {
                anchors.fill(cranks, groups, work);
            }
            let (tile, work) = (Tile::of(on, tile, cranks.len()), Tile::of(on, work, cranks.len()));
            groups.move_links::<S, CHAINS, _>(asked.deepest, Reach, tile, work);
            if asked.deepest >= Stage::Reactions {
                groups.load_joints::<S, CHAINS>(tile, work);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use fixtures::{class_four, four_bar, turning, turning_from};
    use linkage::case::Grid;
    use linkage::math::tally::{LanePeak, Tally, Weighted};
    use linkage::math::{KeepNan, Vec2};
    use linkage::mechanism::{JointId, LinkId, Mechanism, StartGroup};

    /// Returns all register widths of this machine.
    fn widths() -> Vec<Arch> {
        let mut widths = vec![Arch::Scalar, Arch::new()];
        #[cfg(target_arch = "x86_64")]
        widths.extend(pulp::x86::V3::try_new().map(Arch::V3));
        widths
    }

    /// The vector sine and cosine differ from the functions of the standard library by at most one unit in the last
    /// place of 1.
    /// Up to half a unit of the difference may be the rounding error of the standard library; the remainder is the
    /// error of the vector functions.
    #[test]
    fn sines_and_cosines_match_the_standard_library() {
        for k in -400_000..400_000 {
            // One angle in ten is a multiple of a quarter turn, where sine or cosine is zero.
            let quarters = f64::from(k) * if k % 10 == 0 { 1.0 } else { 1.600_123_4 };
            let shares = [1.0, 1e-5, 3.0, 15.0, -1.0, -0.1, 7.3, 0.5];
            let angles = shares.map(|share| quarters * share * PI / 2.0);
            let [mut cos, mut sin] = [[0.0; 8]; 2];
            units(&angles, &mut cos, &mut sin);
            for ((angle, cos), sin) in angles.into_iter().zip(cos).zip(sin) {
                let apart = (cos - angle.cos()).abs().larger((sin - angle.sin()).abs());
                assert!(apart <= f64::EPSILON, "{apart:e} at {angle}");
            }
        }
        let mut cos = [0.0; 8];
        units(&[1e300, f64::NAN, f64::INFINITY, -1e8], &mut cos, &mut [0.0; 8]);
        let [huge, nan, infinite, far, ..] = cos;
        assert_eq!([huge, far], [1e300f64.cos(), 1e8f64.cos()]);
        assert!(nan.is_nan() && infinite.is_nan());
    }

    fn with_masses(mechanism: &Mechanism) -> Mechanism {
        let mut links = mechanism.links().to_vec();
        for (link, mass) in links.iter_mut().zip([0.0, 1.2, 0.7, 2.3, 0.9, 1.7]) {
            (link.mass, link.mass_centre, link.inertia) = (mass, Vec2::new(0.4, 0.1), 0.3 * mass);
        }
        Mechanism::new(links, mechanism.joints().to_vec()).unwrap()
    }

    /// The class IV group of `scenarios/fourth_class.toml`, with masses.
    fn quadrilateral() -> Case {
        let first = StartGroup { rank: Some(1), ..StartGroup::default() };
        turning_from(with_masses(&class_four(1.0, -1.0)), 70f64.to_radians(), &first)
    }

    #[test]
    fn results_do_not_depend_on_the_register_width() {
        for case in [turning(with_masses(&four_bar())), quadrilateral()] {
            let case = case.with(|parts| parts.gravity = Vec2::new(0.0, -9.81)).unwrap();
            let cranks: Vec<f64> = (0..500).map(|k| case.crank().start - 0.0123 * f64::from(k)).collect();
            let solve = |arch: Arch| {
                let (mut batch, mut poses) = (Batch { arch, ..Batch::of(&case).unwrap() }, Poses::new());
                batch.solve(&cranks, -97.2, 3.0, Stage::BalancingMoment, &mut poses).unwrap();
                assert_eq!(batch.solved_singly(), 0);
                // Some widths leave the unused rows of the last tile as they are.
                let used = |tile: usize| TILE.min(cranks.len() - tile * TILE);
                let bits = |(tile, columns): (usize, &mut [f64])| -> Vec<u64> {
                    columns.chunks(TILE).flat_map(|column| &column[..used(tile)]).map(|own| own.to_bits()).collect()
                };
                poses.tiles().enumerate().flat_map(bits).collect::<Vec<_>>()
            };
            let found: Vec<_> = widths().into_iter().map(solve).collect();
            assert!(found.iter().all(|bits| *bits == found[0]));
        }
    }

    #[test]
    fn statistics_do_not_depend_on_the_register_width() {
        let case = turning(with_masses(&four_bar()));
        let grid = Grid::of_inputs(case.crank(), (0..301).map(|k| 0.02 * f64::from(k)).collect());
        let case = case.with(|parts| parts.grid = grid).unwrap();
        let solve = |arch: Arch| {
            let mut batch = CaseBatch::of(&case).unwrap();
            batch.arch = arch;
            let weights = Weighted::of(&[1.0 / 301.0; 301]);
            let mut tallies = [
                PoseTally::of(PoseQuantity::Force(JointId(2)), 1.0, Tally::Column(Vec::new())),
                PoseTally::of(PoseQuantity::Torque(0), 1e-3, Tally::Range([LanePeak::NONE; 2])),
                PoseTally::of(PoseQuantity::Angle(LinkId(3)), 1.0, Tally::Rms(weights.clone())),
                PoseTally::of(PoseQuantity::Alpha(LinkId(2)), 1.0, Tally::At(170, f64::NAN)),
                PoseTally::of(PoseQuantity::ForceSquare(JointId(1)), 1.0, Tally::Max(LanePeak::NONE)),
                PoseTally::of(PoseQuantity::Omega(LinkId(2)), 1.0, Tally::Mean(weights)),
            ];
            tallies[4].want_rows();
            assert!(batch.solve(Stage::BalancingMoment, &mut tallies));
            // Values of all columns in full, and rows of the extreme.
            let rows = tallies[4].tally.rows();
            let columns = tallies[0].tally.clone();
            (tallies.map(|own| own.tally.value().to_bits()), rows, columns)
        };
        let found: Vec<_> = widths().into_iter().map(solve).collect();
        assert!(found.iter().all(|own| *own == found[0]));
    }
}
