//! Compares the Newton-Euler equations along the spanning tree with the dense system of all links.
//! The two methods share only the components of the joints.

use crate::common::assert_within;
use std::path::{Path, PathBuf};

use proptest::prelude::*;

use linkage::case::Case;
use linkage::drive::Wrench;
use linkage::input::Input;
use linkage::math::dense::Lu;
use linkage::math::{KeepNan, Motion, Vec2, cross, turned, unit};
use linkage::mechanism::{Joint, JointId, SpanningTree};
use linkage::solver::State;
use rapier_twin::newton_euler::NewtonEuler;
use scenario::Scenario;

/// All shipped scenarios and study variants, by name, and a planetary train.
/// In this train, the forces of the first and the last transmission are computed together, and the force of the
/// transmission between them separately.
fn shipped() -> Vec<(String, Case)> {
    let top = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios");
    let toml = |directory: &Path| {
        let files = std::fs::read_dir(directory).unwrap().map(|entry| entry.unwrap().path());
        files.filter(|path| path.extension().is_some_and(|of| of == "toml")).collect::<Vec<PathBuf>>()
    };
    let mut files = [toml(&top), toml(&top.join("variants60"))].concat();
    files.sort();
    let case = |path: &PathBuf| (path.display().to_string(), Scenario::load(path).unwrap().case);
    files.push(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/suite/rapier/planetary_side.toml"));
    files.iter().map(case).collect()
}

/// The equations along the tree in use, and along further trees with all links and all driven joints.
/// The further trees are chosen so that every joint belongs to some tree.
fn along_all_trees(case: &Case) -> Vec<(SpanningTree, NewtonEuler)> {
    let driven = case.drives.joint_ids();
    let masses: Vec<[f64; 2]> = case.mechanism.links().iter().map(|link| [link.mass, link.inertia]).collect();
    let mut trees = vec![SpanningTree::with(&case.mechanism, &driven)];
    for tree in SpanningTree::covering(&case.mechanism, &case.wanted_reactions()) {
        let whole = tree.branches.len() + 1 == case.mechanism.links().len();
        if whole && driven.iter().all(|joint| !tree.cut.contains(joint)) {
            trees.push(tree);
        }
    }
    let along = |tree: SpanningTree| (NewtonEuler::along(case, &tree, masses.clone(), 1.0), tree);
    trees.into_iter().map(along).map(|(equations, tree)| (tree, equations)).collect()
}

/// The dense system of all links: its matrix and its right-hand side.
fn dense(case: &Case, state: &State) -> (Vec<Vec<f64>>, Vec<f64>) {
    let links = case.mechanism.links();
    let n = 3 * (links.len() - 1);
    let (mut matrix, mut right) = (vec![vec![0.0; n]; n], vec![0.0; n]);
    for (index, joint) in case.mechanism.joints().entries() {
        let column = case.mechanism.rows(index).start;
        for (side, sign) in [(joint.first, -1.0), (joint.second, 1.0)] {
            let Some(row) = (3 * side.link.index()).checked_sub(3) else { continue };
            let motion = &state.motions[side.link];
            if let Some(normal) = normal(joint, state) {
                let place = state.motions[joint.second.link].point(joint.second.local);
                let arm = place - motion.point(links[side.link].mass_centre);
                matrix[row][column] = normal.x * sign;
                matrix[row + 1][column] = normal.y * sign;
                matrix[row + 2][column] = cross(arm, normal) * sign;
                matrix[row + 2][column + 1] = sign;
            } else {
                let arm = motion.arm(side.local - links[side.link].mass_centre);
                matrix[row][column] = sign;
                matrix[row + 1][column + 1] = sign;
                matrix[row + 2][column] = -arm.y * sign;
                matrix[row + 2][column + 1] = arm.x * sign;
            }
        }
    }
    for (index, transmission) in case.mechanism.transmissions().entries() {
        let (column, carrier) =
            (case.mechanism.row_of_transmission(index), &state.motions[transmission.design.carrier]);
        let contact = transmission.contact_in(case.mechanism.joints(), &state.motions);
        let line = &contact.lines[0];
        let direction = carrier.arm(line.direction);
        for ((link, foot), sign) in transmission.design.links.into_iter().zip(line.feet).zip([-1.0, 1.0]) {
            let Some(row) = (3 * link.index()).checked_sub(3) else { continue };
            let arm = carrier.point(foot) - state.motions[link].point(links[link].mass_centre);
            matrix[row][column] = direction.x * sign;
            matrix[row + 1][column] = direction.y * sign;
            matrix[row + 2][column] = cross(arm, direction) * sign;
        }
    }
    let first = case.mechanism.row_of_drive(0);
    for (column, drive) in (first..).zip(&case.drives) {
        let joint = &case.mechanism.joints()[drive.joint];
        if drive.input == Input::Angle {
            matrix[3 * drive.link.index() - 1][column] = 1.0;
            continue;
        }
        for (side, sign) in [(joint.first, -1.0), (joint.second, 1.0)] {
            let Some(row) = (3 * side.link.index()).checked_sub(3) else { continue };
            let Some(axis) = joint.axis_on(joint.first.link).map(|axis| state.motions[joint.first.link].arm(axis))
            else {
                matrix[row + 2][column] = sign;
                continue;
            };
            let place = state.motions[joint.second.link].point(joint.second.local);
            let arm = place - state.motions[side.link].point(links[side.link].mass_centre);
            matrix[row][column] = axis.x * sign;
            matrix[row + 1][column] = axis.y * sign;
            matrix[row + 2][column] = cross(arm, axis) * sign;
        }
    }
    let mut loads = vec![Wrench::ZERO; links.len()];
    case.loads_on(&state.motions, &state.angles, &mut loads);
    for (id, link) in links.entries().skip(1) {
        let index = id.index();
        let motion = &state.motions[id];
        let inertial = (motion.point_acceleration(link.mass_centre) - case.gravity) * link.mass - loads[index].force;
        let moment = link.inertia * motion.alpha - loads[index].moment;
        right[3 * index - 3..3 * index].copy_from_slice(&[inertial.x, inertial.y, moment]);
    }
    (matrix, right)
}

fn normal(joint: &Joint, state: &State) -> Option<Vec2> {
    Some(turned(state.motions[joint.first.link].arm(joint.axis_on(joint.first.link)?)))
}

/// A state near the start in which the joints do not close.
/// Every link is displaced and rotated independently, and has independent velocities and accelerations.
fn torn(case: &Case, numbers: &[f64]) -> State {
    let (mut state, size) = (State::at_start(case), case.mechanism.size());
    let mut next = numbers.iter().cycle();
    let mut more = || *next.next().unwrap();
    for link in state.motions.ids().skip(1) {
        let mut pair = || Vec2::new(more(), more());
        let (moved, velocity, acceleration) = (pair() * (0.05 * size), pair() * size, pair() * size);
        let angle = state.angles[link] + 0.3 * more();
        state.angles[link] = angle;
        state.motions[link] = Motion {
            origin: state.motions[link].origin + moved,
            direction: unit(angle),
            velocity,
            omega: more(),
            acceleration,
            alpha: more(),
        };
    }
    state
}

/// Reactions and moments in the order of the dense system's columns.
fn flat(case: &Case, state: &State) -> Vec<f64> {
    let joints = case.mechanism.joints().entries().flat_map(|(index, joint)| {
        let force = state.forces[index];
        match normal(joint, state) {
            None => [force.x, force.y],
            Some(normal) => [force.dot(&normal), state.moments[index]],
        }
    });
    joints.chain(state.transmitted.iter().copied()).chain(state.torques.iter().copied()).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(8))]

    /// For every shipped mechanism, the solution satisfies the equations of all links to rounding error.
    /// The solution equals that of the dense system to the accuracy of the dense system.
    #[test]
    fn the_tree_solution_equals_the_dense_solution(numbers in prop::collection::vec(-1.0f64..1.0, 97)) {
        for (name, case) in shipped() {
            let mut state = torn(&case, &numbers);
            let (matrix, right) = dense(&case, &state);
            let n = right.len();
            let mut lu = Lu::new(n);
            for (row, entries) in matrix.iter().enumerate() {
                entries.iter().enumerate().for_each(|(column, &entry)| lu.add(row, column, entry));
            }
            prop_assert!(lu.factor());
            let mut known = right.clone();
            lu.solve(&mut known);
            let most = |of: &[f64]| of.iter().fold(0.0, |most: f64, value| most.larger(value.abs()));
            // Amplification of rounding error: the largest entry of the inverse matrix.
            let inverse = (0..n).map(|k| {
                let mut column = vec![0.0; n];
                column[k] = 1.0;
                lu.solve(&mut column);
                most(&column)
            });
            let inverse = inverse.fold(1.0, f64::larger);
            for (_, mut equations) in along_all_trees(&case) {
                equations.solve(&case, &mut state, 0.0).unwrap();
                let found = flat(&case, &state);
                let largest = most(&known).larger(most(&found));
                let rest = |row: &[f64], right: &f64| row.iter().zip(&found).map(|(a, x)| a * x).sum::<f64>() - right;
                let rest: Vec<f64> = matrix.iter().zip(&right).map(|(row, right)| rest(row, right)).collect();
                assert_within!(most(&rest), 1e-12 * largest, "{name}");
                for (found, known) in found.iter().zip(&known) {
                    let bound = 1e-14 * inverse * largest;
                    assert_within!((found - known).abs(), bound, "{name}: {found} {known}");
                }
            }
        }
    }
}

/// The tested cases include several drives, open chains and loads.
/// The cases include prismatic joints as cut joints and as joints of the tree.
/// In some of the cases the equations are solved in pairs, in others all at once.
#[test]
fn every_kind_of_joint_is_tested() {
    let mut seen = [0; 7];
    for (_, case) in shipped() {
        for (tree, equations) in along_all_trees(&case) {
            let slide = |joint: JointId| case.mechanism.joints()[joint].slides();
            let [pairs, larger] = equations.stages();
            let kinds = [
                tree.cut.iter().any(|&joint| slide(joint)),
                tree.branches.iter().any(|branch| slide(branch.joint)),
                case.drives.len() > 1,
                tree.cut.is_empty(),
                !case.loads.is_empty(),
                pairs > 0,
                larger > 0,
            ];
            seen.iter_mut().zip(kinds).for_each(|(seen, kind)| *seen += usize::from(kind));
        }
    }
    assert!(seen.iter().all(|&count| count > 0), "{seen:?}");
}

/// All links of a four-bar on one line: the equations do not determine the force along this line.
#[test]
fn a_dead_point_is_reported() {
    let case = fixtures::turning(fixtures::four_bar());
    let mut state = State::at_rest(&case);
    for motion in &mut state.motions {
        motion.alpha = 1.0;
    }
    let error = NewtonEuler::new(&case).solve(&case, &mut state, 0.25).unwrap_err();
    assert!(error.message().contains("the reactions are not determined at t = 0.250000 s (dead point)"), "{error}");
}
