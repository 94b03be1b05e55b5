//! Stores the results of a stress family as JSON, schema 1, and reads them back.
//! A family is a set of mechanisms with one varied parameter; a point is one value of this parameter.
//! Each stored point contains a digest of its text. If the text has been changed, the point is not read back.

use serde::{Deserialize, Serialize};
use serde_json::Value;

use lab::stress::{StressFamily, StressOutcome, fnv};

const SCHEMA: u32 = 1;

#[derive(Serialize, Deserialize)]
struct Document<Point> {
    schema: u32,
    family: String,
    dial: String,
    title: String,
    seed: u64,
    points: Vec<Point>,
}

#[derive(Serialize, Deserialize)]
struct Sealed<O> {
    #[serde(flatten)]
    outcome: O,
    #[serde(default)]
    digest: String,
}

/// FNV-1a of the text of a point without its digest.
fn digest(outcome: &StressOutcome) -> String {
    let bare = Sealed { outcome, digest: String::new() };
    fnv(&serde_json::to_string(&bare).expect("texts and numbers can be written"))
}

/// The results of a family as JSON, in the order of `outcomes`.
pub(crate) fn json<'a>(family: &StressFamily, seed: u64, outcomes: impl Iterator<Item = &'a StressOutcome>) -> String {
    let document = Document {
        schema: SCHEMA,
        family: family.name.into(),
        dial: family.dial.into(),
        title: family.title.into(),
        seed,
        points: outcomes.map(|outcome| Sealed { outcome, digest: digest(outcome) }).collect(),
    };
    serde_json::to_string_pretty(&document).expect("texts and numbers can be written") + "\n"
}

/// The stored results in the text of a file.
/// A text with another schema, or not in this format, gives no results, so everything is computed anew.
/// A changed or invalid point is also computed anew.
pub(crate) fn outcomes(text: &str) -> Vec<StressOutcome> {
    let document: Option<Document<Value>> = serde_json::from_str(text).ok();
    let points = document.filter(|own| own.schema == SCHEMA).map_or_else(Vec::new, |own| own.points);
    let sealed = points.into_iter().filter_map(|point| serde_json::from_value::<Sealed<StressOutcome>>(point).ok());
    sealed.filter(|own| own.digest == digest(&own.outcome)).map(|own| own.outcome).collect()
}

/// Whether a file contains results of this family.
pub(crate) fn is_kept(bytes: &[u8], family: &StressFamily) -> bool {
    serde_json::from_slice::<Document<Value>>(bytes).is_ok_and(|own| own.family == family.name)
}
