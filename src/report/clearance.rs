//! Clearance: smallest distances, first collision, swept areas.

use crate::sentences;
use serde_json::{Value, json};

use super::pretty::{list, pretty};
use super::table_csv::as_csv;
use crate::plain::cells::{at_column, fitted, trimmed};
use design::clearance::{ClearanceResult, ClearanceWork, DistanceCurve, Meeting, PairClearance, RangeVariable};
use linkage::error::{Error, Result};
use linkage::input::Input;
use linkage::math::Vec2;
use prover::numbers;
use scenario::Scenario;
use scenario::clearance::ClearanceQuestion;

linkage::words! {
    /// Answer to a clearance question.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub(crate) enum Standing: word {
        /// All pairs keep the requested clearance over the whole range.
        Clear = "clear",
        /// A pair collides.
        Collides = "collides",
        /// No pair collides, but the distance of a pair is less than requested.
        TooNear = "too near",
        /// No collision was found, but the clearance is not proven over the whole range.
        Open = "not proven",
    }
}

/// Answer to a clearance question.
pub(crate) fn standing(found: &ClearanceResult) -> Standing {
    if found.first_collision().is_some() {
        Standing::Collides
    } else if found.first_too_near().is_some() {
        Standing::TooNear
    } else if !found.open.is_empty() {
        Standing::Open
    } else {
        Standing::Clear
    }
}

fn millimetres(value: f64) -> String {
    numbers::fixed(1e3 * value, 4)
}

fn place(point: Vec2) -> String {
    format!("({}, {})", numbers::fixed(1e3 * point.x, 2), numbers::fixed(1e3 * point.y, 2))
}

fn names<'a>(asked: &'a ClearanceQuestion, pair: &PairClearance) -> [&'a str; 2] {
    pair.bodies.map(|body| asked.bodies[body].name.as_str())
}

/// The answer as text.
pub(crate) fn text(
    scenario: &Scenario,
    asked: &ClearanceQuestion,
    found: &ClearanceResult,
    width: Option<usize>,
) -> String {
    let mut text = String::new();
    let variable = RangeVariable::of(&scenario.case);
    let shown = |value: f64| numbers::fixed(variable.shown(value).0, 4);
    let with_unit = |value: f64| numbers::fixed_in(variable.shown(value).0, 4, variable.shown(value).1);
    let (noun, [from, to]) = (variable.noun(), found.range);
    say!(text, sentences::clearance_over_to(&scenario.name, &scenario.title, &noun, &shown(from), &with_unit(to)));
    if found.pairs.is_empty() {
        say!(text, sentences::NO_TWO_BODIES_CAN_MEET_ALL);
    } else {
        let rows = found.pairs.iter().map(|pair| {
            let ([first, second], smallest) = (names(asked, pair).map(String::from), &pair.smallest);
            let [one, two] = smallest.points.map(place);
            let contact = pair.collision.map_or(String::new(), |meeting| shown(meeting.cranks[1]));
            [format!("{first}, {second}"), millimetres(smallest.distance), shown(smallest.crank), one, two, contact]
        });
        let unit = variable.shown(0.0).1;
        let at = at_column(noun, unit);
        let header =
            format!("bodies | smallest\ndistance, mm> | {at}> | nearest\npoints, mm> | > | contact\nat, {unit}>");
        say!(text, "{}\n", trimmed(fitted(&header, width).add_rows(rows)));
        say!(text, sentences::no_distance_is_smaller_by_more(&numbers::significant(1e3 * found.tolerance, 2)));
    }
    if !found.swept.is_empty() {
        let rows = found.swept.iter().map(|(body, area)| {
            let numbers = [area.value, area.error(), area.least, area.most].map(|own| numbers::fixed(1e6 * own, 2));
            [asked.bodies[*body].name.clone()].into_iter().chain(numbers)
        });
        let header = "\nswept area | \nmm2> | \nerror at most> | \nproven covered> | \nupper limit>";
        say!(text, "{}\n", trimmed(fitted(header, width).add_rows(rows)));
        if let Some((body, area)) = found.swept.iter().find(|(_, area)| area.error() > asked.area * area.value) {
            let (name, share) = (&asked.bodies[*body].name, area.error() / area.value);
            say!(text, sentences::the_area_of_is_known_to_only_the_work(&name, &numbers::percent(share)));
        }
    }
    for &[from, to] in &found.open {
        let why = sentences::THE_MECHANISM_IS_SINGULAR_THERE;
        say!(text, sentences::not_proven_from_to(&shown(from), &with_unit(to), &why));
    }
    let said = |text: &mut String, what: &str, (pair, meeting): (&PairClearance, Meeting)| {
        let ([one, two], at) = (names(asked, pair), format!("{noun} {}", with_unit(meeting.cranks[1])));
        say!(text, sentences::and_at_place(&what, &one, &two, &at, &place(meeting.place)));
    };
    if let Some(first) = found.first_collision() {
        said(&mut text, "first collision", first);
    }
    if let (Some(wanted), Some(first)) = (asked.wanted, found.first_too_near()) {
        said(&mut text, &sentences::first_nearer_than_the_mm(&millimetres(wanted)), first);
    }
    let (word, ClearanceWork { poses, distances, positions, squares }) = (standing(found).word(), found.work);
    say!(text, sentences::poses_and_distances_of_convex(&word, &poses, &distances, &positions, &squares));
    text
}

/// The answer as JSON: one entry of the document.
pub(crate) fn value(scenario: &Scenario, asked: &ClearanceQuestion, found: &ClearanceResult) -> Value {
    let (drive, variable) = (scenario.case.crank(), RangeVariable::of(&scenario.case));
    // Input and time at a value of the range's variable, which is the time or the input of the first drive.
    // In a free motion, the time is not known.
    let instant = |value: f64| match variable {
        RangeVariable::Time => (drive.at(value).value, Some(value)),
        RangeVariable::Input(_) => {
            (value, Some(drive.time_of(value)).filter(|t| t.is_finite() && !scenario.case.is_free()))
        }
    };
    let point = |point: Vec2| json!([point.x, point.y]);
    let (key, unit) = (drive.input.key(), variable.unit());
    let meeting = |own: Option<Meeting>| {
        own.map(|own| {
            let (clear, (crank, time)) = (own.cranks[0], instant(own.cranks[1]));
            json!({format!("clear_until_{unit}"): clear, key: crank, "t_s": time, "place_m": point(own.place)})
        })
    };
    let pairs = list(&found.pairs, |pair| {
        let (smallest, (crank, time)) = (&pair.smallest, instant(pair.smallest.crank));
        json!({
            "bodies": names(asked, pair),
            "smallest_m": smallest.distance, "proven_least_m": smallest.least,
            key: crank, "t_s": time,
            "points_m": smallest.points.map(point),
            "collision": meeting(pair.collision), "too_near": meeting(pair.too_near),
        })
    });
    let swept = list(&found.swept, |(body, area)| {
        json!({
            "link": asked.bodies[*body].name, "area_m2": area.value, "error_m2": area.error(),
            "least_m2": area.least, "most_m2": area.most,
        })
    });
    let first = |first: Option<(&PairClearance, Meeting)>| {
        first.map(|(pair, own)| json!({"bodies": names(asked, pair), "at": meeting(Some(own))}))
    };
    json!({
        "scenario": scenario.name, "standing": standing(found).word(), format!("range_{unit}"): found.range,
        "wanted_m": asked.wanted, "tolerance_m": found.tolerance, "pairs": pairs,
        "swept": swept, "first_collision": first(found.first_collision()),
        "first_too_near": first(found.first_too_near()), format!("not_proven_{unit}"): found.open,
        "work": {
            "poses": found.work.poses, "distances": found.work.distances,
            "area_poses": found.work.positions, "squares": found.work.squares,
        },
    })
}

/// The errors of a scenario without a result, as entries of the document.
pub(crate) fn failures(file: &str, error: &Error) -> Vec<Value> {
    let one = |error: &Error| {
        json!({
            "scenario": file, "error": error.message(), "line": error.place().map(linkage::error::Place::line),
            "key": error.scenario_key(), "help": error.way_out(),
        })
    };
    let rest = error.rest().map(|rest| json!({"scenario": file, "error": rest}));
    error.each().map(one).chain(rest).collect()
}

/// The document of all scenarios, schema 1.
pub(crate) fn json(scenarios: Vec<Value>) -> String {
    pretty(&json!({"schema": 1, "scenarios": scenarios}))
}

/// Distances of all pairs at the instants of a grid, as CSV with 17 significant digits.
///
/// # Errors
/// [`ErrorKind::Io`](linkage::error::ErrorKind::Io) if the table cannot be written.
pub(crate) fn distances(
    asked: &ClearanceQuestion,
    input: Input,
    times: &[f64],
    course: &DistanceCurve,
) -> Result<String> {
    let name = |&[a, b]: &[usize; 2]| format!("{}.{}.distance_m", asked.bodies[a].name, asked.bodies[b].name);
    let header = ["t_s", input.key()].map(String::from).into_iter().chain(asked.pairs.iter().map(name));
    let rows = times.iter().zip(&course.cranks).zip(&course.rows).map(|((t, crank), row)| {
        let values = [*t, *crank].into_iter().chain(row.iter().copied());
        values.map(|value| format!("{value:.16e}")).collect()
    });
    as_csv([header.collect::<Vec<_>>()].into_iter().chain(rows))
}
