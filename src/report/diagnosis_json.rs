//! A diagnosis in the JSON report.

use serde::Serialize;

use super::pretty::rows;
use crate::plain::diagnosis::{cause, nature, standing};
use prover::diagnosis::{Diagnosis, Since, Standing};

rows! {
    /// A diagnosis in the JSON report.
    pub struct Row = |diagnosis: &Diagnosis| {} {
        suspect: String = diagnosis.suspect.clone(),
        /// The party that stands alone, if one does, and how all of them stand to each other.
        alone: Option<String> = match &diagnosis.alone {
            Standing::Alone(name) => Some(name.clone()),
            Standing::Together | Standing::Camps(_) | Standing::Open(_) => None,
        },
        standing: String = standing(&diagnosis.alone),
        /// The channels beyond their bounds, the earliest first.
        since: Vec<SinceRow> = diagnosis.since.iter().map(SinceRow::of).collect(),
        /// The cause in words; `null` where nothing simple explains any of it.
        cause: Option<String> = diagnosis.cause.as_ref().map(cause),
        /// What the error looks like, where no cause explains all of it.
        error: Option<String> = diagnosis.nature.map(nature),
        /// Whether it explains all channels.
        explained: bool = diagnosis.is_explained(),
        /// Causes that explain as much.
        also: Vec<String> = diagnosis.also.iter().map(cause).collect(),
        left_over: Vec<String> = diagnosis.left_over.iter().map(ToString::to_string).collect(),
        cases_tried: usize = diagnosis.solved,
    }

    struct SinceRow = |one: &Since| {} {
        channel: String = one.channel.to_string(),
        t_s: f64 = one.time,
        crank_rad: f64 = one.crank,
        difference: f64 = one.difference,
        bound: f64 = one.bound,
        instants_beyond: usize = one.beyond,
    }
}
