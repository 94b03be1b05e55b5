//! What a family has come to, as JSON, schema 1, and back. Numbers have four digits; those that are not finite are
//! `null` and are read back as infinite. A point is taken back only as it was written: it has a digest of its text.

use serde::{Deserialize, Serialize};

use super::super::pretty::rows;
use super::summary::WORDS;
use lab::stress::{Family, Group, Outcome, Party, Reached, fnv};

const SCHEMA: u32 = 1;

#[derive(Serialize, Deserialize)]
struct Document {
    schema: u32,
    family: String,
    dial: String,
    title: String,
    seed: u64,
    points: Vec<Point>,
}

rows! {
    #[derive(Deserialize)]
    struct Point = |own: &Outcome| {} {
        dial: f64 = own.dial,
        sample: u64 = own.sample,
        key: String = own.key.clone(),
        #[serde(default, skip_serializing_if = "String::is_empty")]
        refused: String = own.refused.clone(),
        parties: Vec<Row> = own.parties.iter().map(Row::of).collect(),
        #[serde(default)]
        digest: String = String::new(),
    }

    #[derive(Deserialize)]
    struct Row = |own: &Party| {} {
        name: String = own.name.clone(),
        verdict: String = own.verdict.clone(),
        #[serde(default, skip_serializing_if = "String::is_empty")]
        why: String = own.why.clone(),
        #[serde(default, skip_serializing_if = "String::is_empty")]
        against: String = own.against.clone(),
        groups: Vec<Cell> = own.reached.iter().map(Cell::of).collect(),
        closure: Option<f64> = own.closure.and_then(finite),
        balance: Option<f64> = own.balance.and_then(finite),
        step_s: Option<f64> = own.step,
        sweeps: Option<usize> = own.sweeps,
        extrapolated: Option<usize> = own.extrapolated,
        steps: Option<f64> = own.steps,
        runs: Option<usize> = own.runs,
        work: Option<f64> = own.work,
        #[serde(default)]
        done: Vec<(String, u64)> = own.done.clone(),
        silent: usize = own.silent,
    }

    #[derive(Deserialize)]
    struct Cell = |own: &Reached| {} {
        group: String = own.group.name().into(),
        error: Option<f64> = finite(own.error),
        bound: Option<f64> = finite(own.bound),
        channel: String = own.channel.clone(),
        used: Option<f64> = finite(own.used),
    }
}

impl Point {
    /// FNV-1a of what the point says, its digest left out.
    fn sealed(self) -> Point {
        let bare = Point { digest: String::new(), ..self };
        let text = serde_json::to_string(&bare).expect("texts and numbers can be written");
        Point { digest: fnv(&text), ..bare }
    }
}

/// The results of a family, in the order given.
pub(crate) fn json<'a>(family: &Family, seed: u64, outcomes: impl Iterator<Item = &'a Outcome>) -> String {
    let document = Document {
        schema: SCHEMA,
        family: family.name.into(),
        dial: family.dial.into(),
        title: family.title.into(),
        seed,
        points: outcomes.map(|own| Point::of(own).sealed()).collect(),
    };
    serde_json::to_string_pretty(&document).expect("texts and numbers can be written") + "\n"
}

/// The results that a text holds. A text of another schema, or none of ours, holds none: everything is made anew. So is
/// a point that was changed since it was written, or that has a verdict which is none of [`WORDS`].
pub(crate) fn outcomes(text: &str) -> Vec<Outcome> {
    let Ok(document) = serde_json::from_str::<Document>(text) else { return Vec::new() };
    if document.schema != SCHEMA {
        return Vec::new();
    }
    let point = |own: Point| -> Option<Outcome> {
        let digest = own.digest.clone();
        let own = own.sealed();
        (own.digest == digest).then_some(())?;
        let parties = own.parties.into_iter().map(party).collect::<Option<_>>()?;
        Some(Outcome { dial: own.dial, sample: own.sample, key: own.key, refused: own.refused, parties })
    };
    document.points.into_iter().filter_map(point).collect()
}

/// Whether a file holds results of this family.
pub(crate) fn is_kept(bytes: &[u8], family: &Family) -> bool {
    serde_json::from_slice::<Document>(bytes).is_ok_and(|own| own.family == family.name)
}

fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}

fn party(own: Row) -> Option<Party> {
    WORDS.contains(&own.verdict.as_str()).then_some(())?;
    let number = |value: Option<f64>| value.unwrap_or(f64::INFINITY);
    let cell = |own: Cell| -> Option<Reached> {
        let (error, bound, used) = (number(own.error), number(own.bound), number(own.used));
        Some(Reached { group: Group::named(&own.group)?, error, bound, channel: own.channel, used })
    };
    Some(Party {
        name: own.name,
        against: own.against,
        reached: own.groups.into_iter().map(cell).collect::<Option<_>>()?,
        closure: own.closure,
        balance: own.balance,
        verdict: own.verdict,
        why: own.why,
        step: own.step_s,
        sweeps: own.sweeps,
        extrapolated: own.extrapolated,
        steps: own.steps,
        runs: own.runs,
        work: own.work,
        done: own.done,
        silent: own.silent,
    })
}
