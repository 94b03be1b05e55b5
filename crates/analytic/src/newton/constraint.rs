//! The equations of every joint: residuals, rows of the Jacobian, and the right-hand side for accelerations.
//!
//! Revolute: C = p2 - p1.
//! For a point on a line, let e be the axis and n = z x e its normal, both on the first link, and d = p2 - p1.
//! Then C1 = n . d.
//! A prismatic joint has the additional equation C2 = theta2 - theta1 - twist.
//! As n' = -omega1 e, dC1/dtheta1 = -e . (d + r1) with r1 from the mass centre to p1.
//! C1'' = 0 gives n . d'' = 2 omega1 e . d' + alpha1 e . d. gamma consists of the first term on the right and the
//! centripetal terms of d''.
//! By the derivatives of C1, its multiplier is a force along n that acts at p2 on both links.
//! The multiplier of C2 is a moment.
//! The formulas of the derivatives are derived here. The constraints are equations 3.3.10 and 3.3.13 of E. J. Haug,
//! Computer Aided Kinematics and Dynamics of Mechanical Systems, vol. 1, Allyn and Bacon 1989.

use super::system::System;
use linkage::drive::Drive;
use linkage::input::Input;
use linkage::math::{Vec2, turned};
use linkage::mechanism::{GROUND, Joint, JointId, JointSide};

impl System<'_> {
    /// Residual and Jacobian of a drive's equation q - f(t) = 0 in `row`. The equation sets the coordinate of the drive
    /// to the input `at`, counted as in [`Drive::coordinate`].
    /// For a slide, q = e . (p2 - p1) with the axis e of the first link.
    /// The derivative with respect to the first link's angle is n . (p2 - p1) - e . (z x r1) = -e . (z x (p2 - c1)).
    /// Here c1 is the mass centre of the first link, and r1 the vector from c1 to p1.
    #[inline]
    pub(super) fn assemble_drive(&mut self, row: usize, drive: &Drive, at: f64) {
        match drive.input {
            Input::Angle => {
                let theta = 3 * (drive.link.index() - 1) + 2;
                self.residual[row] = self.q[theta] - at;
                self.jacobian.add(row, theta, 1.0);
            }
            Input::Turn => self.assemble_angle(row, &self.case.mechanism.joints()[drive.joint], at),
            Input::Slide => {
                let joint = &self.case.mechanism.joints()[drive.joint];
                let (axis, place) = self.slide_axis(joint);
                for (side, sign) in [(joint.first, -1.0), (joint.second, 1.0)] {
                    if side.link != GROUND {
                        let column = 3 * (side.link.index() - 1);
                        let arm = place - self.centre(side.link);
                        self.jacobian.add(row, column, axis.x * sign);
                        self.jacobian.add(row, column + 1, axis.y * sign);
                        self.jacobian.add(row, column + 2, axis.dot(&turned(arm)) * sign);
                    }
                }
                self.residual[row] = self.slide(joint) - at;
            }
        }
    }

    /// World axis of a prismatic joint and world position of its point on the second link.
    fn slide_axis(&self, joint: &Joint) -> (Vec2, Vec2) {
        let axis = self.along(joint.first.link, joint.axis_on(joint.first.link).expect("the joint slides"));
        (axis, self.centre(joint.second.link) + self.arm(joint.second.link, joint.second.local))
    }

    /// Slide of a prismatic joint (m).
    pub(super) fn slide(&self, joint: &Joint) -> f64 {
        let (axis, place) = self.slide_axis(joint);
        axis.dot(&(place - self.centre(joint.first.link) - self.arm(joint.first.link, joint.first.local)))
    }

    /// Right-hand side of a drive's acceleration equation. `of_input` is the acceleration of the input.
    /// For a slide s = e . d, with d = p2 - p1 and n = z x e:
    /// s'' = e . d'' + 2 omega1 n . d' + alpha1 n . d - omega1^2 s.
    /// The terms linear in the accelerations belong to the Jacobian. All other terms form the right-hand side.
    pub(super) fn drive_gamma(&self, drive: &Drive, of_input: f64) -> f64 {
        match drive.input {
            Input::Angle | Input::Turn => of_input,
            Input::Slide => {
                let joint = &self.case.mechanism.joints()[drive.joint];
                let (axis, place) = self.slide_axis(joint);
                let [first, second] = [joint.first, joint.second];
                let omega = self.omega(first.link);
                let from = self.centre(first.link) + self.arm(first.link, first.local);
                let speed = self.velocity(second) - self.velocity(first);
                let centripetal = |side: JointSide| self.arm(side.link, side.local) * self.omega(side.link).powi(2);
                of_input + axis.dot(&(centripetal(second) - centripetal(first)))
                    - 2.0 * omega * turned(axis).dot(&speed)
                    + omega * omega * axis.dot(&(place - from))
            }
        }
    }

    /// Residuals and Jacobian of the equations of the joint with this number.
    #[inline]
    pub(super) fn assemble_joint(&mut self, index: JointId, joint: &Joint) {
        let row = self.case.mechanism.rows(index).start;
        match joint.kind.line() {
            None => self.assemble_revolute(row, joint),
            Some(axis) => self.assemble_line(row, joint, axis),
        }
        if joint.keeps_angle() {
            self.assemble_angle(row + 1, joint, self.twists[index]);
        }
    }

    #[inline]
    fn assemble_revolute(&mut self, row: usize, joint: &Joint) {
        let mut gap = Vec2::zeros();
        for (side, sign) in [(joint.first, -1.0), (joint.second, 1.0)] {
            let arm = self.arm(side.link, side.local);
            gap += (self.centre(side.link) + arm) * sign;
            if side.link != GROUND {
                let column = 3 * (side.link.index() - 1);
                self.jacobian.add(row, column, sign);
                self.jacobian.add(row + 1, column + 1, sign);
                self.jacobian.add(row, column + 2, -arm.y * sign);
                self.jacobian.add(row + 1, column + 2, arm.x * sign);
            }
        }
        self.residual[row] = gap.x;
        self.residual[row + 1] = gap.y;
    }

    fn assemble_line(&mut self, row: usize, joint: &Joint, axis: Vec2) {
        let [first, second] = [joint.first.link, joint.second.link];
        let axis = self.along(first, axis);
        let normal = turned(axis);
        let place = self.centre(second) + self.arm(second, joint.second.local);
        let gap = place - (self.centre(first) + self.arm(first, joint.first.local));
        for (link, sign) in [(first, -1.0), (second, 1.0)] {
            if link != GROUND {
                let column = 3 * (link.index() - 1);
                self.jacobian.add(row, column, normal.x * sign);
                self.jacobian.add(row, column + 1, normal.y * sign);
                self.jacobian.add(row, column + 2, axis.dot(&(place - self.centre(link))) * sign);
            }
        }
        self.residual[row] = normal.dot(&gap);
    }

    fn assemble_angle(&mut self, row: usize, joint: &Joint, twist: f64) {
        let [first, second] = [joint.first.link, joint.second.link];
        for (link, sign) in [(first, -1.0), (second, 1.0)] {
            if link != GROUND {
                self.jacobian.add(row, 3 * (link.index() - 1) + 2, sign);
            }
        }
        self.residual[row] = self.angle(second) - self.angle(first) - twist;
    }

    /// Writes the right-hand side of the acceleration equations of the joint with this number.
    #[inline]
    pub(super) fn put_gamma(&mut self, index: JointId, joint: &Joint) {
        let centripetal = |side: JointSide| {
            let omega = self.omega(side.link);
            self.arm(side.link, side.local) * (omega * omega)
        };
        let gamma = centripetal(joint.second) - centripetal(joint.first);
        let row = self.case.mechanism.rows(index).start;
        match joint.kind.line() {
            None => (self.second[row], self.second[row + 1]) = (gamma.x, gamma.y),
            Some(axis) => {
                let axis = self.along(joint.first.link, axis);
                let speed = self.velocity(joint.second) - self.velocity(joint.first);
                self.second[row] = turned(axis).dot(&gamma) + 2.0 * self.omega(joint.first.link) * axis.dot(&speed);
            }
        }
        if joint.keeps_angle() {
            self.second[row + 1] = 0.0;
        }
    }

    /// Force (N) and moment (N m) of the first link on the second in the joint with this number, from its multipliers.
    #[inline]
    pub(super) fn reaction(&self, index: JointId, joint: &Joint) -> (Vec2, f64) {
        let own = &self.lambda[self.case.mechanism.rows(index)];
        match joint.kind.line() {
            None => (Vec2::new(own[0], own[1]), 0.0),
            Some(axis) => {
                (turned(self.along(joint.first.link, axis)) * own[0], if joint.keeps_angle() { own[1] } else { 0.0 })
            }
        }
    }
}
