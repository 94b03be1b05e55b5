//! `linkproof inspect --driver`: the structure for another driving link.

use assert_cmd::Command;
use serde_json::Value;

fn inspect(arguments: &[&str]) -> (i32, String, String) {
    let output = Command::cargo_bin("linkproof").unwrap().arg("inspect").args(arguments).output().unwrap();
    let [out, told] = [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap());
    (output.status.code().unwrap(), out, told)
}

/// The structures for the driving link or driven joint `driver`, as JSON.
fn driven(name: &str, driver: &str) -> Vec<Value> {
    let (code, out, told) = inspect(&[&format!("scenarios/{name}.toml"), "--driver", driver, "-o", "-"]);
    assert_eq!(code, 0, "{told}");
    serde_json::from_str::<Value>(&out).unwrap()["driven_at"].as_array().unwrap().clone()
}

/// Published results: a class III group becomes two dyads if one of its leads is the driving link.
/// The class IV group becomes a class III group if the link on the ground is the driving link.
/// A four-bar has one dyad whichever link on the ground drives it.
#[test]
fn another_driving_link_changes_the_class() {
    for (name, driver, class, formula) in [
        ("class3_group", "lead_1", 2, "I(0,2) -> II(3,5) -> II(1,4)"),
        ("class3_group", "lead_2", 2, "I(0,3) -> II(2,5) -> II(1,4)"),
        ("class3_group", "crank", 3, "I(0,1) -> III(2,3,4,5)"),
        ("fourth_class", "link_5", 3, "I(0,5) -> III(1,2,3,4)"),
        ("fourth_class", "crank", 4, "I(0,1) -> IV(2,3,4,5)"),
        ("crank_rocker", "rocker", 2, "I(0,3) -> II(1,2)"),
    ] {
        let found = driven(name, driver);
        assert_eq!(found.len(), 1, "{name} {driver}");
        assert_eq!(found[0]["class"], class, "{name} {driver}");
        assert_eq!(found[0]["numbered_formula"], formula, "{name} {driver}");
        assert_eq!(found[0]["is_chain_of_dyads"], class == 2, "{name} {driver}");
        assert_eq!(found[0]["links"], serde_json::json!([driver]), "{name} {driver}");
    }
}

#[test]
fn the_structure_for_one_driving_link_is_told() {
    let (code, out, told) = inspect(&["scenarios/class3_group.toml", "--driver", "lead_1"]);
    assert_eq!(code, 0, "{told}");
    for line in [
        "driver     lead_1 at joint A (revolute)\n",
        "class      II, a chain of dyads; driven at joint P as in the file: class III\n",
        "structure  I(ground, lead_1) -> II.2 RRR(lead_2, base) -> II.2 RRR(crank, lead_3)\n",
        "           I(0,2) -> II(3,5) -> II(1,4)\n",
        "  lead_2, base: class II, order 2, RRR; inner joints E; outer joints B, D\n",
    ] {
        assert!(out.contains(line), "{line}: {out}");
    }
}

#[test]
fn without_a_name_every_joint_is_listed() {
    let (code, out, told) = inspect(&["scenarios/fourth_class.toml", "--driver"]);
    assert_eq!(code, 0, "{told}");
    let rows: Vec<&str> = out.lines().collect();
    assert_eq!(rows[1].split_whitespace().collect::<Vec<_>>(), ["driving", "link", "joint", "class", "structure"]);
    assert!(rows[2].contains("crank ") && rows[2].ends_with("I(0,1) -> IV(2,3,4,5) (as in the file)"), "{out}");
    assert!(rows[3].contains("link_5 ") && rows[3].ends_with("I(0,5) -> III(1,2,3,4)"), "{out}");
    // `--driver all` and `--driver` without a name give the same table, which lists each of the seven joints once.
    assert_eq!(driven("fourth_class", "all").len(), 7);
    assert_eq!(out, inspect(&["scenarios/fourth_class.toml", "--driver", "all"]).1);
    assert!(!out.contains("chain of dyads"), "{out}");
    let (_, out, _) = inspect(&["scenarios/class3_group.toml", "--driver"]);
    assert!(out.contains("\na chain of dyads if driven at A, B, D, E\n"), "{out}");
}

/// With several drives, only the first drive is replaced. A free motion has the structure of a prescribed motion.
#[test]
fn mechanisms_with_several_drives_and_free_motions_are_answered() {
    let (code, _, told) = inspect(&["scenarios/robot_arm.toml", "--driver", "elbow"]);
    assert_eq!(code, 2, "{told}");
    assert!(told.contains("another drive already moves the joint \"elbow\""), "{told}");
    assert_eq!(driven("pendulum", "all").len(), 1);
}

#[test]
fn wrong_drivers_are_refused_with_the_way_out() {
    for (driver, message, help) in [
        ("coupler", "\"coupler\" has no joint with the ground", "give a link on the ground (crank, rocker)"),
        ("roker", "there is no link or joint \"roker\"", "did you mean \"rocker\"?"),
        ("ground", "the ground stands still", "give a link on the ground (crank, rocker)"),
    ] {
        let (code, _, told) = inspect(&["scenarios/crank_rocker.toml", "--driver", driver]);
        assert_eq!(code, 2, "{told}");
        let told = told.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(told.contains(message) && told.contains(help) && told.contains("`--driver`"), "{told}");
    }
}
