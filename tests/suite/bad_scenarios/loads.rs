//! Errors in `[[loads]]`. The good scenario has one load, so each tested load is the second load.

use super::{Bad, GOOD, INPUT, assert_refused};

#[test]
fn sorts_links_points_and_tables() {
    let force = "type = \"force\"\nlink = \"rocker\"\npoint = \"B\"\n";
    let moment = "type = \"moment\"\nlink = \"rocker\"\n";
    let friction = "type = \"friction\"\njoint = \"O\"\n";
    let spring = "type = \"spring\"\nlinks = [\"ground\", \"rocker\"]\npoints = [\"O\", \"B\"]\n";
    let cases: [(String, &'static str, &'static str, &[&str]); 24] = [
        (format!("{force}x_N = 1\n"), "[[loads]]\ntype = \"force\"", "loads[2]", &["`y_N` or `y_kN` is missing"]),
        (format!("{force}x_N = 1\ny = 1\n"), "y = 1", "loads[2].y", &["has no unit"]),
        (
            format!("{force}x_N = 1\ny_N = 1\nframe = \"ground\"\n"),
            "frame =",
            "loads[2].frame",
            &["\"ground\" is not a frame of a force", "\"link\""],
        ),
        (
            force.replace("\"B\"", "\"Q\"") + "x_N = 1\ny_N = 1\n",
            "point = \"Q\"",
            "loads[2].point",
            &["no point \"Q\""],
        ),
        (
            force.replace("rocker", "ground") + "x_N = 1\ny_N = 1\n",
            "link = \"ground\"",
            "loads[2].link",
            &["a load on it has no effect"],
        ),
        (
            "type = \"resisting_force\"\nlink = \"rocker\"\npoint = \"C\"\nforce_N = 1\n".into(),
            "point = \"C\"",
            "loads[2].point",
            &["does not move", "hinged"],
        ),
        (format!("{moment}moment_N_m = 1\nacts = \"forwards\"\n"), "acts =", "loads[2].acts", &["when the load acts"]),
        (format!("{moment}moment_N_m = 1\nturns = 2\n"), "turns = 2", "loads[2].turns", &["belongs to a table"]),
        (
            format!("{moment}moment_N_m = 1\ninterpolation = \"linear\"\n"),
            "interpolation",
            "loads[2].interpolation",
            &["table"],
        ),
        (
            format!("{moment}moment_N_m = 1\ntable = [{{ crank_deg = 0, moment_N_m = 1 }}]\n"),
            "moment_N_m = 1\ntable",
            "loads[2].moment_N_m",
            &["both given", "one of the two"],
        ),
        (format!("{moment}table = []\n"), "table = []", "loads[2].table", &["at least one point"]),
        (
            format!("{moment}table = [{{ crank_deg = 9, moment_N_m = 1 }}, {{ crank_deg = 8, moment_N_m = 2 }}]\n"),
            "table = [",
            "loads[2].table[2]",
            &["do not ascend"],
        ),
        (
            format!("{moment}table = [{{ crank_deg = 0, moment_N_m = 1 }}, {{ crank_deg = 370, moment_N_m = 1 }}]\n"),
            "table = [",
            "loads[2].table[2]",
            &["longer than its period, 360 deg", "repeats the first"],
        ),
        (
            format!("{moment}turns = 0\ntable = [{{ crank_deg = 0, moment_N_m = 1 }}]\n"),
            "turns = 0",
            "loads[2].turns",
            &["found 0", "1 to 1000"],
        ),
        (
            format!("{moment}interpolation = \"cubic\"\ntable = [{{ crank_deg = 0, moment_N_m = 1 }}]\n"),
            "interpolation",
            "loads[2].interpolation",
            &["not an interpolation", "\"smooth\""],
        ),
        (
            format!("{spring}stiffness_N_m = -1\nfree_length_m = 0\n"),
            "stiffness_N_m = -1",
            "loads[2].stiffness_N_m",
            &["negative"],
        ),
        (
            spring.replace("\"ground\", ", "") + "stiffness_N_m = 1\nfree_length_m = 0\n",
            "links = [\"rocker\"]",
            "loads[2].links",
            &["found 1 links", "between two"],
        ),
        (
            spring.replace("ground", "rocker") + "stiffness_N_m = 1\nfree_length_m = 0\n",
            "links = [\"rocker\", \"rocker\"]",
            "loads[2].links",
            &["itself"],
        ),
        (
            spring.replace("\"O\"", "\"B\"") + "stiffness_N_m = 1\nfree_length_m = 0\n",
            "points = [\"B\", \"B\"]",
            "loads[2].points",
            &["holds the two points"],
        ),
        (
            spring.replace("\"O\"", "\"X\"") + "stiffness_N_m = 1\nfree_length_m = 0\n",
            "points = [\"X\"",
            "loads[2].points",
            &["link \"ground\" has no point \"X\""],
        ),
        (
            format!("{friction}coefficient = -0.1\nradius_mm = 9\n"),
            "coefficient",
            "loads[2].coefficient",
            &["found -0.1"],
        ),
        (format!("{friction}coefficient = 0.1\n"), "[[loads]]\ntype = \"friction\"", "loads[2]", &["`radius_m` or"]),
        (
            friction.replace("\"O\"", "\"Z\"") + "coefficient = 0.1\nradius_mm = 9\n",
            "joint = \"Z\"",
            "loads[2].joint",
            &["no joint \"Z\"", "\"O\""],
        ),
        (
            "type = \"slide_force\"\njoint = \"A\"\nthrust_N = 1\n".into(),
            "joint = \"A\"",
            "loads[2].joint",
            &["does not slide", "prismatic"],
        ),
    ];
    for (text, at, key, words) in cases {
        let section: &'static str = Box::leak(format!("[[loads]]\n{text}[start]").into_boxed_str());
        assert_refused(GOOD, &Bad { edits: &[("[start]", section)], kind: INPUT, at, key, words });
    }
}
