//! Texts of a page: verdict, structure, settings.

use crate::sentences;
use std::collections::BTreeMap;

use super::markup::escaped;
use crate::plain::judged::{self, JudgedNumber, Sort, grade};
use crate::plain::{brief, figures, machine};
use crate::report::text;
use linkage::mechanism::{DrivingLink, JointId, LinkId, Mechanism};
use prover::numbers::{error_in, fixed, significant};
use prover::run::Proof;

/// Longest scenario that is shown (bytes).
const LONGEST: usize = 200_000;

/// Sign and word of a proof's verdict.
pub(super) fn verdict(proof: &Proof) -> String {
    let grade = grade(&proof.verdict);
    let sign = grade.of(["✓", "?", "✗"]);
    let (word, class) = (grade.capitals(), grade.capitals().to_lowercase());
    format!("<span class=\"{class}\"><span aria-hidden=\"true\">{sign}</span> {word}</span>")
}

/// How much was judged, with which reference, and with which engines.
pub(super) fn sentence(proof: &Proof) -> String {
    let engine = if proof.engines.len() == 1 { "Engine" } else { "Engines" };
    let parties: Vec<&str> = proof.engines.iter().map(|engine| engine.info.name).collect();
    let (judged, parties, at) = (text::sentence(proof), parties.join(", "), brief::resolution(proof));
    let agreement = brief::agreement(proof).map_or_else(String::new, |told| format!("{told} "));
    escaped(&format!("{agreement}{judged} Reference: {}. {engine}: {parties}; {at}.", proof.reference))
}

/// The mechanism as the file describes it, and the figures of its motion.
pub(super) fn facts(proof: &Proof) -> String {
    let told = machine::rows(proof).into_iter();
    let told: String = told.map(|(what, own)| format!("<dt>{what}</dt><dd>{}</dd>\n", escaped(&own))).collect();
    let figures = figures::rows(proof).into_iter().map(|cells| row(&cells.map(|own| escaped(&own)), ""));
    let figures: String = figures.collect();
    if figures.is_empty() {
        return format!("<dl class=\"facts\">\n{told}</dl>\n");
    }
    let (word, unit) = figures::place(proof);
    let heads = ["figure", "value", "unit", &format!("at {word}, {unit}")];
    format!("<dl class=\"facts\">\n{told}</dl>\n{}", table(sentences::FIGURES_OF_THE_MOTION, &heads, figures))
}

/// Table of the checks and of the forces that engines themselves exert, sorted by the ratio of residual to bound.
pub(super) fn checks(proof: &Proof) -> String {
    let share = |own: &JudgedNumber| if own.bound > 0.0 { own.value / own.bound } else { f64::from(own.value > 0.0) };
    let mut all = judged::of(proof);
    all.retain(|own| own.sort != Sort::Channel);
    // At equal ratios, checks come before forces.
    all.sort_by_key(|own| own.sort != Sort::Check);
    all.sort_by(|a, b| share(b).total_cmp(&share(a)));
    let rows = all.into_iter().map(|own| {
        let name = match own.engine {
            Some(engine) if own.sort == Sort::OwnForce => format!("{} ({})", own.name, engine.info.name),
            _ => own.name,
        };
        let ([value, bound], word) = ([own.value, own.bound].map(|one| error_in(one, own.unit)), own.verdict.word());
        let verdict = format!("<td class=\"{word}\">{word}</td>");
        row(&[escaped(&name), value, bound, escaped(&own.basis)], &verdict)
    });
    table("Checks", &["check", "value", "bound", sentences::BASIS_OF_THE_BOUND, "verdict"], rows.collect())
}

/// Mobility, driving links and groups, links and joints.
pub(super) fn structure(proof: &Proof) -> String {
    let case = &proof.scene.case;
    let (mechanism, structure) = (&case.mechanism, &case.structure);
    let mut out = format!("<p><code>{}</code></p>\n", escaped(&proof.formula));
    let mobility = structure.mobility;
    say!(out, "<p>Mobility {mobility} by counting. Groups in the order in which they are solved:</p>\n<ol>");
    for &DrivingLink { link, joint, .. } in &structure.drivers {
        say!(out, "<li>driving link {} at {}</li>", link_name(mechanism, link), joint_name(mechanism, joint));
    }
    for (group, mode) in structure.groups.iter().zip(&case.modes) {
        let joints =
            |all: &[JointId]| all.iter().map(|&joint| joint_name(mechanism, joint)).collect::<Vec<_>>().join(", ");
        let [inner, outer] = [&group.inner, &group.outer].map(|all| joints(all));
        let (links, class, order, pairs) = (group.names(mechanism), group.class, group.order(), group.pairs());
        let head = escaped(&sentences::class_order_mode(&links, &class, &order, &pairs, &mode.name()));
        say!(out, "<li>{head}; inner joints {inner}; outer joints {outer}</li>");
    }
    out.push_str("</ol>\n");
    out + &links(mechanism) + &joints(mechanism)
}

fn link_name(mechanism: &Mechanism, link: LinkId) -> String {
    escaped(&mechanism.links()[link].name)
}

fn joint_name(mechanism: &Mechanism, joint: JointId) -> String {
    escaped(&mechanism.joints()[joint].name)
}

fn links(mechanism: &Mechanism) -> String {
    let rows = mechanism.links().iter().enumerate().map(|(number, link)| {
        let points = link.points.iter().map(|point| {
            let [x, y] = [point.local.x, point.local.y].map(|own| fixed(1e3 * own, 3));
            format!("{} ({x}, {y})", escaped(&point.name))
        });
        let [mass, inertia] = [link.mass, link.inertia].map(|own| significant(own, 5));
        let swatch = format!("<span class=\"swatch k{number}\" aria-hidden=\"true\"></span>");
        row(
            &[format!("{swatch}{number}"), escaped(&link.name), points.collect::<Vec<_>>().join(", "), mass, inertia],
            "",
        )
    });
    table("Links", &["no.", "link", sentences::POINTS_MM_ITS_FRAME, "mass kg", sentences::INERTIA_KG], rows.collect())
}

fn joints(mechanism: &Mechanism) -> String {
    let rows = mechanism.joints().iter().map(|joint| {
        let [first, second] = [joint.first, joint.second].map(|side| link_name(mechanism, side.link));
        row(&[escaped(&joint.name), joint.kind.name().into(), first, second], "")
    });
    table("Joints", &["joint", "kind", "first link", "second link"], rows.collect())
}

/// A row of a table. `cells` are the contents of cells without the `td` tags; `last` is the last cell with its tags.
fn row(cells: &[String], last: &str) -> String {
    let cells: String = cells.iter().map(|cell| format!("<td>{cell}</td>")).collect();
    format!("<tr>{cells}{last}</tr>\n")
}

/// Wide content that scrolls separately on a phone.
fn scrolling(label: &str, inside: &str) -> String {
    format!(
        "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"{label}\"><table>{inside}</tbody></table></div>\n"
    )
}

/// A table with its caption and the heads of its columns.
fn table(caption: &str, heads: &[&str], rows: String) -> String {
    let heads: String = heads.iter().map(|head| format!("<th scope=\"col\">{head}</th>")).collect();
    let inside = format!("<caption>{caption}</caption>\n<thead><tr>{heads}</tr></thead>\n<tbody>\n{rows}");
    scrolling(caption, &inside)
}

/// Settings and versions.
pub(super) fn settings(told: &BTreeMap<String, String>) -> String {
    let row = |(key, value): (&String, &String)| {
        format!("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n", escaped(&key.replace('_', " ")), escaped(value))
    };
    let rows: String = told.iter().map(row).collect();
    scrolling(sentences::SETTINGS_AND_VERSIONS, &format!("<tbody>\n{rows}"))
}

/// The scenario in its original form.
pub(super) fn scenario(given: &str) -> String {
    match given.len() {
        0 => "<p>The case was built in code; there is no file.</p>".into(),
        1..=LONGEST => format!("<pre tabindex=\"0\">{}</pre>", escaped(given)),
        long => format!("<p>The file has {long} bytes and is not repeated here.</p>"),
    }
}
