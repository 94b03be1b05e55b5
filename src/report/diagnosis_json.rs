//! A diagnosis in the JSON report.

use serde::Serialize;

use crate::plain::diagnosis::{cause, nature, standing};
use prover::diagnosis::{Diagnosis, Since, Standing};

/// A diagnosis in the JSON report.
#[derive(Debug, Serialize)]
pub struct Row {
    suspect: String,
    /// The party that stands alone, if one does, and how all of them stand to each other.
    alone: Option<String>,
    standing: String,
    /// The channels beyond their bounds, the earliest first.
    since: Vec<SinceRow>,
    /// The cause in words; `null` where nothing simple explains any of it.
    cause: Option<String>,
    /// What the error looks like, where no cause explains all of it.
    error: Option<String>,
    /// Whether it explains all channels.
    explained: bool,
    /// Causes that explain as much.
    also: Vec<String>,
    left_over: Vec<String>,
    cases_tried: usize,
}

#[derive(Debug, Serialize)]
struct SinceRow {
    channel: String,
    t_s: f64,
    crank_rad: f64,
    difference: f64,
    bound: f64,
    instants_beyond: usize,
}

/// A diagnosis for the JSON report.
#[must_use]
pub fn row(diagnosis: &Diagnosis) -> Row {
    let since = |one: &Since| SinceRow {
        channel: one.channel.to_string(),
        t_s: one.time,
        crank_rad: one.crank,
        difference: one.difference,
        bound: one.bound,
        instants_beyond: one.beyond,
    };
    Row {
        suspect: diagnosis.suspect.clone(),
        alone: match &diagnosis.alone {
            Standing::Alone(name) => Some(name.clone()),
            Standing::Together | Standing::Camps(_) | Standing::Open(_) => None,
        },
        standing: standing(&diagnosis.alone),
        since: diagnosis.since.iter().map(since).collect(),
        cause: diagnosis.cause.as_ref().map(cause),
        error: diagnosis.nature.map(nature),
        explained: diagnosis.is_explained(),
        also: diagnosis.also.iter().map(cause).collect(),
        left_over: diagnosis.left_over.iter().map(ToString::to_string).collect(),
        cases_tried: diagnosis.solved,
    }
}
