//! Planted mistakes in tables: every mistake is found, and most mistakes are correctly named.

use std::f64::consts::PI;

use super::{against, scenario, solved, table};
use linkage::case::Case;
use linkage::trajectory::Trajectory;
use linkproof::report::compare::why;
use prover::compare::{ComparisonRule, PartyComparison};
use scenario::mapping::{Allowed, Size};

/// A mistake: a function that changes the correct columns of a table, and words that must occur in the named cause.
type Mistake = (&'static str, fn(&mut Columns), &'static [&'static str]);

struct Columns {
    time: Vec<f64>,
    /// Angle, angular velocity and angular acceleration of a link, position and x acceleration of its mass centre, and
    /// the driving moment. Columns of zeros are omitted.
    all: Vec<(String, Vec<f64>)>,
    /// Angle of another link.
    other: Vec<f64>,
    speed: f64,
}

impl Columns {
    fn of(right: &Trajectory, link: &str, other: &str, case: &Case) -> Self {
        let names = ["angle_rad", "omega_rad_s", "alpha_rad_s2", "x_m", "y_m", "ax_m_s2"];
        let mut all: Vec<(String, Vec<f64>)> = names
            .iter()
            .map(|suffix| format!("link.{link}.{suffix}"))
            .chain(["drive.torque_N_m".to_string()])
            .map(|name| (name.clone(), right.named(&name).unwrap().to_vec()))
            .collect();
        all.retain(|(_, values)| values.iter().any(|value| *value != 0.0));
        let other = right.named(&format!("link.{other}.angle_rad")).unwrap().to_vec();
        Columns { time: right.times().to_vec(), all, other, speed: case.crank().constant_speed().unwrap() }
    }

    fn change(&mut self, suffix: &str, change: impl Fn(f64) -> f64) {
        for (_, values) in self.all.iter_mut().filter(|(name, _)| name.ends_with(suffix)) {
            values.iter_mut().for_each(|value| *value = change(*value));
        }
    }

    fn compared(&self, name: &str, how: &ComparisonRule) -> PartyComparison {
        let mut columns = vec![("t_s", self.time.clone())];
        columns.extend(self.all.iter().map(|(name, values)| (name.as_str(), values.clone())));
        against(&scenario(name), &table(&columns), how)
    }
}

const MISTAKES: [Mistake; 16] = [
    ("sign of the angle", |own| own.change("angle_rad", |value| -value), &["opposite sign"]),
    ("sign of the moment", |own| own.change("torque_N_m", |value| -value), &["opposite sign"]),
    ("degrees", |own| own.change("angle_rad", f64::to_degrees), &["degrees instead"]),
    ("millimetres", |own| own.change("x_m", |value| 1e3 * value), &["millimetres instead"]),
    ("revolutions per minute", |own| own.change("omega_rad_s", |value| value * 30.0 / PI), &["revolutions per minute"]),
    ("from the y axis", |own| own.change("angle_rad", |value| value - PI / 2.0), &["-90 deg added"]),
    ("clockwise from the y axis", |own| own.change("angle_rad", |value| PI / 2.0 - value), &["opposite sense"]),
    ("twice", |own| own.change("torque_N_m", |value| 2.0 * value), &["twice"]),
    ("a third", |own| own.change("torque_N_m", |value| value / 3.0), &["0.33333"]),
    ("an offset", |own| own.change("y_m", |value| value + 0.0125), &["0.0125 m added"]),
    (
        "per radian",
        |own| {
            let speed = own.speed;
            own.change("omega_rad_s", |value| value / speed);
        },
        &["per radian"],
    ),
    (
        "per radian, squared",
        |own| {
            let speed = own.speed;
            own.change("alpha_rad_s2", |value| value / (speed * speed));
        },
        &["per radian"],
    ),
    (
        "relative to another link",
        |own| {
            let other = own.other.clone();
            let angle = own.all.iter_mut().find(|(name, _)| name.ends_with("angle_rad")).unwrap();
            angle.1.iter_mut().zip(other).for_each(|(value, other)| *value -= other);
        },
        &["measured from another link"],
    ),
    (
        "x and y exchanged",
        |own| {
            let place = |own: &Columns, suffix: &str| own.all.iter().position(|(name, _)| name.ends_with(suffix));
            let [x, y] = ["x_m", "y_m"].map(|suffix| place(own, suffix).unwrap());
            let (first, second) = (own.all[x].1.clone(), own.all[y].1.clone());
            (own.all[x].1, own.all[y].1) = (second, first);
        },
        &["exchanged"],
    ),
    (
        "half a millisecond late",
        |own| own.time.iter_mut().for_each(|time| *time += 5e-4),
        // At constant speed, a delay is equivalent to a rotated crank.
        &["too late", "angle of the drive"],
    ),
    ("the cosine's sign", |own| own.change(".x_m", |value| -value), &["opposite sign"]),
];

const SCENARIOS: [(&str, &str, &str); 5] = [
    ("crank_rocker", "rocker", "coupler"),
    ("offset_press", "rod", "crank"),
    ("quick_return", "guide", "crank"),
    ("compressor", "rod_4", "rod_2"),
    ("ov7_base", "rod_57", "rocker_43"),
];

fn words(found: &PartyComparison) -> Vec<String> {
    found.pairs.iter().flat_map(|pair| &pair.causes).filter_map(why).collect()
}

/// All planted mistakes are found.
/// Wrongly named mistakes are counted, and printed with --nocapture.
#[test]
fn every_planted_mistake_is_found_and_most_are_named() {
    let (mut named, mut all) = (0, 0);
    for (name, link, other) in SCENARIOS {
        let scenario = scenario(name);
        let right = solved(&scenario);
        let agreed = Columns::of(&right, link, other, &scenario.case).compared(name, &ComparisonRule::default());
        assert_eq!(agreed.verdict.word(), "agree", "{name}");
        for (mistake, make, expected) in MISTAKES {
            let mut columns = Columns::of(&right, link, other, &scenario.case);
            let before = columns.all.clone();
            let times = columns.time.clone();
            make(&mut columns);
            if columns.all == before && columns.time == times {
                continue;
            }
            all += 1;
            let found = columns.compared(name, &ComparisonRule::default());
            assert_eq!(found.verdict.word(), "disagree", "{name}: {mistake}");
            let words = words(&found);
            let is_named = words.iter().any(|words| expected.iter().any(|expected| words.contains(expected)));
            named += usize::from(is_named);
            if !is_named {
                println!("{name}: {mistake}: {words:?}");
            }
        }
    }
    println!("{named} of {all} named");
    assert!(all >= 60 && named * 10 >= all * 9, "{named} of {all}");
}

/// If a term of a quantity is missing, no change of the mechanism explains the difference.
/// Least squares finds such a term from the quantities of the correct solution.
#[test]
fn a_missing_term_is_named() {
    let scenario = scenario("crank_rocker");
    let right = solved(&scenario);
    let agreed = Columns::of(&right, "rocker", "coupler", &scenario.case);
    let of = |link: &str, suffix: &str| right.named(&format!("link.{link}.{suffix}")).unwrap().to_vec();
    let (coupler, speed) = (of("coupler", "angle_rad"), of("rocker", "omega_rad_s"));
    type Lack<'a> = (&'a str, &'a dyn Fn(usize) -> f64, &'a str);
    let terms: [Lack; 3] = [
        ("torque_N_m", &|row| 0.25 * coupler[row].cos(), "a missing term, `+ 0.25*cos(coupler)`"),
        ("alpha_rad_s2", &|row| -0.5 * speed[row].powi(2), "a missing term, `- 0.5*omega(rocker)^2`"),
        (
            "angle_rad",
            &|row| 0.01 * (2.0 * right.inputs()[row]).sin() + 0.03 * coupler[row].sin(),
            "missing terms, `+ 0.01*sin(2*phi)` and `+ 0.03*sin(coupler)`",
        ),
    ];
    for (suffix, term, expected) in terms {
        let mut columns = Columns { all: agreed.all.clone(), time: agreed.time.clone(), other: Vec::new(), speed: 0.0 };
        let (_, values) = columns.all.iter_mut().find(|(name, _)| name.ends_with(suffix)).unwrap();
        values.iter_mut().enumerate().for_each(|(row, value)| *value -= term(row));
        let found = columns.compared("crank_rocker", &ComparisonRule::default());
        assert_eq!(words(&found), [expected]);
    }
}

/// A simulation also has errors from its time step.
/// The mistake is named nevertheless, and the error that the mistake does not explain is reported.
#[test]
fn a_mistake_is_named_in_inexact_numbers() {
    let scenario = scenario("crank_rocker");
    let right = solved(&scenario);
    let mut columns = Columns::of(&right, "rocker", "coupler", &scenario.case);
    columns.change("angle_rad", |value| (value + 1e-3 * (7.0 * value).sin()).to_degrees());
    let how =
        ComparisonRule { allowed: vec![Allowed { of: None, size: Size::Relative(0.01) }], ..ComparisonRule::default() };
    for how in [ComparisonRule::default(), how] {
        let found = columns.compared("crank_rocker", &how);
        assert_eq!(found.verdict.word(), "disagree");
        let explained = &found.pairs[0].causes[0];
        assert!(words(&found)[0].contains("degrees instead of radians"), "{:?}", words(&found));
        assert!(explained.left > 0.0 || !how.allowed.is_empty());
    }
}

/// The error of a numerical method is not a mistake.
/// The report states that the error is numerical, and the table agrees within the allowed difference.
#[test]
fn a_small_error_without_a_simple_cause_gets_no_cause() {
    let scenario = scenario("crank_rocker");
    let mut columns = Columns::of(&solved(&scenario), "rocker", "coupler", &scenario.case);
    columns.change("angle_rad", |value| value + 1e-4 * (40.0 * value).sin());
    let found = columns.compared("crank_rocker", &ComparisonRule::default());
    let told = "the error is smooth, at most 0.036 % of the scale: integration error or time step";
    assert_eq!((found.verdict.word(), words(&found)), ("disagree", vec![told.to_string()]));
    for (share, verdict) in [(1e-3, "agree"), (1e-5, "disagree")] {
        let how = ComparisonRule {
            allowed: vec![Allowed { of: None, size: Size::Relative(share) }],
            ..ComparisonRule::default()
        };
        assert_eq!(columns.compared("crank_rocker", &how).verdict.word(), verdict, "{share}");
    }
}
