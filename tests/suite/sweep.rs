//! `linkproof sweep` and `linkproof merge`: figures equal to those of `solve`, complete tables, and the same bytes for
//! any number of threads, shards and interruptions.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

use assert_cmd::cargo::CommandCargoExt;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;

use crate::cli::tools::{Place, Table};

/// Command that writes a four-bar scenario whose numbers are parameters.
const FOUR_BAR: &str = "new four-bar";
const FIGURES: &str = "--figure max:joint.A.f_N --figure maxabs:drive.torque_N_m --figure at_min:link.rocker.angle_deg";

/// A row of a table: its columns by name. Absent values are left out.
type Row = BTreeMap<String, Field>;

fn rows(table: &Path) -> Vec<Row> {
    let reader = SerializedFileReader::new(fs::File::open(table).unwrap()).unwrap();
    let columns = |row: parquet::record::Row| {
        let all = row.get_column_iter().filter(|(_, field)| **field != Field::Null);
        all.map(|(name, field)| (name.clone(), field.clone())).collect()
    };
    reader.get_row_iter(None).unwrap().map(|row| columns(row.unwrap())).collect()
}

fn number(row: &Row, name: &str) -> f64 {
    match row.get(name) {
        Some(Field::Double(number)) => *number,
        other => panic!("{name}: {other:?}"),
    }
}

/// The figures of all cases, in the order of the cases.
pub fn figures(table: &Path, name: &str) -> Vec<f64> {
    rows(table).iter().map(|row| number(row, name)).collect()
}

fn text<'r>(row: &'r Row, name: &str) -> &'r str {
    match row.get(name) {
        Some(Field::Str(text)) => text,
        other => panic!("{name}: {other:?}"),
    }
}

/// The test also computes every figure of every case from the table of `solve`.
/// The figure of the sweep and the figure from the table must be equal, bit by bit.
/// Root mean squares must be equal up to rounding.
#[test]
fn figures_have_the_bits_of_solve() {
    let place = Place::empty();
    place.ok(FOUR_BAR);
    let figures = format!("{FIGURES} --figure rms:point.E.vx_m_s --figure at=0:link.coupler.alpha_rad_s2");
    let vary = "--vary crank_mm=20:40 --vary links.rocker.mass_kg=0.1:0.5 --vary density=normal(1.5,0.1,1,2)";
    place.ok(&format!("sweep four_bar.toml {vary} --sobol 8 --seed 3 {figures} -o out"));
    let rows = rows(&place.path("out/cases.parquet"));
    assert_eq!(rows.len(), 8);
    for (case, row) in rows.iter().enumerate() {
        assert_eq!(row["case"], Field::Long(case as i64));
        assert_eq!(text(row, "state"), "solved");
        let set = ["crank_mm", "links.rocker.mass_kg", "density"]
            .map(|key| format!("--set {key}={:?}", number(row, key)))
            .join(" ");
        let table = Table::of(&place.ok(&format!("solve four_bar.toml {set}")));
        let column = |name: &str| table.column(name);
        let (x, y) = (column("joint.A.fx_N"), column("joint.A.fy_N"));
        let force = x
            .iter()
            .zip(&y)
            .map(|(x, y)| (x * x + y * y).sqrt())
            .fold(0.0, |most: f64, own| if own > most { own } else { most });
        assert_eq!(number(row, "max:joint.A.f_N"), force);
        let torque = column("drive.torque_N_m").into_iter().fold(
            0.0,
            |most: f64, own| {
                if own.abs() > most { own.abs() } else { most }
            },
        );
        assert_eq!(number(row, "maxabs:drive.torque_N_m"), torque);
        let angles = column("link.rocker.angle_rad");
        let least = (0..angles.len()).reduce(|best, own| if angles[own] < angles[best] { own } else { best }).unwrap();
        assert_eq!(number(row, "at_min:link.rocker.angle_deg"), column("crank_rad")[least].to_degrees());
        assert_eq!(number(row, "at=0:link.coupler.alpha_rad_s2"), column("link.coupler.alpha_rad_s2")[0]);
        // The trapezoidal rule at equal steps: the ends count half.
        let speeds = column("point.E.vx_m_s");
        let last = speeds.len() - 1;
        let square = |row: usize| speeds[row] * speeds[row] * if row == 0 || row == last { 0.5 } else { 1.0 };
        let rms = ((0..=last).map(square).sum::<f64>() / last as f64).sqrt();
        assert!((number(row, "rms:point.E.vx_m_s") / rms - 1.0).abs() < 1e-13);
    }
}

/// A moment of resistance changes its sign when its link reverses.
/// Two resistances on one link are added.
#[test]
fn figures_under_resistance_have_the_bits_of_solve() {
    let place = Place::empty();
    place.ok("new --shipped");
    place.ok("new four-bar");
    let loaded = std::fs::read_to_string(place.path("four_bar.toml")).unwrap()
        + "\n[[loads]]\ntype = \"resistance\"\nlink = \"rocker\"\nmoment_N_m = 3\n"
        + "\n[[loads]]\ntype = \"resistance\"\nlink = \"rocker\"\nmoment_N_m = 0.1\n";
    std::fs::write(place.path("loaded.toml"), loaded).unwrap();
    for (file, key) in [("scenarios/crank_rocker.toml", "links.coupler.mass_kg"), ("loaded.toml", "rocker_mm")] {
        let (from, to) = if key == "rocker_mm" { (80.0, 100.0) } else { (20.0, 40.0) };
        place.ok(&format!(
            "sweep {file} --vary {key}={from}:{to}:5 --figure maxabs:drive.torque_N_m --figure at=40:joint.B.fx_N -o out"
        ));
        for row in rows(&place.path("out/cases.parquet")) {
            let table = Table::of(&place.ok(&format!("solve {file} --set {key}={:?}", number(&row, key))));
            let torque =
                table.column("drive.torque_N_m").into_iter().map(f64::abs).reduce(|a, b| if b > a { b } else { a });
            assert_eq!(number(&row, "maxabs:drive.torque_N_m"), torque.unwrap());
            let at =
                table.column("crank_rad").iter().position(|angle| (angle.to_degrees() - 40.0).abs() < 1e-9).unwrap();
            assert_eq!(number(&row, "at=40:joint.B.fx_N"), table.column("joint.B.fx_N")[at]);
        }
        std::fs::remove_dir_all(place.path("out")).unwrap();
    }
}

/// A crank that is too long cannot rotate fully, and with a ground that is too long, the mechanism cannot be assembled.
/// No case is dropped.
#[test]
fn impossible_cases_are_refused_with_their_reasons() {
    let place = Place::empty();
    place.ok(FOUR_BAR);
    let told = place
        .ok("sweep four_bar.toml --vary crank_mm=30:90:3 --vary ground_mm=100:400:2 --figure maxabs:drive.torque_N_m");
    assert!(told.contains("6 cases, 1 solved") && told.contains("5 refused"), "{told}");
    let rows = rows(&place.path("sweep/cases.parquet"));
    assert_eq!(rows.len(), 6);
    for (case, row) in rows.iter().enumerate() {
        let is_solved = case == 0;
        assert_eq!(text(row, "state"), if is_solved { "solved" } else { "refused" });
        assert_eq!(row.contains_key("maxabs:drive.torque_N_m"), is_solved);
        assert_eq!(row.contains_key("reason"), !is_solved);
    }
    assert!(text(&rows[1], "reason").contains("cannot be assembled"), "{rows:?}");
}

/// A rocker with a moment of inertia but no mass is refused in a batch as it is by `solve`.
/// A number that is too large for a double is not taken for zero. The width of a range must be a number.
#[test]
fn regress_impossible_numbers_are_refused() {
    let place = Place::empty();
    place.ok(FOUR_BAR);
    let reasons = |words: &str| -> Vec<Option<String>> {
        let _ = fs::remove_dir_all(place.path("sweep"));
        place.ok(&format!("sweep four_bar.toml {words}"));
        let rows = rows(&place.path("sweep/cases.parquet"));
        rows.iter().map(|row| row.get("reason").map(|_| text(row, "reason").to_string())).collect()
    };
    let found = reasons("--vary links.rocker.mass_kg=0:0.3:2 --figure max:point.A.x_mm");
    assert!(matches!(&found[..], [Some(reason), None] if reason.contains("but no mass")), "{found:?}");
    for figure in ["at=0:1/exp(710+link.crank.angle_rad)", "max:exp(1e5*link.crank.angle_rad)"] {
        let found = reasons(&format!("--vary crank_mm=30:40:2 --figure {figure}"));
        assert!(found.iter().flatten().filter(|own| own.contains("no value")).count() == 2, "{figure}: {found:?}");
    }
    place.refused("sweep four_bar.toml --vary crank_mm=1e308:-1e308:3 --figure max:point.A.x_mm", &["too wide"]);
}

#[test]
fn regress_numbers_of_the_file_that_no_case_has_need_not_be_possible() {
    let place = Place::empty();
    place.ok(FOUR_BAR);
    let text = fs::read_to_string(place.path("four_bar.toml")).unwrap();
    fs::write(place.path("long.toml"), text.replace("crank_mm = 40", "crank_mm = 400")).unwrap();
    fs::write(place.path("light.toml"), text.replace("density = 1.5", "density = -1")).unwrap();
    let figure = "--figure max:joint.A.f_N";
    let sweep = |name: &str, vary: &str| {
        place.ok(&format!("sweep {name}.toml --vary {vary} {figure} -o {name}_{vary} -o {name}.html"));
        figures(&place.path(&format!("{name}_{vary}/cases.parquet")), "max:joint.A.f_N")
    };
    for (name, vary) in [("long", "crank_mm=20:40:5"), ("light", "density=1:2:3")] {
        assert_eq!(sweep(name, vary), sweep("four_bar", vary), "{name}");
    }
    place.refused(&format!("sweep long.toml --vary coupler_mm=20:40:5 {figure} -o none"), &["cannot be assembled"]);
}

/// Transmission angle and range of motion, compared with closed forms of the four-bar (Freudenstein).
#[test]
fn figures_of_the_whole_mechanism_are_those_of_its_geometry() {
    let place = Place::empty();
    place.ok(FOUR_BAR);
    let figures = "--figure transmission_angle_deg --figure reach_from --figure reach_to --figure verdict:psi";
    place.ok(&format!("sweep four_bar.toml --vary crank_mm=30:40:2 --set coupler_mm=110 {figures} -o out"));
    for row in rows(&place.path("out/cases.parquet")) {
        let (crank, coupler, rocker, ground) = (number(&row, "crank_mm"), 110.0f64, 80.0f64, 100.0f64);
        let mu = |distance: f64| {
            let cosine = (coupler.powi(2) + rocker.powi(2) - distance.powi(2)) / (2.0 * coupler * rocker);
            let angle = cosine.acos().to_degrees();
            if angle > 90.0 { 180.0 - angle } else { angle }
        };
        let (inner, outer) = (mu(ground - crank), mu(ground + crank));
        let least = if inner < outer { inner } else { outer };
        assert!((number(&row, "transmission_angle_deg") - least).abs() < 1e-9, "{row:?}");
        assert_eq!([number(&row, "reach_from"), number(&row, "reach_to")], [0.0, 360.0]);
        assert_eq!(number(&row, "verdict:psi"), 1.0);
    }
}

/// One thread, two threads, and three shards in one or in several directories give the same bytes.
#[test]
fn threads_and_shards_do_not_change_the_bytes() {
    let place = Place::empty();
    place.ok(FOUR_BAR);
    let sweep = format!("sweep four_bar.toml --vary crank_mm=20:50 --latin 500 {FIGURES} --part 32");
    place.ok(&format!("{sweep} -o one --jobs 1"));
    place.ok(&format!("{sweep} -o two --jobs 2"));
    let bytes = |name: &str| fs::read(place.path(name).join("cases.parquet")).unwrap();
    let expected = bytes("one");
    assert_eq!(bytes("two"), expected);
    for shard in 1..=3 {
        place.ok(&format!("{sweep} --shard {shard}/3 -o shared"));
        place.ok(&format!("{sweep} --shard {shard}/3 -o shard{shard}"));
    }
    place.refused("merge shard1 shard3 -o half", &["part 1 is missing"]);
    place.ok("merge shared");
    place.ok("merge shard1 shard2 shard3 -o all");
    assert_eq!(bytes("shared"), expected);
    assert_eq!(bytes("all"), expected);
    // A finished sweep is not solved again.
    // A sweep with a different seed does not replace the finished sweep.
    let told = place.ok(&format!("{sweep} -o one"));
    assert!(told.contains("500 cases"), "{told}");
    place.refused(&format!("{sweep} --seed 2 -o one"), &["another sweep"]);
    assert_eq!(bytes("one"), expected);
    place.ok(&format!("{sweep} --seed 2 -o other --shard 1/3"));
    place.refused("merge shard1 other", &["different sweeps"]);
}

/// After a loss of power, the file of a part may lack its end, because this end was not yet on the device.
#[test]
fn a_part_without_its_end_is_solved_again() {
    let place = Place::empty();
    place.ok(FOUR_BAR);
    let sweep = format!("sweep four_bar.toml --vary crank_mm=20:50 --latin 200 {FIGURES} --part 50");
    place.ok(&format!("{sweep} -o whole"));
    place.ok(&format!("{sweep} --shard 1/2 -o cut"));
    let part = place.path("cut/parts/000000002.parquet");
    let bytes = fs::read(&part).unwrap();
    fs::write(&part, &bytes[..bytes.len() / 2]).unwrap();
    place.ok(&format!("{sweep} -o cut"));
    let table = |name: &str| fs::read(place.path(name).join("cases.parquet")).unwrap();
    assert_eq!(table("cut"), table("whole"));
}

/// The sweep is killed ten times at different moments, and continued by the same command.
#[test]
#[cfg(unix)]
fn ten_kills_do_not_change_the_bytes() {
    let place = Place::empty();
    place.ok(FOUR_BAR);
    // The figure `reach_from` takes more than a millisecond for each case, so even the latest kill comes before the end
    // of the sweep.
    let slow = "--figure reach_from --part 2";
    let sweep = format!("sweep four_bar.toml --vary crank_mm=20:50 --random 1200 {FIGURES} {slow}");
    place.ok(&format!("{sweep} -o whole"));
    let parts = || fs::read_dir(place.path("killed/parts")).map_or(0, Iterator::count);
    for round in 0..10 {
        let mut child = Command::cargo_bin("linkproof").unwrap();
        child.current_dir(place.path("")).args(sweep.split(' ')).args(["-o", "killed", "--jobs", "2"]);
        let mut child = child.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
        // The sweep has 600 parts.
        // The command is killed when one to four further parts are stored, at different moments within a part.
        let wanted = parts() + 1 + round % 4;
        while parts() < wanted && child.try_wait().unwrap().is_none() {
            sleep(Duration::from_micros(200));
        }
        sleep(Duration::from_micros(170 * round as u64));
        child.kill().unwrap();
        child.wait().unwrap();
        assert!(!place.path("killed/cases.parquet").exists(), "run {round} ended before it was killed");
    }
    place.ok(&format!("{sweep} -o killed"));
    let bytes = |name: &str| fs::read(place.path(name).join("cases.parquet")).unwrap();
    assert_eq!(bytes("killed"), bytes("whole"));
    assert!(!place.path("killed/parts").exists());
}

/// A table that is joined already is accepted, and parts that a killed run has left are removed.
#[test]
fn regress_a_joined_table_is_copied_and_leftover_parts_are_removed() {
    let place = Place::empty();
    place.ok(FOUR_BAR);
    let sweep = "sweep four_bar.toml --vary crank_mm=30:40:9 --figure maxabs:drive.torque_N_m --part 2";
    place.ok(&format!("{sweep} -o whole"));
    let told = place.ok("merge whole -o copy");
    assert!(told.contains("9 cases"), "{told}");
    let bytes = |name: &str| fs::read(place.path(name).join("cases.parquet")).unwrap();
    assert_eq!(bytes("copy"), bytes("whole"));
    assert!(!place.path("copy/parts").exists());
    for command in [format!("{sweep} -o whole"), "merge whole".into()] {
        fs::create_dir(place.path("whole/parts")).unwrap();
        fs::write(place.path("whole/parts/000000001.parquet"), b"PAR1").unwrap();
        place.ok(&command);
        assert!(!place.path("whole/parts").exists(), "{command}");
    }
    // A loss of power may leave a part of zeros, which is solved again.
    place.ok(&format!("{sweep} --shard 1/2 -o power"));
    fs::write(place.path("power/parts/000000002.parquet"), [0; 1000]).unwrap();
    place.ok(&format!("{sweep} -o power"));
    assert_eq!(bytes("power"), bytes("whole"));
}

/// Every second case is proven; a wrong formula of the file makes the proof disagree and stops the sweep.
#[test]
fn proofs_are_taken_as_asked_and_stop_the_sweep_if_they_disagree() {
    let place = Place::empty();
    place.ok(FOUR_BAR);
    let sweep = "--vary crank_mm=30:40:4 --figure maxabs:drive.torque_N_m --prove every:2";
    let told = place.ok(&format!("sweep four_bar.toml {sweep} -o right"));
    assert!(told.contains("2 proofs: agree"), "{told}");
    for (case, row) in rows(&place.path("right/cases.parquet")).iter().enumerate() {
        assert_eq!(row.contains_key("proof"), case % 2 == 0);
    }
    let right = fs::read_to_string(place.path("four_bar.toml")).unwrap();
    fs::write(place.path("wrong.toml"), right.replace("2*atan2(q + sqrt", "2*atan2(q - sqrt")).unwrap();
    let outcome = place.run(&format!("sweep wrong.toml {sweep} -o wrong"));
    assert_eq!(outcome.code, 1, "{}", outcome.stderr);
    assert!(outcome.stdout.contains("linkproof run wrong.toml --set crank_mm=30"), "{}", outcome.stdout);
    // The stored case still disagrees when the sweep is continued.
    let again = place.run(&format!("sweep wrong.toml {sweep} -o wrong"));
    assert_eq!((again.code, again.stdout), (1, outcome.stdout));
    // So does the joined table.
    for command in ["merge wrong".into(), format!("sweep wrong.toml {sweep} -o wrong")] {
        let joined = place.run(&command);
        assert_eq!(joined.code, 1, "{command}: {}", joined.stderr);
        assert!(joined.stdout.contains("--set crank_mm=30"), "{}", joined.stdout);
    }
}

#[test]
fn questions_that_mean_nothing_are_refused() {
    let place = Place::empty();
    place.ok(FOUR_BAR);
    let refused = |arguments: &str, words: &[&str]| {
        place.refused(&format!("sweep four_bar.toml {arguments}"), words);
        assert!(!place.path("sweep").exists(), "{arguments}");
    };
    let figure = "--figure maxabs:drive.torque_N_m";
    refused(&format!("--vary crnk_mm=1:2:3 {figure}"), &["crnk_mm", "crank_mm"]);
    refused(&format!("--vary links.crank.mas_kg=1:2:3 {figure}"), &["links.crank.mas_kg", "links.crank.mass_kg"]);
    refused(&format!("--vary crank_mm=1:2 {figure}"), &["grid"]);
    refused(&format!("--vary crank_mm=1:2:3 --sobol 8 {figure}"), &["samples"]);
    refused("--vary crank_mm=1:2:3 --figure biggest:drive.torque_N_m", &["biggest", "max"]);
    refused("--vary crank_mm=1:2:3 --figure max:drive.torque_Nm", &["drive.torque_Nm"]);
    refused("--vary crank_mm=1:2:3 --figure verdict:phi2", &["phi2"]);
    refused(&format!("--vary crank_mm=1:2:3 {figure} {figure}"), &["two columns"]);
    refused(&format!("--vary crank_mm=1:2:3 {figure} --best most:x"), &["most:x"]);
    refused(&format!("--vary crank_mm=1:2:3 {figure} --shard 3/2"), &["shard"]);
    refused("--vary crank_mm=1:2:3 --figure at=37.1:link.rocker.angle_deg", &["no instant at 37.1 deg"]);
    refused(&format!("--vary crank_mm=1:2:3 --set coupler_mm=1 --set coupler_mm=2 {figure}"), &["given twice"]);
    fs::create_dir(place.path("mine")).unwrap();
    fs::write(place.path("mine/notes.txt"), "mine").unwrap();
    place.refused(&format!("sweep four_bar.toml --vary crank_mm=30:40:3 {figure} -o mine"), &["notes.txt"]);
    place.refused("merge mine", &["contains no sweep"]);
}

/// The page of a sweep names the cases with the best figure and draws these cases.
#[test]
fn the_page_shows_the_best_cases() {
    let place = Place::empty();
    place.ok(FOUR_BAR);
    place.ok("sweep four_bar.toml --vary crank_mm=20:60 --sobol 64 --figure transmission_angle_deg \
         --best max:transmission_angle_deg -o out -o page.html");
    let page = fs::read_to_string(place.path("page.html")).unwrap();
    let rows = rows(&place.path("out/cases.parquet"));
    let solved = rows.iter().filter(|row| text(row, "state") == "solved");
    let best =
        solved.max_by(|a, b| number(a, "transmission_angle_deg").total_cmp(&number(b, "transmission_angle_deg")));
    let Field::Long(best) = best.unwrap()["case"] else { panic!("a number") };
    assert!(page.contains(&format!("<figcaption>case {best}<")), "{best}");
    assert_eq!(page.matches("<figcaption>").count(), 10);
    assert!(page.matches("<polyline").count() > 30);
}

/// A number of the file is set by its path, whether the file states a number or an expression.
#[test]
fn numbers_are_set_by_their_paths() {
    let place = Place::new();
    let torque = |set: &str| {
        Table::of(&place.ok(&format!("solve scenarios/crank_rocker.toml {set}"))).column("drive.torque_N_m")
    };
    let plain = torque("");
    place.edited("crank_rocker.toml", "heavy.toml", &[("mass_kg = 2.6", "mass_kg = 4.5")]);
    let edited = Table::of(&place.ok("solve scenarios/heavy.toml")).column("drive.torque_N_m");
    assert_eq!(torque("--set links.crank.mass_kg=4.5"), edited);
    assert_ne!(plain, edited);
    place.refused("solve scenarios/crank_rocker.toml --set links.crank.mass_kg=-1", &["-1", "links.crank.mass_kg"]);
    place.refused("solve scenarios/crank_rocker.toml --set joints.Q.axis_deg=1", &["joints.Q.axis_deg"]);
}

/// Processes that start together share one directory, whether they solve shards or the whole sweep.
#[test]
fn regress_processes_that_start_together_share_a_directory() {
    let place = Place::empty();
    place.ok(FOUR_BAR);
    let sweep = format!("sweep four_bar.toml --set grid.step_deg=20 --vary crank_mm=20:40 --sobol 400 {FIGURES}");
    place.ok(&format!("{sweep} -o alone"));
    let alone = fs::read(place.path("alone/cases.parquet")).unwrap();
    let together = |words: &dyn Fn(usize) -> String| {
        let start = |number: usize| {
            let mut child = Command::cargo_bin("linkproof").unwrap();
            child.current_dir(place.path("")).args(sweep.split(' ')).args(words(number).split(' '));
            child.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
        };
        let children: Vec<_> = (1..=4).map(start).collect();
        for child in children {
            let output = child.wait_with_output().unwrap();
            assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        }
    };
    for round in 0..3 {
        together(&|number| format!("--shard {number}/4 -o shards_{round}"));
        place.ok(&format!("merge shards_{round} -o merged_{round}"));
        assert_eq!(fs::read(place.path(&format!("merged_{round}/cases.parquet"))).unwrap(), alone);
        together(&|_| format!("-o whole_{round}"));
        assert_eq!(fs::read(place.path(&format!("whole_{round}/cases.parquet"))).unwrap(), alone);
    }
}
