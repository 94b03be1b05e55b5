//! Compares a user's solver with both analytic sides. The solver uses Freudenstein's equation of the crank-rocker.
//!
//! The solver gets the geometry from the case, and computes angles and angular velocities. The comparison leaves out
//! all other channels.
//!
//! `cargo run --release --example own_solver`.
//! To use the crates from the registry, name them in your manifest as in this workspace:
//! `linkage = { package = "linkproof-linkage", version = "0.1" }`, and `prover` in the same way.

use linkage::error::Result;
use linkage::math::{Motion, Vec2, unit};
use linkage::solver::{Progress, Provision, Solver, State, Visit};
use linkproof::parts::{Channel, Reference, Stage, Wanted};
use linkproof::{Case, Scenario};
use prover::bounds::residuals;

/// Lengths of crank, coupler, rocker and ground (m), and the angle of the line between the fixed pivots (rad).
struct Freudenstein {
    lengths: [f64; 4],
    base: f64,
}

impl Freudenstein {
    fn of(case: &Case) -> Self {
        let joint =
            |name: &str| &case.mechanism.joints()[case.mechanism.joint_named(name).expect("the joint is there")];
        let apart = |a: Vec2, b: Vec2| (b - a).norm();
        let [o, a, b, c] = ["O", "A", "B", "C"].map(joint);
        let ground = c.first.local - o.first.local;
        let lengths = [
            apart(o.second.local, a.first.local),
            apart(a.second.local, b.first.local),
            apart(b.second.local, c.second.local),
            ground.norm(),
        ];
        Freudenstein { lengths, base: ground.y.atan2(ground.x) }
    }

    /// Angles of coupler and rocker (rad). `crank` is the crank angle from the line of the pivots (rad).
    /// The joint between coupler and rocker is on the left of the line from crank pin to rocker pivot.
    fn angles(&self, crank: f64) -> [f64; 2] {
        let [r1, r2, r3, r4] = self.lengths;
        let (x, y) = (r4 - r1 * crank.cos(), -r1 * crank.sin());
        let d = x.hypot(y);
        let at_a = ((r2 * r2 + d * d - r3 * r3) / (2.0 * r2 * d)).acos();
        let coupler = y.atan2(x) + at_a;
        let end = [r1 * crank.cos() + r2 * coupler.cos(), r1 * crank.sin() + r2 * coupler.sin()];
        [coupler, end[1].atan2(end[0] - r4)]
    }
}

impl Solver for Freudenstein {
    fn name(&self) -> &'static str {
        "freudenstein"
    }

    fn provides(&self, _: &Channel) -> Provision {
        Provision::Computed
    }

    fn sweep(&self, case: &Case, visit: Visit, progress: Progress) -> Result<()> {
        let mut state = State::at_rest(case);
        for (row, (&t, &crank)) in case.grid.times.iter().zip(&case.grid.inputs).enumerate() {
            let (theta, omega) = (case.crank().coordinate(crank) - self.base, case.crank().at(t).rate);
            let [coupler, rocker] = self.angles(theta);
            let [r1, r2, r3, _] = self.lengths;
            let between = (coupler - rocker).sin();
            let rates = [
                omega,
                -omega * r1 * (theta - rocker).sin() / (r2 * between),
                omega * r1 * (theta - coupler).sin() / (r3 * -between),
            ];
            for (link, (angle, rate)) in
                case.mechanism.links().ids().skip(1).zip([theta, coupler, rocker].into_iter().zip(rates))
            {
                let angle = angle + self.base;
                state.angles[link] = angle;
                state.motions[link] = Motion { direction: unit(angle), omega: rate, ..Motion::REST };
            }
            visit(row, &state)?;
            progress((row + 1) as f64 / case.grid.len() as f64);
        }
        Ok(())
    }
}

fn main() -> Result<()> {
    let scenario = Scenario::load("scenarios/crank_rocker.toml")?;
    let case = scenario.case.wanting(Wanted::of(&[Stage::Positions, Stage::Velocities]));
    let own = Freudenstein::of(&case).solve(&case)?;
    for side in Reference::ALL {
        for residual in residuals(&side.solver().solve(&case)?, &own)? {
            if ["angle_rad", "omega_rad_s"].contains(&residual.channel.kind.suffix) {
                println!("{:7} {:28} {:.1e} of its scale", side.name(), residual.channel.to_string(), residual.share());
            }
        }
    }
    Ok(())
}
