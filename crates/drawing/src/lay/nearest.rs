//! Poses of links for which the gaps at the joints are smallest: least squares of all gaps, by the method of Levenberg
//! and Marquardt.

use linkage::math::{ColumnVector, KeepNan, Matrix, Vec2, cross, rotated, unit};
use linkage::mechanism::{Joint, JointSide, LinkId, LinkPose, Mechanism, Pose};

/// Weight of gaps between a missing link (a link without a known pose) and a placed link.
/// The weight is large, so that only gaps between missing links remain.
const HELD: f64 = 1000.0;
/// Number of start values that are tried. `STEPS` is the number of steps from each start value.
/// If more than `FEW` links are missing, fewer start values are tried, to limit the time.
/// If more than `MOST` links are missing, none of them is placed.
const STARTS: usize = 12;
const STEPS: usize = 60;
const FEW: usize = 12;
const MOST: usize = 30;
/// Step of the difference quotients: an angle (rad), or a length divided by the mechanism's size.
const TINY: f64 = 1e-7;

/// Poses of the links `missing`. All other links of the mechanism stay at `pose`.
pub fn nearest(mechanism: &Mechanism, pose: &Pose, missing: &[LinkId]) -> Vec<(LinkId, LinkPose)> {
    let problem = Problem { mechanism, pose, missing, size: mechanism.size() };
    if missing.len() > MOST {
        return Vec::new();
    }
    let starts = (STARTS * FEW / missing.len().max(FEW)).max(1);
    let best = (0..starts).map(|start| problem.solved(start)).min_by(|a, b| a.1.total_cmp(&b.1));
    let Some((found, _)) = best else { return Vec::new() };
    missing.iter().enumerate().map(|(k, &link)| (link, problem.pose_of(&found, k))).collect()
}

struct Problem<'a> {
    mechanism: &'a Mechanism,
    pose: &'a Pose,
    missing: &'a [LinkId],
    size: f64,
}

impl Problem<'_> {
    /// The pose of a missing link. The unknowns of a link are x and y, divided by the mechanism's size, and the angle.
    fn pose_of(&self, unknowns: &ColumnVector, k: usize) -> LinkPose {
        let origin = Vec2::new(unknowns[3 * k], unknowns[3 * k + 1]) * self.size;
        LinkPose { origin, angle: unknowns[3 * k + 2] }
    }

    fn place(&self, unknowns: &ColumnVector, link: LinkId) -> LinkPose {
        match self.missing.iter().position(|&own| own == link) {
            Some(k) => self.pose_of(unknowns, k),
            None => self.pose.0[link],
        }
    }

    /// Start values for the unknowns. Each missing link lies at a placed neighbour, and its angle depends on `number`.
    fn start(&self, number: usize) -> ColumnVector {
        let mut unknowns = ColumnVector::zeros(3 * self.missing.len());
        for (k, &link) in self.missing.iter().enumerate() {
            let angle = std::f64::consts::TAU * ((number * (k + 1)) as f64 / STARTS as f64 + 0.01);
            let known = |joint: &&Joint| joint.on(link).is_some() && !self.missing.contains(&joint.other(link).link);
            let at = self.mechanism.joints().iter().find(known).and_then(|joint| {
                let JointSide { link: base, local } = joint.other(link);
                Some(LinkPose::through(joint.on(link)?, self.pose.0[base].point(local), angle).origin)
            });
            // A link without joints lies beside the mechanism.
            let alone = || match self.mechanism.joints_on(link).is_empty() {
                true => Vec2::new(k as f64, -1.0) * self.size,
                false => Vec2::zeros(),
            };
            let at = at.unwrap_or_else(alone) / self.size;
            (unknowns[3 * k], unknowns[3 * k + 1], unknowns[3 * k + 2]) = (at.x, at.y, angle);
        }
        unknowns
    }

    /// Weighted gaps of all joints on missing links, divided by the mechanism's size.
    fn gaps(&self, unknowns: &ColumnVector) -> ColumnVector {
        let mut gaps = Vec::new();
        for joint in self.mechanism.joints() {
            let sides = [joint.first, joint.second];
            let loose = sides.iter().filter(|side| self.missing.contains(&side.link)).count();
            if loose == 0 {
                continue;
            }
            let weight = if loose == 1 { HELD } else { 1.0 };
            let poses = sides.map(|side| self.place(unknowns, side.link));
            let gap = (poses[1].point(joint.second.local) - poses[0].point(joint.first.local)) / self.size;
            let own = match joint.kind.axes() {
                None => [gap.x, gap.y],
                Some(axes) => {
                    let [a, b] = [0, 1].map(|k| rotated(unit(poses[k].angle), axes[k]));
                    [cross(a, gap), HELD * (cross(a, b).atan2(a.dot(&b)))]
                }
            };
            gaps.extend(own.map(|part| weight * part));
        }
        ColumnVector::from_vec(gaps)
    }

    /// The unknowns with the smallest sum of squared gaps that are found from this start, and the sum.
    fn solved(&self, start: usize) -> (ColumnVector, f64) {
        let mut at = self.start(start);
        let mut gaps = self.gaps(&at);
        let mut damping = 1e-3;
        for _ in 0..STEPS {
            let mut jacobian = Matrix::zeros(gaps.len(), at.len());
            for k in 0..at.len() {
                let mut beside = at.clone();
                beside[k] += TINY;
                jacobian.set_column(k, &((self.gaps(&beside) - &gaps) / TINY));
            }
            let (square, slope) = (jacobian.transpose() * &jacobian, jacobian.transpose() * &gaps);
            let damped =
                &square + Matrix::identity(at.len(), at.len()) * (damping * square.diagonal().max().larger(1e-9));
            let Some(step) = damped.lu().solve(&slope) else { break };
            let next = &at - &step;
            let found = self.gaps(&next);
            if found.norm_squared() < gaps.norm_squared() {
                (at, gaps, damping) = (next, found, damping * 0.3);
                if step.norm() < 1e-13 {
                    break;
                }
            } else {
                damping *= 4.0;
            }
        }
        let sum = gaps.norm_squared();
        (at, sum)
    }
}
