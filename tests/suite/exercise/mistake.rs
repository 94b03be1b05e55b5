//! Mistakes of students, computed without the code of `mark`: edited scenarios, closed forms, and writing errors.

use std::path::Path;

use linkage::case::Grid;
use linkage::math::{Vec2, turned};
use linkage::mechanism::LinkId;
use linkage::solver::{Solver, State};
use linkage::trajectory::Stage;
use prover::mark::{AnswerSheet, MarkCause};
use scenario::{Scenario, StartRequest};

use crate::common::sketch::RandomSource;

/// Whether a cause names a mistake.
type Names = Box<dyn Fn(Option<&MarkCause>) -> bool>;

/// A planted mistake: its kind, the answers with the mistake, and a function that tells whether a cause names the
/// mistake.
pub(super) struct Mistake {
    pub(super) sort: &'static str,
    pub(super) answers: Vec<Vec<f64>>,
    pub(super) names: Names,
}

/// All sorts of mistakes.
/// For the last two sorts, `mark` cannot recognise a cause.
pub(super) const SORTS: [&str; 24] = [
    "sign of a cell",
    "sign of a quantity",
    "unit of a quantity",
    "other configuration at all positions",
    "other configuration at one position",
    "normal part of a link forgotten",
    "normal part of a point forgotten",
    "two quantities exchanged",
    "two positions exchanged",
    "two cells exchanged",
    "supplementary angles",
    "complementary angles",
    "digits exchanged",
    "decimal point moved",
    "twice a value",
    "opposite sense of rotation",
    "speed in rpm",
    "point from the other end",
    "weights forgotten",
    "per radian",
    "whole velocity for the relative one",
    "relative velocity only",
    "another number",
    "a length misread",
];

/// The answers of an edited scenario to the questions of a sheet.
fn answers_of(sheet: &AnswerSheet, scenario: &Scenario) -> Option<Vec<Vec<f64>>> {
    let case = scenario.case.on(Grid::of_inputs(scenario.case.crank(), sheet.positions().to_vec())).ok()?;
    let solved = analytic::NewtonSolver.solve(&case.wanting_only(&case.all_channels())).ok()?;
    let value = |row: usize, column: usize| {
        let own = &sheet.columns[column];
        let parts: Vec<f64> = own.channels.iter().map(|channel| solved.column(channel).unwrap()[row]).collect();
        match (&parts[..], own.turn) {
            ([x, y], _) => x.hypot(*y),
            (one, None) => one[0] / own.scale,
            (one, Some(turn)) => (one[0] / own.scale).rem_euclid(turn),
        }
    };
    Some(
        (0..sheet.right.len()).map(|row| (0..sheet.columns.len()).map(|column| value(row, column)).collect()).collect(),
    )
}

fn edited(scenario: &Scenario, edit: impl Fn(&str) -> String) -> Option<Scenario> {
    Scenario::parse(&edit(&scenario.text), Path::new("edited.toml")).ok()
}

fn states(sheet: &AnswerSheet) -> Vec<State> {
    let mut found = vec![None; sheet.right.len()];
    let mut keep = |row: usize, state: &State| {
        found[row] = Some(state.clone());
        Ok(())
    };
    analytic::NewtonSolver.each(&sheet.case, &mut keep).unwrap();
    found.into_iter().map(Option::unwrap).collect()
}

/// Plants a mistake of the sort `sort`; `None` if the sheet has no answers in which this mistake is possible.
pub(super) fn plant(
    sort: &'static str,
    scenario: &Scenario,
    sheet: &AnswerSheet,
    random: &mut RandomSource,
) -> Option<Mistake> {
    let mut answers = sheet.right.clone();
    let rows = answers.len();
    let columns =
        |wanted: &dyn Fn(usize) -> bool| (0..sheet.columns.len()).filter(|column| wanted(*column)).collect::<Vec<_>>();
    let one_of = |random: &mut RandomSource, all: &[usize]| (!all.is_empty()).then(|| all[random.index(all.len())]);
    let is_angle = |column: usize| sheet.columns[column].turn.is_some();
    let is_signed = |column: usize| !is_angle(column) && !sheet.columns[column].is_size();
    let stage = |column: usize| sheet.columns[column].stage();
    let name = |column: usize| sheet.columns[column].name.clone();
    let names: Names = match sort {
        "sign of a cell" | "sign of a quantity" => {
            let column = one_of(random, &columns(&is_signed))?;
            let only = random.index(rows);
            let cells = answers.iter_mut().enumerate().filter(|(row, _)| sort.ends_with("quantity") || *row == only);
            cells.for_each(|(_, row)| row[column] = -row[column]);
            Box::new(|cause| matches!(cause, Some(MarkCause::Sign)))
        }
        "unit of a quantity" => {
            let column = one_of(random, &columns(&|column| stage(column) < Stage::Reactions))?;
            let name = name(column);
            let factor = match name.rsplit_once('.').unwrap().1 {
                "angle_deg" => std::f64::consts::PI / 180.0,
                "omega_rad_s" => 9.549_296_585_513_721,
                "alpha_rad_s2" => 57.295_779_513_082_32,
                _ => 1e3,
            };
            answers.iter_mut().for_each(|row| row[column] *= factor);
            Box::new(|cause| matches!(cause, Some(MarkCause::Unit { .. })))
        }
        "other configuration at all positions" | "other configuration at one position" => {
            let groups = [("rod_2,slider", "behind"), ("link_3,rocker_4", "right"), ("coupler_2,rocker_3", "right")];
            let groups: Vec<_> =
                groups.iter().filter(|(links, _)| scenario.text.contains(links.split(',').next().unwrap())).collect();
            let (links, mode) = groups[random.index(groups.len())];
            let asked = |mode: &str| StartRequest { modes: vec![format!("{links}={mode}")], ..StartRequest::default() };
            let other = |mode: &str| Scenario::parse_as(&scenario.text, Path::new("other.toml"), &asked(mode)).ok();
            let opposite = match *mode {
                "right" => "left",
                _ => "ahead",
            };
            let found: Vec<_> =
                [*mode, opposite].into_iter().filter_map(|mode| answers_of(sheet, &other(mode)?)).collect();
            let differs =
                |own: &&Vec<Vec<f64>>| own[0].iter().zip(&sheet.right[0]).any(|(a, b)| (a - b).abs() > 1e-3 * b.abs());
            let found = found.iter().find(differs)?.clone();
            let only = random.index(rows);
            for row in (0..rows).filter(|row| sort.ends_with("all positions") || *row == only) {
                answers[row].clone_from(&found[row]);
            }
            let first = links.split(',').next().unwrap().to_string();
            Box::new(
                move |cause| matches!(cause, Some(MarkCause::Configuration { group, .. }) if group.contains(&first)),
            )
        }
        "normal part of a link forgotten" => forgotten_normal(sheet, random, &mut answers)?,
        "normal part of a point forgotten" => {
            let column = one_of(
                random,
                &columns(&|column| {
                    name(column) == "point.D.a_m_s2"
                        || name(column) == "point.B.a_m_s2" && scenario.text.contains("rocker_3")
                }),
            )?;
            let point = sheet.columns[column].of().to_string();
            let link = scenario.case.mechanism.link_named(if point == "D" { "rocker_4" } else { "rocker_3" })?;
            let own = &scenario.case.mechanism.links()[link];
            let length = (own.points[1].local - own.points[0].local).norm();
            for (row, state) in answers.iter_mut().zip(states(sheet)) {
                row[column] = (length * state.motions[link].alpha).abs();
            }
            Box::new(|cause| matches!(cause, Some(MarkCause::WithoutPart(..))))
        }
        "two quantities exchanged" => {
            let ending = ["omega_rad_s", "alpha_rad_s2", "angle_deg", "v_m_s", "a_m_s2"][random.index(5)];
            let alike = columns(&|column| name(column).ends_with(&format!(".{ending}")));
            let (one, other) = (alike[0], *alike[1..].get(random.index(alike.len() - 1))?);
            answers.iter_mut().for_each(|row| row.swap(one, other));
            Box::new(|cause| matches!(cause, Some(MarkCause::Exchanged(_) | MarkCause::OfCell(_))))
        }
        "two positions exchanged" => {
            let column = random.index(sheet.columns.len());
            let (one, other) = (random.index(rows - 1), rows - 1);
            let kept = answers[one][column];
            answers[one][column] = answers[other][column];
            answers[other][column] = kept;
            Box::new(|cause| matches!(cause, Some(MarkCause::Exchanged(_) | MarkCause::OfCell(_))))
        }
        "two cells exchanged" => {
            let row = random.index(rows);
            let alike = columns(&|column| name(column).ends_with(".omega_rad_s"));
            let (one, other) = (alike[0], *alike[1..].get(random.index(alike.len() - 1))?);
            answers[row].swap(one, other);
            Box::new(|cause| matches!(cause, Some(MarkCause::Exchanged(_) | MarkCause::OfCell(_))))
        }
        "supplementary angles" | "complementary angles" => {
            let column = one_of(random, &columns(&is_angle))?;
            let whole = if sort.starts_with("supplementary") { 180.0 } else { 90.0 };
            answers.iter_mut().for_each(|row| row[column] = whole - row[column]);
            match whole {
                180.0 => Box::new(|cause| matches!(cause, Some(MarkCause::Supplement))),
                _ => Box::new(|cause| matches!(cause, Some(MarkCause::Complement))),
            }
        }
        "digits exchanged" => {
            let (row, column) = (random.index(rows), random.index(sheet.columns.len()));
            let text = format!("{:.*}", sheet.decimals[column] as usize, answers[row][column]);
            let digits: Vec<usize> =
                text.char_indices().filter(|(_, sign)| sign.is_ascii_digit()).map(|(at, _)| at).collect();
            let at = digits.windows(2).position(|pair| text.as_bytes()[pair[0]] != text.as_bytes()[pair[1]])?;
            let mut bytes = text.into_bytes();
            bytes.swap(digits[at], digits[at + 1]);
            answers[row][column] = String::from_utf8(bytes).unwrap().parse().unwrap();
            Box::new(|cause| matches!(cause, Some(MarkCause::DigitsSwapped)))
        }
        "decimal point moved" | "twice a value" => {
            let column = one_of(random, &columns(&|column| !is_angle(column)))?;
            let row = random.index(rows);
            let is_twice = sort.starts_with("twice");
            answers[row][column] *= if is_twice { 2.0 } else { 10.0 };
            match is_twice {
                true => Box::new(|cause| matches!(cause, Some(MarkCause::Twice))),
                false => Box::new(|cause| matches!(cause, Some(MarkCause::DecimalPoint(1)))),
            }
        }
        "opposite sense of rotation" => {
            answers = answers_of(sheet, &edited(scenario, |text| text.replace("speed_rad_s = ", "speed_rad_s = -"))?)?;
            Box::new(|cause| matches!(cause, Some(MarkCause::Reversed)))
        }
        "speed in rpm" => {
            answers = answers_of(sheet, &edited(scenario, |text| text.replace("speed_rad_s = ", "speed_rpm = "))?)?;
            Box::new(|cause| matches!(cause, Some(MarkCause::SpeedUnit("rpm", "rad/s"))))
        }
        "point from the other end" => {
            let other = |text: &str| {
                let begin =
                    ["[links.rod_2.points]", "[links.coupler_2.points]"].iter().find_map(|head| text.find(head));
                let (head, tail) = text.split_at(begin.unwrap());
                let line = |key: &str| tail.lines().find(|line| line.starts_with(key)).unwrap();
                let x = |line: &str| line.split(['=', ',']).nth(2).unwrap().trim().parse::<f64>().unwrap();
                let (near, far) = (line("C = "), line("B = "));
                let turned = format!("C = {{ x_m = {}, y_m = 0 }}", x(far) - x(near));
                format!("{head}{}", tail.replacen(near, &turned, 1))
            };
            answers = answers_of(sheet, &edited(scenario, other)?)?;
            Box::new(|cause| matches!(cause, Some(MarkCause::FromOtherEnd(_, point)) if point == "C"))
        }
        "weights forgotten" => {
            answers = answers_of(sheet, &edited(scenario, |text| text.replace("y_m_s2 = -9.81", "y_m_s2 = 0"))?)?;
            Box::new(|cause| matches!(cause, Some(MarkCause::NoGravity)))
        }
        "per radian" => {
            let column =
                one_of(random, &columns(&|column| matches!(stage(column), Stage::Velocities | Stage::Accelerations)))?;
            let speed = sheet.case.crank().constant_speed()?;
            let divisor = if stage(column) == Stage::Velocities { speed } else { speed * speed };
            answers.iter_mut().for_each(|row| row[column] /= divisor);
            Box::new(|cause| matches!(cause, Some(MarkCause::PerRadian)))
        }
        "whole velocity for the relative one" | "relative velocity only" => {
            let is_omega = sort.starts_with("whole");
            let link = scenario.case.mechanism.links().entries().find(|(_, link)| link.name.ends_with("_2"))?.0;
            let points = &scenario.case.mechanism.links()[link].points;
            let local = |name: &str| points.iter().find(|point| point.name == name).map(|point| point.local);
            let (a, b) = (local("A")?, local("B")?);
            let wanted = if is_omega { "omega_rad_s" } else { "v_m_s" };
            let column = columns(&|column| {
                name(column).ends_with(wanted) && (name(column).contains("_2.") || name(column) == "point.B.v_m_s")
            })[0];
            for (row, state) in answers.iter_mut().zip(states(sheet)) {
                let motion = &state.motions[link];
                let [whole, relative] = [motion.point_velocity(b).norm(), motion.omega.abs() * (b - a).norm()];
                row[column] = if is_omega { (whole / (b - a).norm()).copysign(row[column]) } else { relative };
            }
            match is_omega {
                true => Box::new(|cause| matches!(cause, Some(MarkCause::FromWholeSpeed(_)))),
                false => Box::new(|cause| matches!(cause, Some(MarkCause::WithoutPart(..)))),
            }
        }
        "another number" => {
            let column = one_of(random, &columns(&is_signed))?;
            let row = random.index(rows);
            answers[row][column] *= random.number(1.15, 1.7);
            Box::new(|cause| cause.is_none())
        }
        "a length misread" => {
            let misread = |text: &str| {
                let begin =
                    text.find("[links.rocker_4.points]").or_else(|| text.find("[links.rocker_3.points]")).unwrap();
                let (head, tail) = text.split_at(begin);
                let Some(at) = tail.find("x_m = 0.").map(|at| at + "x_m = 0.".len()) else { return text.into() };
                let digit = tail.as_bytes()[at] as char;
                let other = if digit == '9' { '8' } else { (digit as u8 + 1) as char };
                format!("{head}{}{other}{}", &tail[..at], &tail[at + 1..])
            };
            answers = answers_of(sheet, &edited(scenario, misread)?)?;
            Box::new(|cause| cause.is_none())
        }
        other => panic!("no such mistake: {other}"),
    };
    Some(Mistake { sort, answers, names })
}

/// Angular accelerations of the last dyad without the normal part of one of its links, by two equations in closed form:
/// a_C + eps_3 x CD - k_3 omega_3^2 CD = eps_4 x O2D - k_4 omega_4^2 O2D, with k = 0 for the forgotten part.
fn forgotten_normal(sheet: &AnswerSheet, random: &mut RandomSource, answers: &mut [Vec<f64>]) -> Option<Names> {
    let mechanism = &sheet.case.mechanism;
    let [three, four] = ["link_3", "rocker_4"].map(|name| mechanism.link_named(name));
    let (three, four) = (three?, four?);
    let forgets_three = random.yes();
    let column = |name: &str| sheet.columns.iter().position(|own| own.name == name);
    let (of_three, of_four) = (column("link.link_3.alpha_rad_s2")?, column("link.rocker_4.alpha_rad_s2")?);
    let of_d = column("point.D.a_m_s2")?;
    let local = |link: LinkId, name: &str| {
        mechanism.links()[link].points.iter().find(|own| own.name == name).map(|own| own.local)
    };
    let (c, d3, o2, d4) = (local(three, "C")?, local(three, "D")?, local(four, "O2")?, local(four, "D")?);
    for (row, state) in answers.iter_mut().zip(states(sheet)) {
        let [arm3, arm4]: [Vec2; 2] = [state.motions[three].arm(d3 - c), state.motions[four].arm(d4 - o2)];
        let [k3, k4] = if forgets_three { [0.0, 1.0] } else { [1.0, 0.0] };
        let normal3 = -arm3 * (k3 * state.motions[three].omega.powi(2));
        let normal4 = -arm4 * (k4 * state.motions[four].omega.powi(2));
        let right = normal4 - normal3 - state.motions[three].point_acceleration(c);
        // turned(arm3) eps_3 - turned(arm4) eps_4 = right, by Cramer's rule.
        let (p, q) = (turned(arm3), -turned(arm4));
        let determinant = p.x * q.y - p.y * q.x;
        row[of_three] = (right.x * q.y - right.y * q.x) / determinant;
        row[of_four] = (p.x * right.y - p.y * right.x) / determinant;
        row[of_d] = (turned(arm4) * row[of_four] + normal4).norm();
    }
    let link = if forgets_three { "link_3" } else { "rocker_4" };
    Some(Box::new(move |cause| match cause {
        Some(MarkCause::NoNormal(own)) => own == link,
        // The acceleration of point D then lacks its normal part too, so a cause that names this part is equally right.
        Some(MarkCause::WithoutPart(_, point, _)) => point == "D",
        _ => false,
    }))
}
