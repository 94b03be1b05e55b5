//! Linkages whose motion and forces are known in closed form.

use linkproof_simbody::{
    GROUND, Inertia, IntegrationSettings, Law, LoopClosure, SimbodyBody, SimbodyJoint, SimbodyModel, version,
};

const G: f64 = 9.81;

fn pin(on_parent: [f64; 2]) -> SimbodyJoint {
    SimbodyJoint::Pin { on_parent, on_child: [0.0, 0.0] }
}

fn rod(mass: f64, length: f64) -> Inertia {
    Inertia { mass, centre: [length / 2.0, 0.0], inertia: mass * length * length / 12.0, ..Inertia::default() }
}

fn body(parent: usize, joint: SimbodyJoint, inertia: Inertia, coordinate: f64) -> SimbodyBody {
    SimbodyBody { parent, joint, inertia, resistance: 0.0, coordinate, rate: 0.0, law: None }
}

/// A parallelogram with cranks of length 1 from (0, 0) and (2, 0).
/// The first crank is driven; the coupler only translates.
/// The start coordinates of the coupler and of the second crank are wrong by `off` (rad).
fn parallelogram(coupler: Inertia, start: f64, rate: f64, off: f64) -> SimbodyModel {
    let mut model = SimbodyModel::new([0.0, -G]);
    let first = SimbodyBody { law: Some(Law { rate }), ..body(GROUND, pin([0.0, 0.0]), rod(1.0, 1.0), start) };
    let first = model.add(first).unwrap();
    let coupler = model.add(body(first, pin([1.0, 0.0]), coupler, -start + off)).unwrap();
    let second = model.add(body(GROUND, pin([2.0, 0.0]), rod(1.0, 1.0), start + off)).unwrap();
    model.close(LoopClosure { bodies: [coupler, second], places: [[2.0, 0.0], [1.0, 0.0]] }).unwrap();
    model
}

fn close_to(found: [f64; 2], wanted: [f64; 2], bound: f64) {
    assert!((0..2).all(|k| (found[k] - wanted[k]).abs() <= bound), "{found:?} instead of {wanted:?}");
}

#[test]
fn the_library_is_a_simbody_3() {
    assert!(version().starts_with("3."), "{}", version());
}

#[test]
fn forces_in_a_parallelogram_are_those_of_statics() {
    // The coupler of 3 kg only translates, on a circle of radius 1 at 4 rad/s.
    // The acceleration of the coupler is a = -16 e, where e is the unit vector along the crank.
    // The two joint forces on the coupler add up to m (a - g).
    // The force of each joint follows from the moments about the coupler's middle and about the second pivot.
    // The second crank turns uniformly, and its weight acts at half its length.
    let (start, rate, t) = (0.7, 4.0, 0.2);
    let mut run = parallelogram(rod(3.0, 2.0), start, rate, 1e-4).run(IntegrationSettings::default()).unwrap();
    run.advance(t).unwrap();
    let state = run.read(true).unwrap();
    let angle = start + rate * t;
    let (cos, sin) = (angle.cos(), angle.sin());
    let total = [3.0 * -16.0 * cos, 3.0 * (-16.0 * sin + G)];
    // The coupler does not turn, so the y components of force in its two joints are equal.
    // Moments about the second pivot: the moment of the x component of the force on the second crank balances the
    // moments of the y component and of the crank's weight.
    let half = total[1] / 2.0;
    let on_second = [(-half * cos - 1.0 * G * cos / 2.0) / sin, -half];
    close_to(state.loops[0].force, on_second, 1e-9);
    close_to(state.bodies[1].force, [total[0] + on_second[0], half], 1e-9);
    assert!(state.bodies[1].moment.abs() < 1e-9 && state.bodies[2].moment.abs() < 1e-9);
    // The moment of the drive follows from its power. Only the weights contribute, because the kinetic energy is
    // constant.
    let drive = G * cos * (0.5 + 3.0 + 0.5);
    assert!((state.bodies[0].drive - drive).abs() < 1e-9, "{} instead of {drive}", state.bodies[0].drive);
    assert!((state.bodies[0].moment - drive).abs() < 1e-9, "the drive is part of the moment in its pin");
    assert!(state.loops[0].gap < 1e-12);
    assert!((state.bodies[1].coordinate + angle).abs() < 1e-12 && (state.bodies[0].coordinate - angle).abs() < 1e-15);
    close_to(state.bodies[1].acceleration, [-16.0 * cos, -16.0 * sin], 1e-10);
}

#[test]
fn extra_mass_of_a_massless_coupler_is_not_in_its_reactions() {
    let failure = parallelogram(Inertia::default(), 0.7, 4.0, 0.0).run(IntegrationSettings::default()).unwrap_err();
    assert!(failure.message.contains("not finite"), "{failure}");

    let coupler = Inertia { centre: [0.4, 0.3], extra_mass: 2.0, extra_inertia: 0.7, ..Inertia::default() };
    let mut run = parallelogram(coupler, 0.7, 4.0, 0.0).run(IntegrationSettings::default()).unwrap();
    run.advance(0.2).unwrap();
    let state = run.read(true).unwrap();
    // A massless rod between two joints transmits a force only along its length. This force supports the weight of the
    // second crank.
    let angle: f64 = 1.5;
    let along = G * angle.cos() / 2.0 / angle.sin();
    close_to(state.loops[0].force, [-along, 0.0], 1e-9);
    close_to(state.bodies[1].force, [-along, 0.0], 1e-9);
}

#[test]
fn all_links_may_be_massless() {
    let extra = Inertia { extra_mass: 1.0, extra_inertia: 0.1, ..Inertia::default() };
    let mut model = SimbodyModel::new([0.0, -G]);
    let law = Some(Law { rate: 4.0 });
    let first = model.add(SimbodyBody { law, ..body(GROUND, pin([0.0, 0.0]), extra, 0.7) }).unwrap();
    let coupler = model.add(body(first, pin([1.0, 0.0]), extra, -0.7)).unwrap();
    let loaded = SimbodyBody { resistance: 6.0, ..body(GROUND, pin([2.0, 0.0]), extra, 0.7) };
    let second = model.add(loaded).unwrap();
    model.close(LoopClosure { bodies: [coupler, second], places: [[2.0, 0.0], [1.0, 0.0]] }).unwrap();
    let mut run = model.run(IntegrationSettings::default()).unwrap();
    run.advance(0.1).unwrap();
    let state = run.read(true).unwrap();
    // The loaded crank needs a moment of 6 N m, which it gets from the axial force in the coupler. The driven crank is
    // parallel to the loaded crank and has the same length, so its drive supplies the same moment.
    close_to(state.loops[0].force, [-6.0 / 1.1_f64.sin(), 0.0], 1e-11);
    assert!((state.bodies[0].drive - 6.0).abs() < 1e-11);
}

#[test]
fn a_slider_carries_force_and_moment_across_its_axis() {
    // A block of 2 kg moves at 1.5 m/s on a guide inclined by 0.3 rad. The block's mass centre is not at the joint's
    // point.
    let (angle, axis) = (0.3_f64, [0.3_f64.cos(), 0.3_f64.sin()]);
    let joint =
        SimbodyJoint::Slider { on_parent: [0.1, 0.2], on_child: [0.0, 0.1], axis_parent: axis, axis_child: [1.0, 0.0] };
    let inertia = Inertia { mass: 2.0, centre: [0.5, 0.1], inertia: 0.1, ..Inertia::default() };
    let mut model = SimbodyModel::new([0.0, -G]);
    model.add(SimbodyBody { law: Some(Law { rate: 1.5 }), ..body(GROUND, joint, inertia, 0.25) }).unwrap();
    let mut run = model.run(IntegrationSettings::default()).unwrap();
    run.advance(2.0).unwrap();
    let block = run.read(true).unwrap().bodies[0];
    assert_eq!(block.coordinate, 3.25);
    close_to(block.direction, axis, 1e-15);
    close_to(block.velocity, axis.map(|part| 1.5 * part), 1e-14);
    close_to(block.force, [0.0, 2.0 * G], 1e-12);
    assert!((block.moment - 2.0 * G * 0.5 * angle.cos()).abs() < 1e-12);
    assert!((block.drive - 2.0 * G * angle.sin()).abs() < 1e-12);
}

#[test]
fn resistance_acts_against_the_rotation() {
    for rate in [3.0, -3.0, 0.0] {
        let mut model = SimbodyModel::new([0.0, 0.0]);
        let law = Some(Law { rate });
        model.add(SimbodyBody { law, resistance: 5.0, ..body(GROUND, pin([0.0, 0.0]), rod(1.0, 1.0), 0.0) }).unwrap();
        let mut run = model.run(IntegrationSettings::default()).unwrap();
        run.advance(0.1).unwrap();
        let wanted = if rate == 0.0 { 0.0 } else { 5.0 * f64::signum(rate) };
        assert!((run.read(true).unwrap().bodies[0].drive - wanted).abs() < 1e-12);
    }
}

#[test]
fn a_linkage_that_cannot_be_closed_is_refused() {
    let mut model = SimbodyModel::new([0.0, -G]);
    let law = Some(Law { rate: 1.0 });
    let first = model.add(SimbodyBody { law, ..body(GROUND, pin([0.0, 0.0]), rod(1.0, 1.0), 0.0) }).unwrap();
    let second = model.add(body(GROUND, pin([5.0, 0.0]), rod(1.0, 1.0), 1.0)).unwrap();
    model.close(LoopClosure { bodies: [first, second], places: [[1.0, 0.0], [1.0, 0.0]] }).unwrap();
    let failure = model.run(IntegrationSettings::default()).unwrap_err();
    assert!(!failure.message.is_empty(), "{failure}");
}

#[test]
fn the_run_ends_at_the_dead_point() {
    // The lengths are: crank 1, coupler 1.5, rocker 1, base 3.
    // The linkage can be assembled only if the distance between crank pin and rocker pivot is at most 2.5.
    // The distance reaches 2.5 at the crank angle whose cosine is 0.625.
    let start = 0.2_f64;
    let crank_pin = [start.cos(), start.sin()];
    let reach: f64 = (3.0 - crank_pin[0]).hypot(crank_pin[1]);
    let base = (-crank_pin[1]).atan2(3.0 - crank_pin[0]);
    let coupler = base + ((1.5_f64.powi(2) + reach * reach - 1.0) / (3.0 * reach)).acos();
    let end = [crank_pin[0] + 1.5 * coupler.cos(), crank_pin[1] + 1.5 * coupler.sin()];
    let mut model = SimbodyModel::new([0.0, -G]);
    let law = Some(Law { rate: 1.0 });
    let first = model.add(SimbodyBody { law, ..body(GROUND, pin([0.0, 0.0]), rod(1.0, 1.0), start) }).unwrap();
    let second = model.add(body(first, pin([1.0, 0.0]), rod(1.5, 1.5), coupler - start)).unwrap();
    let rocker = model.add(body(GROUND, pin([3.0, 0.0]), rod(1.0, 1.0), end[1].atan2(end[0] - 3.0))).unwrap();
    model.close(LoopClosure { bodies: [second, rocker], places: [[1.5, 0.0], [1.0, 0.0]] }).unwrap();
    let mut run = model.run(IntegrationSettings::default()).unwrap();
    let failure = run.advance(2.0).unwrap_err();
    let dead = 0.625_f64.acos() - start;
    assert!((failure.time.unwrap() - dead).abs() < 1e-4, "{failure} instead of {dead}");
    assert_eq!(failure.gaps.len(), 1);
}

#[test]
fn wrong_models_are_refused_before_simbody_sees_them() {
    let good = body(GROUND, pin([0.0, 0.0]), rod(1.0, 1.0), 0.0);
    let refused = |body: SimbodyBody| SimbodyModel::new([0.0, 0.0]).add(body).unwrap_err().message;
    assert!(refused(SimbodyBody { parent: 1, ..good }).contains("has not been added"));
    assert!(refused(SimbodyBody { coordinate: f64::NAN, ..good }).contains("not finite"));
    assert!(refused(SimbodyBody { inertia: rod(-1.0, 1.0), ..good }).contains("negative"));
    let joint = SimbodyJoint::Slider {
        on_parent: [0.0; 2],
        on_child: [0.0; 2],
        axis_parent: [2.0, 0.0],
        axis_child: [1.0, 0.0],
    };
    assert!(refused(SimbodyBody { joint, ..good }).contains("unit vector"));

    let mut model = SimbodyModel::new([0.0, 0.0]);
    assert!(model.run(IntegrationSettings::default()).unwrap_err().message.contains("no body"));
    model.add(good).unwrap();
    for bodies in [[1, 1], [0, 2]] {
        assert!(
            model
                .close(LoopClosure { bodies, places: [[0.0; 2]; 2] })
                .unwrap_err()
                .message
                .contains("cannot be joined")
        );
    }
    for (accuracy, tolerance) in [(0.0, 1e-9), (f64::NAN, 1e-9), (1e-9, 0.0)] {
        assert!(model.run(IntegrationSettings { accuracy, tolerance, ..IntegrationSettings::default() }).is_err());
    }
    let mut run = model.run(IntegrationSettings::default()).unwrap();
    run.advance(0.5).unwrap();
    assert!(run.advance(0.4).unwrap_err().message.contains("requested after"));
    assert!(run.advance(f64::NAN).is_err());
}
