//! `linkproof exercise` and `linkproof mark` on the built command.

use std::fs;
use std::path::Path;

use crate::cli::tools::Place;

const CLASS: &str = "exercise scenarios/crank_rocker.toml scenarios/quick_return.toml --seed 17";

/// Fills the table of a sheet with the teacher's answers, each changed by `change`.
fn fill(place: &Place, class: &str, name: &str, change: impl Fn(&str, &str, &str) -> String) {
    let answers = fs::read_to_string(place.path(&format!("{class}/teacher/answers.csv"))).unwrap();
    let rows: Vec<Vec<&str>> =
        answers.lines().filter(|line| !line.starts_with('#')).map(|line| line.split(',').collect()).collect();
    let at = place.path(&format!("{class}/answers/{name}.csv"));
    let empty = fs::read_to_string(&at).unwrap();
    let header: Vec<&str> = empty.lines().find(|line| !line.starts_with('#')).unwrap().split(',').collect();
    let filled = empty.lines().map(|line| match line.split_once(',') {
        Some((position, _)) if position.parse::<f64>().is_ok() => {
            let answer = |quantity: &&str| {
                let row = rows.iter().find(|row| row[..3] == [name, position, *quantity]).unwrap();
                change(position, quantity, row[4])
            };
            format!("{position},{}", header[1..].iter().map(answer).collect::<Vec<_>>().join(","))
        }
        _ => line.to_string(),
    });
    fs::write(at, filled.collect::<Vec<_>>().join("\n") + "\n").unwrap();
}

#[test]
fn a_class_is_written_filled_and_marked() {
    let place = Place::new();
    place.ok(&format!("{CLASS} -n 3 -o class"));
    for file in [
        "tasks/student_001.html",
        "answers/student_003.csv",
        "scenarios/student_002.toml",
        "teacher/answers.html",
        "key.json",
    ] {
        assert!(place.path("class").join(file).is_file(), "{file}");
    }
    for number in 1..=3 {
        fill(&place, "class", &format!("student_00{number}"), |_, _, answer| answer.into());
    }
    let text = place.ok("mark class");
    assert!(text.contains("student_003") && text.matches(" 100").count() == 3, "{text}");
    // One quantity with the wrong sign: exit code 1, and the cause in every result.
    fill(&place, "class", "student_002", |_, quantity, answer| match quantity {
        "link.guide.omega_rad_s" => format!("{}", -answer.parse::<f64>().unwrap()),
        _ => answer.into(),
    });
    let outcome = place.run("mark class -o marks/ -o marks.csv -o marks.json -o marks.html");
    assert_eq!(outcome.code, 1, "{}", outcome.stderr);
    assert!(outcome.unbroken().contains("opposite sign"), "{}", outcome.stdout);
    for file in ["marks/class.html", "marks/student_002.html", "marks.csv", "marks.json", "marks.html"] {
        let text = fs::read_to_string(place.path(file)).unwrap();
        assert!(text.contains("opposite sign"), "{file}");
    }
    let page = |arguments: &str| {
        place.run(arguments);
        fs::read_to_string(place.path("one.html")).unwrap()
    };
    let shown = page("mark class/answers/student_002.csv --language uk -o one.html");
    assert!(shown.contains("протилежний знак") && shown.contains("правильне значення"), "{shown}");
    let hidden = page("mark class/answers/student_002.csv --language uk --hide-answers -o one.html");
    assert!(hidden.contains("протилежний знак") && !hidden.contains("правильне значення"), "{hidden}");
}

/// Every text below a directory, by path.
fn texts(directory: &Path) -> Vec<(String, String)> {
    let mut found = Vec::new();
    for entry in fs::read_dir(directory).unwrap().map(Result::unwrap) {
        let path = entry.path();
        match path.is_dir() {
            true => found.extend(
                texts(&path)
                    .into_iter()
                    .map(|(name, text)| (format!("{}/{name}", path.file_name().unwrap().display()), text)),
            ),
            false => found.push((path.file_name().unwrap().display().to_string(), fs::read_to_string(&path).unwrap())),
        }
    }
    found.sort();
    found
}

#[test]
fn the_same_seed_gives_the_same_class_and_students_do_not_depend_on_each_other() {
    let place = Place::new();
    for (count, directory) in [(3, "one"), (3, "other"), (2, "small")] {
        place.ok(&format!("{CLASS} -n {count} --language uk -o {directory}"));
    }
    let [one, other, small] = ["one", "other", "small"].map(|name| texts(&place.path(name)));
    assert_eq!(one, other);
    let of_students = |all: &[(String, String)]| {
        all.iter()
            .filter(|(name, _)| name.contains("student_001") || name.contains("student_002"))
            .cloned()
            .collect::<Vec<_>>()
    };
    assert!(of_students(&small).len() == 6 && of_students(&small) == of_students(&one));
}

#[test]
fn a_filled_table_is_never_replaced() {
    let place = Place::new();
    let command = "exercise scenarios/crank_rocker.toml -o class";
    place.ok(command);
    // Files that were not changed are replaced.
    place.ok(command);
    fill(&place, "class", "crank_rocker", |_, _, answer| answer.into());
    let before = texts(&place.path("class"));
    place.refused(command, &["crank_rocker.csv"]);
    assert_eq!(texts(&place.path("class")), before);
    place.ok("mark class");
}

#[test]
fn a_drawn_scenario_is_proven() {
    let place = Place::new();
    place.ok(&format!("{CLASS} -n 2 -o class"));
    place.ok("run class/scenarios/student_001.toml class/scenarios/student_002.toml --no-record --quiet");
}

#[test]
fn bad_answers_are_refused_with_their_place() {
    let place = Place::new();
    place.ok(&format!("{CLASS} -n 2 -o class"));
    let at = place.path("class/answers/student_001.csv");
    let empty = fs::read_to_string(&at).unwrap();
    fill(&place, "class", "student_001", |_, _, answer| answer.into());
    let good = fs::read_to_string(&at).unwrap();
    let first = good.lines().position(|line| line.starts_with("crank_deg")).unwrap() + 2;
    let row = good.lines().nth(first - 1).unwrap().to_string();
    let line = format!("line {first}");
    let column = "link.coupler.angle_deg";
    let cases: Vec<(String, Vec<&str>)> = vec![
        (good.replace(column, "link.coupler.angle_grad"), vec!["student_001.csv", "line", "angle_grad"]),
        (good.replace(&format!(",{column}"), ""), vec!["student_001.csv", column, "missing"]),
        (good.replacen(&row, &format!("{row},7"), 1), vec!["student_001.csv", &line, "cells"]),
        (format!("{good}{row}\n"), vec!["student_001.csv", "twice"]),
        (
            format!("{good}{}\n", row.replacen(row.split(',').next().unwrap(), "33.25", 1)),
            vec!["student_001.csv", "33.25"],
        ),
        (
            good.replacen(&row, &row.replacen(row.split(',').nth(1).unwrap(), "about two", 1), 1),
            vec![&line, "column 2", "about two"],
        ),
        (good.replace("seed 17", "seed 18"), vec!["student_001 of seed 18", "student_001 of seed 17"]),
        ("# nothing\n".into(), vec!["student_001.csv", "empty"]),
    ];
    for (text, words) in cases {
        fs::write(&at, &text).unwrap();
        place.refused("mark class/answers/student_001.csv", &words);
    }
    // Decimal commas and semicolons are accepted. An empty table counts as not handed in.
    let commas = |line: &str| match line.starts_with(|sign: char| sign.is_ascii_digit()) {
        true => line.replace(',', ";").replace('.', ",") + "\n",
        false => line.replace(',', ";") + "\n",
    };
    let commas: String = good.lines().map(commas).collect();
    fs::write(&at, commas).unwrap();
    place.ok("mark class/answers/student_001.csv");
    fs::write(&at, empty).unwrap();
    let outcome = place.run("mark class/answers/student_001.csv");
    assert!(outcome.code == 1 && outcome.stdout.contains("not handed in"), "{}", outcome.stdout);
    // Files and directories that belong to no class are refused.
    place.refused("mark scenarios", &["scenarios", "key.json"]);
    fs::write(place.path("class/answers/eve.csv"), "crank_deg\n").unwrap();
    place.refused("mark class/answers/eve.csv", &["eve.csv"]);
    fs::write(place.path("class/key.json"), "{}").unwrap();
    place.refused("mark class", &["key.json"]);
}

#[test]
fn exercises_that_cannot_be_made_are_refused() {
    let place = Place::new();
    for (arguments, words) in [
        ("scenarios/pendulum.toml", vec!["pendulum", "drive"]),
        ("scenarios/robot_arm.toml -n 2", vec!["robot_arm", "drive"]),
        ("scenarios/crank_rocker.toml scenarios/crank_rocker.toml", vec!["two scenarios", "crank_rocker"]),
        ("scenarios/crank_rocker.toml --ask link.crunk.omega_rad_s", vec!["link.crunk.omega_rad_s"]),
        ("scenarios/crank_rocker.toml --vary lengths", vec!["--students"]),
        ("scenarios/crank_rocker.toml -n 2 --vary widths", vec!["lengths"]),
        ("scenarios/crank_rocker.toml --positions 900", vec!["900"]),
        ("scenarios/crank_rocker.toml --within 120%", vec!["5%"]),
        ("scenarios/crank_rocker.toml --language de", vec!["uk"]),
    ] {
        place.refused(&format!("exercise {arguments} -o class"), &words);
        assert!(!place.path("class").exists(), "{arguments}");
    }
}

/// A translating follower has no angle, so its slide and its rates are asked for.
/// Sheets of another class are not mixed with the new ones.
#[test]
fn a_follower_is_asked_for_its_slide_and_classes_stay_apart() {
    let place = Place::new();
    place.ok("exercise scenarios/cam_follower.toml -n 2 -o class");
    let answers = fs::read_to_string(place.path("class/answers/student_001.csv")).unwrap();
    assert!(answers.contains("crank_deg,joint.B.slide_mm,joint.B.slide_speed_m_s"), "{answers}");
    let command = "exercise scenarios/crank_rocker.toml -n 1 -o class";
    place.refused(command, &["another class", "student_002"]);
}

/// Loads and transmissions that the file writes in braces are on the sheets, with numbers in place of expressions, and
/// vary like others.
#[test]
fn regress_loads_and_transmissions_in_braces_are_on_the_sheets() {
    let place = Place::new();
    let load = "[[loads]]\ntype = \"resistance\"\nlink = \"rocker\"\nmoment_N_m = 100\n";
    let inline = "loads = [{ type = \"resistance\", link = \"rocker\", moment_N_m = \"2*heavy\" }]\n";
    let text = fs::read_to_string(place.path("scenarios/crank_rocker.toml")).unwrap();
    assert!(text.contains(load));
    let text = text.replace(load, "").replacen("[ground.points]", &format!("{inline}[ground.points]"), 1);
    fs::write(place.path("named.toml"), format!("{text}\n[parameters]\nheavy_N_m = 50\n")).unwrap();
    fs::write(place.path("plain.toml"), text.replace("\"2*heavy\"", "100")).unwrap();
    place.ok("exercise named.toml --ask reactions -o named");
    let task = fs::read_to_string(place.path("named/tasks/crank_rocker.html")).unwrap();
    assert!(task.contains("moment_N_m = 100"), "{task}");
    place.ok("exercise plain.toml -n 1 --vary loads --ask reactions -o plain");
    let task = fs::read_to_string(place.path("plain/tasks/student_001.html")).unwrap();
    assert!(task.contains("moment_N_m = ") && !task.contains("moment_N_m = 100"), "{task}");
    place.ok("exercise scenarios/geared_five_bar.toml -n 1 -o gears");
    let task = fs::read_to_string(place.path("gears/tasks/student_001.html")).unwrap();
    assert!(task.contains("[[transmissions]]") && task.contains("teeth"), "{task}");
}
