//! Pairs of tables: alignment, mapping, units, digits, interpolation.

use super::{against, held, mapping, scenario, solved, table};
use prover::compare::{ComparedParty, ComparisonRule, compare as compared};
use prover::tables::{By, Held, load};
use scenario::mapping::{Allowed, Size};

fn rel(share: f64) -> ComparisonRule {
    ComparisonRule { allowed: vec![Allowed { of: None, size: Size::Relative(share) }], ..ComparisonRule::default() }
}

#[test]
fn a_mapping_bridges_names_units_signs_and_offsets() {
    let scenario = scenario("crank_rocker");
    let right = solved(&scenario);
    let own = |name: &str| right.named(name).unwrap();
    let changed = |name: &str, change: &dyn Fn(f64) -> f64| own(name).iter().map(|&value| change(value)).collect();
    let raw = table(&[
        ("time", right.times().to_vec()),
        ("phi 3", changed("link.rocker.angle_rad", &|angle| -angle - 0.25)),
        ("xB", changed("point.B.x_m", &|x| 1e3 * x)),
        ("w", own("link.rocker.omega_rad_s").to_vec()),
    ]);
    let lines = [
        "-(`phi 3` + 0.25)*180/pi=link.rocker.angle_deg",
        "xB=point.B.x_mm",
        "w = link.rocker.omega_rad_s",
        "2*w=link.rocker.omega_rad_s + link.rocker.omega_rad_s",
    ];
    let mapping = mapping(&lines);
    let table = Held::of_table(&raw, &mapping).unwrap();
    let both = [ComparedParty::from(scenario), ComparedParty::from(table)];
    let found = compared(both, &ComparisonRule::default()).unwrap();
    assert_eq!((found.verdict.word(), found.pairs[0].channels.len()), ("agree", 4));
    // The text of the mapping is written to a file and read back.
    let text = mapping.text();
    let path = std::env::temp_dir().join("linkproof-mapping-of-a-test.toml");
    std::fs::write(&path, &text).unwrap();
    assert_eq!(scenario::mapping::Mapping::load(&path).unwrap().text(), text);
    assert!(text.contains("\"link.rocker.angle_deg\" = \"-(`phi 3` + 0.25)*180/pi\""), "{text}");
}

#[test]
fn a_wrong_mapping_is_refused_with_its_position() {
    let right = solved(&scenario("crank_rocker"));
    let raw =
        table(&[("time", right.times().to_vec()), ("phi3", right.named("link.rocker.angle_rad").unwrap().to_vec())]);
    for (line, message, help) in [
        ("phi4=link.rocker.angle_rad", "no column `phi4`", "did you mean `phi3`?"),
        ("2*(phi3=link.rocker.angle_rad", "not closed", "add `)`"),
        ("phi3=link.rocker.angle", "no channel", ""),
    ] {
        let error = Held::of_table(&raw, &mapping(&[line])).unwrap_err();
        assert!(error.message().contains(message), "{line}: {}", error.message());
        assert!(
            error.place().is_some() && format!("{:?}", error.advice()).contains(help),
            "{line}: {:?}",
            error.advice()
        );
    }
    // The mapping names the link `roker`, which the scenario lacks.
    let table = Held::of_table(&raw, &mapping(&["phi3=link.roker.angle_rad"])).unwrap();
    let both = [ComparedParty::from(scenario("crank_rocker")), ComparedParty::from(table)];
    let error = compared(both, &ComparisonRule::default()).err().unwrap();
    assert!(format!("{:?}", error.advice()).contains("link.rocker.angle_rad"), "{:?}", error.advice());
}

/// The bound includes half a unit of the last digit of each number, and half a unit of the last digit of each time.
#[test]
fn digits_of_numbers_and_of_instants_are_in_the_bound() {
    let scenario = scenario("crank_rocker");
    let right = solved(&scenario);
    let path = std::env::temp_dir().join("linkproof-digits-of-a-test.csv");
    let angle = right.named("link.rocker.angle_rad").unwrap();
    let row = |row: usize| format!("{:.5},{:.4}\n", right.times()[row], angle[row].to_degrees());
    let lines: String = (0..angle.len()).map(row).collect();
    std::fs::write(&path, format!("t_s,link.rocker.angle_deg\n{lines}")).unwrap();
    let raw = load(&path).unwrap();
    assert_eq!(against(&scenario, &raw, &ComparisonRule::default()).verdict.word(), "agree");
    // One number is wrong by a hundred units of its last digit, which is more than the two roundings allow.
    let spoiled =
        lines.replacen(&format!("{:.4}", angle[40].to_degrees()), &format!("{:.4}", angle[40].to_degrees() + 0.01), 1);
    std::fs::write(&path, format!("t_s,link.rocker.angle_deg\n{spoiled}")).unwrap();
    let found = against(&scenario, &load(&path).unwrap(), &ComparisonRule::default());
    assert_eq!(found.verdict.word(), "disagree");
    let since = found.pairs[0].channels[0].since.unwrap();
    assert!((since.time - right.times()[40]).abs() < 1e-5);
}

#[test]
fn rows_are_also_matched_by_crank_angle() {
    let scenario = scenario("crank_rocker");
    let right = solved(&scenario);
    let cranks: Vec<f64> = right.inputs().iter().map(|crank| crank.to_degrees()).collect();
    let raw = table(&[
        ("crank_deg", cranks),
        ("link.rocker.angle_rad", right.named("link.rocker.angle_rad").unwrap().to_vec()),
    ]);
    let found = against(&scenario, &raw, &ComparisonRule::default());
    assert!(found.pairs[0].by_crank && found.verdict.word() == "agree");
    let error = compared([held(&raw), held(&raw)], &ComparisonRule { by: Some(By::Time), ..ComparisonRule::default() })
        .err()
        .unwrap();
    assert!(error.message().contains("no times"), "{}", error.message());
}

/// Without an analytic side, the comparison of two different tables needs an allowed difference; otherwise it is
/// inconclusive.
/// Equal tables always agree.
#[test]
fn two_tables_need_an_allowance() {
    let right = solved(&scenario("crank_rocker"));
    let of = |more: f64| {
        let angle = right.named("link.rocker.angle_rad").unwrap().iter().map(|value| value + more).collect();
        table(&[("t", right.times().to_vec()), ("link.rocker.angle_rad", angle)])
    };
    let verdict =
        |more: f64, how: &ComparisonRule| compared([held(&of(0.0)), held(&of(more))], how).unwrap().verdict.word();
    assert_eq!(verdict(0.0, &ComparisonRule::default()), "agree");
    assert_eq!(verdict(1e-6, &ComparisonRule::default()), "inconclusive");
    assert_eq!([verdict(1e-6, &rel(1e-5)), verdict(1e-4, &rel(1e-5))], ["agree", "disagree"]);
}

/// Every third instant is enough to interpolate the remaining instants.
/// The bound contains the interpolation error, and is below 1e-3 rad.
#[test]
fn the_interpolation_error_is_in_the_bound() {
    let right = solved(&scenario("crank_rocker"));
    let name = "link.rocker.angle_rad";
    let every = |step: usize| {
        let thin = |values: &[f64]| values.iter().copied().step_by(step).collect();
        table(&[("t", thin(right.times())), (name, thin(right.named(name).unwrap()))])
    };
    let plain = compared([held(&every(3)), held(&every(1))], &rel(0.0)).unwrap();
    assert_eq!((plain.pairs[0].unshared, plain.pairs[0].channels[0].judged), (240, 121));
    let how = ComparisonRule { interpolates: true, ..rel(0.0) };
    let found = compared([held(&every(3)), held(&every(1))], &how).unwrap();
    let channel = &found.pairs[0].channels[0];
    assert_eq!((found.verdict.word(), found.pairs[0].unshared, channel.judged), ("agree", 0, 361));
    let worst = channel.largest.unwrap();
    assert!(worst.difference.abs() > 1e-9 && worst.bound < 1e-3, "{worst:?}");
    // Interpolation hides no mistake of 1e-3 rad.
    let mut spoiled = every(1);
    spoiled.columns[1][100].value += 1e-3;
    assert_eq!(compared([held(&every(3)), held(&spoiled)], &how).unwrap().verdict.word(), "disagree");
}

/// The comparison of crank angles finds an error of 1e-6 rad.
#[test]
fn a_crank_angle_that_is_off_by_a_millionth_is_found() {
    let scenario = scenario("crank_rocker");
    let right = solved(&scenario);
    let verdict = |more: f64| {
        let cranks = right.inputs().iter().map(|crank| crank + more).collect();
        let angle = right.named("link.rocker.angle_rad").unwrap().to_vec();
        let raw = table(&[("t", right.times().to_vec()), ("crank_rad", cranks), ("link.rocker.angle_rad", angle)]);
        against(&scenario, &raw, &ComparisonRule::default()).verdict.word()
    };
    assert_eq!([verdict(0.0), verdict(1e-6)], ["agree", "disagree"]);
}

/// The slope of the quantity over time is 2.
/// The quantity may therefore differ by twice the sum of the uncertainties of the instants in both tables.
/// This bound holds at rows and between rows.
#[test]
fn uncertain_instants_of_both_tables_widen_the_bound() {
    let uneven: Vec<f64> = (0..20).map(|row| 0.0131 * f64::from(row) + 0.0007 * f64::from(row % 3)).collect();
    let between: Vec<f64> = uneven.windows(2).map(|pair| f64::midpoint(pair[0], pair[1])).collect();
    let of = |times: &[f64], error: f64| {
        let mut raw =
            table(&[("t", times.to_vec()), ("link.rocker.angle_rad", times.iter().map(|time| 2.0 * time).collect())]);
        raw.columns[0].iter_mut().for_each(|time| time.error = error);
        held(&raw)
    };
    for (first, second) in [(1e-4, 1e-9), (1e-9, 1e-4), (1e-4, 1e-4)] {
        for (times, interpolates) in [(&uneven, false), (&between, true)] {
            let how = ComparisonRule { interpolates, ..rel(0.0) };
            let found = compared([of(&uneven, first), of(times, second)], &how).unwrap();
            let bound = found.pairs[0].channels[0].largest.unwrap().bound / (2.0 * (first + second));
            assert!((1.0..1.5).contains(&bound), "{first:e} {second:e} {interpolates}: {bound}");
        }
    }
}

/// The verdict on a number does not depend on the columns of other numbers.
#[test]
fn a_number_is_judged_by_its_own_channel_alone() {
    let scenario = scenario("fourth_class");
    let alpha = ["link.link_4.alpha_rad_s2", "link.link_2.alpha_rad_s2", "link.link_2.omega_rad_s", "point.B.x_m"];
    let known: Vec<&str> = alpha.into_iter().filter(|name| solved(&scenario).named(name).is_some()).collect();
    assert!(known.len() >= 3, "{known:?}");
    for size in [Size::Relative(0.05), Size::OfValue(0.05)] {
        let how = ComparisonRule { allowed: vec![Allowed { of: None, size }], ..ComparisonRule::default() };
        let judged = |names: &[&str]| {
            let mut columns = vec![("crank_deg", vec![70.0])];
            columns.extend(names.iter().map(|name| (*name, vec![if *name == alpha[0] { -80.0 } else { 3.0 }])));
            let found = against(&scenario, &table(&columns), &how);
            let own = found.pairs[0].channels[0].clone();
            (own.scale, own.worst.unwrap().bound, own.verdict.word())
        };
        let alone = judged(&known[..1]);
        for count in 2..=known.len() {
            assert_eq!(judged(&known[..count]), alone, "{:?}", &known[..count]);
        }
        // The error is more than 5 % of the value -48.44, but less than 5 % of the channel's scale.
        assert_eq!(alone.2, if size == Size::OfValue(0.05) { "disagree" } else { "agree" });
    }
}

/// The values of the channel consist of rounding error.
/// The lower limit of their uncertainty follows from the other channels of the solution, even if the table lacks these
/// other channels.
#[test]
fn a_zero_of_rounding_size_agrees_with_and_without_others() {
    let scenario = scenario("compressor");
    let right = solved(&scenario);
    let name = "point.B.ax_m_s2";
    let rounded: Vec<f64> = right.named(name).unwrap().iter().map(|value| 2.0 * value + 1e-15).collect();
    assert!(rounded.iter().all(|value| value.abs() < 1e-12));
    for columns in [vec![], vec![("point.B.ay_m_s2", right.named("point.B.ay_m_s2").unwrap().to_vec())]] {
        let mut all = vec![("t", right.times().to_vec()), (name, rounded.clone())];
        all.extend(columns);
        assert_eq!(against(&scenario, &table(&all), &ComparisonRule::default()).verdict.word(), "agree");
    }
}

/// A table in m and a table in mm agree, unless a number has the wrong unit.
#[test]
fn two_tables_in_different_units_are_compared_in_one() {
    let right = solved(&scenario("crank_rocker"));
    let x = |factor: f64| right.named("point.B.x_m").unwrap().iter().map(|value| factor * value).collect::<Vec<f64>>();
    let of = |name: &'static str, factor: f64| held(&table(&[("t", right.times().to_vec()), (name, x(factor))]));
    let verdict = |one, other| compared([one, other], &rel(1e-9)).unwrap().verdict.word();
    assert_eq!(verdict(of("point.B.x_m", 1.0), of("point.B.x_mm", 1e3)), "agree");
    assert_eq!(verdict(of("point.B.x_mm", 1e3), of("point.B.x_m", 1.0)), "agree");
    assert_eq!(verdict(of("point.B.x_m", 1.0), of("point.B.x_mm", 1.0)), "disagree");
    assert_eq!(verdict(of("point.B.x_m", 1e3), of("point.B.x_mm", 1e3)), "disagree");
    // A table with times in s and a table with times in ms agree too.
    let ms = right.times().iter().map(|time| 1e3 * time).collect::<Vec<f64>>();
    let late = |name| held(&table(&[(name, ms.clone()), ("point.B.x_m", x(1.0))]));
    assert_eq!(verdict(of("point.B.x_m", 1.0), late("time_ms")), "agree");
    let both = [of("point.B.x_m", 1.0), late("time_s")];
    assert!(compared(both, &rel(1e-9)).map_or(true, |found| found.verdict.word() != "agree"));
    // Unit conversion adds only rounding error, so an error of 1e-7 in the last number is found.
    for (instants, name, factor) in [
        ("t", "point.B.x_m", 1.0),
        ("t", "point.B.x_mm", 1e3),
        ("time_ms", "point.B.x_m", 1.0),
        ("time_ms", "point.B.x_mm", 1e3),
    ] {
        let with = |more: f64| {
            let mut values = x(factor);
            *values.last_mut().unwrap() *= 1.0 + more;
            let times = if instants == "t" { right.times().to_vec() } else { ms.clone() };
            held(&table(&[(instants, times), (name, values)]))
        };
        for (more, word) in [(0.0, "agree"), (1e-7, "disagree"), (-1e-7, "disagree")] {
            assert_eq!(verdict(of("point.B.x_m", 1.0), with(more)), word, "{instants} {name} {more}");
            assert_eq!(verdict(with(more), of("point.B.x_m", 1.0)), word, "{instants} {name} {more}");
        }
    }
}

#[test]
fn two_models_of_one_mechanism_are_compared() {
    let one = scenario("crank_rocker");
    let both = |other: linkproof::Scenario| [ComparedParty::from(one.clone()), ComparedParty::from(other)];
    let same = compared(both(one.clone()), &ComparisonRule::default()).unwrap();
    assert_eq!(same.verdict.word(), "agree");
    assert_eq!(same.pairs[0].channels.len(), one.case.channels().len());
    let heavier = one.text.replacen("mass_kg = ", "mass_kg = 1", 1);
    let other = linkproof::Scenario::parse(&heavier, &one.path).unwrap();
    let found = compared(both(other), &ComparisonRule::default()).unwrap();
    assert_eq!(found.verdict.word(), "disagree");
    let off: Vec<&str> =
        found.pairs[0].channels.iter().filter(|own| own.since.is_some()).map(|own| own.claim.text.as_str()).collect();
    assert!(off.iter().all(|name| name.ends_with("_N") || name.ends_with("_N_m")), "{off:?}");
}

#[test]
fn unshared_columns_are_reported() {
    let scenario = scenario("crank_rocker");
    let right = solved(&scenario);
    let raw = table(&[
        ("t", right.times().to_vec()),
        ("link.rocker.angle_rad", right.named("link.rocker.angle_rad").unwrap().to_vec()),
        ("link.ghost.angle_rad", right.times().to_vec()),
        ("temperature", right.times().to_vec()),
    ]);
    let pair = &against(&scenario, &raw, &ComparisonRule::default()).pairs[0];
    assert_eq!(pair.alone[1], ["link.ghost.angle_rad"]);
    let missing = ComparisonRule {
        allowed: vec![Allowed { of: Some("point.B".into()), size: Size::Relative(0.1) }],
        ..ComparisonRule::default()
    };
    let parties = [ComparedParty::from(scenario), held(&raw)];
    let error = compared(parties, &missing).err().unwrap();
    assert!(error.message().contains("point.B"), "{}", error.message());
}
