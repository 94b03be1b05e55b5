//! Errors of the three routes on the four-bar, and their orders.

use super::four_bar::{Build, CHANNELS, FourBar, GRAVITY, LOAD, SPEED, exact, exact_with, power_imbalance, ranges};
use rapier_reactions::double::{ImpulseReader, JointReaction, PoseWindow, Probing, WorldRef, extrapolated};
use rapier2d_f64::prelude::Vector;

/// A route to the reactions.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Way {
    Impulses,
    Differences,
    Probe,
}

/// Number of instants per turn that are compared. The first instant is left out, because the motion starts there.
const INSTANTS: usize = 20;

/// Time (s) and reactions at the compared instants, of a run with `steps` steps per turn.
fn run(build: Build, way: Way, steps: usize, gravity: [f64; 2]) -> (FourBar, Vec<(f64, Vec<JointReaction>)>) {
    let step = std::f64::consts::TAU / SPEED / steps as f64;
    let mut four_bar = FourBar::new(build, step);
    let (mut reader, mut window, mut found) = (ImpulseReader::default(), PoseWindow::default(), Vec::new());
    for start in 0..steps {
        reader.before_step(&WorldRef::from(&four_bar.world)).unwrap();
        four_bar.world.step();
        let world = WorldRef { gravity: Vector::new(gravity[0], gravity[1]), ..WorldRef::from(&four_bar.world) };
        window.push(&world).unwrap();
        if start == 0 || start % (steps / INSTANTS) != 0 {
            continue;
        }
        let reactions = match way {
            Way::Impulses => reader.after_step(&world).unwrap(),
            Way::Differences => window.by_differences().unwrap().reactions,
            Way::Probe => window.by_probe(&Probing::default()).unwrap(),
        };
        found.push((start as f64 * step, reactions));
    }
    (four_bar, found)
}

/// Largest error of every channel, relative to half its range. NaN for a channel that is not read.
fn errors(four_bar: &FourBar, found: &[(f64, Vec<JointReaction>)]) -> [f64; CHANNELS] {
    let ranges = ranges();
    let mut largest = [0.0f64; CHANNELS];
    for (time, reactions) in found {
        let (read, exact) = (four_bar.channels(reactions), exact(*time));
        for channel in 0..CHANNELS {
            let error = (read[channel] - exact[channel]).abs() / ranges[channel];
            largest[channel] = most(largest[channel], error);
        }
    }
    largest
}

/// The larger number, or NaN if one of the numbers is NaN.
fn most(a: f64, b: f64) -> f64 {
    if a.is_nan() || a > b { a } else { b }
}

/// Largest error; channels that are not read are left out.
fn worst(errors: [f64; CHANNELS]) -> f64 {
    errors.into_iter().filter(|error| !error.is_nan()).fold(0.0, most)
}

fn error(build: Build, way: Way, steps: usize) -> f64 {
    let (four_bar, found) = run(build, way, steps, GRAVITY);
    worst(errors(&four_bar, &found))
}

/// Error of impulses that are extrapolated from runs with `steps` and twice as many steps per turn.
fn extrapolated_error(build: Build, steps: usize) -> f64 {
    let (_, coarse) = run(build, Way::Impulses, steps, GRAVITY);
    let (four_bar, fine) = run(build, Way::Impulses, 2 * steps, GRAVITY);
    let both = coarse.iter().zip(&fine);
    let found: Vec<_> = both.map(|((time, coarse), (_, fine))| (*time, extrapolated(coarse, fine))).collect();
    worst(errors(&four_bar, &found))
}

/// The numbers of steps per turn in the table.
const STEPS: [usize; 3] = [400, 800, 1600];

/// The table of the README: for each construction and route, the errors at the three steps.
fn table() -> Vec<(String, [f64; 3])> {
    let mut rows = Vec::new();
    for (name, build) in [("multibody", Build::Multibody), ("separate bodies", Build::Impulse)] {
        rows.push((format!("{name}, impulses"), STEPS.map(|steps| error(build, Way::Impulses, steps))));
        rows.push((format!("{name}, impulses, extrapolated"), STEPS.map(|steps| extrapolated_error(build, steps))));
        rows.push((format!("{name}, differences"), STEPS.map(|steps| error(build, Way::Differences, steps))));
        rows.push((format!("{name}, probe"), STEPS.map(|steps| error(build, Way::Probe, steps))));
    }
    rows
}

/// Order of convergence between the last two steps.
fn order([_, coarse, fine]: [f64; 3]) -> f64 {
    (coarse / fine).log2()
}

/// The rows of the README's table of errors.
fn rows_of_the_readme() -> Vec<(String, Vec<f64>)> {
    let text = include_str!("../../README.md");
    let rows = text.lines().skip_while(|line| !line.starts_with("| world, route |")).skip(2);
    let row = |line: &str| {
        let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
        (cells[0].to_string(), cells[1..].iter().map(|cell| cell.parse().unwrap()).collect())
    };
    rows.take_while(|line| line.starts_with('|')).map(row).collect()
}

#[test]
fn the_table_of_errors_is_that_of_the_readme_and_has_the_stated_orders() {
    let measured = table();
    let text = |error: &f64| format!("{error:.1e}");
    for (name, errors) in &measured {
        println!("| {name} | {} | {:.2} |", errors.each_ref().map(text).join(" | "), order(*errors));
    }
    let printed = rows_of_the_readme();
    assert_eq!(measured.len(), printed.len(), "one row for each world and route");
    for ((name, errors), (printed_name, printed)) in measured.iter().zip(&printed) {
        assert_eq!(name, printed_name);
        for (error, printed) in errors.iter().zip(printed) {
            assert!((error / printed - 1.0).abs() < 0.1, "{name}: {error:.2e} measured, {printed:.2e} printed");
        }
        let stated = if name.ends_with("impulses") { 1.0 } else { 2.0 };
        for pair in errors.windows(2) {
            let found = (pair[0] / pair[1]).log2();
            assert!((found - stated).abs() < 0.15, "{name}: order {found:.2} instead of {stated}");
        }
        assert!((order(*errors) - printed[3]).abs() < 0.05, "{name}: order");
    }
}

#[test]
fn the_closed_form_balances_the_power() {
    for k in 0..50 {
        let time = 0.013 * f64::from(k);
        assert!(power_imbalance(time).abs() < 1e-11, "{}", power_imbalance(time));
    }
}

/// The comparison must notice faults: each fault causes an error that is large against the error of the route.
#[test]
fn planted_faults_are_noticed() {
    let steps = STEPS[0];
    let (four_bar, found) = run(Build::Multibody, Way::Differences, steps, GRAVITY);
    let good = worst(errors(&four_bar, &found));
    let reversed: Vec<_> = found.iter().map(|(time, own)| (*time, own.iter().map(reversed).collect())).collect();
    assert!(worst(errors(&four_bar, &reversed)) > 1.0, "a reversed sign");
    let late: Vec<_> = found.iter().map(|(time, own)| (time + 1e-2, own.clone())).collect();
    assert!(worst(errors(&four_bar, &late)) > 100.0 * good, "another instant");
    for way in [Way::Differences, Way::Probe] {
        let (four_bar, found) = run(Build::Multibody, way, steps, [0.0, 0.0]);
        let light = worst(errors(&four_bar, &found));
        assert!(light > 100.0 * good, "{way:?} without gravity: {light:.1e}, with gravity {good:.1e}");
        // Without gravity in the window, the reactions agree with the closed form without gravity.
        let rows = found.iter().map(|(time, own)| (four_bar.channels(own), exact_with(*time, [0.0, 0.0], LOAD)));
        for (read, exact) in rows {
            let wrong = (0..CHANNELS).map(|k| (read[k] - exact[k]).abs() / ranges()[k]).fold(0.0, most);
            assert!(wrong < 2.0 * good, "{wrong:.1e}");
        }
    }
}

fn reversed(of: &JointReaction) -> JointReaction {
    JointReaction { force: of.force.map(|value| -value), moment: -of.moment, ..*of }
}

/// The reactions that are read differ clearly from the closed form without the load.
#[test]
fn loads_are_taken_into_account() {
    let (four_bar, found) = run(Build::Impulse, Way::Differences, STEPS[0], GRAVITY);
    let (time, reactions) = &found[3];
    let (read, without) = (four_bar.channels(reactions), exact_with(*time, GRAVITY, ([0.0; 2], 0.0)));
    let apart = (0..CHANNELS).map(|k| (read[k] - without[k]).abs() / ranges()[k]).fold(0.0, most);
    assert!(apart > 0.05, "the load matters: {apart:.1e}");
}

/// Reactions of a joint of the tree come from differences and probes only; a motor has its moment in `efforts`.
#[test]
fn every_joint_is_read() {
    let steps = STEPS[0];
    let (four_bar, found) = run(Build::Multibody, Way::Impulses, steps, GRAVITY);
    let read = four_bar.channels(&found[0].1);
    assert_eq!(read.map(f64::is_nan), [true, true, true, true, false, false, true, true, false]);
    for way in [Way::Differences, Way::Probe] {
        let (four_bar, found) = run(Build::Multibody, way, steps, GRAVITY);
        assert!(four_bar.channels(&found[0].1).iter().all(|value| value.is_finite()));
        assert_eq!(found[0].1.len(), 5);
        let motor = found[0].1.iter().find(|own| own.efforts[2] != 0.0).unwrap();
        assert_eq!(motor.efforts[2], motor.moment);
        assert_eq!(motor.bodies[1], four_bar.links[0]);
    }
}
