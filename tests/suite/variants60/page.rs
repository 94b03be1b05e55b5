//! The statements of docs/variants60.md about the whole family, which stand below a marker in that page.

use std::fmt::Write;

use scenario::Scenario;

use super::geometry::{Linkage, Senses, Variant};
use super::plan::Plan;

const MARKER: &str = "<!-- written by tests/suite/variants60.rs -->\n";

/// The page with a new generated part.
pub fn renewed(page: &str, plans: &[Plan], scenarios: &[Scenario]) -> String {
    let (prose, _) = page.split_once(MARKER).expect("the page has its marker");
    format!("{prose}{MARKER}{}{}{}", counts(plans), senses(plans), table(plans, scenarios))
}

fn turning<'a>(plans: &'a [Plan], has_slider: bool) -> (usize, usize) {
    let of_kind: Vec<&'a Plan> =
        plans.iter().filter(|plan| plan.linkage.variant.rocker.is_some() == has_slider).collect();
    (of_kind.iter().filter(|plan| plan.limits.is_none()).count(), of_kind.len())
}

fn counts(plans: &[Plan]) -> String {
    let [(slider, sliders), (plain, plains)] = [true, false].map(|has_slider| turning(plans, has_slider));
    format!(
        "\n## How many turn fully\n\n{} of {}: {slider} of the {sliders} with a slider, {plain} of the {plains} of scheme 4.\nOf the variants with a slider, the number that turns fully depends on the senses in which the angles \
beta, gamma and phi are measured (cw: clockwise, ccw: counter-clockwise):\n\n",
        slider + plain,
        sliders + plains
    )
}

/// For all eight combinations of directions of the three angles: the number of variants with a slider whose crank
/// rotates fully.
fn senses(plans: &[Plan]) -> String {
    let mut text = String::from("| beta | gamma | phi | variants with a slider that turn fully |\n|---|---|---|---|\n");
    let variants: Vec<&Variant> =
        plans.iter().map(|plan| &plan.linkage.variant).filter(|v| v.rocker.is_some()).collect();
    for k in 0..8 {
        let senses: Senses = [4, 2, 1].map(|bit| if k & bit == 0 { 1.0 } else { -1.0 });
        let turns = |v: &&&Variant| Linkage::of(v, senses).interval(v.alpha, 0.0).is_none();
        let count = variants.iter().filter(turns).count();
        // In the project's interpretation, beta is measured clockwise, and gamma and phi counter-clockwise.
        let words = [-senses[0], senses[1], senses[2]].map(|s| if s > 0.0 { "ccw" } else { "cw" });
        let ours = if k == 0 { " (our reading)" } else { "" };
        let _ = writeln!(text, "| {} | {} | {} | {count}{ours} |", words[0], words[1], words[2]);
    }
    text
}

fn table(plans: &[Plan], scenarios: &[Scenario]) -> String {
    let mut text = String::from(
        "\n## All variants\n\nAngles in degrees.\n*Smallest transmission angle*: over the grid, of the dyad with the slider (scheme 4: of the only dyad), and of \
link 3 and rocker 4.\n\n",
    );
    for (letter, formula) in formulas(scenarios) {
        let _ = writeln!(text, "- structure {letter}: `{formula}`");
    }
    text += "\n| variant | scheme | structure | crank angles that can be reached | grid | engine step | given pose | smallest transmission angle |\n";
    text += "|---|---|---|---|---|---|---|---|\n";
    let known = formulas(scenarios);
    for (plan, scenario) in plans.iter().zip(scenarios) {
        let v = &plan.linkage.variant;
        let formula = scenario.case.structure.formula(&scenario.case.mechanism);
        let letter = known.iter().find(|(_, other)| *other == formula).map_or(' ', |(letter, _)| *letter);
        let range = plan.limits.map_or("all".into(), |[from, to]| format!("{from:.6} to {to:.6}"));
        let least = if v.rocker.is_some() {
            format!("{:.2}, {:.2}", plan.least[0], plan.least[1])
        } else {
            format!("{:.2}", plan.least[1])
        };
        let _ = writeln!(
            text,
            "| {} | {} | {letter} | {range} | {} to {} | {} | {:.2} | {least} |",
            v.number,
            v.scheme,
            plan.grid[0],
            plan.grid[1],
            super::file::number(plan.engine_step),
            plan.given
        );
    }
    text
}

fn formulas(scenarios: &[Scenario]) -> Vec<(char, String)> {
    let mut all: Vec<String> = scenarios.iter().map(|s| s.case.structure.formula(&s.case.mechanism)).collect();
    all.sort();
    all.dedup();
    all.reverse();
    ('A'..).zip(all).collect()
}
