//! JSON answers to questions about a mechanism.
//! Every number equals the library's number, and has the promised key and unit.

use std::f64::consts::{PI, TAU};
use std::fs;
use std::path::Path;

use analytic::range::{Extent, Range, ValueAtCrank};
use analytic::reduced::ReducedModel;
use analytic::reduced::means::means_over_turn;
use analytic::{AssurSolver, NewtonSolver};
use design::bearings::{Peak, over_range};
use design::clearance::{Meeting, course, find};
use design::drive::motor::MotorChoice;
use linkage::case::{Case, Grid};
use linkage::drive::{DriveMotion, Load};
use linkage::math::{KeepNan, Vec2};
use linkage::solver::Solver;
use scenario::Scenario;
use scenario::clearance::ClearanceQuestion;
use serde_json::{Value, json};

use super::tools::{Place, Table};
use crate::common::assert_within;
use crate::common::spec::four_bar;

fn scenario(place: &Place, name: &str) -> Scenario {
    Scenario::load(place.path(&format!("scenarios/{name}.toml"))).unwrap()
}

fn point(at: Vec2) -> Value {
    json!([at.x, at.y])
}

/// A parallelogram that passes its change point smoothly. Near the change point no clearance is proven.
fn smooth() -> String {
    let mut spec = four_bar([0.4, 0.1, 0.4, 0.1], false);
    (spec.start, spec.dt) = (60f64.to_radians(), None);
    spec.grid = (spec.start, 10f64.to_radians(), 18);
    spec.other.drive = "speed_rad_s = 2\nthrough = \"smooth\"".into();
    spec.other.sections = "[clearance]\nradius_mm = 2\narea_rel = 0.2\n[[clearance.housing]]\nname = \"post\"\n\
                           line = [{ x_mm = 200, y_mm = 300 }]\nradius_mm = 3\n"
        .into();
    spec.toml()
}

/// Three cases: a collision, a collision in a backward motion, and an undecided clearance.
#[test]
fn a_clearance_is_reported_in_json_csv_and_text() {
    let place = Place::new();
    let coarse = ("wanted_mm = 0.4", "wanted_mm = 0.4\narea_rel = 0.05");
    place.edited("crankcase.toml", "longer.toml", &[("x_mm = 130,", "x_mm = 132,"), coarse]);
    place.edited(
        "crankcase.toml",
        "back.toml",
        &[
            ("speed_rpm = 600", "speed_rpm = -600"),
            ("from_deg = 0\nto_deg = 360\nstep_deg = 2", "from_deg = 0\nto_deg = -360\nstep_deg = -2"),
            ("x_mm = 130,", "x_mm = 132,"),
            coarse,
        ],
    );
    fs::write(place.path("scenarios/smooth.toml"), smooth()).unwrap();
    for (name, standing, code) in [("longer", "collides", 1), ("back", "collides", 1), ("smooth", "not proven", 3)] {
        let scenario = scenario(&place, name);
        let asked = scenario.clearance.as_ref().unwrap();
        let found = find(&scenario.case, asked, &mut |_| ()).unwrap();
        let outcome = place.run(&format!("clearance scenarios/{name}.toml --json -"));
        assert_eq!(outcome.code, code, "{name}");
        let document = outcome.json();
        let own = &document["scenarios"][0];
        let time = |crank: f64| json!(scenario.case.crank().time_of(crank));
        let meeting = |meeting: Option<Meeting>| {
            meeting.map(|own| {
                // A collision is reported with two crank angles: the bodies are apart up to the first angle, and touch
                // at the second angle.
                assert!((own.cranks[0] - found.range[0]).abs() <= (own.cranks[1] - found.range[0]).abs());
                let [until, at] = own.cranks;
                json!({"clear_until_rad": until, "crank_rad": at, "t_s": time(at), "place_m": point(own.place)})
            })
        };
        assert_eq!(own["standing"], standing, "{name}");
        assert_eq!(own["range_rad"], json!(found.range));
        assert_eq!([&own["wanted_m"], &own["tolerance_m"]], [&json!(asked.wanted), &json!(found.tolerance)]);
        let names = |bodies: [usize; 2]| json!(bodies.map(|body| asked.bodies[body].name.clone()));
        assert_eq!(own["pairs"].as_array().unwrap().len(), found.pairs.len());
        for (row, pair) in own["pairs"].as_array().unwrap().iter().zip(&found.pairs) {
            let least = &pair.smallest;
            let wanted = json!({
                "bodies": names(pair.bodies), "smallest_m": least.distance, "proven_least_m": least.least,
                "crank_rad": least.crank, "t_s": time(least.crank), "points_m": [point(least.points[0]), point(least.points[1])],
                "collision": meeting(pair.collision), "too_near": meeting(pair.too_near),
            });
            assert_eq!(*row, wanted, "{name}");
        }
        assert_eq!(own["swept"].as_array().unwrap().len(), found.swept.len());
        for (row, (body, area)) in own["swept"].as_array().unwrap().iter().zip(&found.swept) {
            let [value, error] = ["area_m2", "error_m2"].map(|key| row[key].as_f64().unwrap());
            assert_eq!((row["link"].as_str(), value), (Some(asked.bodies[*body].name.as_str()), area.value));
            assert!(value - error <= area.least && area.most <= value + error, "{name}: {row}");
            assert_eq!([&row["least_m2"], &row["most_m2"]], [&json!(area.least), &json!(area.most)]);
        }
        // The first contact is the earliest one in the direction of the drive, which may be backwards.
        for (key, all) in [("first_collision", false), ("first_too_near", true)] {
            let gone = |own: &Meeting| (own.cranks[1] - found.range[0]).abs();
            let each =
                found.pairs.iter().filter_map(|pair| Some((pair, if all { pair.too_near } else { pair.collision }?)));
            let first = each.min_by(|a, b| gone(&a.1).total_cmp(&gone(&b.1)));
            let wanted = first.map(|(pair, own)| json!({"bodies": names(pair.bodies), "at": meeting(Some(own))}));
            assert_eq!(own[key], json!(wanted), "{name}: {key}");
        }
        assert_eq!(own["not_proven_rad"], json!(found.open));
        let work = [found.work.poses, found.work.distances, found.work.positions, found.work.squares];
        assert_eq!(
            ["poses", "distances", "area_poses", "squares"].map(|key| own["work"][key].as_u64().unwrap() as usize),
            work
        );
        if name == "longer" {
            in_text(&place, name, asked, &found);
            in_table(&place, name, &scenario.case, asked);
        }
    }
}

fn in_text(place: &Place, name: &str, asked: &ClearanceQuestion, found: &design::clearance::ClearanceResult) {
    let text = place.run(&format!("clearance scenarios/{name}.toml")).stdout;
    let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split_whitespace().collect()).collect();
    for pair in &found.pairs {
        let names = pair.bodies.map(|body| asked.bodies[body].name.as_str());
        let first = format!("{},", names[0]);
        let row = rows.iter().find(|row| row.starts_with(&[first.as_str(), names[1]]));
        let row = row.unwrap_or_else(|| panic!("{names:?} in {text}"));
        assert_eq!(row[2], format!("{:.4}", 1e3 * pair.smallest.distance), "{text}");
        // The last column contains the first collision; without a collision, the column is empty.
        if let Some(meeting) = pair.collision {
            assert_eq!(row[row.len() - 1], format!("{:.4}", meeting.cranks[1].to_degrees()), "{text}");
        }
    }
    let areas = rows.iter().position(|row| row.starts_with(&["swept", "area"])).unwrap();
    for (body, area) in &found.swept {
        let own = rows[areas..].iter().find(|row| row.first() == Some(&asked.bodies[*body].name.as_str())).unwrap();
        // Areas are in square millimetres.
        let told: Vec<f64> = own[1..5].iter().map(|cell| cell.parse().unwrap()).collect();
        for (told, value) in told.iter().zip([area.value, area.error(), area.least, area.most]) {
            assert_within!((told - 1e6 * value).abs(), 0.005_000_1, "{text}");
        }
    }
}

fn in_table(place: &Place, name: &str, case: &Case, asked: &ClearanceQuestion) {
    let table = Table::of(&place.run(&format!("clearance scenarios/{name}.toml --csv -")).stdout);
    let right = course(case, asked).unwrap();
    assert_eq!((table.column("t_s"), table.column("crank_rad")), (case.grid.times.clone(), right.cranks.clone()));
    for (index, pair) in asked.pairs.iter().enumerate() {
        let [a, b] = pair.map(|body| &asked.bodies[body].name);
        let wanted: Vec<f64> = right.rows.iter().map(|row| row[index]).collect();
        assert_eq!(table.column(&format!("{a}.{b}.distance_m")), wanted);
    }
}

/// Three mechanisms that rotate fully, one of them with sliders, and one mechanism with limits.
#[test]
fn a_range_is_reported_in_json() {
    let place = Place::new();
    let limited = [
        ("A = { x_m = 0.025995627740337, y_m = 0 }", "A = { x_m = 0.15, y_m = 0 }"),
        ("crank_deg = 0\n", "crank_deg = 90\n"),
    ];
    place.edited("crank_rocker.toml", "limited.toml", &limited);
    for name in ["crank_rocker", "limited", "quick_return", "ov7_base"] {
        let scenario = scenario(&place, name).nominal();
        let range = Range::of(&scenario.case).unwrap();
        let told = place.run(&format!("inspect scenarios/{name}.toml --range --json -")).json()["range"].clone();
        let extent = match range.extent {
            Extent::FullTurn(turns) => json!({"full_turn": true, "turns_to_same_pose": turns}),
            Extent::Limited([from, to]) => {
                assert!(from.crank < to.crank);
                json!({"full_turn": false, "from_rad": from.crank, "to_rad": to.crank})
            }
        };
        assert_eq!(told["extent"], extent, "{name}");
        let links = told["links"].as_array().unwrap();
        assert_eq!(links.len(), range.links.len());
        for (row, link) in links.iter().zip(&range.links) {
            assert_eq!(row["name"], scenario.case.mechanism.links()[link.link].name);
            for (key, end) in ["least", "greatest"].into_iter().zip(link.angles) {
                assert_eq!(row[key], json!({"crank_rad": end.crank, "angle_rad": end.value}), "{name}");
            }
            assert_eq!(row["turns"], link.turns);
            let extremes = link.extremes.iter();
            let extremes: Vec<Value> = extremes
                .map(|own| json!({"crank_rad": own.crank, "angle_rad": own.angle, "greatest": own.is_greatest}))
                .collect();
            assert_eq!(row["extremes"], json!(extremes), "{name}");
        }
        for (index, (row, group)) in told["groups"].as_array().unwrap().iter().zip(&range.groups).enumerate() {
            let ValueAtCrank { crank, value } = group.determinant;
            assert_eq!(row["least_determinant"], json!({"crank_rad": crank, "determinant": value}));
            // The determinant of a dyad is the sine of its transmission angle, so its magnitude must equal the sine of
            // the reported angle.
            if let Some(angle) = row["least_transmission_angle_rad"].as_f64() {
                assert_within!((angle.sin() - value.abs()).abs(), 1e-15, "{name}");
            }
            let worst = group.condition.as_ref().map(|own| json!({"crank_rad": own.crank, "condition": own.value}));
            assert_eq!(row["largest_condition"], json!(worst));
            let sampled = &told["samples"]["groups"][index];
            let of = |of: fn(&analytic::range::GroupCondition) -> f64| -> Value {
                json!(range.samples.iter().map(|own| of(&own.groups[index])).collect::<Vec<f64>>())
            };
            assert_eq!(sampled["determinant"], of(|own| own.determinant), "{name}");
            assert_eq!(sampled["condition"], of(|own| own.condition), "{name}");
        }
        let bar = range.four_bar.as_ref().map(|own| {
            let [frame, driver, coupler, output] = own.lengths;
            json!({"type": own.of_type.name(), "frame_m": frame, "driver_m": driver, "coupler_m": coupler, "output_m": output})
        });
        assert_eq!(told["four_bar"], json!(bar), "{name}");
    }
    // The text gives the angle that the rocker sweeps between its extremes.
    let text = place.ok("inspect scenarios/crank_rocker.toml --range");
    assert!(text.contains("over 32.000000 deg"), "{text}");
}

/// The answer gives journal diameters for revolute joints, and moments for prismatic joints.
/// Lever and stress, given in mm and MPa, are reported in m and Pa.
#[test]
fn bearings_are_reported_in_json() {
    let place = Place::new();
    for name in ["crank_rocker", "quick_return", "six_bar_slider"] {
        let scenario = scenario(&place, name).nominal();
        let peaks = over_range(&scenario.case).unwrap();
        let told = place.run(&format!("bearings scenarios/{name}.toml --lever-mm 12 --stress-mpa 150 --json -")).json();
        let peak = |own: Peak, unit: &str| json!({unit: own.value, "crank_rad": own.crank});
        assert_eq!([&told["lever_m"], &told["stress_Pa"]], [&json!(0.012), &json!(150e6)]);
        assert_eq!(told["shaking_force"], peak(peaks.shaking_force, "N"));
        assert_eq!(told["balancing_moment"], peak(peaks.balancing_moment, "N_m"));
        // On the grid, the largest reactions and moments of side 2 are within 1 % of the reported ones, and not larger.
        let solved = NewtonSolver.solve(&scenario.case).unwrap();
        let sizes = |names: &[String]| -> Vec<f64> {
            let columns: Vec<&[f64]> = names.iter().map(|name| solved.named(name).unwrap()).collect();
            (0..solved.times().len())
                .map(|row| columns.iter().map(|own| own[row].powi(2)).sum::<f64>().sqrt())
                .collect()
        };
        let holds = |what: &str, peak: f64, sizes: Vec<f64>| {
            let most = sizes.into_iter().fold(0.0, f64::larger);
            assert!(most <= peak * (1.0 + 1e-9) && peak <= 1.01 * most + 1e-9, "{name} {what}: {most} {peak}");
        };
        holds("drive", peaks.balancing_moment.value, sizes(&["drive.torque_N_m".into()]));
        for (index, (row, joint)) in
            told["joints"].as_array().unwrap().iter().zip(scenario.case.mechanism.joints()).enumerate()
        {
            let reaction = peaks.reactions[index];
            assert_eq!((row["joint"].as_str(), &row["reaction"]), (Some(&*joint.name), &peak(reaction, "N")));
            let forces = ["fx_N", "fy_N"].map(|own| format!("joint.{}.{own}", joint.name));
            holds(&joint.name, reaction.value, sizes(&forces));
            assert_eq!(row["moment"], json!(peaks.moments[index].map(|own| peak(own, "N_m"))));
            if let Some(moment) = peaks.moments[index] {
                holds(&joint.name, moment.value, sizes(&[format!("joint.{}.moment_N_m", joint.name)]));
            }
            match row["smallest_journal_m"].as_f64() {
                // The bending stress of a round journal, 32 M / (pi d^3), equals the permissible stress.
                Some(diameter) => {
                    let stress = 32.0 * reaction.value * 0.012 / (PI * diameter.powi(3));
                    assert_within!((stress / 150e6 - 1.0).abs(), 1e-12, "{name} {}", joint.name);
                    assert!(joint.is_pin());
                }
                None => assert!(!joint.is_pin(), "{name} {}", joint.name),
            }
        }
    }
}

/// The reported least and greatest values of inertia and resistance are near those of the table in the answer.
/// The slope column is the derivative of the inertia column.
#[test]
fn a_drive_is_reported_in_json_and_its_run_up_in_csv() {
    let place = Place::new();
    let name = "crank_rocker";
    let scenario = scenario(&place, name).nominal();
    let sense = scenario.case.crank().sense();
    let told = place.run(&format!("drive scenarios/{name}.toml --step-deg 0.5 --json -")).json();
    let column = |key: &str| -> Vec<f64> {
        told["by_angle"][key].as_array().unwrap().iter().map(|own| own.as_f64().unwrap()).collect()
    };
    let [cranks, inertia, slopes, resistance] =
        ["crank_rad", "inertia_kg_m2", "inertia_slope_kg_m2", "resistance_N_m"].map(column);
    let ends =
        |own: &[f64]| own.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], &x| [a.smaller(x), b.larger(x)]);
    for (key, values) in [("inertia_kg_m2", &inertia), ("resistance_N_m", &resistance)] {
        let [least, greatest] = ends(values);
        for (end, wanted) in [("least", least), ("greatest", greatest)] {
            let [value, crank] = ["value", "crank_rad"].map(|part| told[key][end][part].as_f64().unwrap());
            assert_within!((value - wanted).abs(), 5e-3 * greatest, "{name} {key} {end}");
            // Angles that differ by whole revolutions are the same pose.
            let apart = |row: usize| ((cranks[row] - crank + PI).rem_euclid(TAU) - PI).abs();
            let row = (0..cranks.len()).min_by(|&a, &b| apart(a).total_cmp(&apart(b)));
            assert_within!((values[row.unwrap()] - value).abs(), 2e-2 * greatest, "{name} {key} {end}: {crank}");
        }
        // Over whole revolutions, the mean of evenly spaced values equals the integral mean.
        let rows = values.len() - 1;
        let mean = values[..rows].iter().sum::<f64>() / rows as f64;
        let told = told[key]["mean"].as_f64().unwrap();
        assert_within!((told - mean).abs(), 1e-3 * greatest, "{name} {key}: {told} {mean}");
    }
    for k in 1..cranks.len() - 1 {
        let slope = (inertia[k + 1] - inertia[k - 1]) / (cranks[k + 1] - cranks[k - 1]);
        assert_within!((slope - slopes[k]).abs(), 1e-2, "{name} {k}: {slope} {}", slopes[k]);
    }
    // The reported slowest and fastest speeds of the steady motion equal the extremes of the reported column of speeds,
    // to 1e-3 rad/s.
    let speeds: Vec<f64> = column("omega_rad_s").iter().map(|own| own * sense).collect();
    for (key, wanted) in ["slowest", "fastest"].into_iter().zip(ends(&speeds)) {
        let found = sense * told["steady"][key]["omega_rad_s"].as_f64().unwrap();
        assert_within!((found - wanted).abs(), 1e-3, "{name} {key}: {found} {wanted}");
    }
    let model = ReducedModel::of(&scenario.case).unwrap();
    assert_eq!(told["motor_and_reducer_kg_m2"], json!(model.added_inertia()));

    // Checks the run-up row by row: accelerations are the derivatives of speeds.
    let table = Table::of(&place.ok(&format!("drive scenarios/{name}.toml --run-up - --seconds 0.1 --points 200")));
    let [times, speeds, rates] = ["t_s", "crank_omega_rad_s", "crank_alpha_rad_s2"].map(|name| table.column(name));
    let (angles, of_link) = (table.column("crank_rad"), table.column("link.crank.omega_rad_s"));
    assert_eq!(speeds, of_link, "{name}");
    for k in 1..times.len() - 1 {
        let by = times[k + 1] - times[k - 1];
        let [speed, rate] = [&angles, &speeds].map(|own| (own[k + 1] - own[k - 1]) / by);
        assert_within!((speed - speeds[k]).abs(), 2e-2, "{name} {k}");
        assert_within!((rate - rates[k]).abs(), 1e-2 * rates[0].abs() + 1e-2 * rates[k].abs(), "{name} {k}");
    }
}

/// The vectors of a plan are the differences of its points.
/// The length of a vector on paper is its magnitude divided by the scale.
#[test]
fn a_plan_is_reported_in_json() {
    let place = Place::new();
    for name in ["crank_rocker", "quick_return", "fourth_class"] {
        let scenario = scenario(&place, name).nominal();
        let told = place.run(&format!("plan scenarios/{name}.toml --crank-deg 70 --json -")).json();
        let solved = place.ok(&format!("solve scenarios/{name}.toml --with newton --times {}", {
            scenario.case.crank().time_of(70f64.to_radians())
        }));
        let solved = Table::of(&solved);
        for (key, suffix) in [("velocity", ["vx_m_s", "vy_m_s"]), ("acceleration", ["ax_m_s2", "ay_m_s2"])] {
            let plan = &told[key];
            let scale = plan["scale_per_mm"].as_f64().unwrap();
            let number = |own: &Value, key: &str| own[key].as_f64().unwrap();
            let points: Vec<(&str, Vec2)> = (plan["points"].as_array().unwrap().iter())
                .map(|own| (own["letter"].as_str().unwrap(), Vec2::new(number(own, "x"), number(own, "y"))))
                .collect();
            let at = |letter: &Value| points.iter().find(|(own, _)| Some(*own) == letter.as_str()).unwrap().1;
            let mut checked = 0;
            for vector in plan["vectors"].as_array().unwrap() {
                let own = Vec2::new(number(vector, "x"), number(vector, "y"));
                let size = own.norm();
                let off = (at(&vector["to"]) - at(&vector["from"]) - own).norm();
                assert_within!(off, 1e-12 * (1.0 + size), "{name} {vector}");
                assert_within!((number(vector, "size") - size).abs(), 1e-15 * size, "{name} {vector}");
                assert_within!(
                    (number(vector, "paper_mm") - size / scale).abs(),
                    1e-12 * size / scale,
                    "{name} {vector}"
                );
            }
            for (letter, at) in &points {
                let columns = suffix.map(|own| format!("point.{}.{own}", letter.to_uppercase()));
                if solved.header.contains(&columns[0]) {
                    let right = Vec2::new(solved.column(&columns[0])[0], solved.column(&columns[1])[0]);
                    assert_within!((at - right).norm(), 1e-8 * (1.0 + right.norm()), "{name} {letter}");
                    checked += 1;
                }
            }
            assert!(checked > 0, "{name} {key}");
        }
    }
}

/// The numbers of a choice in JSON equal those of the library; power is moment times speed.
#[test]
fn a_choice_of_a_motor_is_reported_in_json() {
    let place = Place::new();
    let catalogue = Path::new(env!("CARGO_MANIFEST_DIR")).join("catalogues/motors.toml");
    let told = place
        .run(&format!(
            "drive scenarios/crank_rocker.toml --catalogue {} --efficiency 0.92 --json -",
            catalogue.display()
        ))
        .json();
    let number = |key: &str| told[key].as_f64().unwrap_or_else(|| panic!("no {key} in {told}"));
    let motors = design::drive::catalogue::load(&catalogue).unwrap();
    let case = scenario(&place, "crank_rocker").nominal().case;
    let choice = MotorChoice::of(&case, &motors, number("efficiency")).unwrap();
    assert_eq!(told["peak"], json!({"crank_rad": choice.peak.0, "moment_N_m": choice.peak.1}));
    for (key, wanted) in [
        ("wanted_rad_s", choice.wanted),
        ("peak_W", choice.peak.1 * choice.wanted),
        ("asked_W", choice.peak.1 * choice.wanted / number("efficiency")),
        ("shaft_mean_N_m", choice.mean / number("ratio") / number("efficiency")),
        ("shaft_peak_N_m", choice.peak.1 / number("ratio") / number("efficiency")),
        ("mean_N_m", means_over_turn(&case, &AssurSolver).unwrap().resistance),
    ] {
        assert_within!((number(key) / wanted - 1.0).abs(), 1e-9, "{key}: {} {wanted}", number(key));
    }
}

/// Solvers that read an exported case start in the start pose of the original case.
/// The test checks masses, states, drives and loads of cases with springs, motors and a backward drive.
#[test]
fn a_case_is_exported_in_json() {
    let place = Place::new();
    for name in ["crank_rocker_runup", "five_bar_on_a_spring", "double_pendulum", "n_four_bar_1", "loaded_slider"] {
        let scenario = scenario(&place, name);
        let case = &scenario.case;
        let told = place.run(&format!("export scenarios/{name}.toml --json -")).json();
        let first = NewtonSolver.solve(&case.on(Grid::of_times(case.crank(), vec![0.0, 1e-3])).unwrap());
        let first = first.unwrap();
        for (row, link) in told["links"].as_array().unwrap().iter().zip(case.mechanism.links()) {
            assert_eq!([&row["mass_kg"], &row["inertia_kg_m2"]], [&json!(link.mass), &json!(link.inertia)], "{name}");
            assert_eq!([&row["name"], &row["mass_centre_m"]], [&json!(link.name), &point(link.mass_centre)]);
            let value = |suffix: &str| first.named(&format!("link.{}.{suffix}", link.name)).map(|column| column[0]);
            let Some(angle) = value("angle_rad") else { continue };
            let start = &row["start"];
            let number = |key: &str| start[key].as_f64().unwrap();
            let [omega, alpha] = ["omega_rad_s", "alpha_rad_s2"].map(|key| value(key).unwrap());
            let near = |found: f64, wanted: f64, what: &str| {
                assert_within!((found - wanted).abs(), 1e-8 * (1.0 + wanted.abs()), "{name} {} {what}", link.name);
            };
            near((number("angle_rad") - angle + PI).rem_euclid(TAU), PI, "angle");
            near(number("omega_rad_s"), omega, "omega");
            near(number("alpha_rad_s2"), alpha, "alpha");
            // Motion of the mass centre, from the state of the frame's origin.
            let of = |key: &str| Vec2::new(start[key][0].as_f64().unwrap(), start[key][1].as_f64().unwrap());
            let arm = linkage::math::rotated(linkage::math::unit(angle), link.mass_centre);
            let turned = linkage::math::turned(arm);
            let states = [
                ("x_m", "y_m", of("origin_m") + arm),
                ("vx_m_s", "vy_m_s", of("velocity_m_s") + turned * omega),
                ("ax_m_s2", "ay_m_s2", of("acceleration_m_s2") + turned * alpha - arm * omega * omega),
            ];
            for (x, y, found) in states {
                near(found.x, value(x).unwrap(), x);
                near(found.y, value(y).unwrap(), y);
            }
        }
        for (row, drive) in told["drives"].as_array().unwrap().iter().zip(case.drives.iter()) {
            assert_eq!([&row["zero_rad"], &row["start_rad"]], [&json!(drive.zero), &json!(drive.start)], "{name}");
            if let DriveMotion::Free { initial_speed, nominal_speed, motor } = &drive.motion {
                let motion = &row["motion"];
                assert_eq!(motion["initial_speed_rad_s"], json!(initial_speed));
                assert_eq!(motion["sense"], json!(if *nominal_speed < 0.0 { -1.0 } else { 1.0 }), "{name}");
                if let Some(motor) = motor {
                    let own = &motion["motor"];
                    assert_eq!([&own["ratio"], &own["efficiency"]], [&json!(motor.ratio), &json!(motor.efficiency)]);
                    let inertia = own["inertia_on_crank_kg_m2"].as_f64().unwrap();
                    assert!(inertia > 0.0 && inertia == motor.inertia_on_crank());
                }
            }
        }
        let springs = case.loads.iter().zip(told["loads"].as_array().unwrap());
        for (load, row) in springs {
            if let Load::TorsionSpring { stiffness, free_angle, .. } = load {
                assert_eq!(
                    [&row["stiffness_N_m_rad"], &row["free_angle_rad"]],
                    [&json!(stiffness), &json!(free_angle)]
                );
            } else if let Load::Spring { stiffness, free_length, .. } = load {
                assert_eq!([&row["stiffness_N_m"], &row["free_length_m"]], [&json!(stiffness), &json!(free_length)]);
            }
        }
    }
}

/// Two tables: the first is right at the beginning and then has a known error; in the second, the time restarts.
#[test]
fn a_comparison_is_reported_in_json() {
    let place = Place::new();
    let table = Table::of(&place.ok("solve scenarios/crank_rocker.toml --with newton"));
    let [times, cranks, right] = ["t_s", "crank_rad", "point.B.x_m"].map(|name| table.column(name));
    let off = |row: usize| if row < 100 { 0.0 } else { 1e-3 - 2e-8 * (row as f64 - 250.0).powi(2) };
    let written = |rows: &mut dyn Iterator<Item = usize>, off: &dyn Fn(usize) -> f64| {
        let rows = rows.map(|row| format!("{:?},{:?}\n", times[row], right[row] + off(row)));
        fs::write(place.path("mine.csv"), format!("t_s,point.B.x_m\n{}", rows.collect::<String>())).unwrap();
        place.run("compare scenarios/crank_rocker.toml mine.csv --json -").json()["pairs"][0].clone()
    };
    let told = written(&mut (0..times.len()), &off);
    let own = &told["channels"][0];
    let squares: f64 = (0..times.len()).map(|row| off(row).powi(2)).sum();
    let rms = (squares / times.len() as f64).sqrt();
    assert_within!((own["rms"].as_f64().unwrap() - rms).abs(), 1e-9, "{own}");
    for (key, row) in [("since", 100), ("largest", 250), ("worst", 250)] {
        let at = &own[key];
        let number = |key: &str| at[key].as_f64().unwrap();
        assert_within!((number("t_s") - times[row]).abs(), 1e-9, "{key}: {own}");
        assert_within!((number("crank_deg") - cranks[row].to_degrees()).abs(), 1e-6, "{key}: {own}");
        assert_within!((number("difference").abs() - off(row)).abs(), 1e-9, "{key}: {own}");
        // `first` is the value of the analytic side, `second` that of the table.
        assert_within!((number("first") - right[row]).abs(), 1e-9, "{key}: {own}");
        assert_within!((number("second") - right[row] - off(row)).abs(), 1e-9, "{key}: {own}");
    }
    let ends = right.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], &x| [a.smaller(x), b.larger(x)]);
    let scale = own["scale"].as_f64().unwrap();
    assert!(scale > 10.0 * rms && scale <= ends[1] - ends[0] + ends[1].abs(), "{scale}");
    assert_eq!(told["jumps_back_in_row"], Value::Null);
    // The 51st row of the table is earlier than the 50th row.
    let told = written(&mut (0..50).chain(20..200), &|_| 0.0);
    assert_eq!(told["jumps_back_in_row"], 51);
}
