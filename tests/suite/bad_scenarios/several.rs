//! Several mistakes in one file: each mistake is reported at its location.
//! A mistake that only follows from an earlier mistake is not reported.

use std::fmt::Write;

use linkage::Error;

use super::{GOOD, TABLE, line_of, parse};

/// The text of the good scenario with these edits, and its errors.
fn refused(edits: &[(&str, &str)]) -> (String, Error) {
    let mut text = GOOD.to_string();
    for (from, to) in edits {
        assert!(text.contains(from), "the edit `{from}` does not apply");
        text = text.replacen(from, to, 1);
    }
    let error = parse(&text, TABLE).expect_err("the mistakes are found");
    (text, error)
}

/// Asserts that each case gives exactly one error, and that this error has the key and the line stated in the case.
fn assert_all_told(cases: &[(&'static str, &'static str, &str, &str)]) {
    let edits: Vec<(&str, &str)> = cases.iter().map(|&(from, to, ..)| (from, to)).collect();
    let (text, error) = refused(&edits);
    let found: Vec<(String, usize)> = error
        .each()
        .map(|error| (error.scenario_key().unwrap_or_default().to_string(), error.place().unwrap().line()))
        .collect();
    let mut expected: Vec<(String, usize)> =
        cases.iter().map(|&(_, _, key, at)| (key.to_string(), line_of(&text, at))).collect();
    expected.sort_by_key(|&(_, line)| line);
    assert_eq!(found, expected, "{error}");
    assert!(error.each().all(|error| error.way_out().is_some()), "{error}");
}

#[test]
fn mistakes_in_different_tables_are_reported_together() {
    assert_all_told(&[
        ("name = \"good\"", "name = \"Good one\"", "name", "Good one"),
        ("title =", "titel =", "title", "titel"),
        ("C = { x_mm = 150,", "C = { x_mm = \"1 +\",", "ground.points.C.x_mm", "1 +"),
        ("mass_kg = 2.6", "mass_kg = -2.6", "links.crank.mass_kg", "-2.6"),
        ("inertia_kg_m2", "inertia_kgm2", "links.crank.inertia_kgm2", "inertia_kgm2"),
        ("length_mm = 26", "lenght_mm = 26", "links.crank.points.A.length_mm", "lenght_mm"),
        ("links = [\"crank\", \"coupler\"]", "links = [\"crank\", \"cuopler\"]", "joints.A.links", "cuopler"),
        ("speed_rpm = 130", "speed_rpm = 0\ncolour = 1", "drive.speed_rpm", "speed_rpm = 0"),
        // The edit of the drive makes two mistakes.
        // The edit of `[gravity]` only adds an empty line; this row of the list states the second error of the drive.
        ("[gravity]", "\n[gravity]", "drive.colour", "colour"),
        ("x_m_s2 = 0\n", "", "gravity", "[gravity]"),
        ("link = \"rocker\"", "link = \"rockre\"", "loads[1].link", "rockre"),
        ("moment_N_m = 100", "moment_N_m = true", "loads[1].moment_N_m", "moment_N_m = true"),
        ("crank_deg = 0\n[[start", "crank_deg = nan\n[[start", "start.crank_deg", "nan"),
        ("mode = \"left\"", "mode = \"lfet\"", "start.groups[1].mode", "lfet"),
        ("step_deg = 10", "step_deg = 0", "grid.step_deg", "step_deg = 0"),
        ("want = [\"positions\", \"velocities\"]", "want = [\"positions\", 2]", "channels.want", "want = ["),
        ("dt_s = 1e-3", "dt_s = -1\nsweeps = 0", "engine.dt_s", "dt_s = -1"),
        ("engine_rel = 1e-2", "engine_rel = 2", "tolerances.engine_rel", "engine_rel = 2"),
        ("[tolerances]", "\n[tolerances]", "engine.sweeps", "sweeps = 0"),
    ]);
}

#[test]
fn mistakes_in_one_table_are_reported_together() {
    assert_all_told(&[
        ("mass_kg = 2.6\n", "masss_kg = 2.6\n", "links.crank.masss_kg", "masss_kg"),
        ("inertia_kg_m2 = 0.0002", "inertia_kg_m2 = -1", "links.crank.inertia_kg_m2", "inertia_kg_m2"),
        ("x_mm = 13, y_mm = 0 }\n", "x_mm = 13, y_mm = \"b\" }\ncolour = \"red\"\n", "links.crank.colour", "colour"),
        ("[links.crank.points]", "\n[links.crank.points]", "links.crank.mass_centre.y_mm", "\"b\""),
    ]);
}

#[test]
fn mistakes_in_published_numbers_are_reported_together() {
    assert_all_told(&[
        ("crank = \"crank_deg\"", "crank = \"crank_deg\"\nbass = 1", "oracle[1].bass", "bass"),
        ("value = 70, digits = 1", "valeu = 70, digits = 1", "oracle[2].values[1].value", "valeu"),
        ("reduced_inertia_mean_kg_m2", "reduced_inertia_maen_kg_m2", "oracle[3].figures[1].figure", "maen"),
    ]);
}

/// An error that depends on an unreadable part is not reported, because correcting the part may correct the error.
#[test]
fn consequences_of_a_mistake_are_not_reported() {
    for (edits, key) in [
        // Joint C and the load refer to the rocker, but only the error in the rocker is reported.
        (
            &[("[links.rocker.points]\nC = { x_mm = 0, y_mm = 0 }", "[links.rocker.points]\nC = 5")][..],
            "links.rocker.points.C",
        ),
        (&[("B = { x_mm = 250, y_mm = 0 }", "B = { x_mm = 250, z_mm = 0 }")], "links.rocker.points.B.y_mm"),
        // The drive refers to joint O, but only the error in joint O is reported.
        (&[("name = \"O\"\ntype = \"revolute\"", "name = \"O\"\ntype = \"revolut\"")], "joints.O.type"),
        (&[("name = \"O\"\n", "")], "joints[1]"),
        // The grid, the engine's step and the groups depend on the drive, but only the error in the drive is reported.
        (&[("speed_rpm = 130", "speed_rpm = 1e308")], "drive.speed_rpm"),
        (&[("[[joints]]", "[[joint]]")], "joint"),
        (&[("[links.crank]\n", "[link.crank]\n")], "link"),
        // A missing mass centre is reported only if the key is absent, not if its value is wrong.
        (&[("mass_centre = { x_mm = 13, y_mm = 0 }", "mass_centre = 13")], "links.crank.mass_centre"),
        (&[("mass_kg = 2.6", "mass_kg = \"much\"")], "links.crank.mass_kg"),
    ] {
        let (_, error) = refused(edits);
        let keys: Vec<Option<&str>> = error.each().map(Error::scenario_key).collect();
        assert_eq!(keys, [Some(key)], "{error}");
    }
}

/// Twenty mistakes are shown; the remaining mistakes are counted, however many there are.
#[test]
fn many_mistakes_are_counted() {
    let many = (0..500).fold(String::new(), |mut text, k| {
        let _ = writeln!(text, "[[loads]]\ntype = \"resistance\"\nlink = \"rocker\"\nmoment_N_m = -{k}.5");
        text
    });
    let (_, error) = refused(&[("[start]", &format!("{many}[start]"))]);
    assert_eq!((error.each().count(), error.left_out()), (20, 480));
    assert!(error.to_string().ends_with("\n480 more mistakes are not shown"));
}
