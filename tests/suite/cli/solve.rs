//! `linkproof solve`.

use std::fs;

use super::tools::{Place, Table};
use crate::common::{assert_within, shipped};

const SOLVERS: [&str; 3] = ["assur", "newton", "rapier"];
const ON_LINKS: &str = "angle_rad omega_rad_s alpha_rad_s2 x_m y_m vx_m_s vy_m_s ax_m_s2 ay_m_s2";
const AT_POINTS: &str = "x_m y_m vx_m_s vy_m_s ax_m_s2 ay_m_s2";

/// Channels of the mechanism as a whole.
/// In the documented header, these channels follow the channels of the links, points and joints.
const WHOLE: [&str; 4] = ["frame.fx_N", "frame.fy_N", "frame.moment_N_m", "drive.torque_N_m"];

fn header(links: &[&str], points: &[&str], joints: &[&str]) -> Vec<String> {
    let mut names = vec!["t_s".to_string(), "crank_rad".to_string()];
    for (subject, all, quantities) in
        [("link", links, ON_LINKS), ("point", points, AT_POINTS), ("joint", joints, "fx_N fy_N")]
    {
        for name in all {
            names.extend(quantities.split(' ').map(|quantity| format!("{subject}.{name}.{quantity}")));
        }
    }
    names.extend(WHOLE.map(String::from));
    names
}

/// The documented columns of a table, in the table's order.
fn documented(header: &[String], names: &[String]) -> Vec<String> {
    header.iter().filter(|own| names.contains(own)).cloned().collect()
}

#[test]
fn every_solver_gives_the_documented_columns_in_order() {
    let place = Place::new();
    let crank_rocker = header(&["crank", "coupler", "rocker"], &["A", "B", "D"], &["O", "A", "B", "C"]);
    let links = ["crank", "rod_23", "rocker_43", "rod_35", "rocker_65", "rod_57", "rocker_87"];
    let joints = ["1", "2", "3a", "4", "3b", "5a", "6", "5b", "7", "8"];
    let ov7 = header(&links, &["2", "3", "5", "7", "9"], &joints);
    for solver in SOLVERS {
        let table = Table::of(&place.ok(&format!("solve scenarios/crank_rocker.toml --with {solver}")));
        assert_eq!(documented(&table.header, &crank_rocker), crank_rocker, "{solver}");
        assert_eq!(table.header.len(), 2 + shipped("crank_rocker.toml").case.channels().len(), "{solver}");
        assert_eq!(table.rows.len(), 361, "one row a grid point");
        let few = format!("solve scenarios/ov7_base.toml --with {solver} --crank-deg 0:-10:-5");
        assert_eq!(documented(&Table::of(&place.ok(&few)).header, &ov7), ov7, "{solver}");
    }
}

#[test]
fn every_number_has_17_digits_and_reads_back_the_same() {
    let place = Place::new();
    for solver in SOLVERS {
        let table = Table::of(&place.ok(&format!("solve scenarios/crank_rocker.toml --with {solver}")));
        for cell in table.rows.iter().flatten() {
            let value: f64 = cell.parse().unwrap();
            assert!(value.is_finite() && format!("{value:.16e}") == *cell, "{cell}");
        }
    }
}

#[test]
fn a_file_has_the_same_content_as_standard_output() {
    let place = Place::new();
    let solve = "solve scenarios/crank_rocker.toml --with assur";
    let shown = place.ok(solve);
    assert_eq!(place.ok(&format!("{solve} --csv table.csv")), "");
    assert_eq!(fs::read_to_string(place.path("table.csv")).unwrap(), shown);
    assert_eq!(place.ok(&format!("{solve} --csv -")), shown);
}

#[test]
fn ranges_may_be_negative_and_reversed() {
    let place = Place::new();
    for solver in SOLVERS {
        let cranks = |range: &str| {
            let table = Table::of(&place.ok(&format!("solve scenarios/crank_rocker.toml --with {solver} {range}")));
            let rocker = table.column("link.rocker.angle_rad");
            (table.column("crank_rad"), table.column("t_s"), rocker)
        };
        let degrees = |all: &[f64]| all.iter().map(|angle| angle.to_degrees().round()).collect::<Vec<_>>();
        let (back, times, rocker_back) = cranks("--crank-deg 30:-30:-15");
        assert_eq!(degrees(&back), [30.0, 15.0, 0.0, -15.0, -30.0], "{solver}");
        // At 130 revolutions per minute, the crank rotates by 780 degrees per second.
        let late = times.iter().zip(&back).all(|(t, crank)| (t - crank.to_degrees() / 780.0).abs() < 1e-15);
        assert!(late, "{solver}: {times:?}");
        let (forth, _, mut rocker_forth) = cranks("--crank-deg=-30:30:15");
        assert_eq!(degrees(&forth), [-30.0, -15.0, 0.0, 15.0, 30.0]);
        rocker_forth.reverse();
        assert_eq!(rocker_back, rocker_forth, "{solver}: the results must not depend on the order of the grid");
        let (cranks, times, _) = cranks("--times 0.1:-0.1:-0.05");
        assert_eq!((times.len(), degrees(&cranks)), (5, vec![78.0, 39.0, 0.0, -39.0, -78.0]), "{solver}");
        assert_within!((times[4] + 0.1).abs(), 1e-15);
    }
}

#[test]
fn the_crank_angle_is_measured_as_in_the_scenario() {
    let place = Place::new();
    // In ov7_base, crank angles are measured from a direction at 181.84 degrees.
    // In crank_rocker, crank angles are measured from the x axis.
    let solve =
        |name: &str| Table::of(&place.ok(&format!("solve scenarios/{name}.toml --with assur --crank-deg 0:0:1")));
    let angle = |name: &str| solve(name).column("link.crank.angle_rad")[0].to_degrees().rem_euclid(360.0);
    assert!(angle("crank_rocker") == 0.0);
    assert_within!((angle("ov7_base") - 181.84).abs(), 1e-12);
}

#[test]
fn val_ov7_base_positions_row_by_row() {
    let place = Place::new();
    let printed = Table::of(&fs::read_to_string(place.path("scenarios/ov7_base/positions.csv")).unwrap());
    for solver in ["assur", "newton"] {
        let command = format!("solve scenarios/ov7_base.toml --with {solver} --crank-deg 0:-360:-30");
        let table = Table::of(&place.ok(&command));
        let cranks = table.column("crank_rad");
        let mut compared = 0;
        for (k, crank) in printed.column("crank_deg").into_iter().enumerate() {
            let row =
                cranks.iter().position(|own| (own.to_degrees() - crank).abs() < 1e-9).expect("the angle is solved");
            for (at, name) in printed.header.iter().enumerate().skip(1) {
                // The column P2x_mm is the x coordinate of point 2 in millimetres, with two decimals.
                let (point, axis) = (&name[1..2], &name[2..3]);
                let own = table.column(&format!("point.{point}.{axis}_m"))[row] * 1e3;
                let cell: f64 = printed.rows[k][at].parse().unwrap();
                assert_within!((own - cell).abs(), 0.005 + 1e-12, "{solver}, {crank} deg, {name}: {own} for {cell}");
                compared += 1;
            }
        }
        assert!(compared >= 120, "only {compared} numbers were compared");
    }
}

#[test]
fn unrequested_channels_have_no_column() {
    let place = Place::new();
    for (want, quantities) in [
        ("\"positions\"", "angle_rad x_m y_m"),
        ("\"positions\", \"velocities\"", "angle_rad omega_rad_s x_m y_m vx_m_s vy_m_s"),
        ("\"positions\", \"velocities\", \"reactions\"", "angle_rad omega_rad_s x_m y_m vx_m_s vy_m_s fx_N fy_N"),
    ] {
        let wanted = format!("[channels]\nwant = [{want}]\n[grid]");
        // The published numbers of the scenario need more than positions, so the test removes all of them.
        place.edited("crank_rocker.toml", "few.toml", &[("[grid]", &wanted)]);
        let text = fs::read_to_string(place.path("scenarios/few.toml")).unwrap();
        let text = text.split("[[oracle]]").next().unwrap();
        fs::write(place.path("scenarios/few.toml"), text).unwrap();
        for solver in SOLVERS {
            let table = Table::of(&place.ok(&format!("solve scenarios/few.toml --with {solver}")));
            let expected =
                |name: &&String| quantities.split(' ').any(|quantity| name.ends_with(&format!(".{quantity}")));
            let all = header(&["crank", "coupler", "rocker"], &["A", "B", "D"], &["O", "A", "B", "C"]);
            let named = all.iter().filter(|name| !WHOLE.contains(&name.as_str()));
            let expected: Vec<&String> = all.iter().take(2).chain(named.filter(expected)).collect();
            assert_eq!(table.header.iter().collect::<Vec<_>>(), expected, "{solver}, {want}");
        }
    }
}

#[test]
fn only_engines_take_a_step() {
    let place = Place::new();
    let solve = |step: &str| {
        let command = format!("solve scenarios/crank_rocker.toml --with rapier --dt {step} --crank-deg 0:90:30");
        Table::of(&place.ok(&command)).column("link.rocker.angle_rad")
    };
    assert_ne!(solve("1e-3"), solve("5e-4"));
    let words = ["--dt", "assur is an analytic solver", "rapier"];
    place.refused("solve scenarios/crank_rocker.toml --with assur --dt 1e-3", &words);
}

/// The settings that `tune --write` writes to `[engine]` apply to `solve` too; options replace these settings.
#[test]
fn engine_settings_of_the_file_apply_unless_overridden() {
    let place = Place::new();
    let solve = |file: &str, options: &str| {
        place.ok(&format!("solve scenarios/{file} --with rapier --crank-deg 90:180:30 {options}"))
    };
    let plain = solve("ov7_base.toml", "");
    for (key, option) in [
        ("sweeps = 7", "--sweeps 7"),
        ("substeps = 2", "--substeps 2"),
        ("route = \"native\"", "--route native"),
        ("extrapolated = true", "--extrapolate"),
        ("sweeps = 64\nroute = \"probe\"\nextrapolated = true", "--sweeps 64 --route probe --extrapolate"),
    ] {
        place.edited("ov7_base.toml", "set.toml", &[("[grid]\n", &format!("[engine]\n{key}\n[grid]\n"))]);
        let told = solve("set.toml", "");
        assert!(told == solve("ov7_base.toml", option), "{key} is not {option}");
        assert!(told != plain, "{key} has no effect");
    }
    place.edited("ov7_base.toml", "set.toml", &[("[grid]\n", "[engine]\nsweeps = 7\n[grid]\n")]);
    assert!(solve("set.toml", "--sweeps 9") == solve("ov7_base.toml", "--sweeps 9"));
    place.edited("ov7_base.toml", "set.toml", &[("[grid]\n", "[engine]\nroute = \"guess\"\n[grid]\n")]);
    place.refused("solve scenarios/set.toml --with rapier", &["\"guess\" is not a route", "probe", "set.toml"]);
    // If an engine cannot compute forces by the requested route, the message says which option or key requested this
    // route.
    if cfg!(feature = "simbody") {
        place.edited("ov7_base.toml", "set.toml", &[("[grid]\n", "[engine]\nroute = \"probe\"\n[grid]\n")]);
        let missing = "engine simbody has no route (method for the reactions) called \"probe\"";
        let words = ["set.toml:", "engine.route", missing, "native"];
        place.refused("solve scenarios/set.toml --with simbody", &words);
        place.refused("solve scenarios/ov7_base.toml --with simbody --route probe", &["--route", missing]);
    }
}

#[test]
fn analytic_solvers_refuse_engine_settings() {
    let place = Place::new();
    for option in ["--dt 1e-3", "--accuracy 1e-3", "--sweeps 7", "--substeps 2", "--route probe", "--extrapolate"] {
        let name = option.split(' ').next().unwrap();
        for solver in ["assur", "newton"] {
            let words = [name, &format!("{solver} is an analytic solver"), "rapier"];
            place.refused(&format!("solve scenarios/crank_rocker.toml --with {solver} {option}"), &words);
        }
    }
    let words = ["--sweeps", "a whole number of at least 1"];
    place.refused("solve scenarios/crank_rocker.toml --with rapier --sweeps 0", &words);
}

#[test]
fn bad_grids_are_refused() {
    let place = Place::new();
    let scenario = "solve scenarios/crank_rocker.toml --with";
    for (grid, word) in [
        ("--crank-deg 0:360", "expected FROM:TO:STEP"),
        ("--crank-deg a:b:c", "not a number"),
        ("--crank-deg 0:360:-1", "leads away"),
        ("--crank-deg 0:360:0", "must not be zero"),
        ("--crank-deg 0:nan:1", "not finite"),
        ("--times 0:1:1e-9", "more than 1000000 points"),
        ("--times 0:1:1 --crank-deg 0:1:1", "cannot be used with"),
    ] {
        place.refused(&format!("{scenario} assur {grid}"), &[word]);
    }
    for solver in SOLVERS {
        place.refused(&format!("{scenario} {solver} --times 0:1e300:1e300"), &["turns from zero; the limit is"]);
    }
    place.refused(&format!("{scenario} rapier --times 0:1e4:1e4 --dt 1e-4"), &["the limit is", "larger time step"]);
    place.refused(&format!("{scenario} magic"), &["magic", "assur, newton, rapier"]);
}

#[test]
fn assur_is_the_default_solver() {
    let place = Place::new();
    let solve = "solve scenarios/crank_rocker.toml --crank-deg 0:90:30";
    let table = place.ok(solve);
    assert_eq!(table, place.ok(&format!("{solve} --with assur")));
    assert_ne!(table, place.ok(&format!("{solve} --with newton")));
}

/// Symptom: a free motion requested at a crank angle of 120 deg was solved at 147 deg.
/// Cause: angles were converted to times by the nominal speed.
#[test]
fn regress_a_free_motion_takes_no_grid_of_crank_angles() {
    let place = Place::new();
    for (file, solver) in [("pendulum", "assur"), ("crank_rocker_runup", "newton"), ("double_pendulum", "rapier")] {
        let words = ["the motion is free", "--times"];
        place.refused(&format!("solve scenarios/{file}.toml --with {solver} --crank-deg 90:60:-30"), &words);
    }
    let by_time = "from_s = 0\nto_s = 3\nstep_s = 0.01";
    let by_angle = "from_deg = 150\nto_deg = 90\nstep_deg = -30";
    place.edited("pendulum.toml", "angles.toml", &[(by_time, by_angle)]);
    for command in ["run scenarios/angles.toml --no-record", "inspect scenarios/angles.toml"] {
        place.refused(command, &["angles.toml", "grid", "the motion is free", "from_s"]);
    }
    let published = "
[[oracle]]
name = \"printed\"
source = \"made up\"
basis = \"derived\"
crank_deg = 90
values = [{ channel = \"link.rod.omega_rad_s\", value = 1, digits = 1 }]
";
    let text = fs::read_to_string(place.path("scenarios/pendulum.toml")).unwrap() + published;
    fs::write(place.path("scenarios/printed.toml"), text).unwrap();
    place.refused("run scenarios/printed.toml --no-record", &["published numbers", "the motion is free"]);
}
