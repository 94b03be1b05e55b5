//! Mistakes whose results can be computed from the right values alone: sign, unit, decimal point, angles, exchanged
//! cells.

use std::f64::consts::{PI, TAU};

use super::cause::MarkCause;
use super::hypothesis::{Hypothesis, Origin};
use super::sheet::AnswerSheet;
use linkage::trajectory::{Stage, Unit};

/// Units that students confuse: symbol, and value of the unit in SI.
fn units(of: Unit) -> &'static [(&'static str, f64)] {
    const G: f64 = 9.806_65;
    match of {
        Unit::Radian => &[("rad", 1.0), ("deg", PI / 180.0)],
        Unit::RadianPerSecond => &[("rad/s", 1.0), ("rpm", TAU / 60.0), ("deg/s", PI / 180.0)],
        Unit::RadianPerSecondSquared => &[("rad/s^2", 1.0), ("deg/s^2", PI / 180.0)],
        Unit::Metre => &[("m", 1.0), ("mm", 1e-3), ("cm", 1e-2)],
        Unit::MetrePerSecond => &[("m/s", 1.0), ("mm/s", 1e-3), ("cm/s", 1e-2), ("km/h", 1.0 / 3.6)],
        Unit::MetrePerSecondSquared => &[("m/s^2", 1.0), ("mm/s^2", 1e-3), ("cm/s^2", 1e-2)],
        Unit::Newton => &[("N", 1.0), ("kN", 1e3), ("kgf", G)],
        Unit::NewtonMetre => &[("N m", 1.0), ("N mm", 1e-3), ("N cm", 1e-2), ("kN m", 1e3), ("kgf m", G)],
    }
}

/// The hypotheses of mistakes whose results can be computed from the right values alone.
pub(super) fn all(sheet: &AnswerSheet) -> Vec<Hypothesis> {
    let mut found = Vec::new();
    let mut rule = |cause: MarkCause, prior: f64, factor: f64, rule: &dyn Fn(usize, usize, f64) -> Option<f64>| {
        let own = Hypothesis::by_rule(sheet, Origin::Mistake(cause), prior, |at, value| rule(at.row, at.column, value));
        found.push(Hypothesis { factor, ..own });
    };
    let turn = |column: usize| sheet.columns[column].turn;
    rule(MarkCause::Sign, -0.5, 1.0, &|_, _, value| Some(-value));
    rule(MarkCause::Zero, -2.0, 1.0, &|_, _, _| Some(0.0));
    rule(MarkCause::Supplement, -1.5, 1.0, &|_, column, value| turn(column).map(|turn| turn / 2.0 - value));
    rule(MarkCause::OtherEnd, -1.5, 1.0, &|_, column, value| turn(column).map(|turn| turn / 2.0 + value));
    rule(MarkCause::Complement, -1.8, 1.0, &|_, column, value| turn(column).map(|turn| turn / 4.0 - value));
    for sign in [1.0, -1.0] {
        rule(MarkCause::FromVertical, -2.2, 1.0, &|_, column, value| {
            turn(column).map(|turn| value + sign * turn / 4.0)
        });
    }
    rule(MarkCause::Twice, -2.0, 2.0, &|_, _, value| Some(2.0 * value));
    rule(MarkCause::Half, -2.0, 0.5, &|_, _, value| Some(value / 2.0));
    for power in [1, -1, 2, -2, 3, -3] {
        let factor = 10f64.powi(power);
        // A factor of a hundred or a thousand is usually a wrong unit.
        let prior = if power.abs() == 1 { -1.8 } else { -2.3 };
        rule(MarkCause::DecimalPoint(power), prior, factor, &|_, _, value| Some(factor * value));
    }
    if let Some(speed) = sheet.case.crank().constant_speed() {
        for (stage, rate) in [(Stage::Velocities, speed), (Stage::Accelerations, speed * speed)] {
            let is_rate = |column: usize| sheet.columns[column].stage() == stage;
            let size = |column: usize| if sheet.columns[column].is_size() { rate.abs() } else { rate };
            rule(MarkCause::PerRadian, -2.0, 1.0 / rate.abs(), &|_, column, value| {
                is_rate(column).then(|| value / size(column))
            });
        }
    }
    let mut confused: Vec<(&str, &str)> = Vec::new();
    for column in &sheet.columns {
        let is_asked = |(_, size): &&(&str, f64)| (size / column.scale - 1.0).abs() < 1e-9;
        let Some(asked) = units(column.si_unit()).iter().find(is_asked) else { continue };
        for written in units(column.si_unit()).iter().filter(|own| own.0 != asked.0) {
            if confused.contains(&(written.0, asked.0)) {
                continue;
            }
            confused.push((written.0, asked.0));
            let factor = asked.1 / written.1;
            let has = |other: usize| {
                sheet.columns[other].si_unit() == column.si_unit() && sheet.columns[other].scale == column.scale
            };
            let cause = MarkCause::Unit { written: written.0, asked: asked.0 };
            rule(cause, -1.2, factor, &|_, other, value| has(other).then_some(factor * value));
        }
    }
    found.extend(other_cells(sheet));
    found
}

/// Hypotheses with the values of other cells: values of another quantity in the same unit at the same position, and
/// values of the same quantity at another position. The list also contains angles relative to other links.
fn other_cells(sheet: &AnswerSheet) -> Vec<Hypothesis> {
    let mut found = Vec::new();
    let alike = |one: usize, other: usize| {
        let [one, other] = [&sheet.columns[one], &sheet.columns[other]];
        one.si_unit() == other.si_unit() && one.scale == other.scale
    };
    for column in 0..sheet.columns.len() {
        let value = |row: usize| sheet.right[row][column];
        let other = |at: usize| at != column && alike(at, column);
        found.push(Hypothesis::by_rule(sheet, Origin::OfColumn(column), -2.5, |at, _| {
            other(at.column).then(|| value(at.row))
        }));
        found.push(Hypothesis::by_rule(sheet, Origin::OppositeOfColumn(column), -4.0, |at, _| {
            other(at.column).then(|| -value(at.row))
        }));
        if sheet.columns[column].turn.is_some() {
            let cause = MarkCause::RelativeAngle(sheet.columns[column].of().into());
            for sign in [1.0, -1.0] {
                found.push(Hypothesis::by_rule(sheet, Origin::Mistake(cause.clone()), -3.0, |at, own| {
                    other(at.column).then(|| sign * (own - value(at.row)))
                }));
            }
        }
    }
    for row in 0..sheet.right.len() {
        found.push(Hypothesis::by_rule(sheet, Origin::OfRow(row), -2.8, |at, _| {
            (at.row != row).then(|| sheet.right[row][at.column])
        }));
    }
    found
}
