//! The mechanism reduced to its crank's shaft: the exact coefficients of its equation of motion at every crank angle.

use super::means::{self, Kinks};
use crate::{PoseSolver, sentences};
use linkage::case::Case;
use linkage::drive::{Load, LoadState, Motor, MotorBranch};
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::{KeepNan, Motion, Vec2, just_below};
use linkage::mechanism::{GROUND, LinkId};
use linkage::solver::State;
use linkage::trajectory::Stage;

/// A motion ends at this distance from a limit of rotation (rad). At the limit the reduced moment of inertia would be
/// infinite.
const LIMIT_MARGIN: f64 = 1e-4;

/// Reduced quantities at one crank angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reduced {
    /// Reduced moment of inertia I* (kg m^2), without motor, reducer and flywheel.
    pub inertia: f64,
    /// Derivative dI*/dphi of the reduced moment of inertia (kg m^2).
    /// The derivative is twice the sum of m v . a + J omega alpha for a crank with the speed 1 rad/s and the
    /// acceleration 0 rad/s^2.
    pub slope: f64,
    /// Moment of gravity and loads reduced to the crank (N m), counter-clockwise positive.
    pub applied: f64,
}

/// A mass of the mechanism.
#[derive(Clone, Copy, Debug)]
struct Mass {
    link: LinkId,
    mass: f64,
    inertia: f64,
    centre: Vec2,
}

/// An interval of crank angles without a kink.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Piece {
    index: i64,
    /// Crank angles (rad) at the ends of the piece.
    pub(crate) ends: [f64; 2],
}

impl Piece {
    /// The piece of all crank angles, used before the mechanism is first placed.
    pub(crate) fn unbounded() -> Self {
        Piece { index: 0, ends: [f64::NEG_INFINITY, f64::INFINITY] }
    }
}

/// A mechanism of one degree of freedom under forces.
/// The model contains the coefficients of the equation of motion `omega^2 / 2 dI*/dphi + I* domega/dt = M`.
/// The model also contains the crank angles at which these coefficients have kinks.
#[derive(Clone, Debug)]
pub struct ReducedModel<'a> {
    pub(crate) case: &'a Case,
    masses: Vec<Mass>,
    /// Each load that depends on the sense of a link's rotation, with this link.
    sensed: Vec<(LinkId, Load)>,
    /// Loads that depend only on the pose.
    steady: Vec<Load>,
    kinks: Kinks,
    /// Crank angles of the boundaries between pieces. The boundaries are the kinks of one period.
    /// If there are no kinks, the start of the period is the only boundary.
    /// If the motion has limits, there are two more boundaries, each at the distance [`LIMIT_MARGIN`] inside a limit.
    boundaries: Vec<f64>,
    /// Sense of the transfer function of each link in `sensed`, on each piece of one period: +1 or -1.
    /// The values are ordered by piece: all links on the first piece, then all links on each following piece.
    senses: Vec<f64>,
    pub(crate) motor: Option<Motor>,
    /// Sense in which the motor drives the crank: the sense of the prescribed speed in the scenario.
    pub(crate) sense: f64,
    /// Moment of inertia that turns with the crank (kg m^2): motor and reducer, both reduced to the crank, and a
    /// flywheel.
    pub(crate) added: f64,
}

impl<'a> ReducedModel<'a> {
    /// The model of a case. The motor of the model drives in the sense of the prescribed speed.
    /// The model does not use the value of this speed.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] for mechanisms of several degrees of freedom, for loads that depend on the magnitude
    /// of speeds, and for springs that every turn winds up further.
    /// [`ErrorKind::Input`] for mechanisms without masses.
    /// The errors of [`kinks`](means::kinks) are passed on.
    pub fn of(case: &'a Case) -> Result<Self> {
        if !case.drives.further().is_empty() {
            let message = sentences::the_motion_under_forces_is_asked_for_but_the_mechanism(&case.drives.len());
            return Err(Error::new(ErrorKind::Unsupported, message).help(sentences::TAKE_A_SCENARIO_WITH_ONE_DRIVE));
        }
        let links = case.mechanism.links().entries();
        let masses = links.filter(|(link, body)| *link != GROUND && (body.mass > 0.0 || body.inertia > 0.0));
        let masses =
            masses.map(|(link, body)| Mass { link, mass: body.mass, inertia: body.inertia, centre: body.mass_centre });
        let kinks = means::kinks(case)?;
        check_loads(case, &kinks)?;
        let steady = case.loads.iter().filter(|load| load.sensed_link().is_none()).cloned();
        let sensed = case.loads.iter().filter_map(|load| Some((load.sensed_link()?, load.clone())));
        let sensed = sensed.filter(|&(link, _)| case.can_turn(link));
        let mut model = ReducedModel {
            case,
            masses: masses.collect(),
            sensed: sensed.collect(),
            steady: steady.collect(),
            boundaries: boundaries(&kinks, case.crank().start),
            kinks,
            senses: Vec::new(),
            motor: case.crank().motor().cloned(),
            sense: case.crank().sense(),
            added: case.crank().motor().map_or(0.0, Motor::inertia_on_crank),
        };
        if model.masses.is_empty() && model.added == 0.0 {
            let message = sentences::THE_MOTION_UNDER_FORCES_IS_ASKED;
            return Err(Error::new(ErrorKind::Input, message).help(sentences::GIVE_THE_LINKS_MASSES_OR_THE_MOTOR));
        }
        model.find_senses()?;
        Ok(model)
    }

    /// Applies [`PoseSolver::turning_fully`] to `poses` if the crank is known to turn fully.
    pub(crate) fn guided<'p>(&self, poses: PoseSolver<'p>) -> PoseSolver<'p> {
        if self.kinks.period.is_some() { poses.turning_fully() } else { poses }
    }

    /// This model with an additional flywheel on the crank's shaft. `inertia` is the flywheel's moment of inertia (kg
    /// m^2).
    /// A negative value removes inertia; the total must stay positive.
    #[must_use]
    pub fn with_flywheel(&self, inertia: f64) -> Self {
        ReducedModel { added: self.added + inertia, ..self.clone() }
    }

    /// Kinks, period and limits of the reduced quantities.
    #[must_use]
    pub fn kinks(&self) -> &Kinks {
        &self.kinks
    }

    /// Moment of inertia that turns with the crank besides the mechanism itself (kg m^2).
    #[must_use]
    pub fn added_inertia(&self) -> f64 {
        self.added
    }

    fn find_senses(&mut self) -> Result<()> {
        let mut poses = PoseSolver::new(self.case)?;
        let count = self.boundaries.len() as i64;
        for index in 0..count {
            let piece = self.piece(index);
            let middle = (piece.ends[0] + piece.ends[1]) / 2.0;
            let motions = &poses.solve(middle, 1.0, 0.0, Stage::Velocities)?.motions;
            self.senses.extend(self.sensed.iter().map(|&(link, _)| 1f64.copysign(motions[link].omega)));
        }
        Ok(())
    }

    /// Angle (rad) to subtract so that the crank angle stays small and loses no digits.
    /// If the crank moves upwards and `crank` is at the end of the last piece, the result is the period.
    /// If the crank moves downwards and `crank` is at the beginning of the first piece, the result is minus the period.
    /// Otherwise the result is zero.
    pub(crate) fn wrap(&self, crank: f64, way: f64) -> f64 {
        let first = self.boundaries[0];
        match self.kinks.period {
            Some(period) if way > 0.0 && crank >= first + period => period,
            Some(period) if way < 0.0 && crank <= first => -period,
            _ => 0.0,
        }
    }

    /// Crank angle of a boundary. Boundaries of all periods are numbered continuously.
    fn boundary(&self, index: i64) -> f64 {
        let all = &self.boundaries;
        let count = all.len() as i64;
        match self.kinks.period {
            Some(period) => all[index.rem_euclid(count) as usize] + period * index.div_euclid(count) as f64,
            None => all[index.clamp(0, count - 1) as usize],
        }
    }

    /// The piece that begins at the boundary with the number `index` and lies above it.
    fn piece(&self, index: i64) -> Piece {
        Piece { index, ends: [self.boundary(index), self.boundary(index + 1)] }
    }

    /// The piece at `crank`. At a boundary, the result is the piece on the side of `way` (+1 or -1). `None` beyond a
    /// limit.
    pub(crate) fn piece_at(&self, crank: f64, way: f64) -> Option<Piece> {
        let all = &self.boundaries;
        let (turns, inside) = match self.kinks.period {
            Some(period) => {
                let turns = ((crank - all[0]) / period).floor();
                (turns as i64, crank - turns * period)
            }
            None => (0, crank),
        };
        let below = all.iter().filter(|&&boundary| boundary <= inside).count() as i64 - 1;
        let count = all.len() as i64;
        // Check the neighbouring pieces too, because rounding may have selected a neighbour of the right piece.
        let guess = below + turns * count;
        let holds = |piece: &Piece| match way > 0.0 {
            true => crank >= piece.ends[0] && crank < piece.ends[1],
            false => crank > piece.ends[0] && crank <= piece.ends[1],
        };
        let allowed = |index: &i64| self.kinks.period.is_some() || (0..count - 1).contains(index);
        (guess - 1..=guess + 1).filter(allowed).map(|index| self.piece(index)).find(holds)
    }

    /// Reduced quantities at `crank` (rad) while the crank turns in the direction `way`.
    /// `way` is +1, -1, or 0 for standstill, where loads that depend on a sense do not act.
    /// Beyond its ends the piece is continued smoothly.
    pub(crate) fn on_piece(&self, poses: &mut PoseSolver, crank: f64, way: f64, piece: Piece) -> Result<Reduced> {
        let state = self.at_unit_speed(poses, crank)?;
        let count = self.sensed.len();
        let row = piece.index.rem_euclid((self.senses.len() / count.max(1)).max(1) as i64) as usize;
        // At the upper end of the piece, a table may already have the value after a jump.
        let within = crank.larger(piece.ends[0]).smaller(just_below(piece.ends[1]));
        let mut found = self.of_pose(state, within);
        for ((link, load), sense) in self.sensed.iter().zip(&self.senses[row * count..]) {
            found.applied += load.moment_in(way * sense, within) * state.motions[*link].omega;
        }
        Ok(found)
    }

    /// Reduced quantities at `crank` (rad) while the crank turns in the sense of `way` (+1 or -1).
    ///
    /// # Errors
    /// [`ErrorKind::Geometry`] if the crank angle cannot be reached.
    pub fn at(&self, poses: &mut PoseSolver, crank: f64, way: f64) -> Result<Reduced> {
        let state = self.at_unit_speed(poses, crank)?;
        let mut found = self.of_pose(state, crank);
        for (link, load) in &self.sensed {
            let omega = state.motions[*link].omega;
            found.applied += load.moment_in(way * omega, crank) * omega;
        }
        Ok(found)
    }

    /// Moment of inertia reduced to the crank at its start angle (kg m^2), including everything that turns with the
    /// crank.
    ///
    /// # Errors
    /// The errors of [`ReducedModel::at`].
    pub fn inertia_at_start(&self) -> Result<f64> {
        let mut poses = PoseSolver::new(self.case)?;
        Ok(self.at(&mut poses, self.case.crank().start, self.sense)?.inertia + self.added)
    }

    fn at_unit_speed<'p>(&self, poses: &'p mut PoseSolver, crank: f64) -> Result<&'p State> {
        poses.solve(crank, 1.0, 0.0, Stage::Accelerations)?;
        Ok(poses.last(self.steady.iter().any(Load::needs_angles)))
    }

    /// Contribution of masses, gravity and steady loads: their virtual powers at a crank speed of 1 rad/s.
    fn of_pose(&self, state: &State, crank: f64) -> Reduced {
        let mut found = self.of_masses(&state.motions);
        let (motions, angles) = (&*state.motions, &*state.angles);
        let setting =
            LoadState { motions, angles, joints: self.case.mechanism.joints(), start: &self.case.start.0, crank };
        for load in &self.steady {
            load.act(&setting, &mut |action| found.applied += action.power(&motions[action.link]));
        }
        found
    }

    /// Contribution of masses and gravity, from the motions at a crank speed of 1 rad/s.
    #[inline]
    fn of_masses(&self, motions: &[Motion]) -> Reduced {
        let mut found = Reduced { inertia: 0.0, slope: 0.0, applied: 0.0 };
        for own in &self.masses {
            let motion = &motions[own.link];
            let arm = motion.arm(own.centre);
            let (velocity, acceleration) = (motion.velocity_beyond(arm), motion.acceleration_beyond(arm));
            found.inertia += own.mass * velocity.norm_squared() + own.inertia * motion.omega * motion.omega;
            found.slope += 2.0 * (own.mass * velocity.dot(&acceleration) + own.inertia * motion.omega * motion.alpha);
            found.applied += own.mass * self.case.gravity.dot(&velocity);
        }
        found
    }

    /// Smooth piece of the motor's moment that is valid while the crank turns with `omega` (rad/s) and accelerates in
    /// the sense of `towards` (rad/s^2).
    pub(crate) fn branch(&self, omega: f64, towards: f64) -> Option<MotorBranch> {
        let motor = self.motor.as_ref()?;
        Some(motor.branch(self.sense * omega, self.sense * towards))
    }
}

/// Checks that the reduction to the crank supports all loads.
fn check_loads(case: &Case, kinks: &Kinks) -> Result<()> {
    let refuse = |load: &Load, why: &str, help: &str| {
        let message = sentences::the_motion_under_forces_is_asked_for_but_a_load(&load.sort(), &why);
        Err(Error::new(ErrorKind::Unsupported, message).help(help))
    };
    for load in &case.loads {
        if load.is_viscous() {
            let why = sentences::DEPENDS_ON_THE_SIZE_OF_SPEEDS;
            return refuse(load, why, sentences::LEAVE_IT_OUT_OR_TAKE_ITS_PART);
        }
        if let (Some(links), Some(period)) = (load.nature().twist, kinks.period) {
            let (mut poses, start) = (PoseSolver::new(case)?, case.crank().start);
            let mut twist = |crank: f64| -> Result<f64> {
                poses.solve(crank, 1.0, 0.0, Stage::Positions)?;
                let state = poses.with_angles();
                Ok(state.angles[links[1]] - state.angles[links[0]])
            };
            if (twist(start + period)? - twist(start)?).abs() > 1.0 {
                let why = sentences::IS_WOUND_UP_BY_EVERY_TURN;
                return refuse(load, why, sentences::FASTEN_IT_TO_LINKS_THAT_DO_NOT_TURN);
            }
        }
    }
    Ok(())
}

/// Crank angles between pieces, for a drive that starts at `start` (rad).
fn boundaries(kinks: &Kinks, start: f64) -> Vec<f64> {
    match kinks.limits {
        None if kinks.cranks.is_empty() => vec![start],
        None => kinks.cranks.clone(),
        Some([from, to]) => {
            let inner = kinks.cranks.iter().copied().filter(|&kink| kink > from && kink < to);
            let ends = [from + LIMIT_MARGIN, to - LIMIT_MARGIN];
            ends[..1].iter().copied().chain(inner).chain([ends[1]]).collect()
        }
    }
}
