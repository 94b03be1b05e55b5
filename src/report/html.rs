//! A proof as one self-contained HTML page: the mechanism in motion, all channels with errors and bounds, verdict and
//! findings.
//! A script on the page draws the proof; all text is visible without the script.

mod data;
mod findings;
mod formulas;
mod graphs;
mod loads;
mod markup;
mod picture;
mod placed;
mod plans;
mod thinned;
mod words;

use crate::sentences;
use std::collections::BTreeMap;

use super::pretty::list;
use crate::plain::Tell;
use design::diagram::Graphs;
use drawing::{Sketch, Travels};
use linkage::input::Input;
use markup::contained;
pub(super) use markup::{escaped, filled};
use placed::Placed;
use prover::run::Proof;
use serde_json::{Value, json};
use thinned::Thinned;

const TEMPLATE: &str = include_str!("html/page.html");
const STYLE: &str = include_str!("html/page.css");
/// Further parts of the script under `linkproof watch`: points can be dragged and the view is kept, and pages replace
/// each other.
const WATCHED: [&str; 2] = [include_str!("html/script/watched.js"), include_str!("html/script/taken.js")];
/// The parts of the script; each part comes after the parts on which it depends.
const SCRIPT: [&str; 9] = [
    include_str!("html/script/read.js"),
    include_str!("html/script/svg.js"),
    include_str!("html/script/motion.js"),
    include_str!("html/script/loads.js"),
    include_str!("html/script/names.js"),
    include_str!("html/script/charts.js"),
    include_str!("html/script/plans.js"),
    include_str!("html/script/curves.js"),
    include_str!("html/script/main.js"),
];

/// Limit for the columns of a page, in bytes; the page then stays below 3 MB.
pub(crate) const PAGE_BYTES: usize = 1_900_000;

/// Contents of a page besides the proof.
pub(crate) struct Beside<'a> {
    /// The scenario's text.
    pub(crate) given: &'a str,
    /// Versions, settings, and the options of the command that change the scenario, by name.
    pub(crate) settings: &'a BTreeMap<String, String>,
    /// Graphs over the crank angle, or the reason why they are missing.
    pub(crate) reduced: Result<Graphs, String>,
    /// Limit for all columns, in bytes of base64; longer columns lose instants.
    pub(crate) bytes: usize,
}

/// The page of a proof. `tell` puts the advice into words.
pub(crate) fn page(proof: &Proof, beside: &Beside, tell: Tell) -> String {
    filled_page(proof, beside, &Judged::of(proof, tell), tell, &[&SCRIPT.concat(), "setUp(null);\n"].concat())
}

/// The page of a proof under `linkproof watch`. If the motion is not judged yet, `words` stand in place of the verdict.
pub(crate) fn watched(proof: &Proof, beside: &Beside, words: Option<&str>, tell: Tell) -> String {
    let judged = match words {
        Some(words) => Judged { sentence: escaped(words), ..Judged::default() },
        None => Judged::of(proof, tell),
    };
    filled_page(proof, beside, &judged, tell, "")
}

/// The script of the frame in which the pages of `linkproof watch` are shown.
pub(super) fn watching_script() -> String {
    let [watched, taken] = WATCHED;
    ["const run = (view) => {", &SCRIPT.concat(), watched, "};", taken].concat()
}

/// The parts of a page that depend on the verdict, as HTML.
#[derive(Default)]
struct Judged {
    verdict: String,
    sentence: String,
    why: String,
    findings: String,
    checks: String,
}

impl Judged {
    fn of(proof: &Proof, tell: Tell) -> Judged {
        Judged {
            verdict: words::verdict(proof),
            sentence: words::sentence(proof),
            why: findings::why(proof, tell),
            findings: findings::others(proof, tell),
            checks: words::checks(proof),
        }
    }
}

fn filled_page(proof: &Proof, beside: &Beside, judged: &Judged, tell: Tell, script: &str) -> String {
    let Beside { given, settings, reduced, bytes } = beside;
    let case = &proof.scene.case;
    let errors = thinned::errors(proof);
    let reference = &proof.reference_trajectory;
    let placed = Placed::of(&case.mechanism, reference);
    let beside = placed.as_ref().map_or(0, |placed| loads::width(case) + plans::width(case, placed, 0));
    let curves = formulas::of(proof);
    let thinned = Thinned::of(proof, &errors, beside + formulas::WIDTH * curves.len(), *bytes);
    let mut data = data::of(proof, &errors, &thinned, tell);
    data.insert("formulas".into(), list(&curves, |own| own.json(&thinned.rows)));
    let input = case.crank().input;
    if input != Input::Angle {
        let (noun, word, (unit, _)) = (input.noun(), input.word(), input.shown_in());
        data.insert("input".into(), json!({ "noun": noun, "word": word, "unit": unit, "factor": input.shown(1.0) }));
    }
    let picture = match placed {
        Some(placed) => {
            let room = placed.room(&thinned.rows);
            let unit = placed::unit(&case.mechanism, room);
            let mut travels = Travels::none(&case.mechanism);
            for &row in &thinned.rows {
                travels.take_in(&case.mechanism, |link, local| Some(placed.point(row, link, local)));
            }
            let sketch = Sketch::of_case(case, &travels, unit);
            let view = picture::view(room, unit);
            data.insert("motion".into(), data::motion(proof, &sketch, view));
            data.insert("loads".into(), loads::of(case, &sketch, &placed, &thinned.rows, reference));
            data.insert("plans".into(), plans::of(case, &placed, &thinned.rows));
            picture::drawn(&sketch, &placed, view, thinned.rows[0])
        }
        None => "<p>The positions of all links are not among the requested channels: nothing can be drawn.</p>".into(),
    };
    let no_graphs = match reduced {
        Ok(graphs) => {
            data.insert("reduced".into(), graphs::over_crank(graphs));
            String::new()
        }
        Err(why) => format!("<p>The mechanism is not reduced to its crank here: {}</p>", escaped(why)),
    };
    data.insert("motor".into(), graphs::motor(case, reference));
    let links = case.mechanism.links().len();
    let [light, dark] = [false, true].map(|dark| picture::colours(links, dark));
    let style = filled(STYLE, &[("light", &light), ("dark", &dark), ("links", &picture::inks(links))]);
    filled(
        TEMPLATE,
        &[
            ("name", &escaped(&proof.scenario)),
            ("title", &escaped(&proof.title)),
            ("style", &style),
            ("verdict", &judged.verdict),
            ("sentence", &judged.sentence),
            ("why", &judged.why),
            ("facts", &words::facts(proof)),
            ("findings", &judged.findings),
            ("picture", &picture),
            ("thinned", &told(&thinned)),
            ("input", input.noun()),
            ("reduced", &no_graphs),
            ("checks", &judged.checks),
            ("structure", &words::structure(proof)),
            ("settings", &words::settings(settings)),
            ("scenario", &words::scenario(given)),
            ("version", env!("CARGO_PKG_VERSION")),
            ("data", &contained(&Value::Object(data).to_string())),
            ("script", script),
        ],
    )
}

/// Number of instants on the page; if some are omitted, also the number of all instants.
fn told(thinned: &Thinned) -> String {
    let (shown, all) = (thinned.rows.len(), thinned.all);
    if shown == all { format!("{all} instants.") } else { sentences::of_instants_evenly_chosen_and_those(&shown, &all) }
}
