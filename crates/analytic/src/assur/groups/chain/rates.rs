//! Velocities and accelerations of a higher group, with the factored Jacobian of its last pose.

use super::{Chain, Contours, Hangs, Node, World};
use linkage::math::{Motion, Vec2, turned};
use linkage::mechanism::GROUND;

impl Chain {
    /// Computes the velocities of the group's links. The velocities of the links that carry the group must be known.
    pub(in crate::assur::groups) fn velocities(&mut self, rates: &[f64], motions: &mut [Motion]) {
        match self.is_sliding {
            true => self.velocities_as::<true>(rates, motions),
            false => self.velocities_as::<false>(rates, motions),
        }
    }

    /// Writes the right-hand sides of the given coordinates and transmissions. The `order` is 1 for rates and 2 for
    /// accelerations.
    /// `of` contains the rates or accelerations of the drives; `led` returns the rate or acceleration of a known angle.
    #[inline(never)]
    fn put_given(&mut self, order: usize, of: &[f64], led: impl Fn(&Motion) -> f64, motions: &[Motion]) {
        let first = 2 * self.contours.closings.len();
        for (row, given) in self.given.iter().enumerate() {
            let parent = &motions[self.contours.nodes[given.node].parent.link];
            let known = if given.is_slide || given.parent_spin.is_some() { 0.0 } else { led(parent) };
            self.unknown[first + row] = given.factor * of[given.drive] + known;
        }
        let first = first + self.given.len();
        for (row, train) in self.trains.iter().enumerate() {
            self.unknown[first + row] = train.known(order, &led, motions);
        }
    }

    fn velocities_as<const SLIDING: bool>(&mut self, of_drives: &[f64], motions: &mut [Motion]) {
        if SLIDING {
            for node in self.led() {
                motions[node.link].omega = motions[node.parent.link].omega;
            }
        }
        let Contours { closings, roots, .. } = &self.contours;
        let World { arrows: vectors, roots: ends, .. } = &mut self.world;
        for (end, side) in ends.iter_mut().zip(roots).filter(|(_, side)| side.link != GROUND) {
            end.velocity = motions[side.link].velocity_beyond(end.arm);
        }
        for (closing, rates) in closings.iter().zip(self.unknown.chunks_exact_mut(2)) {
            let mut rate = Vec2::zeros();
            for (end, sign) in closing.ends {
                rate -= ends[end].velocity * sign;
            }
            if SLIDING {
                for led in closing.ways.iter().filter(|stretch| stretch.spin.is_none()) {
                    rate -= turned(vectors[led.arrow] * led.sign) * motions[led.carrier].omega;
                }
            }
            (rates[0], rates[1]) = (rate.x, rate.y);
        }
        if self.has_given() {
            self.put_given(1, of_drives, |parent| parent.omega, motions);
        }
        let Contours { nodes, arrows, .. } = &self.contours;
        let World { arrows: vectors, roots: ends, joints, .. } = &mut self.world;
        self.jacobian.solve(&mut self.unknown);
        for (index, node) in nodes.iter().enumerate() {
            let mut velocity = match node.hangs {
                Hangs::Root(root) => ends[root].velocity,
                Hangs::Arrow(arrow) => {
                    let from = &arrows[arrow];
                    joints[from.node].velocity + turned(vectors[arrow]) * motions[from.carrier].omega
                }
            };
            let axis = if SLIDING { node.axis(motions) } else { None };
            let omega = match axis {
                None => self.unknown[index],
                Some(axis) => {
                    let led = motions[node.parent.link].omega;
                    self.speeds[index] = self.unknown[index] * self.size;
                    velocity += turned(axis * self.slides[index]) * led + axis * self.speeds[index];
                    led
                }
            };
            joints[index].velocity = velocity;
            let motion = &mut motions[node.link];
            motion.omega = omega;
            motion.velocity = if node.at_origin { velocity } else { velocity - turned(joints[index].arm) * omega };
        }
    }

    /// Computes the accelerations of the group's links.
    /// The velocities of the group's links and the accelerations of the links that carry the group must be known.
    pub(in crate::assur::groups) fn accelerations(&mut self, second: &[f64], motions: &mut [Motion]) {
        match self.is_sliding {
            true => self.accelerations_as::<true>(second, motions),
            false => self.accelerations_as::<false>(second, motions),
        }
    }

    fn accelerations_as<const SLIDING: bool>(&mut self, of_drives: &[f64], motions: &mut [Motion]) {
        if SLIDING {
            for node in self.led() {
                motions[node.link].alpha = motions[node.parent.link].alpha;
            }
        }
        let Contours { nodes, closings, arrows, roots } = &self.contours;
        let World { arrows: vectors, centripetal, roots: ends, .. } = &mut self.world;
        for (centripetal, (vector, arrow)) in centripetal.iter_mut().zip(vectors.iter().zip(arrows)) {
            let omega = motions[arrow.carrier].omega;
            *centripetal = *vector * (omega * omega);
        }
        let speeds = &self.speeds;
        let of_slide = |node: usize, motions: &[Motion]| coriolis(&nodes[node], speeds[node], motions);
        for (end, side) in ends.iter_mut().zip(roots).filter(|(_, side)| side.link != GROUND) {
            end.acceleration = motions[side.link].acceleration_beyond(end.arm);
        }
        for (closing, rates) in closings.iter().zip(self.unknown.chunks_exact_mut(2)) {
            let mut second = Vec2::zeros();
            for (end, sign) in closing.ends {
                second -= ends[end].acceleration * sign;
            }
            for stretch in &closing.ways {
                second += centripetal[stretch.arrow] * stretch.sign;
                if SLIDING && stretch.spin.is_none() {
                    second -= turned(vectors[stretch.arrow] * stretch.sign) * motions[stretch.carrier].alpha;
                }
                if SLIDING && let Some(node) = stretch.slide {
                    second -= of_slide(node, motions) * stretch.sign;
                }
            }
            (rates[0], rates[1]) = (second.x, second.y);
        }
        if self.has_given() {
            self.put_given(2, of_drives, |parent| parent.alpha, motions);
        }
        self.jacobian.solve(&mut self.unknown);
        let Contours { nodes, arrows, .. } = &self.contours;
        let World { arrows: vectors, centripetal, roots: ends, joints } = &mut self.world;
        let speeds = &self.speeds;
        let coriolis = |node: usize, motions: &[Motion]| coriolis(&nodes[node], speeds[node], motions);
        for (index, node) in nodes.iter().enumerate() {
            let mut acceleration = match node.hangs {
                Hangs::Root(root) => ends[root].acceleration,
                Hangs::Arrow(arrow) => {
                    let from = &arrows[arrow];
                    joints[from.node].acceleration + turned(vectors[arrow]) * motions[from.carrier].alpha
                        - centripetal[arrow]
                }
            };
            let axis = if SLIDING { node.axis(motions) } else { None };
            let alpha = match axis {
                None => self.unknown[index],
                Some(axis) => {
                    let (parent, slide) = (&motions[node.parent.link], axis * self.slides[index]);
                    acceleration += turned(slide) * parent.alpha - slide * (parent.omega * parent.omega);
                    acceleration += axis * (self.unknown[index] * self.size) + coriolis(index, motions);
                    parent.alpha
                }
            };
            joints[index].acceleration = acceleration;
            let motion = &mut motions[node.link];
            motion.alpha = alpha;
            motion.acceleration = acceleration;
            if !node.at_origin {
                let arm = joints[index].arm;
                motion.acceleration = acceleration - turned(arm) * alpha + arm * (motion.omega * motion.omega);
            }
        }
    }

    /// The nodes that turn with links outside the group, parents first.
    /// The angles of these nodes are not unknowns of the group: their rotation is known before the group is solved.
    fn led(&self) -> impl Iterator<Item = &Node> {
        let nodes: &[Node] = if self.is_sliding { &self.contours.nodes } else { &[] };
        nodes.iter().filter(|node| node.spin.is_none())
    }
}

/// Coriolis acceleration of a sliding node along the normal of its axis; `speed` is the rate of the slide (m/s).
#[inline]
fn coriolis(node: &Node, speed: f64, motions: &[Motion]) -> Vec2 {
    turned(node.slide_axis(motions)) * (2.0 * speed * motions[node.parent.link].omega)
}
