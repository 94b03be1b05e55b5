//! Reads the results (velocities, accelerations, multipliers) of a system that has been followed to the requested
//! instant.

use super::Passing;
use super::spot::Spot;
use crate::newton::system::System;
use linkage::case::Case;
use linkage::drive::Wrench;
use linkage::error::Result;
use linkage::math::{Motion, rotated, turned, unit};
use linkage::trajectory::Stage;

/// Writes the loads that act on the links of a case, for given motions and angles (rad) of the links.
type Loads<'a> = &'a mut dyn FnMut(&Case, &[Motion], &[f64], &mut [Wrench]);

impl Passing {
    /// The path from the settled start pose of a system, if its mechanism passes change points.
    pub(in crate::newton) fn of(system: &mut System) -> Option<Self> {
        let case = system.case;
        case.passes().then(|| {
            let own = system.inputs[0];
            let passing = Passing::from(system);
            system.inputs[0] = own;
            passing
        })
    }

    /// Follows the path to a crank angle (rad, in the world). Sets the coordinates.
    pub(in crate::newton) fn go_to(&mut self, system: &mut System, angle: f64) -> Result<()> {
        self.travel(system, angle)?;
        if self.inside().is_some() {
            turn_crank(system, &mut self.spot);
        }
        Ok(())
    }

    /// Computes velocities and accelerations after [`Passing::go_to`], from the crank's angular velocity and
    /// acceleration.
    pub(in crate::newton) fn rates(&self, system: &mut System, omega: f64, alpha: f64) {
        for (i, (slope, curve)) in self.spot.slope.iter().zip(&self.spot.curve).enumerate() {
            (system.rate[i], system.second[i]) = (slope * omega, slope * alpha + curve * omega * omega);
        }
    }

    /// Computes the multipliers after [`Passing::go_to`] and [`Passing::rates`]; `loads` finds the loads on all links.
    /// In free motion, `shaft` contains the moment on the crank and the moment of inertia that turns with it.
    pub(in crate::newton) fn multipliers(
        &self,
        system: &mut System,
        shaft: Option<[f64; 2]>,
        loads: Loads,
    ) -> Result<()> {
        let (case, input) = (system.case, system.inputs[0]);
        let Some(window) = self.inside() else {
            system.find_loads(loads);
            system.multipliers();
            return Ok(());
        };
        let mut own = |motions: &[Motion], angles: &[f64], out: &mut [Wrench]| loads(case, motions, angles, out);
        window.multipliers(system, [input.value, input.rate, input.acceleration], shaft, &mut own)
    }

    /// Follows a prescribed motion to the time `t`, up to the stage that the system requests.
    pub(in crate::newton) fn pass_to(&mut self, system: &mut System, t: f64) -> Result<()> {
        system.set_time(t);
        let input = system.inputs[0];
        self.go_to(system, input.value)?;
        system.inputs[0] = input;
        self.rates(system, input.rate, input.acceleration);
        if system.stage >= Stage::Reactions {
            self.multipliers(system, None, &mut |case, motions, angles, out| case.loads_on(motions, angles, out))?;
        }
        Ok(())
    }

    /// Condition number of the last pose; `None` if the pose lies in no window around a change point.
    pub(in crate::newton) fn condition(&self) -> Option<f64> {
        self.inside().map(|window| window.condition)
    }
}

/// Sets the crank to its exact pose, which needs no polynomial.
fn turn_crank(system: &mut System, spot: &mut Spot) {
    let crank = system.case.crank();
    let joint = &system.case.mechanism.joints()[crank.joint];
    let pin = joint.on(crank.link).expect("the driven joint is on its link");
    let centre = system.case.mechanism.links()[crank.link].mass_centre;
    let arm = rotated(unit(spot.angle), centre - pin);
    let (place, across) = (joint.other(crank.link).local + arm, turned(arm));
    let first = 3 * (crank.link.index() - 1);
    let own = [(place.x, across.x, -arm.x), (place.y, across.y, -arm.y), (spot.angle, 1.0, 0.0)];
    for (index, (q, slope, curve)) in (first..).zip(own) {
        (spot.q[index], spot.slope[index], spot.curve[index]) = (q, slope, curve);
        system.q[index] = q;
    }
}
