//! Correct tables as programs print them: each column with different digits, times rounded.
//! All correct tables are accepted, and an error of a few units of the last digit is found.

use std::fmt::Write;

use super::{against, scenario, solved};
use linkage::math::KeepNan;
use linkage::trajectory::Trajectory;
use linkproof::Scenario;
use prover::compare::{ComparisonRule, PartyComparison};
use prover::tables::{Raw, load};

/// Random numbers, the same in every run (SplitMix64).
pub(crate) struct RandomSource(pub(crate) u64);

impl RandomSource {
    pub(crate) fn index(&mut self, count: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((mixed ^ (mixed >> 31)) % count as u64) as usize
    }
}

/// How a column is printed.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Format {
    /// Number of significant digits, without trailing zeros, as in `%.9g`.
    General(usize),
    /// Number of significant digits, with an exponent.
    Exponent(usize),
    /// Number of decimals.
    Fixed(usize),
    /// The shortest text of a double, as in Python.
    Shortest,
    /// The shortest text of a single-precision number.
    Single,
}

impl Format {
    pub(crate) fn print(self, value: f64) -> String {
        match self {
            Format::Exponent(digits) => format!("{value:.*e}", digits - 1),
            Format::Fixed(decimals) => format!("{value:.decimals$}"),
            Format::Shortest => format!("{value}"),
            Format::Single => format!("{}", value as f32),
            Format::General(digits) => {
                let rounded = format!("{value:.*e}", digits - 1);
                let (_, exponent) = rounded.split_once('e').unwrap();
                let decimals = (digits as i32 - 1 - exponent.parse::<i32>().unwrap()).max(0) as usize;
                let plain = format!("{:.decimals$}", rounded.parse::<f64>().unwrap());
                match plain.contains('.') {
                    true => plain.trim_end_matches('0').trim_end_matches('.').into(),
                    false => plain,
                }
            }
        }
    }

    /// The value of one unit of the last printed digit.
    pub(crate) fn unit(self, value: f64) -> f64 {
        match self {
            Format::Fixed(decimals) => 10f64.powi(-(decimals as i32)),
            Format::General(digits) | Format::Exponent(digits) => {
                10f64.powi(value.abs().log10().floor() as i32 + 1 - digits as i32)
            }
            Format::Shortest => f64::EPSILON * value.abs(),
            Format::Single => f64::from(f32::EPSILON) * value.abs(),
        }
    }
}

/// A table as printed.
/// `times` holds the format of the printed times, the factor from seconds to their unit, and the name of their column.
/// `columns` holds the name, the format and the numbers of each column, and `at` the times (s).
struct Printed {
    times: (Format, f64, &'static str),
    columns: Vec<(String, Format, Vec<f64>)>,
    at: Vec<f64>,
}

impl Printed {
    /// Some channels of a trajectory, in random formats.
    fn of(right: &Trajectory, random: &mut RandomSource, times: (Format, f64, &'static str), every: usize) -> Self {
        let rows = (0..right.times().len()).step_by(every);
        let mut columns = Vec::new();
        for (channel, values) in right.iter() {
            if columns.len() < 12 && random.index(right.channels().len()) >= 12 {
                continue;
            }
            let digits = 3 + random.index(15);
            let size = values.iter().map(|value| value.abs()).fold(0.0, KeepNan::larger);
            let places = if size > 0.0 { size.log10().floor() as i32 } else { 0 };
            let format = match random.index(4) {
                0 => Format::Exponent(digits),
                1 => Format::Fixed((digits as i32 - 1 - places).max(0) as usize),
                2 if digits == 17 => Format::Shortest,
                _ => Format::General(digits),
            };
            columns.push((channel.to_string(), format, rows.clone().map(|row| values[row]).collect()));
        }
        Printed { times, columns, at: rows.map(|row| right.times()[row]).collect() }
    }

    fn text(&self) -> String {
        let (format, factor, name) = self.times;
        let mut text = name.to_string();
        self.columns.iter().for_each(|(name, ..)| write!(text, ",{name}").unwrap());
        for (row, at) in self.at.iter().enumerate() {
            write!(text, "\n{}", format.print(factor * at)).unwrap();
            self.columns.iter().for_each(|(_, format, values)| write!(text, ",{}", format.print(values[row])).unwrap());
        }
        text + "\n"
    }

    fn raw(&self) -> Raw {
        let directory = tempfile::TempDir::new().unwrap();
        let path = directory.path().join("printed.csv");
        std::fs::write(&path, self.text()).unwrap();
        load(&path).unwrap()
    }

    fn compared(&self, scenario: &Scenario) -> PartyComparison {
        against(scenario, &self.raw(), &ComparisonRule::default())
    }
}

const TIMES: [(Format, f64, &str); 8] = [
    (Format::General(9), 1.0, "t_s"),
    (Format::Fixed(6), 1.0, "t_s"),
    (Format::Fixed(4), 1.0, "time"),
    (Format::General(6), 1.0, "t"),
    (Format::Exponent(5), 1e3, "time_ms"),
    (Format::Fixed(0), 1e3, "time_ms"),
    (Format::General(15), 1.0, "t_s"),
    (Format::Shortest, 1.0, "t_s"),
];

const SCENARIOS: [&str; 8] = [
    "crank_rocker",
    "offset_press",
    "quick_return",
    "compressor",
    "ov7_base",
    "fourth_class",
    "crank_rocker_runup",
    "scotch_yoke",
];

#[test]
fn correct_tables_are_never_refused_for_any_digits() {
    let (mut tables, mut channels, mut agreed) = (0, 0, 0);
    for (number, name) in SCENARIOS.into_iter().enumerate() {
        let scenario = scenario(name);
        let right = solved(&scenario);
        for (seed, times) in TIMES.into_iter().enumerate() {
            let mut random = RandomSource(100 * number as u64 + seed as u64);
            // Complete tables, tables with every third row, and tables of a few rows.
            let every = [1, 3, right.times().len() / 4][seed % 3];
            let printed = Printed::of(&right, &mut random, times, every);
            let found = printed.compared(&scenario);
            for own in &found.pairs[0].channels {
                assert!(own.since.is_none(), "{name}, {times:?}: {} {:?}", own.claim.text, own.since);
                agreed += usize::from(own.verdict.word() == "agree");
                channels += 1;
            }
            tables += 1;
        }
    }
    println!("{tables} tables, {agreed} of {channels} columns agree");
    // If times are printed in whole milliseconds, many columns stay undecided.
    // With finer times, hardly any column stays undecided.
    assert!(agreed * 10 >= channels * 8, "{agreed} of {channels}");
}

/// At exact instants, an error of three units of the last digit is found, and half a unit is allowed.
#[test]
fn an_error_of_three_units_of_the_last_digit_is_found() {
    let (mut planted, mut random) = (0, RandomSource(7));
    for name in ["crank_rocker", "offset_press", "quick_return", "compressor", "ov7_base", "scotch_yoke"] {
        let scenario = scenario(name);
        let right = solved(&scenario);
        let mut printed = Printed::of(&right, &mut random, (Format::Shortest, 1.0, "t_s"), 1);
        let mut wrong = Vec::new();
        for (text, format, values) in &mut printed.columns {
            let size = values.iter().map(|value| value.abs()).fold(0.0, KeepNan::larger);
            let row = random.index(values.len());
            // Limits the format to digits that the analytic sides compute reliably.
            *format = match (*format, size.log10().floor() as i32) {
                (Format::Fixed(decimals), places) => Format::Fixed(decimals.min((6 - places).max(0) as usize)),
                (Format::General(digits), _) => Format::General(digits.min(7)),
                (Format::Exponent(digits), _) => Format::Exponent(digits.min(7)),
                (Format::Shortest | Format::Single, _) => Format::General(7),
            };
            // A value that consists of rounding error has no significant digits, so no error is planted in it.
            let has_digits = size > 1e-6 && values[row].abs() > 1e-3 * size && format.unit(values[row]) > 1e-7 * size;
            if has_digits {
                values[row] += 3.0 * format.unit(values[row]);
            }
            wrong.push((text.clone(), *format, has_digits.then_some(row)));
        }
        let found = printed.compared(&scenario);
        for (own, (text, format, row)) in found.pairs[0].channels.iter().zip(wrong) {
            assert_eq!(own.since.map(|at| at.row), row, "{name}: {text} with {format:?}: {:?}", own.worst);
            planted += usize::from(row.is_some());
        }
    }
    assert!(planted > 50, "{planted}");
}

/// If instants are rounded, a number may differ by as much as the quantity changes within the rounding interval, but
/// not by more.
#[test]
fn rounded_instants_excuse_only_the_change_within_them() {
    let mut planted = 0;
    for name in ["crank_rocker", "offset_press", "ov7_base", "compressor", "six_bar_slider"] {
        let scenario = scenario(name);
        let right = solved(&scenario);
        for times in [(Format::Fixed(5), 1.0, "t_s"), (Format::General(4), 1e3, "time_ms")] {
            let points = right.channels().iter().filter(|own| own.to_string().ends_with(".x_m"));
            let names: Vec<String> = points.map(ToString::to_string).collect();
            let column = |name: &str| right.named(name).unwrap().to_vec();
            let columns = names.iter().map(|name| (name.clone(), Format::Fixed(9), column(name))).collect();
            let mut printed = Printed { times, columns, at: right.times().to_vec() };
            let mut wrong = Vec::new();
            for (index, name) in names.iter().enumerate() {
                let speed = column(&name.replace(".x_m", ".vx_m_s"));
                let row = (37 * (index + 1)) % speed.len();
                let half = 0.5 * times.0.unit(times.1 * printed.at[row]) / times.1;
                // The planted error is three units of the last digit plus twice the change of the quantity in half a
                // unit of the instant.
                // Of this error, the rounding of the instant can explain only one such change.
                printed.columns[index].2[row] += 3e-9 + 2.0 * speed[row].abs() * half + 1e3 * half * half;
                wrong.push(row);
            }
            let found = printed.compared(&scenario);
            for (own, row) in found.pairs[0].channels.iter().zip(wrong) {
                assert_eq!(own.since.map(|at| at.row), Some(row), "{name}: {}: {:?}", own.claim.text, own.worst);
                planted += 1;
            }
        }
    }
    assert!(planted >= 30, "{planted}");
}
