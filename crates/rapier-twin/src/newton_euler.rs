//! Reactions and driving moment from the engine's motion: the Newton-Euler equations, link by link along a spanning
//! tree.
//!
//! For every link, m (a - g) = sum of joint forces + loads.
//! For every link, J alpha = sum of the moments of the joint forces about the mass centre + moments of the loads.
//! The reaction of a joint has as many unknown components as the joint has constraint equations.
//! For a revolute joint, the unknowns are the two components of its force.
//! For a prismatic joint, the unknowns are the moment and the force across the joint's axis. This force acts at the
//! joint's point on the second link.
//!
//! The unknowns are the reaction components of the joints that the tree cuts.
//! The force and moment that a tree joint must transmit to its outer link follow from the motion of all links beyond
//! the joint.
//! This force and moment are a linear function of the unknowns and are computed from the leaves inwards.
//! A revolute joint transmits no moment, and a prismatic joint no force along its axis.
//! Each joint of the tree therefore gives one equation.
//! The links beyond a joint form a composite body: Featherstone, "Rigid Body Dynamics Algorithms", 2008, ch. 8.
//! Driven joints are in the tree, and the residual of a driven joint's equation is the driving moment or force.
//! The frame takes the reaction to the driving moment of a crank. The reaction to any other driving moment or force
//! acts on the inner link of the driven joint.
//! The equations of the other tree joints determine the components in the cut joints: there are as many equations as
//! components.
//! For a four-bar, two equations determine the components, while all its links together have nine equations of motion.
//! A transmission is a cut joint with one component: the force in its first line of action.

mod seam;
mod stages;

use crate::sentences;
use std::ops::Range;

use linkage::case::Case;
use linkage::drive::Wrench;
use linkage::error::{Error, ErrorKind, Result};
use linkage::input::Input;
use linkage::math::dense::solve_pair;
use linkage::math::{Vec2, cross};
use linkage::mechanism::SpanningTree;
use linkage::solver::State;
use linkage::work::{Count, WorkTally};
use seam::{PAIR, Seam, Stand, Term};
use stages::{Limb, Row, Stage, stages};

/// The equations of a case. The memory of the equations is reused for every pose.
#[derive(Debug)]
pub struct NewtonEuler {
    /// The links of the tree, from the ground outwards.
    tree: Vec<Limb>,
    cut: Vec<Seam>,
    /// For each cut joint, then for each transmission, the range of its components in the list of all components.
    of_cut: Vec<Range<usize>>,
    /// For each transmission, the indices of its members in the tree.
    members: Vec<[Option<usize>; 2]>,
    /// The joints of the tree, then the cut joints, in the present pose.
    stands: Vec<Stand>,
    /// For every link of the tree: the force and moment that the link must receive through the joint that carries it.
    /// The force and moment are a sum of terms: one term for each component of the cut joints, and one constant term.
    needs: Vec<Term>,
    stages: Vec<Stage>,
    /// The components in the cut joints.
    components: Vec<f64>,
    /// Mass (kg) and moment of inertia (kg m^2) of every link.
    masses: Vec<[f64; 2]>,
    loads: Vec<Wrench>,
    /// Fraction of the loads that is included.
    load_share: f64,
    tally: WorkTally,
}

impl NewtonEuler {
    /// The equations of a case with the case's masses and all its loads.
    pub fn new(case: &Case) -> Self {
        let masses = case.mechanism.links().iter().map(|link| [link.mass, link.inertia]).collect();
        NewtonEuler::of(case, masses, 1.0)
    }

    /// The equations of a case with the given masses (kg) and moments of inertia (kg m^2) and with a fraction of the
    /// loads.
    pub fn of(case: &Case, masses: Vec<[f64; 2]>, load_share: f64) -> Self {
        let tree = SpanningTree::with(&case.mechanism, &case.drives.joint_ids());
        NewtonEuler::along(case, &tree, masses, load_share)
    }

    /// The equations along any tree that contains all links and all driven joints.
    /// The equations have the masses (kg) and moments of inertia (kg m^2) `masses` and the fraction `load_share` of the
    /// loads.
    pub fn along(case: &Case, tree: &SpanningTree, masses: Vec<[f64; 2]>, load_share: f64) -> Self {
        let mut numbers = vec![None; masses.len()];
        for (number, branch) in tree.branches.iter().enumerate() {
            numbers[branch.link] = Some(number);
        }
        let limbs = tree.branches.iter().map(|branch| {
            let drive = case.drives.iter().position(|drive| drive.joint == branch.joint);
            Limb {
                seam: Seam::new(case, branch.joint, [branch.parent, branch.link], &numbers),
                drive,
                is_rigid: drive.is_some_and(|index| case.drives[index].input != Input::Angle),
                terms: Vec::new(),
            }
        });
        let mut limbs: Vec<Limb> = limbs.collect();
        let cut = tree.cut.iter().map(|&joint| {
            let sides = [case.mechanism.joints()[joint].first, case.mechanism.joints()[joint].second];
            Seam::new(case, joint, sides.map(|side| side.link), &numbers)
        });
        let cut: Vec<Seam> = cut.collect();
        let transmissions = case.mechanism.transmissions();
        let members: Vec<[Option<usize>; 2]> =
            transmissions.iter().map(|own| own.design.links.map(|link| numbers[link])).collect();
        let mut components = 0;
        let counts = cut.iter().map(|seam| case.mechanism.joints()[seam.joint].kind.equations());
        let of_cut = counts.chain(transmissions.iter().map(|_| 1)).map(|count| {
            components += count;
            components - count..components
        });
        let of_cut: Vec<Range<usize>> = of_cut.collect();
        let sides = cut.iter().map(|seam| seam.numbers).chain(members.iter().copied());
        for (numbers, terms) in sides.zip(&of_cut) {
            for side in numbers {
                let mut next = side;
                while let Some(number) = next {
                    let limb = &mut limbs[number];
                    limb.terms.extend(terms.clone());
                    next = limb.seam.numbers[0];
                }
            }
        }
        for limb in &mut limbs {
            limb.terms.sort_unstable();
            limb.terms.dedup();
        }
        debug_assert_eq!(components, limbs.iter().filter(|limb| limb.drive.is_none()).count(), "mobility");
        NewtonEuler {
            stands: Vec::with_capacity(limbs.len() + cut.len()),
            needs: vec![[0.0; 3]; limbs.len() * (components + 1)],
            stages: stages(&limbs, &of_cut),
            of_cut,
            members,
            components: vec![0.0; components],
            loads: vec![Wrench::ZERO; masses.len()],
            tree: limbs,
            cut,
            masses,
            load_share,
            tally: WorkTally::default(),
        }
    }

    /// Fills in the reactions and the driving moment of a state whose motion is known.
    ///
    /// # Errors
    /// [`ErrorKind::Numeric`] where the equations do not determine the reactions.
    pub fn solve(&mut self, case: &Case, state: &mut State, t: f64) -> Result<()> {
        case.loads_on(&state.motions, &state.angles, &mut self.loads);
        self.balance(case, state, t)
    }

    /// Like [`NewtonEuler::solve`], with the given loads on all links.
    ///
    /// # Errors
    /// The errors of [`NewtonEuler::solve`].
    pub(super) fn solve_under(&mut self, loads: &[Wrench], case: &Case, state: &mut State, t: f64) -> Result<()> {
        self.loads.copy_from_slice(loads);
        self.balance(case, state, t)
    }

    fn balance(&mut self, case: &Case, state: &mut State, t: f64) -> Result<()> {
        self.tally.one(Count::Forces);
        self.begin(case, state);
        self.pass_on();
        if !self.find() {
            return Err(Error::new(ErrorKind::Numeric, sentences::the_reactions_are_not_determined(&t))
                .at_time(t)
                .help(sentences::SHORTEN_THE_GRID_TO_THE_CRANK));
        }
        self.read(state);
        Ok(())
    }

    /// Number of stages with two unknowns, and number of all other stages.
    pub fn stages(&self) -> [usize; 2] {
        let pairs = self.stages.iter().filter(|stage| matches!(stage, Stage::Pair(..))).count();
        [pairs, self.stages.len() - pairs]
    }

    /// Finds the components in the cut joints, stage by stage. Returns false if the components are not determined.
    fn find(&mut self) -> bool {
        let NewtonEuler { stages, stands, needs, components, .. } = self;
        let width = components.len() + 1;
        let of = |row: &Row| (stands[row.number].pass(), &needs[row.number * width..][..width]);
        for stage in stages {
            match stage {
                Stage::Pair(terms, rows) => {
                    let (mut matrix, mut right) = ([[0.0; PAIR]; PAIR], [0.0; PAIR]);
                    for ((entries, right), row) in matrix.iter_mut().zip(&mut right).zip(rows) {
                        *right = row.equation(of(row), components, |column, value| entries[column] = value);
                    }
                    let Some(values) = solve_pair(matrix, right) else { return false };
                    terms.iter().zip(values).for_each(|(&term, value)| components[term] = value);
                }
                Stage::All { rows, terms, values, matrix } => {
                    matrix.clear();
                    for (number, row) in rows.iter().enumerate() {
                        let put = |column, value| matrix.add(number, column, value);
                        values[number] = row.equation(of(row), components, put);
                    }
                    if !matrix.factor() {
                        return false;
                    }
                    matrix.solve(values);
                    terms.iter().zip(values).for_each(|(&term, value)| components[term] = *value);
                }
            }
        }
        true
    }

    /// `needs` has a force and moment for every link. For every link, the part that the link's joint transmits is added
    /// to the force and moment of the link that carries this link.
    /// The order is from the leaves of the tree to the ground.
    fn pass_on(&mut self) {
        let width = self.components.len() + 1;
        for (number, limb) in self.tree.iter().enumerate().rev() {
            let Some(parent) = limb.seam.numbers[0] else { continue };
            let pass = if limb.is_rigid { self.stands[number].rigid() } else { self.stands[number].pass() };
            let (inner, own) = self.needs.split_at_mut(number * width);
            let (inner, own) = (&mut inner[parent * width..][..width], &own[..width]);
            for &term in &limb.terms {
                pass.on(&own[term], &mut inner[term]);
            }
            pass.on(&own[width - 1], &mut inner[width - 1]);
        }
    }

    /// Fills `needs` with the force and moment for the motion of every single link, and with the contributions of cut
    /// joints and transmissions.
    fn begin(&mut self, case: &Case, state: &State) {
        let width = self.components.len() + 1;
        self.stands.clear();
        self.stands.extend(self.tree.iter().map(|limb| &limb.seam).chain(&self.cut).map(|seam| seam.stand(state)));
        self.needs.as_flattened_mut().fill(0.0);
        for (limb, needs) in self.tree.iter().zip(self.needs.chunks_exact_mut(width)) {
            let link = limb.seam.links[1];
            let (motion, centre) = (&state.motions[link], case.mechanism.links()[link].mass_centre);
            let [mass, inertia] = self.masses[link];
            let Wrench { force, moment } = self.loads[link];
            let inertial = (motion.point_acceleration(centre) - case.gravity) * mass - force * self.load_share;
            needs[width - 1] = [inertial.x, inertial.y, inertia * motion.alpha - moment * self.load_share];
        }
        for ((seam, own), stand) in self.cut.iter().zip(&self.of_cut).zip(&self.stands[self.tree.len()..]) {
            for (k, (number, sign)) in seam.numbers.into_iter().zip(seam.signs).enumerate() {
                let Some(number) = number else { continue };
                let terms = &mut self.needs[number * width..][own.clone()];
                for (need, given) in terms.iter_mut().zip(stand.components(k)) {
                    (0..3).for_each(|c| need[c] -= sign * given[c]);
                }
            }
        }
        let meshes = case.mechanism.transmissions().iter().zip(&self.members);
        for ((transmission, members), term) in meshes.zip(self.of_cut[self.cut.len()..].iter().map(|own| own.start)) {
            let actions = transmission.unit_actions(case.mechanism.joints(), &state.motions);
            for ((link, force, place), member) in actions.into_iter().zip(members) {
                let Some(number) = member else { continue };
                let centre = state.motions[link].point(case.mechanism.links()[link].mass_centre);
                let given = [force.x, force.y, cross(place - centre, force)];
                (0..3).for_each(|c| self.needs[number * width + term][c] -= given[c]);
            }
        }
    }

    /// Computes reactions and driving moments from the components in the cut joints.
    fn read(&self, state: &mut State) {
        let (constant, (stands, cut)) = (self.components.len(), self.stands.split_at(self.tree.len()));
        for ((seam, stand), own) in self.cut.iter().zip(cut).zip(&self.of_cut) {
            let components = &self.components[own.clone()];
            (state.forces[seam.joint], state.moments[seam.joint]) = match stand.normal {
                None => (Vec2::new(components[0], components[1]), 0.0),
                Some(normal) => (normal * components[0], components[1]),
            };
        }
        for (transmitted, term) in state.transmitted.iter_mut().zip(&self.of_cut[self.cut.len()..]) {
            *transmitted = self.components[term.start];
        }
        let needs = self.needs.chunks_exact(constant + 1);
        for ((Limb { seam, drive, is_rigid, terms }, stand), own) in self.tree.iter().zip(stands).zip(needs) {
            let mut need = own[constant];
            for &term in terms {
                (0..3).for_each(|c| need[c] += own[term][c] * self.components[term]);
            }
            let effort = drive.map(|drive| (drive, stand.pass().left_over(&need)));
            if let Some((drive, effort)) = effort {
                state.torques[drive] = if *is_rigid { effort * seam.signs[1] } else { effort };
                need[2] -= stand.moment_of_thrust(effort);
            }
            let (force, moment) = stand.reaction(need);
            (state.forces[seam.joint], state.moments[seam.joint]) = (force * seam.signs[1], moment * seam.signs[1]);
        }
    }
}
