//! Constraint equations of a mechanism without its first drive. The number of equations is the number of coordinates
//! minus one, so that the solutions are curves.
//! The coordinate of a driven joint between moving links is an additional coordinate.
//! Every driven or geared slide is also an additional coordinate.
//!
//! The coordinates of every moving link are x and y of the middle of its joints, and its angle.
//! The coordinates x and y are divided by the size of the mechanism, so that they are comparable with angles.
//! One function per kind of joint writes the rows of the joint.

use linkage::input::Input;
use linkage::math::{ColumnVector, Matrix, Vec2, cross, rotated, unit};
use linkage::mechanism::{
    Coordinate, GROUND, Group, Joint, JointId, JointSide, LinkId, LinkPose, Mechanism, Pose, TransmissionId,
};

/// An equation between coordinates: a drive with a speed ratio to the first drive, or a transmission.
pub(super) struct Gearing {
    /// Indices of the coordinates and their factors.
    pub(super) terms: Vec<(usize, f64)>,
    /// Constant value of the equation. Each coordinate is multiplied by its factor; the law of the transmission is
    /// subtracted from the sum of these products.
    pub(super) sum: f64,
    /// The law of a transmission.
    pub(super) law: Option<FirstMember>,
}

/// The first member of a transmission, whose coordinate is the argument of the law.
pub(super) struct FirstMember {
    transmission: TransmissionId,
    /// Indices of the coordinates and their factors.
    first: Vec<(usize, f64)>,
    /// Unit of the second member's coordinate: 1, or the mechanism's size (m).
    unit: f64,
}

impl Gearing {
    /// Returns the value of the equation at `q`: the sum of all products of factor and coordinate, minus the law.
    /// Also returns the derivatives of the negated law: index and value for each coordinate of the first member.
    fn at(&self, mechanism: &Mechanism, q: &ColumnVector) -> (f64, Vec<(usize, f64)>) {
        let sum = |terms: &[(usize, f64)]| terms.iter().map(|&(index, factor)| factor * q[index]).sum::<f64>();
        let Some(FirstMember { transmission, first, unit }) = &self.law else { return (sum(&self.terms), Vec::new()) };
        let [value, rate, _] = mechanism.transmissions()[*transmission].law(sum(first));
        let terms = first.iter().map(|&(index, factor)| (index, -factor * rate / unit));
        (sum(&self.terms) - value / unit, terms.collect())
    }
}

/// A joint whose coordinate is an additional coordinate of the equations. A joint of a crank is never a `Given`.
pub(super) struct Given(pub(super) JointId);

/// The equations of a mechanism.
pub(super) struct Constraints<'a> {
    mechanism: &'a Mechanism,
    /// World position of the coordinates' origin (m). The coordinates' origin lies near the mechanism, so that no
    /// digits are lost if the mechanism is far from the world's origin.
    origin: Vec2,
    /// Length by which all lengths are divided (m).
    size: f64,
    /// The transmissions, then the drives.
    gearings: Vec<Gearing>,
    given: Vec<Given>,
    /// For every link: middle of its joints, in the link's frame (m).
    middles: Vec<Vec2>,
}

/// Residuals and their derivatives with respect to the coordinates.
pub(super) struct Equations {
    pub(super) residual: ColumnVector,
    pub(super) jacobian: Matrix,
}

impl<'a> Constraints<'a> {
    /// The equations of `mechanism`, with coordinates relative to the position `origin` (m).
    pub(super) fn of(mechanism: &'a Mechanism, origin: Vec2, mut given: Vec<Given>) -> Self {
        let middle = |link: LinkId| {
            let locals: Vec<Vec2> = mechanism.joints().iter().filter_map(|joint| joint.on(link)).collect();
            locals.iter().sum::<Vec2>() / locals.len().max(1) as f64
        };
        let (size, of_links) = (mechanism.size(), 3 * (mechanism.links().len() - 1));
        let mut gearings = Vec::new();
        for (index, transmission) in mechanism.transmissions().entries() {
            let mut indexed = |&(of, sign): &(Coordinate, f64)| match of {
                Coordinate::Angle(link) => (Self::angle(link), sign),
                Coordinate::Slide(joint) => {
                    let known = given.iter().position(|given| given.0 == joint);
                    let number = known.unwrap_or_else(|| {
                        given.push(Given(joint));
                        given.len() - 1
                    });
                    (of_links + number, sign)
                }
            };
            let [first, second] =
                transmission.coordinates.each_ref().map(|terms| terms.iter().map(&mut indexed).collect());
            let unit = if transmission.slide().is_some() { size } else { 1.0 };
            gearings.push(Gearing {
                terms: second,
                sum: 0.0,
                law: Some(FirstMember { transmission: index, first, unit }),
            });
        }
        let middles = mechanism.links().ids().map(middle).collect();
        Constraints { mechanism, origin, size, gearings, given, middles }
    }

    /// Adds the equations of the further drives. The pose `start` fixes the phases of the transmissions.
    pub(super) fn geared(mut self, gearings: Vec<Gearing>, start: &Pose) -> Self {
        let q = self.coordinates_of(start);
        self.gearings.iter_mut().for_each(|gearing| gearing.sum = gearing.at(self.mechanism, &q).0);
        self.gearings.extend(gearings);
        self
    }

    /// Number of coordinates of the links: three per moving link.
    pub(super) fn of_links(&self) -> usize {
        3 * (self.mechanism.links().len() - 1)
    }

    /// Number of all coordinates: the coordinates of the links, and one coordinate for every given joint.
    pub(super) fn coordinates(&self) -> usize {
        self.of_links() + self.given.len()
    }

    /// Index of the coordinate of the given joint with this number.
    pub(super) fn of_given(&self, number: usize) -> usize {
        self.of_links() + number
    }

    /// Number of equations.
    pub(super) fn rows(&self) -> usize {
        self.mechanism.equations() + self.gearings.len() + self.given.len()
    }

    /// Index of the coordinate that is the angle of `link`.
    pub(super) fn angle(link: LinkId) -> usize {
        3 * (link.index() - 1) + 2
    }

    /// Coordinates of a pose.
    pub(super) fn coordinates_of(&self, pose: &Pose) -> ColumnVector {
        let mut q = ColumnVector::zeros(self.coordinates());
        for (link, place) in pose.0.entries().skip(1) {
            let middle = (place.point(self.middles[link]) - self.origin) / self.size;
            let angle = Self::angle(link);
            (q[angle - 2], q[angle - 1], q[angle]) = (middle.x, middle.y, place.angle);
        }
        for (number, given) in self.given.iter().enumerate() {
            let joint = &self.mechanism.joints()[given.0];
            let input = if joint.slides() { Input::Slide } else { Input::Turn };
            q[self.of_given(number)] = joint.coordinate(joint.second.link, input, pose) / input.span(self.size);
        }
        q
    }

    /// The pose for these coordinates.
    pub(super) fn pose(&self, q: &ColumnVector) -> Pose {
        let place = |link: LinkId| {
            let angle = Self::angle(link);
            let middle = Vec2::new(q[angle - 2], q[angle - 1]) * self.size + self.origin;
            LinkPose::through(self.middles[link], middle, q[angle])
        };
        Pose(std::iter::once(LinkPose::GROUND).chain(self.mechanism.links().ids().skip(1).map(place)).collect())
    }

    /// All equations at the coordinates `q`.
    pub(super) fn at(&self, q: &ColumnVector) -> Equations {
        let mut equations =
            Equations { residual: ColumnVector::zeros(self.rows()), jacobian: Matrix::zeros(self.rows(), q.len()) };
        for (index, joint) in self.mechanism.joints().entries() {
            let row = self.mechanism.rows(index).start;
            match joint.kind.line() {
                None => self.revolute(joint, q, row, &mut equations),
                Some(axis) => self.line(joint, axis, q, row, &mut equations),
            }
            if let Some(axes) = joint.kind.axes() {
                let [first, second] = [joint.first.link, joint.second.link];
                let [axis, other] = [(first, axes[0]), (second, axes[1])]
                    .map(|(link, axis)| if link == GROUND { axis } else { rotated(unit(q[Self::angle(link)]), axis) });
                equations.residual[row + 1] = cross(axis, other).atan2(axis.dot(&other));
                for (link, sign) in [(first, -1.0), (second, 1.0)].into_iter().filter(|(link, _)| *link != GROUND) {
                    equations.jacobian[(row + 1, Self::angle(link))] += sign;
                }
            }
        }
        for (index, gearing) in self.gearings.iter().enumerate() {
            let row = self.mechanism.equations() + index;
            let (sum, first) = gearing.at(self.mechanism, q);
            equations.residual[row] = sum - gearing.sum;
            let terms = gearing.terms.iter().chain(&first);
            terms.for_each(|&(column, factor)| equations.jacobian[(row, column)] += factor);
        }
        for number in 0..self.given.len() {
            self.coordinate(number, q, &mut equations);
        }
        equations
    }

    /// Row of the equation of a given joint.
    fn row_of_given(&self, number: usize) -> usize {
        self.mechanism.equations() + self.gearings.len() + number
    }

    /// The coordinate of a given joint: theta2 - theta1 - q = 0, or e . (p2 - p1) - q = 0 with the axis e.
    fn coordinate(&self, number: usize, q: &ColumnVector, equations: &mut Equations) {
        let (row, joint) = (self.row_of_given(number), &self.mechanism.joints()[self.given[number].0]);
        let [first, second] = [joint.first, joint.second];
        let moving = || [(first, -1.0), (second, 1.0)].into_iter().filter(|(side, _)| side.link != GROUND);
        equations.residual[row] = -q[self.of_given(number)];
        equations.jacobian[(row, self.of_given(number))] = -1.0;
        let Some(axis) = joint.axis_on(first.link) else {
            for (side, sign) in moving() {
                equations.residual[row] += sign * q[Self::angle(side.link)];
                equations.jacobian[(row, Self::angle(side.link))] += sign;
            }
            return;
        };
        let axis = if first.link == GROUND { axis } else { rotated(unit(q[Self::angle(first.link)]), axis) };
        let gap = self.point(second, q).0 - self.point(first, q).0;
        equations.residual[row] += axis.dot(&gap);
        for (side, sign) in moving() {
            let column = 3 * (side.link.index() - 1);
            let arm = self.point(side, q).1;
            equations.jacobian[(row, column)] += sign * axis.x;
            equations.jacobian[(row, column + 1)] += sign * axis.y;
            equations.jacobian[(row, column + 2)] += sign * cross(arm, axis);
        }
        if first.link != GROUND {
            // The axis turns with the first link.
            equations.jacobian[(row, Self::angle(first.link))] += cross(axis, gap);
        }
    }

    /// p_second - p_first = 0.
    fn revolute(&self, joint: &Joint, q: &ColumnVector, row: usize, equations: &mut Equations) {
        for (side, sign) in [(joint.first, -1.0), (joint.second, 1.0)] {
            let (place, arm) = self.point(side, q);
            equations.residual[row] += sign * place.x;
            equations.residual[row + 1] += sign * place.y;
            if side.link != GROUND {
                let column = 3 * (side.link.index() - 1);
                equations.jacobian[(row, column)] += sign;
                equations.jacobian[(row + 1, column + 1)] += sign;
                equations.jacobian[(row, column + 2)] -= sign * arm.y;
                equations.jacobian[(row + 1, column + 2)] += sign * arm.x;
            }
        }
    }

    /// n . (p_second - p_first) = 0 with the normal n of the axis on the first link.
    fn line(&self, joint: &Joint, axis: Vec2, q: &ColumnVector, row: usize, equations: &mut Equations) {
        let [first, second] = [joint.first, joint.second];
        let axis = if first.link == GROUND { axis } else { rotated(unit(q[Self::angle(first.link)]), axis) };
        let gap = self.point(second, q).0 - self.point(first, q).0;
        equations.residual[row] = cross(axis, gap);
        for (side, sign) in [(first, -1.0), (second, 1.0)] {
            if side.link != GROUND {
                let column = 3 * (side.link.index() - 1);
                let arm = self.point(side, q).1;
                equations.jacobian[(row, column)] -= sign * axis.y;
                equations.jacobian[(row, column + 1)] += sign * axis.x;
                equations.jacobian[(row, column + 2)] += sign * axis.dot(&arm);
            }
        }
        if first.link != GROUND {
            // This term of the derivative arises because the normal turns with the first link.
            equations.jacobian[(row, Self::angle(first.link))] -= axis.dot(&gap);
        }
    }

    /// Position of a joint on one of its links, and the vector from the middle of this link to the joint.
    /// The unit is the mechanism's size.
    fn point(&self, side: JointSide, q: &ColumnVector) -> (Vec2, Vec2) {
        if side.link == GROUND {
            return ((side.local - self.origin) / self.size, Vec2::zeros());
        }
        let at = 3 * (side.link.index() - 1);
        let arm = rotated(unit(q[at + 2]), side.local - self.middles[side.link]) / self.size;
        (Vec2::new(q[at], q[at + 1]) + arm, arm)
    }

    /// The part of a Jacobian for the joints, transmissions and links of a group. The part is square.
    /// The columns are in the order: all x and y, all angles, the slides of racks.
    pub(super) fn block(&self, jacobian: &Matrix, group: &Group) -> Matrix {
        let joints = || group.inner.iter().chain(&group.outer);
        let is_known = |number: usize| group.given.contains(&self.given[number].0);
        let trains = || group.trains.iter().map(|id| id.index());
        let slides = |number: usize| {
            let is_term =
                |gearing: usize| self.gearings[gearing].terms.iter().any(|(own, _)| *own == self.of_given(number));
            !is_known(number) && joints().any(|joint| *joint == self.given[number].0) && trains().any(is_term)
        };
        let racks: Vec<usize> = (0..self.given.len()).filter(|&number| slides(number)).collect();
        let given = (0..self.given.len()).filter(|&number| is_known(number)).chain(racks.iter().copied());
        let rows = joints().flat_map(|&joint| self.mechanism.rows(joint));
        let rows = rows.chain(given.map(|number| self.row_of_given(number)));
        let rows: Vec<usize> = rows.chain(trains().map(|gearing| self.mechanism.equations() + gearing)).collect();
        let places = group.links.iter().flat_map(|&link| [Self::angle(link) - 2, Self::angle(link) - 1]);
        let columns = places.chain(group.links.iter().map(|&link| Self::angle(link)));
        let columns: Vec<usize> = columns.chain(racks.iter().map(|&number| self.of_given(number))).collect();
        Matrix::from_fn(rows.len(), columns.len(), |r, c| jacobian[(rows[r], columns[c])])
    }
}
