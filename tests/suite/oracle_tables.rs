//! Tables of `[[oracle]]` as programs print them: each column with different digits, times and crank angles rounded.
//! Correct tables are accepted, and an error of a few units of the last digit is found.

use std::fmt::Write;
use std::path::Path;

use linkage::case::{Case, Grid};
use linkage::math::{KeepNan, largest_size};
use linkage::solver::Solver;
use linkage::trajectory::{Channel, Trajectory};
use prover::bounds::Check;
use prover::run::{Options, prove};
use prover::tolerance::BoundBasis;
use scenario::Scenario;

use crate::compare::digits::{Format, RandomSource};

/// A column of instants: its format, the number of its units in one SI unit, and its name.
type Instants = (Format, f64, &'static str);

const TIMES: [Instants; 7] = [
    (Format::General(9), 1.0, "t_s"),
    (Format::Fixed(4), 1.0, "t_s"),
    (Format::Fixed(7), 1.0, "t_s"),
    (Format::Exponent(5), 1e3, "t_ms"),
    (Format::Single, 1.0, "t_s"),
    (Format::General(15), 1.0, "t_s"),
    (Format::Shortest, 1.0, "t_s"),
];

const CRANKS: [Instants; 5] = [
    (Format::General(9), 180.0 / std::f64::consts::PI, "crank_deg"),
    (Format::Fixed(3), 180.0 / std::f64::consts::PI, "crank_deg"),
    (Format::Fixed(5), 1.0, "crank_rad"),
    (Format::Single, 1.0, "crank_rad"),
    (Format::Shortest, 1.0, "crank_rad"),
];

/// The text of a scenario before the scenario's own oracles.
fn text(path: &str) -> String {
    let text = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).unwrap();
    text.split("[[oracle]]").next().unwrap().to_string()
}

/// A table of a correct solution.
struct Table {
    instants: Instants,
    at: Vec<f64>,
    /// Channel as printed, its format, and its numbers in the printed unit.
    columns: Vec<(String, Format, Vec<f64>)>,
}

impl Table {
    /// Some channels at unevenly spaced instants, in random units and formats.
    fn of(case: &Case, instants: Instants, random: &mut RandomSource) -> Table {
        let name = instants.2;
        let (rows, last) = (40, case.grid.times.iter().copied().fold(0.0, KeepNan::larger));
        let grid = match name.starts_with("crank") {
            true => Grid::of_inputs(
                case.crank(),
                (0..rows).map(|row| 0.0361 + 0.127_314_159_265 * f64::from(row)).collect(),
            ),
            // The last instant is the end of the run; rounding of the printed instants may move the last instant beyond
            // this end.
            false => {
                let share = |row: i32| (f64::from(row) / f64::from(rows)).powf(1.1);
                Grid::of_times(case.crank(), (1..=rows).map(|row| last * share(row)).collect())
            }
        };
        let at = if name.starts_with("crank") { grid.inputs.clone() } else { grid.times.clone() };
        let right = analytic::AssurSolver.solve(&case.on(grid).unwrap()).unwrap();
        let mut columns = Vec::new();
        for (channel, values) in right.iter() {
            if columns.is_empty() || random.index(right.channels().len()) < 9 {
                columns.push(column(channel, values, &right, random));
            }
        }
        Table { instants, at, columns }
    }

    fn text(&self) -> String {
        let (format, factor, name) = self.instants;
        let mut text = name.to_string();
        (0..self.columns.len()).for_each(|index| write!(text, ",k{index}").unwrap());
        for (row, at) in self.at.iter().enumerate() {
            write!(text, "\n{}", format.print(factor * at)).unwrap();
            self.columns.iter().for_each(|(_, format, values)| write!(text, ",{}", format.print(values[row])).unwrap());
        }
        text + "\n"
    }
}

fn column(
    channel: &Channel,
    values: &[f64],
    right: &Trajectory,
    random: &mut RandomSource,
) -> (String, Format, Vec<f64>) {
    let name = channel.to_string();
    let other = [("angle_rad", "angle_deg", 180.0 / std::f64::consts::PI), ("x_m", "x_mm", 1e3), ("y_m", "y_mm", 1e3)];
    let in_other = other.iter().find(|(si, ..)| name.ends_with(&format!(".{si}")) && random.index(2) == 0);
    let (name, values): (String, Vec<f64>) = match in_other {
        Some((si, unit, factor)) => (name.replace(si, unit), values.iter().map(|value| factor * value).collect()),
        None if name.starts_with("joint.") && name.ends_with(".fx_N") && random.index(2) == 0 => {
            let across = right.named(&name.replace("fx_N", "fy_N")).unwrap();
            (name.replace("fx_N", "f_N"), values.iter().zip(across).map(|(x, y)| x.hypot(*y)).collect())
        }
        None => (name, values.to_vec()),
    };
    let (digits, size) = (3 + random.index(15), largest_size(&values));
    let places = if size > 0.0 { size.log10().floor() as i32 } else { 0 };
    let format = match random.index(5) {
        0 => Format::Exponent(digits),
        1 => Format::Fixed((digits as i32 - 1 - places).max(0) as usize),
        2 => Format::Single,
        3 if digits == 17 => Format::Shortest,
        _ => Format::General(digits),
    };
    (name, format, values)
}

/// Proves the scenario with every table added as one `[[oracle]]`, and returns the checks of these tables.
fn checks(scenario: &str, tables: &[Table]) -> Vec<Check> {
    let directory = tempfile::tempdir().unwrap();
    let mut text = scenario.to_string();
    for (number, table) in tables.iter().enumerate() {
        std::fs::write(directory.path().join(format!("{number}.csv")), table.text()).unwrap();
        let name = table.instants.2;
        let key = if name.starts_with("crank") { "crank" } else { "time" };
        write!(text, "\n[[oracle]]\nname = \"table {number}\"\nsource = \"printed\"\nfile = \"{number}.csv\"\n")
            .unwrap();
        writeln!(text, "{key} = \"{name}\"\n[oracle.columns]").unwrap();
        for (index, (channel, ..)) in table.columns.iter().enumerate() {
            writeln!(text, "k{index} = {{ channel = \"{channel}\" }}").unwrap();
        }
    }
    let path = directory.path().join("x.toml");
    let scenario = Scenario::parse(&text, &path).unwrap_or_else(|error| panic!("{error}"));
    let proof = prove(&scenario, &Options::default().budget(100.0)).unwrap_or_else(|error| panic!("{error}"));
    let is_table = |check: &Check| matches!(check.basis, BoundBasis::Digits { .. });
    proof.checks.into_iter().filter(is_table).collect()
}

/// Description of a check: table, column, channel and format.
fn told(check: &Check, tables: &[Table]) -> String {
    let number = |text: &str| text.split(' ').nth(2).unwrap().parse::<usize>().unwrap();
    let table = &tables[number(&check.family)];
    let (channel, format, _) = &table.columns[check.detail[1..].parse::<usize>().unwrap()];
    format!("{:?}, {channel} with {format:?}: {} {:?}", table.instants, check.family, check.verdict)
}

#[test]
fn correct_tables_are_never_refused_by_time_or_crank_angle() {
    let (mut all, mut agreed, mut rounded) = (0, 0, 0);
    for (seed, path) in [
        "scenarios/crank_rocker.toml",
        "scenarios/quick_return.toml",
        "scenarios/scotch_yoke.toml",
        "scenarios/crank_rocker_runup.toml",
        // No other test of tables uses these scenarios.
        "tests/outside/scenarios/eccentric_guide.toml",
        "tests/outside/scenarios/cycloidal_press.toml",
    ]
    .into_iter()
    .enumerate()
    {
        let scenario = text(path);
        let case = Scenario::parse(&scenario, Path::new("x.toml")).unwrap_or_else(|error| panic!("{error}")).case;
        let by_crank: &[Instants] = if case.is_steady() && !case.is_free() { &CRANKS } else { &[] };
        let mut random = RandomSource(seed as u64);
        let of = |&instants| Table::of(&case, instants, &mut random);
        let tables: Vec<Table> = TIMES.iter().chain(by_crank).map(of).collect();
        for check in checks(&scenario, &tables) {
            let word = check.verdict.word();
            assert_ne!(word, "disagree", "{path}: {}", told(&check, &tables));
            (all, agreed) = (all + 1, agreed + usize::from(word == "agree"));
            rounded += usize::from(check.basis.to_string().contains("covers the rounding of the instant"));
        }
    }
    println!("{agreed} of {all} series agree, {rounded} with rounded instants in the bound");
    assert!(agreed * 10 >= all * 9 && rounded * 3 > all, "{agreed} of {all}, {rounded} rounded");
}

/// If the instants are exact, the planted error is three units of the last digit.
/// If the instants are rounded, the planted error is larger.
/// It then exceeds twice the change of the number within half a unit of the last digit of the instant.
#[test]
fn a_wrong_number_is_found_among_rounded_instants() {
    let mut planted = 0;
    for path in ["scenarios/crank_rocker.toml", "scenarios/quick_return.toml", "scenarios/offset_press.toml"] {
        let scenario = text(path);
        let case = Scenario::parse(&scenario, Path::new("x.toml")).unwrap_or_else(|error| panic!("{error}")).case;
        let speed = case.crank().constant_speed().unwrap();
        let mut tables = Vec::new();
        for instants in TIMES.into_iter().chain(CRANKS) {
            let mut table = Table::of(&case, instants, &mut RandomSource(0));
            let is_crank = instants.2.starts_with("crank");
            let own = match is_crank {
                true => Grid::of_inputs(case.crank(), table.at.clone()),
                false => Grid::of_times(case.crank(), table.at.clone()),
            };
            let right = analytic::AssurSolver.solve(&case.on(own).unwrap()).unwrap();
            let places = right.iter().filter(|(channel, _)| channel.to_string().ends_with(".x_m"));
            table.columns =
                places.map(|(channel, values)| (channel.to_string(), Format::Fixed(9), values.to_vec())).collect();
            for (index, (channel, _, values)) in table.columns.iter_mut().enumerate() {
                let row = (7 * index + 3) % table.at.len();
                let half = 0.5 * instants.0.unit(instants.1 * table.at[row]) / instants.1;
                let late = if is_crank { half / speed.abs() } else { half };
                let rate = right.named(&channel.replace(".x_m", ".vx_m_s")).unwrap()[row];
                values[row] += 3e-9 + 2.0 * rate.abs() * late + 1e3 * late * late;
            }
            tables.push(table);
        }
        for check in checks(&scenario, &tables) {
            assert_eq!(check.verdict.word(), "disagree", "{path}: {}", told(&check, &tables));
            planted += 1;
        }
    }
    assert!(planted > 100, "{planted}");
}

/// The instants are rounded to ten milliseconds, in which the crank turns by eight degrees.
/// At instants rounded this coarsely, the check of a number is inconclusive, whether the number is right or wrong.
#[test]
fn instants_rounded_too_much_are_inconclusive() {
    let scenario = text("scenarios/crank_rocker.toml");
    let case = Scenario::parse(&scenario, Path::new("x.toml")).unwrap().case;
    let mut table = Table::of(&case, (Format::Fixed(2), 1.0, "t_s"), &mut RandomSource(3));
    let grid = Grid::of_times(case.crank(), table.at.clone());
    let right = analytic::AssurSolver.solve(&case.on(grid).unwrap()).unwrap();
    let omega = right.named("link.rocker.omega_rad_s").unwrap().to_vec();
    table.columns = vec![("link.rocker.omega_rad_s".into(), Format::General(9), omega)];
    for check in checks(&scenario, &[table]) {
        assert_eq!(check.verdict.word(), "inconclusive", "{:?}", check.verdict);
        let reason = check.verdict.reason(|advice| format!("{advice:?}")).unwrap();
        assert!(reason.contains("the instant is rounded") && reason.contains("more digits"), "{reason}");
    }
}

/// A column of zeros may belong to a quantity that is zero by structure, or to a quantity that was forgotten.
/// If the file prints nine digits and omits trailing zeros, its zeros count as exact.
#[test]
fn a_zero_column_is_exact_if_others_omit_trailing_zeros() {
    let scenario = text("scenarios/crank_rocker.toml");
    let case = Scenario::parse(&scenario, Path::new("x.toml")).unwrap().case;
    let verdicts = |name: &str, zero: Format| {
        let mut table = Table::of(&case, (Format::General(9), 1.0, "t_s"), &mut RandomSource(3));
        let grid = Grid::of_times(case.crank(), table.at.clone());
        let right = analytic::AssurSolver.solve(&case.on(grid).unwrap()).unwrap();
        let column = |name: &str| (name.to_string(), Format::General(9), right.named(name).unwrap().to_vec());
        table.columns = vec![column("link.rocker.omega_rad_s"), column("link.coupler.alpha_rad_s2")];
        table.columns.push((name.into(), zero, vec![0.0; table.at.len()]));
        checks(&scenario, &[table]).into_iter().map(|check| check.verdict.word()).collect::<Vec<_>>()
    };
    assert_eq!(verdicts("link.crank.alpha_rad_s2", Format::General(9)), ["agree"; 6]);
    // All positions are below 0.5 m.
    // If only the single digit of `0` counted, a column of `0` would therefore agree with every position.
    let wrong = ["agree", "agree", "disagree", "agree", "agree", "disagree"];
    assert_eq!(verdicts("point.A.x_m", Format::General(9)), wrong);
}

/// Some programs print angles within one revolution, so angles that differ by whole revolutions count as equal.
/// Positions have no such period.
#[test]
fn angles_may_be_whole_turns_apart() {
    let scenario = text("scenarios/crank_rocker.toml");
    let case = Scenario::parse(&scenario, Path::new("x.toml")).unwrap().case;
    let turns: [fn(f64, f64) -> f64; 4] = [
        |angle, turn| angle - turn * (angle / turn).floor(),
        |angle, turn| angle - turn * (angle / turn).round(),
        |angle, turn| angle + 3.0 * turn,
        |angle, turn| angle - 2.0 * turn,
    ];
    let mut tables = Vec::new();
    for instants in [(Format::General(15), 1.0, "t_s"), (Format::Shortest, 1.0, "crank_rad")] {
        let mut table = Table::of(&case, instants, &mut RandomSource(3));
        let grid = match instants.2 {
            "t_s" => Grid::of_times(case.crank(), table.at.clone()),
            _ => Grid::of_inputs(case.crank(), table.at.clone()),
        };
        let right = analytic::AssurSolver.solve(&case.on(grid).unwrap()).unwrap();
        table.columns.clear();
        for link in ["crank", "coupler", "rocker"] {
            for (unit, factor) in [("rad", 1.0), ("deg", 180.0 / std::f64::consts::PI)] {
                let angles = right.named(&format!("link.{link}.angle_rad")).unwrap();
                for of in turns {
                    let angles =
                        angles.iter().map(|angle| of(factor * angle, factor * std::f64::consts::TAU)).collect();
                    table.columns.push((format!("link.{link}.angle_{unit}"), Format::Fixed(9), angles));
                }
            }
        }
        tables.push(table);
    }
    let found = checks(&scenario, &tables);
    assert_eq!(found.len(), 2 * 2 * 24);
    for check in found {
        assert_eq!(check.verdict.word(), "agree", "{}", told(&check, &tables));
    }
    // An error of a tenth of a degree stays visible under any number of whole revolutions.
    for table in &mut tables {
        table.columns.retain(|(channel, ..)| channel.ends_with("deg"));
        table.columns.iter_mut().for_each(|(_, _, values)| values[7] += 720.1);
    }
    for check in checks(&scenario, &tables) {
        assert_eq!(check.verdict.word(), "disagree", "{}", told(&check, &tables));
    }
}
