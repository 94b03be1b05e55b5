//! Errors in sliders.

use linkage::ErrorKind;

use super::{Bad, INPUT, TABLE, assert_refused, parse};

/// A slider-crank: crank 100 mm, rod 300 mm, slider on a guide through O along x.
const SLIDER: &str = include_str!("slider.toml");

fn assert_sliders_refused(cases: &[Bad]) {
    assert!(parse(SLIDER, TABLE).is_ok(), "{:?}", parse(SLIDER, TABLE).err());
    cases.iter().for_each(|bad| assert_refused(SLIDER, bad));
}

/// Guides and rods that do not work: the message states the fault and the remedy.
#[test]
fn sliders() {
    const RRP: &str = "start.groups (rod, slider)";
    const GUIDE: &str = "links = [\"ground\", \"slider\"]\npoints = [\"O\", \"B\"]";
    const OTHER: &str =
        "name = \"B\"\ntype = \"prismatic\"\naxis_deg = 0\nlinks = [\"rod\", \"slider\"]\npoints = [\"B\", \"C\"]";
    // The edit names the slider's point C, because B is also a point of the rod.
    const POINT: (&str, &str) = ("[links.slider.points]\nB =", "[links.slider.points]\nC =");
    const PLACE: (&str, &str) = ("points = [\"O\", \"B\"]", "points = [\"O\", \"C\"]");
    const PIN: &str = "name = \"B\"\ntype = \"revolute\"\nlinks = [\"rod\", \"slider\"]";
    assert_sliders_refused(&[
        Bad {
            // The rod is shorter than the distance from the crank pin to the guide.
            edits: &[("crank_deg = 30", "crank_deg = 90"), ("B = { x_mm = 300", "B = { x_mm = 50")],
            kind: ErrorKind::Geometry,
            at: "[[start.groups]]",
            key: RRP,
            words: &["0.100000 m away from its outer pin", "its rod is 0.050000 m long", "check the lengths"],
        },
        bad!("B = { x_mm = 300" => "B = { x_mm = 0", ErrorKind::Geometry, at "[[start.groups]]", key RRP,
            ["its rod is 0.000000 m long"]),
        Bad {
            // RPP with both axes along the guide.
            edits: &[
                (PIN, OTHER),
                POINT,
                PLACE,
                ("[[start.groups]]\nlinks = [\"rod\", \"slider\"]\nmode = \"ahead\"\n", ""),
                ("[[loads]]\ntype = \"resistance\"\nlink = \"rod\"\nmoment_N_m = 1\n", ""),
            ],
            kind: ErrorKind::Geometry,
            at: "[start]",
            key: RRP,
            words: &["axes of its two prismatic joints are parallel", "check the axes"],
        },
        Bad {
            // The rod slides on the ground and on the slider, which gives a loop of three prismatic joints.
            edits: &[
                (PIN, OTHER),
                POINT,
                PLACE,
                ("link = \"rod\"", "link = \"crank\""),
                ("[links.rod.points]\nA =", "[links.rod.points]\nR ="),
                (
                    "name = \"A\"\ntype = \"revolute\"\nlinks = [\"crank\", \"rod\"]",
                    "name = \"A\"\ntype = \"prismatic\"\naxis_deg = 70\nlinks = [\"ground\", \"rod\"]\npoints = [\"O\", \"R\"]",
                ),
            ],
            kind: INPUT,
            at: "[[joints]]\nname = \"guide\"",
            key: "joints.guide",
            words: &["a loop of prismatic joints only", "must be revolute"],
        },
        bad!("joint = \"O\"" => "joint = \"guide\"\nstart_mm = 380", INPUT, at "speed_rpm", key "drive.speed_rpm",
            ["unit of a speed", "`speed_m_s` or `speed_mm_s`"]),
        bad!("[drive]" => "[[joints]]\nname = \"B2\"\ntype = \"prismatic\"\naxis_deg = 0\nlinks = [\"rod\", \"slider\"]\npoints = [\"B\", \"S\"]\n[drive]",
            INPUT, at "links = [\"rod\", \"slider\"]\npoints", key "joints.B2.links",
            ["\"B\" already joins \"rod\" and \"slider\"", "lock"]),
        bad!("mode = \"ahead\"" => "mode = \"left\"", INPUT, at "mode = \"left\"", key "start.groups[1].mode",
            ["a group of RRP has no mode \"left\"", "\"ahead\" or \"behind\""]),
        bad!("axis_deg = 0" => "axis_deg = nan", INPUT, at "axis_deg = nan", key "joints.guide.axis_deg", ["finite number"]),
        bad!("link = \"rod\"" => "link = \"slider\"", INPUT, at "link = \"slider\"", key "loads[1].link",
            ["\"slider\" does not turn", "name a link that turns"]),
    ]);
    // Naming the ground as second link, instead of first link, does not change the guide.
    let turned = SLIDER.replace(GUIDE, "links = [\"slider\", \"ground\"]\npoints = [\"B\", \"O\"]");
    assert_ne!(turned, SLIDER);
    let [one, other] = [SLIDER, &turned].map(|text| parse(text, TABLE).unwrap().case.start.clone());
    assert_eq!(one, other);
}
