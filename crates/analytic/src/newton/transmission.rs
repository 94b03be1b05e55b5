//! The equations of a transmission. Each member has a foot, a point on the first line of action; both feet have the
//! same speed along this line.
//!
//! C' = w . (v2 - v1) with the line's direction w at the feet.
//! The residual is c (q2 - f(q1)), minus its value in the start pose, plus the gaps along the line.
//! A gap is the distance of an axle or a guide from its place on the carrier.
//! Here c is `Contact::factor`.
//! The gaps are zero in the solution. With these gaps, the row C' is the exact derivative of the residual.
//! For cams, the feet move relative to the carrier with the velocity q1' p, and the line turns relative to the carrier
//! with the rate k q1'.
//! With the angular velocities omega_i of the members and omega_0 of the carrier, and the velocity v of the point of
//! contact,
//! ```text
//! C'' = w . (a2 - a1) + w . (omega2 z x (v - v2) - omega1 z x (v - v1)) + (omega0 + k q1') (z x w) . (v2 - v1).
//! ```
//!
//! The multiplier of the row is the force in the first line of action.
//! If the multiplier is negative, the second line of action carries the force, and the reactions change accordingly.

use super::system::System;
use linkage::math::{Vec2, cross, turned};
use linkage::mechanism::transmission::Member;
use linkage::mechanism::{Contact, Coordinate, GROUND, JointSide, LinkId, Transmission, TransmissionId};

impl System<'_> {
    /// The coordinates of the members of a transmission.
    pub(super) fn members(&self, transmission: &Transmission) -> [f64; 2] {
        let of = |(of, sign): &(Coordinate, f64)| {
            sign * match *of {
                Coordinate::Angle(link) => self.angle(link),
                Coordinate::Slide(joint) => self.slide(&self.case.mechanism.joints()[joint]),
            }
        };
        transmission.coordinates.each_ref().map(|terms| terms.iter().map(of).sum())
    }

    /// The difference q2 - f(q1) of a transmission.
    pub(super) fn coupled(&self, transmission: &Transmission) -> f64 {
        let [q1, q2] = self.members(transmission);
        q2 - transmission.law(q1)[0]
    }

    fn contact(&self, transmission: &Transmission) -> Contact {
        transmission.contact(self.members(transmission))
    }

    /// Vector from the mass centre of `link` to a point of the carrier.
    fn foot(&self, carrier: LinkId, foot: Vec2, link: LinkId) -> Vec2 {
        self.centre(carrier) + self.arm(carrier, foot) - self.centre(link)
    }

    /// Residual and row of a transmission.
    pub(super) fn assemble_transmission(&mut self, index: TransmissionId, transmission: &Transmission) {
        let (row, carrier) = (self.case.mechanism.row_of_transmission(index), transmission.design.carrier);
        let contact = self.contact(transmission);
        let line = &contact.lines[0];
        let direction = self.along(carrier, line.direction);
        for ((link, foot), sign) in transmission.design.links.into_iter().zip(line.feet).zip([-1.0, 1.0]) {
            if link != GROUND {
                let (column, arm) = (3 * (link.index() - 1), self.foot(carrier, foot, link));
                self.jacobian.add(row, column, sign * direction.x);
                self.jacobian.add(row, column + 1, sign * direction.y);
                self.jacobian.add(row, column + 2, sign * cross(arm, direction));
            }
        }
        let off = self.coupled(transmission) - self.phases[index];
        self.residual[row] = contact.factor * off + self.gap(transmission, line.feet[1], direction);
    }

    /// Gap of the second axle or guide minus the gap of the first axle, along the world direction of the line (m).
    fn gap(&self, transmission: &Transmission, foot: Vec2, direction: Vec2) -> f64 {
        let carrier = transmission.design.carrier;
        let at = |link: LinkId, local: Vec2| self.centre(link) + self.arm(link, local);
        let axle = |member: &Member| at(member.link, member.local) - at(carrier, member.place);
        let [first, second] = &transmission.members;
        let of_second = match transmission.slide() {
            None => direction.dot(&axle(second)),
            Some(joint) => {
                let joint = &self.case.mechanism.joints()[joint];
                let place = at(second.link, second.local);
                let guide = place - at(carrier, joint.on(carrier).expect("the guide is on the carrier"));
                let normal = turned(self.along(carrier, joint.axis_on(carrier).expect("it slides")));
                let start = &self.case.start.0;
                let turn = self.angle(second.link) - self.angle(carrier);
                let turn = turn - (start[second.link].angle - start[carrier].angle);
                direction.dot(&normal) * normal.dot(&guide) + turn * cross(at(carrier, foot) - place, direction)
            }
        };
        of_second - direction.dot(&axle(first))
    }

    /// Right-hand side of a transmission's acceleration equation.
    pub(super) fn transmission_gamma(&self, transmission: &Transmission) -> f64 {
        let (carrier, contact) = (transmission.design.carrier, self.contact(transmission));
        let line = &contact.lines[0];
        let direction = self.along(carrier, line.direction);
        let spin = self.omega(transmission.design.links[0]) - self.omega(carrier);
        let drift = self.along(carrier, contact.drift) * spin;
        let turn = self.omega(carrier) + contact.turn * spin;
        let mut gamma = 0.0;
        for ((link, foot), sign) in transmission.design.links.into_iter().zip(line.feet).zip([-1.0, 1.0]) {
            let arm = self.foot(carrier, foot, link);
            let omega = self.omega(link);
            let own = self.velocity(JointSide { link: carrier, local: foot }) + drift;
            let velocity = self.velocity_at(link, arm);
            let carried = turned(own - velocity) * omega - arm * (omega * omega);
            gamma -= sign * (direction.dot(&carried) + turn * turned(direction).dot(&velocity));
        }
        gamma
    }

    /// Corrects the multipliers, which were computed as if the first line of action carried each transmission's force.
    /// The force acts in the line that really carries it, and the tension of a belt's slack strand acts in both lines.
    pub(super) fn change_lines(&mut self) {
        self.find_lines();
        let rows = self.case.mechanism.equations();
        self.lambda[..rows].iter_mut().zip(&self.beside).for_each(|(lambda, beside)| *lambda += beside);
    }

    /// Finds the changes of the multipliers that [`System::change_lines`] adds.
    pub(super) fn find_lines(&mut self) {
        let case = self.case;
        if case.mechanism.transmissions().is_empty() {
            return;
        }
        self.beside.fill(0.0);
        for (index, transmission) in case.mechanism.transmissions().entries() {
            let carrier = transmission.design.carrier;
            let force = self.lambda[case.mechanism.row_of_transmission(index)];
            let [first, second] = transmission.forces(force);
            let contact = self.contact(transmission);
            for (line, change) in contact.lines.iter().zip([first - force, second]) {
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
    }
}
