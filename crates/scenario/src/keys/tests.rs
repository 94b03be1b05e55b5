//! The table of keys, compared with the keys that the readers request.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use super::{Section, section, sections};
use crate::reader::asked;
use crate::{Scenario, files_in};

/// Changes of a scenario. After these changes, readers request keys that no scenario of the repository has.
const CHANGES: [(&str, &str, &str); 19] = [
    ("crank_rocker", "[grid]", "[report]\nfigures = [\"maxabs:drive.torque_N_m\"]\n[grid]"),
    (
        "crank_rocker",
        "speed_rpm = 130",
        "law = \"table\"\npoints = [{ time_s = 0, angle_deg = 0 }, { time_s = 1, angle_deg = 90 }]",
    ),
    ("crank_rocker", "law = \"linear\"\ntorque_at_rest_N_m = 22.51", "law = \"constant\"\ntorque_N_m = 5"),
    ("crank_rocker", "speed_rpm = 130", "law = \"harmonic\"\namplitude_deg = 9\nperiod_s = 1\nphase_deg = 0"),
    ("crank_rocker", "speed_rpm = 130", "law = \"formula\"\nformula = \"3*t\"\ntime_s = 1"),
    ("cam_follower", "type = \"cam\"", "type = \"screw\"\nlead_mm = 1"),
    ("cam_follower", "motion = [", "formula = \"0.01*sin(phi)\"\nx = ["),
    ("cam_follower", "motion = [", "lifts = [{ angle_deg = 0, lift_mm = 0 }, { angle_deg = 9, lift_mm = 1 }]\nx = ["),
    (
        "crank_rocker",
        "law = \"linear\"\ntorque_at_rest_N_m = 22.51",
        "law = \"table\"\npoints = [{ speed_rpm = 0, torque_N_m = 4 }, { speed_rpm = 3000, torque_N_m = 1 }]",
    ),
    (
        "crank_rocker",
        "[[loads]]\n",
        "[[loads]]\ntype = \"resisting_force\"\nlink = \"rocker\"\npoint = \"B\"\nforce_N = 3\n\n[[loads]]\n",
    ),
    (
        "crank_rocker",
        "[[loads]]\n",
        "[[loads]]\ntype = \"moment\"\nlink = \"rocker\"\n\
         table = [{ crank_deg = 0, moment_N_m = 1 }, { crank_deg = 90, moment_N_m = 2 }]\n\n[[loads]]\n",
    ),
    (
        "slider_crank_friction",
        "[start]",
        "[[loads]]\ntype = \"slide_force\"\njoint = \"guide\"\nbore_mm = 9\ntable = [{ crank_deg = 0, pressure_bar = 1 }]\n\
         [[loads]]\ntype = \"slide_force\"\njoint = \"guide\"\ntable = [{ crank_deg = 0, thrust_N = 1 }]\n\
         [[loads]]\ntype = \"slide_spring\"\njoint = \"guide\"\nstiffness_N_m = 1\nfree_slide_mm = 0\n[start]",
    ),
    (
        "crank_rocker",
        "[grid]",
        "[tolerances]\nengine_rel = 1e-2\n\
         [clearance]\nradius_mm = 1\nignore = [{ bodies = [\"crank\", \"rocker\"] }]\n\
         [clearance.outlines.rocker]\nline = [{ x_mm = 0, y_mm = 0 }]\nradius_mm = 2\n\
         [[clearance.housing]]\nname = \"floor\"\n\
         corners = [{ x_mm = 0, y_mm = -90 }, { x_mm = 9, y_mm = -80 }, { x_mm = 0, y_mm = -70 }]\n[grid]",
    ),
    ("ov7_base", "file = ", "digits = 3\nfile = "),
    ("boom_lift", "law = \"cycloidal\"", "law = \"harmonic\"\namplitude_mm = 9\nperiod_s = 1"),
    (
        "boom_lift",
        "[grid]",
        "[[loads]]\ntype = \"slide_force\"\njoint = \"S\"\ntable = [{ crank_mm = 0, thrust_N = 1 }]\n[grid]",
    ),
    ("boom_lift", "from_s = 0\nto_s = 4\nstep_s = 0.05\n", "from_mm = 1\nto_mm = 2\nstep_mm = 1\n"),
    (
        "boom_lift",
        "[grid]",
        "[[oracle]]\nname = \"a\"\nbasis = \"derived\"\nsource = \"s\"\ncrank_mm = 20\n\
         values = [{ channel = \"link.boom.angle_deg\", value = 1, digits = 1 }]\n[grid]",
    ),
    (
        "boom_lift",
        "[grid]",
        "[[oracle]]\nsource = \"s\"\nfile = \"ov7_new/positions.csv\"\ncrank = \"P4x_mm\"\n\
         [oracle.columns]\nP5x_mm = { channel = \"link.boom.angle_deg\", expect = [\n\
         { crank_mm = 95.72, finding = \"f\", right = { value = 1, digits = 1 } }] }\n\
         [grid]",
    ),
];

fn asked_by_readers() -> BTreeMap<String, BTreeSet<String>> {
    let top = &Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    asked::forget();
    for directory in ["scenarios", "scenarios/formulas", "scenarios/variants60"] {
        for path in files_in(top.join(directory)).unwrap() {
            Scenario::load(&path).unwrap_or_else(|error| panic!("{error}"));
        }
    }
    for (name, old, new) in CHANGES {
        let path = top.join(format!("scenarios/{name}.toml"));
        let text = std::fs::read_to_string(&path).unwrap();
        assert!(text.contains(old), "{name}: {old}");
        // The scenario need not make sense, because only the requested keys matter.
        let _ = Scenario::parse(&text.replacen(old, new, 1), &path);
    }
    asked::all()
}

#[test]
fn every_key_that_is_read_is_in_the_table() {
    for (path, keys) in asked_by_readers() {
        let Some(section) = section(&path) else {
            let is_named = sections().any(|own| own.path.strip_suffix(".*") == Some(path.as_str()));
            assert!(is_named || path == "parameters", "there is no section `{path}`");
            continue;
        };
        let known: BTreeSet<String> = section.keys.iter().flat_map(super::FileKey::spellings).collect();
        let unknown: Vec<&String> = keys.difference(&known).collect();
        assert!(unknown.is_empty(), "`{path}` lacks {unknown:?}");
    }
}

#[test]
fn every_key_of_the_table_is_read() {
    let asked = asked_by_readers();
    let names = |section: &Section| section.keys.iter().map(|key| key.name).collect::<Vec<_>>();
    let mut never = Vec::new();
    for section in sections() {
        // One reader serves all sections with the same keys, for example positions and printed numbers. A key counts
        // as read if this reader requests the key in one of these sections.
        let alike = || sections().filter(|other| names(other) == names(section));
        for spelling in section.keys.iter().flat_map(super::FileKey::spellings) {
            if !alike().any(|own| asked.get(own.path).is_some_and(|keys| keys.contains(&spelling))) {
                never.push(format!("{}.{spelling}", section.path));
            }
        }
    }
    assert!(never.is_empty(), "{never:?}");
}
