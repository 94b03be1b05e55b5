//! Compares the derivatives with difference quotients.
//! For these quotients, the crate `precise` solves files with changed numbers.

use std::f64::consts::TAU;

use scenario::{CaseKey, KeySort, StartRequest};

use super::*;

fn of_repository(name: &str) -> Scenario {
    fixtures::of_repository(&format!("scenarios/{name}.toml"))
}

fn question(figures: &[&str]) -> SensitivityQuestion {
    let figures = figures.iter().map(|text| text.parse().unwrap()).collect();
    SensitivityQuestion { figures, ..SensitivityQuestion::default() }
}

/// Changes one number of a file, and computes the figures with the precise solver.
/// A finite change may move an extreme to another instant of the grid. The value is therefore read at the instant of
/// the extreme in the unchanged file.
fn precise_figures(scenario: &Scenario, found: &Sensitivity, key: &CaseKey, value: f64) -> Vec<f64> {
    let asked = StartRequest { set: vec![(key.name.clone(), value)], ..StartRequest::default() };
    let moved = Scenario::parse_as(&scenario.text, &scenario.path, &asked).unwrap();
    let run = precise::solve(&moved.case).unwrap();
    let one = |own: &FigureSlopes| {
        let claim = own.figure.claim(&moved.case).unwrap();
        let values = scenario::sampled_values(&claim, &run).unwrap();
        match (own.figure.statistic, own.sampled.rows.as_slice()) {
            (Statistic::MaxAbs, [row]) => values[*row].abs(),
            (_, [row]) => values[*row],
            (_, [most, least]) => values[*most] - values[*least],
            _ => own.figure.of(&run, &values).unwrap().value,
        }
    };
    found.figures.iter().map(one).collect()
}

/// A small change of a key. For a dimension or parameter, it is 0.4 % of the smallest nonzero number of the same unit,
/// or of 10 if that is smaller. For any other key, it is 0.4 % of the key's reference value: see [`size_of`].
fn small_change(key: &CaseKey, all: &[CaseKey]) -> f64 {
    let alike = all.iter().filter(|own| own.unit == key.unit && own.value != 0.0).map(|own| own.value.abs());
    match key.sort {
        // All angles of the file may be zero. The change is then 0.4 % of 10.
        KeySort::Dimension | KeySort::Parameter => 4e-3 * alike.fold(10.0, f64::smaller),
        KeySort::Mass | KeySort::Law | KeySort::Load | KeySort::Other => 4e-3 * size_of(key, all),
    }
}

/// The reference value of a key: the magnitude of its number. If the number is zero, the reference value is the
/// largest number of the same unit.
fn size_of(key: &CaseKey, all: &[CaseKey]) -> f64 {
    let alike = all.iter().filter(|own| own.unit == key.unit).map(|own| own.value.abs());
    let most = alike.fold(0.0, f64::larger);
    match (key.value != 0.0, most > 0.0) {
        (true, _) => key.value.abs(),
        (false, true) => most,
        (false, false) => 1.0,
    }
}

/// Central differences with three widths, extrapolated to remove the errors of second and fourth order.
fn differences(scenario: &Scenario, found: &Sensitivity, key: &CaseKey) -> Vec<f64> {
    let width = small_change(key, &found.keys);
    let central = |h: f64| -> Vec<f64> {
        let [up, down] = [h, -h].map(|h| precise_figures(scenario, found, key, key.value + h));
        up.iter().zip(down).map(|(up, down)| (up - down) / (2.0 * h)).collect()
    };
    let [one, half, quarter] = [1.0, 0.5, 0.25].map(|part| central(width * part));
    (0..one.len())
        .map(|k| {
            let [first, second] = [(one[k], half[k]), (half[k], quarter[k])].map(|(a, b)| (4.0 * b - a) / 3.0);
            (16.0 * second - first) / 15.0
        })
        .collect()
}

/// Compares all derivatives. `share` is the largest allowed error, divided by the largest effect of a key.
fn compare(scenario: &Scenario, asked: &SensitivityQuestion, share: f64) -> usize {
    let found = sensitivity(scenario, asked).unwrap();
    let by: Vec<Vec<f64>> = found.keys.iter().map(|key| differences(scenario, &found, key)).collect();
    for (index, figure) in found.figures.iter().enumerate() {
        // The effect of a key is the derivative by the key times the reference value of the key. Effects of keys with
        // different units can be compared.
        let size = |k: usize| size_of(&found.keys[k], &found.keys);
        let most = (0..by.len()).map(|k| (figure.by[k] * size(k)).abs()).fold(0.0, f64::larger);
        for (k, key) in found.keys.iter().enumerate() {
            let off = (figure.by[k] - by[k][index]).abs() * size(k) / most;
            assert!(off <= share, "{} {}: {} and {}, {off:e}", figure.figure, key.name, figure.by[k], by[k][index]);
        }
    }
    found.keys.len()
}

#[test]
fn a_crank_rocker_has_the_derivatives_of_differences() {
    let figures = ["max:joint.A.f_N", "maxabs:drive.torque_N_m", "mean:drive.torque_N_m", "rms:joint.B.fx_N"];
    let keys = compare(&of_repository("crank_rocker"), &question(&figures), 1e-10);
    assert!(keys >= 10, "{keys}");
}

#[test]
fn the_needle_drive_has_the_derivatives_of_differences() {
    let figures = ["max:joint.3a.f_N", "maxabs:drive.torque_N_m", "range:point.9.x_mm"];
    let keys = compare(&of_repository("ov7_base"), &question(&figures), 1e-10);
    assert!(keys >= 60, "{keys}");
}

#[test]
fn loads_laws_and_several_drives_have_the_derivatives_of_differences() {
    for (name, figures, share) in [
        ("loaded_slider", ["max:drive.torque_N_m", "min:joint.A.fx_N"], 1e-10),
        ("cycloidal_start", ["maxabs:drive.torque_N_m", "rms:drive.torque_N_m"], 1e-10),
        ("five_bar", ["maxabs:drive.torque_N_m", "range:drive.torque_N_m"], 1e-10),
        ("boom_lift", ["maxabs:drive.force_N", "mean:drive.force_N"], 1e-10),
        // Tables of loads are evaluated in doubles, so the differences have fewer digits.
        ("offset_press", ["max:drive.torque_N_m", "mean:drive.torque_N_m"], 1e-8),
    ] {
        println!("{name}");
        let scenario = of_repository(name);
        // A changed number may shorten a law. The law must still reach the last instant of the grid.
        let text = scenario.text.replace("to_s = 0.2", "to_s = 0.18").replace("to_s = 4", "to_s = 1");
        let scenario = Scenario::parse(&text, &scenario.path).unwrap();
        compare(&scenario, &question(&figures), share);
    }
}

#[test]
fn unsupported_cases_are_refused() {
    for (name, part) in
        [("slider_crank_friction", "friction"), ("cam_follower", "transmissions"), ("ov7_new_runup", "free")]
    {
        let scenario = of_repository(name);
        let figure = format!("max:{}", scenario.case.all_channels()[1]);
        let error = sensitivity(&scenario, &question(&[&figure])).unwrap_err();
        assert!(error.message().contains(part), "{name}: {error}");
        assert_eq!(error.kind(), ErrorKind::Unsupported);
    }
    let mut asked = question(&["max:joint.A.f_N"]);
    asked.keys = vec!["links.crank.mass".into()];
    let error = sensitivity(&of_repository("crank_rocker"), &asked).unwrap_err();
    assert!(error.to_string().contains("links.crank.mass_kg"), "{error}");
    let reduced = question(&["max:drive.reduced_inertia_kg_m2"]);
    assert!(sensitivity(&of_repository("crank_rocker"), &reduced).unwrap_err().message().contains("masses"));
}

#[test]
fn kinks_are_told() {
    let scenario = of_repository("crank_rocker");
    let found = sensitivity(&scenario, &question(&["maxabs:joint.O.fx_N - joint.O.fx_N"])).unwrap();
    assert!(found.figures[0].has_kink && found.figures[0].by[0].is_nan());
    // The mass centre lies on the pivot at all instants. Away from it, its coordinate is a cosine, so that its maximum
    // grows in both senses. The angular velocity is the same at all instants too, but so is its derivative.
    let text = scenario.text.replace("mass_centre = { x_m = 0.0129978138701685", "mass_centre = { x_m = 0");
    assert!(text != scenario.text);
    let centred = Scenario::parse(&text, &scenario.path).unwrap();
    let figures = ["max:link.crank.x_m", "range:link.crank.x_m", "max:link.crank.omega_rad_s"];
    let keys = ["links.crank.mass_centre.x_m", "drive.speed_rpm"];
    let asked = SensitivityQuestion { keys: keys.map(String::from).to_vec(), ..question(&figures) };
    let found = sensitivity(&centred, &asked).unwrap();
    let by = |index: usize| (found.figures[index].has_kink, found.figures[index].by.clone());
    for index in [0, 1] {
        assert!(matches!(by(index), (true, by) if by[0].is_nan() && by[1] == 0.0), "{:?}", found.figures[index]);
    }
    assert!(
        matches!(by(2), (false, by) if by[0] == 0.0 && (by[1] - TAU / 60.0).abs() < 1e-12),
        "{:?}",
        found.figures[2]
    );
    // The slide moves along y, so that x is zero up to rounding at all instants, until the guide is inclined.
    let tangent = of_repository("tangent");
    let asked = SensitivityQuestion { keys: vec!["joints.bed.axis_deg".into()], ..question(&["range:link.block.x_m"]) };
    let found = sensitivity(&tangent, &asked).unwrap();
    assert!(
        found.figures[0].has_kink && found.figures[0].relative(&found.keys, 0).is_none_or(f64::is_nan),
        "{found:?}"
    );
    // The acceleration of the yoke is zero up to rounding at 90 deg.
    let yoke = of_repository("scotch_yoke");
    let keys = vec!["links.crank.points.O.y_mm".into()];
    let asked = SensitivityQuestion { keys, ..question(&["at=90:link.yoke.a_m_s2", "at=60:link.yoke.a_m_s2"]) };
    let found = sensitivity(&yoke, &asked).unwrap();
    assert_eq!([0, 1].map(|index| found.figures[index].has_kink), [true, false], "{found:?}");
    // The square of a sine has two equal maxima per turn.
    let found = sensitivity(&scenario, &question(&["max:sin(link.crank.angle_rad)^2", "max:point.A.y_m"])).unwrap();
    assert!(found.figures[0].rival.is_some(), "{:?}", found.figures[0]);
    assert!(found.figures[1].rival.is_none(), "{:?}", found.figures[1]);
}

#[test]
fn stacks_agree_with_samples_for_small_tolerances() {
    let scenario = of_repository("crank_rocker");
    let asked = question(&["max:joint.A.f_N", "max:point.D.y_m"]);
    let found = sensitivity(&scenario, &asked).unwrap();
    let tolerances: Vec<KeyTolerance> = [("links.rocker.mass_kg", 0.1), ("links.coupler.points.B.x_m", 1e-7)]
        .map(|(key, limit)| KeyTolerance { key: key.into(), limit })
        .to_vec();
    let stacks = stacks(&scenario, &asked, &found, &tolerances, (60, 1)).unwrap();
    for (stack, figure) in stacks.iter().zip(&found.figures) {
        let off = (stack.sampled_deviation - stack.linear_deviation).abs() / stack.linear_deviation;
        assert!(off < 0.02, "{}: {stack:?}", figure.figure);
        assert!(stack.worst >= stack.root_sum_square && stack.root_sum_square > stack.linear_deviation);
        assert!(stack.sampled_ends.iter().all(|own| own.abs() <= 1.02 * stack.worst), "{stack:?}");
        assert_eq!(stack.unsolved, 0);
        match stack.limit {
            LinearLimit::From(multiple) | LinearLimit::UntilUnsolved(multiple) => assert!(multiple > 1.0, "{stack:?}"),
            LinearLimit::Beyond(multiple) => assert_eq!(multiple, 1024.0),
        }
    }
    let wrong = KeyTolerance { key: "links.rocker.mass_g".into(), limit: 1.0 };
    assert!(super::stacks(&scenario, &asked, &found, &[wrong], (10, 1)).is_err());
}
