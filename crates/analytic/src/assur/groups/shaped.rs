//! RRR dyad whose bodies change their shape: a cylinder and its rod count as one link with a changing length.
//! See docs/numerics/given.md.
//!
//! The root of a body is the link with its outer joint.
//! Given joints, whose coordinates are functions of time, connect the other links of the body with the root.
//! The vector p(t) goes from the outer to the inner joint, in the frame of the root; its rates are p' and p''.
//! The dyad is solved with the present vectors p in closed form.
//! Let v be the velocity of the outer joint, and omega the angular velocity of the root.
//! In world axes, r = p and w = p'. The velocity of the inner joint is v + omega x r + w.
//! The acceleration of the inner joint has the additional terms p'' in world axes and 2 omega x w (relative motion,
//! Coriolis).
//! The roots therefore have the angular velocities of rigid links in a dyad whose outer joints have the velocities
//! v1 + w1 and v2 + w2.

use super::driver::Driver;
use super::misfit::{Misfit, SingularityDistance};
use super::rrr::Rrr;
use linkage::math::{Motion, Vec2, cross, rotated, turned};
use linkage::mechanism::{AssemblyMode, DrivingLink, Group, JointId, LinkId, Mechanism};

/// One body: its root, and the links that given joints connect with the root, parents before children.
#[derive(Clone, Debug)]
pub(in crate::assur) struct Shape {
    pub(in crate::assur) root: LinkId,
    pub(in crate::assur) hung: Vec<Driver>,
    outer: Vec2,
    /// The link of the body with the inner joint, and the position of the joint on this link.
    inner: (LinkId, Vec2),
    /// p and its rates in the frame of the root (m, m/s, m/s^2).
    span: [Vec2; 3],
    /// If all given joints are slides: p at zero slides, and for each drive the derivative of p, which is constant.
    linear: Option<(Vec2, Vec<(usize, Vec2)>)>,
}

impl Shape {
    fn of(
        mechanism: &Mechanism,
        group: &Group,
        [outer, inner]: [JointId; 2],
        lead: LinkId,
        all: &[DrivingLink],
    ) -> Self {
        let leads = group.leads(mechanism);
        let members = group.links.iter().zip(&leads).filter(|(_, own)| **own == lead).map(|(&link, _)| link);
        let members: Vec<LinkId> = members.collect();
        let on = |joint: JointId| {
            let joint = &mechanism.joints()[joint];
            let link =
                members.iter().copied().find(|&link| joint.on(link).is_some()).expect("the joint is on the body");
            (link, joint.on(link).expect("the joint is on the link"))
        };
        let (root, outer) = on(outer);
        let (mut placed, mut hung) = (vec![root], Vec::new());
        while placed.len() < members.len() {
            let mut given = all.iter().enumerate().filter(|(_, driver)| group.given.contains(&driver.joint));
            let found = given.find_map(|(index, driver)| {
                let joint = &mechanism.joints()[driver.joint];
                let [first, second] = [joint.first.link, joint.second.link];
                let far = if placed.contains(&first) { second } else { first };
                let reaches = placed.contains(&first) != placed.contains(&second);
                reaches.then_some((index, DrivingLink { link: far, ..*driver }))
            });
            let (index, driver) = found.expect("the links of a body are connected");
            placed.push(driver.link);
            hung.push(Driver::of(mechanism, index, &driver));
        }
        let mut shape = Shape { root, hung, outer, inner: on(inner), span: [Vec2::zeros(); 3], linear: None };
        if shape.hung.iter().all(Driver::slides) {
            let mut drives: Vec<usize> = shape.hung.iter().map(|own| own.index).collect();
            let mut frame = vec![Motion::REST; mechanism.links().len()];
            let mut at = |unit: Option<usize>| {
                let coordinates: Vec<f64> = (0..all.len()).map(|k| if unit == Some(k) { 1.0 } else { 0.0 }).collect();
                shape.form(&coordinates, &mut frame);
                shape.span[0]
            };
            let zero = at(None);
            drives.sort_unstable();
            let derivatives = drives.into_iter().map(|drive| (drive, at(Some(drive)) - zero)).collect();
            shape.linear = Some((zero, derivatives));
        }
        shape
    }

    /// Returns p and its rates from the coordinates, rates and accelerations of all drives.
    #[inline]
    fn all(&mut self, [coordinates, rates, seconds]: [&[f64]; 3], frame: &mut [Motion]) {
        let Some((zero, derivatives)) = &self.linear else {
            self.form(coordinates, frame);
            self.rates(rates, frame);
            self.seconds([rates, seconds], frame);
            return;
        };
        self.span = [*zero, Vec2::zeros(), Vec2::zeros()];
        for &(drive, by) in derivatives {
            self.span[0] += by * coordinates[drive];
            self.span[1] += by * rates[drive];
            self.span[2] += by * seconds[drive];
        }
    }

    /// Computes the positions of the body's links in the frame of the root.
    /// `frame` receives these positions.
    #[inline]
    fn form(&mut self, coordinates: &[f64], frame: &mut [Motion]) {
        frame[self.root] = Motion::REST;
        self.hung.iter().for_each(|own| own.put_position(coordinates[own.index], frame));
        self.span[0] = frame[self.inner.0].point(self.inner.1) - self.outer;
    }

    #[inline]
    fn rates(&mut self, rates: &[f64], frame: &mut [Motion]) {
        self.hung.iter().for_each(|own| own.put_velocity(rates[own.index], frame));
        self.span[1] = frame[self.inner.0].point_velocity(self.inner.1);
    }

    #[inline]
    fn seconds(&mut self, rates: [&[f64]; 2], frame: &mut [Motion]) {
        self.hung.iter().for_each(|own| own.put_acceleration(rates.map(|all| all[own.index]), frame));
        self.span[2] = frame[self.inner.0].point_acceleration(self.inner.1);
    }

    /// Rate of rotation of p in the frame of the root (rad/s).
    fn turn(&self) -> f64 {
        cross(self.span[0], self.span[1]) / self.span[0].norm_squared()
    }
}

/// RRR dyad of bodies of changing shape, prepared for solving.
#[derive(Clone, Debug)]
pub struct Shaped {
    dyad: Rrr,
    shapes: [Shape; 2],
    /// Motions of the bodies' links in the frames of their roots, one entry per link of the mechanism.
    frame: Vec<Motion>,
    /// Rates of all driven coordinates at the last pose.
    rates: Vec<f64>,
}

impl Shaped {
    pub(super) fn of(mechanism: &Mechanism, group: &Group, mode: AssemblyMode, drivers: &[DrivingLink]) -> Self {
        let leads = group.leads(mechanism);
        let free: Vec<JointId> = group.inner.iter().copied().filter(|joint| !group.given.contains(joint)).collect();
        let shapes = [0, 1].map(|k| {
            let outer = &mechanism.joints()[group.outer[k]];
            let at =
                group.links.iter().position(|&link| outer.on(link).is_some()).expect("an outer joint is on a link");
            Shape::of(mechanism, group, [group.outer[k], free[0]], leads[at], drivers)
        });
        let dyad = Rrr::between(mechanism, [0, 1].map(|k| (shapes[k].root, group.outer[k])), mode);
        Shaped { dyad, shapes, frame: vec![Motion::REST; mechanism.links().len()], rates: vec![0.0; drivers.len()] }
    }

    /// The dyad of the roots.
    #[inline]
    pub(in crate::assur) fn dyad(&self) -> &Rrr {
        &self.dyad
    }

    pub(in crate::assur) fn shapes(&self) -> &[Shape; 2] {
        &self.shapes
    }

    /// Positions, velocities and accelerations in one pass.
    #[inline]
    pub(super) fn motions(&mut self, of_drives: [&[f64]; 3], motions: &mut [Motion]) -> Result<(), Misfit> {
        for (k, shape) in self.shapes.iter_mut().enumerate() {
            shape.all(of_drives, &mut self.frame);
            self.dyad.reshape(k, shape.span[0]);
        }
        self.rates.copy_from_slice(of_drives[1]);
        self.dyad.measure();
        self.dyad.positions(motions)?;
        let relative = self.shapes.each_ref().map(|shape| rotated(motions[shape.root].direction, shape.span[1]));
        self.dyad.velocities_with(relative, motions);
        let extra = [0, 1].map(|k| {
            let (shape, root) = (&self.shapes[k], &motions[self.shapes[k].root]);
            rotated(root.direction, shape.span[2]) + turned(relative[k]) * (2.0 * root.omega)
        });
        self.dyad.accelerations_with(extra, motions);
        for own in self.shapes.iter().flat_map(|shape| &shape.hung) {
            own.place_at(of_drives.map(|all| all[own.index]), motions);
        }
        Ok(())
    }

    #[inline]
    pub(super) fn positions(&mut self, coordinates: &[f64], motions: &mut [Motion]) -> Result<(), Misfit> {
        for (k, shape) in self.shapes.iter_mut().enumerate() {
            shape.form(coordinates, &mut self.frame);
            self.dyad.reshape(k, shape.span[0]);
        }
        self.dyad.measure();
        self.dyad.positions(motions)?;
        for own in self.shapes.iter().flat_map(|shape| &shape.hung) {
            own.put_position(coordinates[own.index], motions);
        }
        Ok(())
    }

    #[inline]
    pub(super) fn velocities(&mut self, rates: &[f64], motions: &mut [Motion]) {
        self.rates.copy_from_slice(rates);
        let extra = self.shapes.each_mut().map(|shape| {
            shape.rates(rates, &mut self.frame);
            rotated(motions[shape.root].direction, shape.span[1])
        });
        self.dyad.velocities_with(extra, motions);
        for own in self.shapes.iter().flat_map(|shape| &shape.hung) {
            own.put_velocity(rates[own.index], motions);
        }
    }

    #[inline]
    pub(super) fn accelerations(&mut self, seconds: &[f64], motions: &mut [Motion]) {
        let extra = self.shapes.each_mut().map(|shape| {
            shape.seconds([&self.rates, seconds], &mut self.frame);
            let root = &motions[shape.root];
            let [relative, second] = [shape.span[1], shape.span[2]].map(|of| rotated(root.direction, of));
            second + turned(relative) * (2.0 * root.omega)
        });
        self.dyad.accelerations_with(extra, motions);
        for own in self.shapes.iter().flat_map(|shape| &shape.hung) {
            own.put_acceleration([self.rates[own.index], seconds[own.index]], motions);
        }
    }

    /// Returns the dyad, switched to its other configuration.
    pub(super) fn flipped(&self) -> Self {
        Shaped { dyad: self.dyad.flipped(), ..self.clone() }
    }

    /// The roots of the two bodies.
    pub(super) fn links(&self) -> [LinkId; 2] {
        self.dyad.links()
    }

    /// Sine of the transmission angle, without sign.
    pub(super) fn sine(&self) -> f64 {
        self.dyad.sine()
    }

    /// Distance of the dyad from a singular pose. Velocities must be known.
    pub(super) fn clearance(&self, motions: &[Motion]) -> SingularityDistance {
        let [one, other] = self.shapes.each_ref().map(Shape::turn);
        self.dyad.clearance_with(other - one, motions)
    }
}
