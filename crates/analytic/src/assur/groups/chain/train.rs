//! The equation of a transmission in a group: q2 - f(q1) keeps the value that it has in the start pose.
//! The coordinates q1 and q2 are sums of link angles and slides, inside or outside the group. Angles count whole turns.

use std::f64::consts::TAU;

use super::Node;
use linkage::math::Motion;
use linkage::math::dense::Lu;
use linkage::mechanism::{Coordinate, Joint, LinkId, Mechanism, Transmission, TransmissionId};

/// A coordinate of a transmission.
#[derive(Clone, Debug)]
enum Of {
    Angle(LinkId),
    /// The slide of a node, and the sign with which it gives the slide of the joint.
    Node(usize, f64),
    /// The slide of a joint outside the group.
    Slide(Box<Joint>),
}

#[derive(Clone, Debug)]
struct Term {
    of: Of,
    sign: f64,
    /// The unknown on which the coordinate depends, and the derivative of the term with respect to this unknown; `None`
    /// for a known coordinate.
    column: Option<(usize, f64)>,
    /// The coordinate at the last pose and at the present pose.
    last: f64,
    now: f64,
}

impl Term {
    fn of(mechanism: &Mechanism, &(of, sign): &(Coordinate, f64), nodes: &[Node], size: f64) -> Self {
        let (of, column) = match of {
            Coordinate::Angle(link) => {
                let spin = nodes.iter().find(|node| node.link == link).and_then(|node| node.spin);
                (Of::Angle(link), spin.map(|spin| (spin, sign)))
            }
            Coordinate::Slide(joint) => {
                let found = &mechanism.joints()[joint];
                match nodes.iter().position(|node| node.joint == joint) {
                    Some(node) => {
                        let way = if found.second.link == nodes[node].link { 1.0 } else { -1.0 };
                        (Of::Node(node, way), Some((node, sign * way * size)))
                    }
                    None => (Of::Slide(Box::new(found.clone())), None),
                }
            }
        };
        Term { of, sign, column, last: 0.0, now: 0.0 }
    }

    /// Reads the coordinate at the present pose, with the whole turns that bring its angle nearest to the angle at the
    /// last pose. Returns the coordinate times the sign of the term.
    fn read(&mut self, slides: &[f64], motions: &[Motion]) -> f64 {
        self.now = match &self.of {
            Of::Angle(link) => {
                let direction = motions[*link].direction;
                let angle = direction.y.atan2(direction.x);
                angle + TAU * ((self.last - angle) / TAU).round()
            }
            Of::Node(node, way) => way * slides[*node],
            Of::Slide(joint) => joint.slide(motions).expect("the joint slides")[0],
        };
        self.sign * self.now
    }

    /// Derivative (`order` 1 or 2) of the term, 0 if it depends on an unknown; `of_link` returns the derivative of a
    /// link's angle.
    fn known(&self, order: usize, of_link: impl Fn(&Motion) -> f64, motions: &[Motion]) -> f64 {
        match &self.of {
            _ if self.column.is_some() => 0.0,
            Of::Angle(link) => self.sign * of_link(&motions[*link]),
            Of::Slide(joint) => self.sign * joint.slide(motions).expect("the joint slides")[order],
            Of::Node(..) => 0.0,
        }
    }
}

/// A transmission of a group.
#[derive(Clone, Debug)]
pub(in crate::assur) struct Train {
    pub(in crate::assur) id: TransmissionId,
    transmission: Transmission,
    /// The terms of q1 and q2.
    terms: [Vec<Term>; 2],
    /// Unit of q2 in the equation's row of the Jacobian: 1, or the unit of slides (m).
    unit: f64,
    /// The value of q2 - f(q1); NaN before the first pose.
    value: f64,
    /// First two derivatives of f at the present pose.
    rates: [f64; 2],
}

impl Train {
    /// The equation of a transmission in the group of these nodes; `size` is the unit of slides (m).
    pub(super) fn of(mechanism: &Mechanism, id: TransmissionId, nodes: &[Node], size: f64) -> Self {
        let transmission = mechanism.transmissions()[id].clone();
        let term = |own| Term::of(mechanism, own, nodes, size);
        let terms = transmission.coordinates.each_ref().map(|own| own.iter().map(term).collect());
        let unit = if transmission.slide().is_some() { size } else { 1.0 };
        Train { id, terms, unit, transmission, value: f64::NAN, rates: [0.0; 2] }
    }

    /// Force in the first line of action (N) for the row's multiplier (N m) at the last pose.
    pub(in crate::assur) fn force(&self, multiplier: f64) -> f64 {
        let at = self.terms.each_ref().map(|terms| terms.iter().map(|term| term.sign * term.now).sum());
        multiplier / (self.transmission.contact(at).factor * self.unit)
    }

    /// At the first call, stores the value of q2 - f(q1) in the start pose.
    pub(super) fn start(&mut self, slides: &[f64], motions: &[Motion]) {
        if self.value.is_nan() {
            self.value = self.read(slides, motions);
            self.keep();
        }
    }

    /// q2 - f(q1) at the present pose.
    fn read(&mut self, slides: &[f64], motions: &[Motion]) -> f64 {
        let [q1, q2] =
            self.terms.each_mut().map(|terms| terms.iter_mut().map(|term| term.read(slides, motions)).sum::<f64>());
        let [value, first, second] = self.transmission.law(q1);
        self.rates = [first, second];
        q2 - value
    }

    /// Stores the coordinates of the present pose as the coordinates of the last pose.
    pub(super) fn keep(&mut self) {
        self.terms.iter_mut().flatten().for_each(|term| term.last = term.now);
    }

    /// Writes the row of the equation to the Jacobian and returns its residual.
    pub(super) fn assemble(&mut self, row: usize, slides: &[f64], motions: &[Motion], jacobian: &mut Lu) -> f64 {
        let residual = (self.read(slides, motions) - self.value) / self.unit;
        for (terms, factor) in self.terms.iter().zip([-self.rates[0], 1.0]) {
            for (column, derivative) in terms.iter().filter_map(|term| term.column) {
                jacobian.add(row, column, factor * derivative / self.unit);
            }
        }
        residual
    }

    /// Right-hand side of the equation, differentiated once (`order` 1) or twice (`order` 2) with respect to time.
    /// `of_link` returns the time derivative of this order of a link's angle.
    /// For order 2, the velocities must be known.
    pub(super) fn known(&self, order: usize, of_link: impl Fn(&Motion) -> f64, motions: &[Motion]) -> f64 {
        let [first, second] = self
            .terms
            .each_ref()
            .map(|terms| terms.iter().map(|term| term.known(order, &of_link, motions)).sum::<f64>());
        let spin = |term: &Term| match term.of {
            Of::Angle(link) => term.sign * motions[link].omega,
            Of::Node(..) | Of::Slide(_) => unreachable!("the first member turns"),
        };
        let bend = match order {
            2 if self.rates[1] != 0.0 => self.rates[1] * self.terms[0].iter().map(spin).sum::<f64>().powi(2),
            _ => 0.0,
        };
        (self.rates[0] * first + bend - second) / self.unit
    }
}
