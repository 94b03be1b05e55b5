//! A set of truths for simulators: mechanisms as models, with their motion and reactions, and bounds on both.

use serde_json::{Value, json};

use super::html::filled;
use super::table_csv::{as_csv, number, solution};
use crate::sentences;
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::KeepNan;
use linkage::math::statistics::ends;
use linkage::trajectory::Trajectory;
use prover::run::Proof;
use sweep::column_table;

const README: &str = include_str!("../golden/README.md");
/// The checker, a script of Python.
pub(crate) const CHECKER: &str = include_str!("../golden/check.py");
/// Version of the set's format: names of files, and columns.
const FORMAT: u32 = 1;

/// The mechanisms: scenario among the shipped files, and what sort of mechanism it is.
pub(crate) const SET: [(&str, &str); 22] = [
    ("scenarios/crank_rocker.toml", "four-bar: crank-rocker, resistance at the rocker"),
    ("scenarios/double_crank.toml", "four-bar: double crank"),
    ("scenarios/double_rocker.toml", "four-bar: double rocker"),
    ("scenarios/formulas/parallel_cranks.toml", "four-bar: parallel cranks through their change points"),
    ("scenarios/swinging_parallelogram.toml", "four-bar: parallelogram that swings at 0.7504 Hz"),
    ("scenarios/n_four_bar_1.toml", "four-bar: free swing through change points"),
    ("scenarios/formulas/slider_crank_centric.toml", "slider-crank, centric"),
    ("scenarios/formulas/slider_crank_eccentric.toml", "slider-crank, eccentric"),
    ("scenarios/compressor.toml", "two slider-cranks on one crank"),
    ("scenarios/quick_return.toml", "six-bar with a swinging guide"),
    ("scenarios/scotch_yoke.toml", "slider-crank with a slot (Scotch yoke)"),
    ("scenarios/six_bar_slider.toml", "six-bar with a slider"),
    ("scenarios/formulas/peaucellier_inversor.toml", "eight-bar with double joints"),
    ("scenarios/class3_group.toml", "group of class III"),
    ("scenarios/guided_group.toml", "group of class III with a guide"),
    ("scenarios/fourth_class.toml", "group of class IV"),
    ("scenarios/five_bar.toml", "five-bar with two drives"),
    ("scenarios/geared_five_bar.toml", "five-bar with a gear pair"),
    ("scenarios/planetary_train.toml", "planetary gear train"),
    ("scenarios/boom_lift.toml", "machine with a hydraulic ram"),
    ("scenarios/crank_rocker_runup.toml", "four-bar: run-up under a motor"),
    ("scenarios/double_pendulum.toml", "open chain, free"),
];

/// A mechanism of the set, as its files describe it.
pub(crate) struct Golden {
    /// Name of the scenario, of its directory and of its models.
    pub(crate) name: String,
    pub(crate) title: String,
    /// What sort of mechanism it is.
    pub(crate) sort: &'static str,
    /// File name endings of the models, each with the reason if the model is missing.
    pub(crate) models: Vec<(&'static str, Option<String>)>,
    /// The number of instants and the number of channels of the truth.
    pub(crate) size: [usize; 2],
    /// Largest relative bound of a channel: its bound divided by the largest magnitude in all channels of its unit.
    pub(crate) bound: f64,
}

/// The truth of a proof: the tables `truth.csv`, `truth.parquet` and `bounds.csv`.
///
/// # Errors
/// [`ErrorKind::Io`] if a table cannot be written.
pub(crate) fn tables(proof: &Proof) -> Result<[(&'static str, Vec<u8>); 3]> {
    let truth = &proof.reference_trajectory;
    let failed =
        |error: &dyn std::fmt::Display| Error::new(ErrorKind::Io, sentences::the_table_cannot_be_written(&error));
    let mut text = Vec::new();
    solution(truth, &mut text).map_err(|error| failed(&error))?;
    let input = truth.input();
    let own = [("t_s", "s", truth.times()), (input.key(), input.unit(), truth.inputs())];
    let own = own.into_iter().map(|(name, unit, values)| (name.to_string(), unit.to_string(), values));
    let channels = truth.iter().map(|(channel, values)| (channel.to_string(), channel.kind.unit.to_string(), values));
    let columns: Vec<_> = own.chain(channels).collect();
    let table = column_table(&columns).map_err(|error| failed(&error))?;
    let head = ["channel", "unit", "smallest", "largest", "bound"].map(String::from);
    let rows = truth.iter().zip(&proof.reference_bounds).map(|((channel, values), bound)| {
        let [low, high] = ends(values.iter().copied());
        [channel.to_string(), channel.kind.unit.symbol().into(), number(low), number(high), number(*bound)]
    });
    let bounds = as_csv(std::iter::once(head).chain(rows))?;
    Ok([("truth.csv", text), ("truth.parquet", table), ("bounds.csv", bounds.into_bytes())])
}

/// Largest relative bound of a channel: its bound divided by the largest magnitude in all channels of its unit.
pub(crate) fn largest_bound(truth: &Trajectory, bounds: &[f64]) -> f64 {
    let size = |values: &[f64]| ends(values.iter().map(|own| own.abs()))[1];
    let share = |(channel, bound): (&linkage::trajectory::Channel, &f64)| {
        let alike = truth.iter().filter(|(own, _)| own.kind.unit == channel.kind.unit);
        let scale = alike.map(|(_, values)| size(values)).fold(0.0, f64::larger);
        // If no value exceeds the bound, the values are only rounding errors of a quantity that is zero.
        if scale > *bound { bound / scale } else { 0.0 }
    };
    truth.channels().iter().zip(bounds).map(share).fold(0.0, f64::larger)
}

/// `README.md` of the set.
pub(crate) fn readme(set: &[Golden]) -> String {
    let row = |own: &Golden| {
        let models: Vec<&str> = own.models.iter().filter(|(_, why)| why.is_none()).map(|(ending, _)| *ending).collect();
        format!("| `{}` | {} | {} | {} |", own.name, own.title, own.sort, models.join(", "))
    };
    let rows: Vec<String> = set.iter().map(row).collect();
    let (count, format) = (set.len().to_string(), FORMAT.to_string());
    let version = env!("CARGO_PKG_VERSION");
    filled(README, &[("count", &count), ("version", version), ("format", &format), ("rows", &rows.join("\n"))])
}

/// `manifest.json` of the set.
pub(crate) fn manifest(set: &[Golden]) -> String {
    let mechanisms: Vec<Value> = set
        .iter()
        .map(|own| {
            let models = own.models.iter().map(|(ending, why)| match why {
                None => (ending.to_string(), json!(format!("{}/{}.{ending}", own.name, own.name))),
                Some(why) => (ending.to_string(), json!({ "missing": why })),
            });
            json!({
                "name": own.name, "title": own.title, "sort": own.sort, "models": models.collect::<serde_json::Map<_, _>>(),
                "instants": own.size[0], "channels": own.size[1], "largest_bound": own.bound,
            })
        })
        .collect();
    let all = json!({ "format": FORMAT, "program": format!("linkproof {}", env!("CARGO_PKG_VERSION")), "mechanisms": mechanisms });
    serde_json::to_string_pretty(&all).expect("texts and numbers") + "\n"
}
