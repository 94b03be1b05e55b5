//! The equations of a transmission: the feet on both members have the same speed along the first line of action.
//!
//! C' = w . (v2 - v1) with the line's direction w and the feet, all fixed in the carrier.
//! The residual is the sum of the factors times coordinates, minus its value in the start pose, plus the gaps of axles
//! and guide along the line. The gaps are zero at the pose; with them, the row C' is the derivative of the residual.
//! With the angular velocities omega_i of the members and omega_0 of the carrier, and its velocities v0 of the feet,
//!
//!     C'' = w . (a2 - a1) + w . (omega2 z x (v0(2) - v2) - omega1 z x (v0(1) - v1)) + omega0 (z x w) . (v2 - v1).
//!
//! The multiplier of the row is the force in the first line of action.
//! If it is negative, the second line carries the force, and the reactions change accordingly.

use super::system::System;
use linkage::math::{Vec2, cross, turned};
use linkage::mechanism::transmission::Member;
use linkage::mechanism::{Coordinate, GROUND, JointSide, LinkId, Transmission, TransmissionId};

impl System<'_> {
    /// The sum of the factors of a transmission times its coordinates.
    pub(super) fn coupled(&self, transmission: &Transmission) -> f64 {
        let of = |(of, factor): &(Coordinate, f64)| {
            let value = match *of {
                Coordinate::Angle(link) => self.angle(link),
                Coordinate::Slide(joint) => self.slide(&self.case.mechanism.joints()[joint]),
            };
            factor * value
        };
        transmission.terms.iter().map(of).sum()
    }

    /// Vector from the mass centre of `link` to a point of the carrier.
    fn foot(&self, carrier: LinkId, foot: Vec2, link: LinkId) -> Vec2 {
        self.centre(carrier) + self.arm(carrier, foot) - self.centre(link)
    }

    /// Residual and row of a transmission.
    pub(super) fn assemble_transmission(&mut self, index: TransmissionId, transmission: &Transmission) {
        let (row, carrier) = (self.case.mechanism.row_of_transmission(index), transmission.design.carrier);
        let line = &transmission.lines[0];
        let direction = self.along(carrier, line.direction);
        for ((link, foot), sign) in transmission.design.links.into_iter().zip(line.feet).zip([-1.0, 1.0]) {
            if link != GROUND {
                let (column, arm) = (3 * (link.index() - 1), self.foot(carrier, foot, link));
                self.jacobian.add(row, column, sign * direction.x);
                self.jacobian.add(row, column + 1, sign * direction.y);
                self.jacobian.add(row, column + 2, sign * cross(arm, direction));
            }
        }
        self.residual[row] = self.coupled(transmission) - self.phases[index] + self.gap(transmission, direction);
    }

    /// Gap of the second axle or guide minus that of the first axle, along the world direction of the line (m).
    fn gap(&self, transmission: &Transmission, direction: Vec2) -> f64 {
        let (carrier, line) = (transmission.design.carrier, &transmission.lines[0]);
        let at = |link: LinkId, local: Vec2| self.centre(link) + self.arm(link, local);
        let axle = |member: &Member| at(member.link, member.local) - at(carrier, member.place);
        let [first, second] = &transmission.members;
        let of_second = match transmission.terms.iter().find_map(|(of, _)| of.joint()) {
            None => direction.dot(&axle(second)),
            Some(joint) => {
                let joint = &self.case.mechanism.joints()[joint];
                let place = at(second.link, second.local);
                let guide = place - at(carrier, joint.on(carrier).expect("the guide is on the carrier"));
                let normal = turned(self.along(carrier, joint.axis_on(carrier).expect("the rack slides")));
                let start = &self.case.start.0;
                let turn = self.angle(second.link) - self.angle(carrier);
                let turn = turn - (start[second.link].angle - start[carrier].angle);
                direction.dot(&normal) * normal.dot(&guide) + turn * cross(at(carrier, line.feet[1]) - place, direction)
            }
        };
        of_second - direction.dot(&axle(first))
    }

    /// Right-hand side of a transmission's row for the accelerations.
    pub(super) fn transmission_gamma(&self, transmission: &Transmission) -> f64 {
        let (carrier, line) = (transmission.design.carrier, &transmission.lines[0]);
        let direction = self.along(carrier, line.direction);
        let mut gamma = 0.0;
        for ((link, foot), sign) in transmission.design.links.into_iter().zip(line.feet).zip([-1.0, 1.0]) {
            let arm = self.foot(carrier, foot, link);
            let (omega, of_carrier) = (self.omega(link), self.velocity(JointSide { link: carrier, local: foot }));
            let velocity = self.velocity_at(link, arm);
            let carried = turned(of_carrier - velocity) * omega - arm * (omega * omega);
            gamma -= sign * (direction.dot(&carried) + self.omega(carrier) * turned(direction).dot(&velocity));
        }
        gamma
    }

    /// Moves the forces of transmissions from their first lines of action to the lines that carry them, and adds the
    /// tension of slack strands.
    pub(super) fn change_lines(&mut self) {
        self.beside.fill(0.0);
        let case = self.case;
        for (index, transmission) in case.mechanism.transmissions().entries() {
            let carrier = transmission.design.carrier;
            let force = self.lambda[case.mechanism.row_of_transmission(index)];
            let [first, second] = transmission.forces(force);
            for (line, change) in transmission.lines.iter().zip([first - force, second]) {
                let along = self.along(carrier, line.direction) * change;
                for ((link, foot), sign) in transmission.design.links.into_iter().zip(line.feet).zip([-1.0, 1.0]) {
                    if link != GROUND {
                        let (column, arm) = (3 * (link.index() - 1), self.foot(carrier, foot, link));
                        self.beside[column] -= sign * along.x;
                        self.beside[column + 1] -= sign * along.y;
                        self.beside[column + 2] -= sign * cross(arm, along);
                    }
                }
            }
        }
        self.jacobian.solve_transposed(&mut self.beside);
        let rows = case.mechanism.equations();
        self.lambda[..rows].iter_mut().zip(&self.beside).for_each(|(lambda, beside)| *lambda += beside);
    }
}
