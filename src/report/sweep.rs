//! Results of sweeps: text, and a page with parallel coordinates and the best cases.

use crate::sentences;
use std::fmt::Write;
use std::path::Path;

use super::html::{escaped, filled};
use crate::plain::cells::{counted, fitted, trimmed};
use prover::numbers::{significant, with_unit};
use sweep::{FigureSpread, Goal, Shard, SweepPlan, SweepRow, SweepSummary, SweepTally};

/// Significant digits of numbers for people.
const DIGITS: usize = 5;
/// Number of reasons of refusals that are shown.
const REASONS: usize = 5;

fn shown(value: f64) -> String {
    if value.is_nan() { "-".into() } else { significant(value, DIGITS) }
}

/// The result of one shard, in words.
pub(crate) fn of_shard(tally: &SweepTally, shard: Shard, directory: &Path) -> String {
    let done = tally.solved + tally.refused;
    sentences::a_shard_is_stored(
        &shard.number,
        &shard.count,
        &directory.display(),
        &counted(done as usize, "new case"),
        &tally.refused,
        &counted(tally.stored as usize, "case"),
    ) + "\n"
}

/// Smallest, largest, mean and standard deviation of a figure.
fn cells(spread: Option<FigureSpread>) -> [String; 4] {
    spread.map_or([f64::NAN; 4], |own| [own.least.0, own.most.0, own.mean, own.deviation]).map(shown)
}

/// The heading of the best cases.
fn heading(plan: &SweepPlan, goal: Goal) -> String {
    let end = if goal.is_largest { sentences::LARGEST } else { sentences::SMALLEST };
    sentences::best_cases(&end, &plan.figures[goal.figure].text)
}

/// The summary for people. `next` is the command that proves the best case.
pub(crate) fn text(
    plan: &SweepPlan,
    summary: &SweepSummary,
    goal: Goal,
    table: &Path,
    next: &str,
    width: Option<usize>,
) -> String {
    let (cases, solved) = (counted(summary.cases as usize, "case"), summary.cases - summary.refused);
    let mut out = sentences::cases_are_in(&table.display(), &cases, &solved) + "\n";
    if summary.refused > 0 {
        out += &(sentences::cases_refused(&summary.refused) + "\n");
        let mut reasons: Vec<&(String, u64)> = summary.reasons.values().collect();
        reasons.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
        for (reason, count) in reasons.iter().take(REASONS) {
            let _ = writeln!(out, "  {count}  {reason}");
        }
        if reasons.len() > REASONS {
            let _ = writeln!(
                out,
                "  {}",
                sentences::and_further_reasons(&counted(reasons.len() - REASONS, "further reason"))
            );
        }
    }
    for (verdict, count) in &summary.verdicts {
        out += &(sentences::proofs_end_in(&counted(*count as usize, "proof"), verdict) + "\n");
    }
    let mut spreads = fitted("figure|unit|smallest>|largest>|mean>|standard deviation>", width);
    for ((figure, unit), spread) in plan.figures.iter().zip(&plan.units).zip(&summary.figures) {
        spreads.add_row([figure.text.clone(), unit.clone()].into_iter().chain(cells(*spread)));
    }
    let _ = write!(out, "\n{}", trimmed(&spreads));
    if !summary.best.is_empty() {
        let figure = &plan.figures[goal.figure].text;
        let _ = write!(out, "\n\n{}\n", heading(plan, goal));
        let axes = plan.design.axes().iter().map(|axis| format!("|{}>", axis.key));
        let mut best = fitted(&format!("case>{}|{figure}>", axes.collect::<String>()), width);
        for row in &summary.best {
            let numbers = row.values.iter().chain([&row.figures[goal.figure]]).map(|value| shown(*value));
            best.add_row(std::iter::once(row.case.to_string()).chain(numbers));
        }
        let _ = write!(out, "{}", trimmed(&best));
        let _ = writeln!(out, "\n{next}");
    }
    out
}

/// Width of a letter, and smallest distance of a name from the edge of the picture (px).
const LETTER: f64 = 7.0;
const EDGE: f64 = 3.0;
/// Width and height of the parallel coordinates (px), and their margins.
const SIZE: [f64; 2] = [1100.0, 420.0];
const MARGIN: [f64; 2] = [70.0, 60.0];

/// The page: parallel coordinates of a sample, drawings of the best cases, and the spread of every figure.
/// `drawings` are these drawings as SVG.
pub(crate) fn page(plan: &SweepPlan, summary: &SweepSummary, goal: Goal, title: &str, drawings: &[String]) -> String {
    let mut best = String::new();
    for (row, drawing) in summary.best.iter().zip(drawings) {
        let lines = named(plan, row).map(|(name, value)| format!("<dt>{name}</dt><dd>{value}</dd>"));
        let _ = write!(
            best,
            "<figure>{drawing}<figcaption>{}<dl>{}</dl></figcaption></figure>",
            escaped(&sentences::case_number(&row.case)),
            lines.collect::<String>()
        );
    }
    let spread = plan.figures.iter().zip(&plan.units).zip(&summary.figures).map(|((figure, unit), spread)| {
        let cells: String = cells(*spread).iter().map(|cell| format!("<td>{cell}</td>")).collect();
        format!("<tr><th>{}</th><td>{}</td>{cells}</tr>", escaped(&figure.text), escaped(unit))
    });
    let solved = summary.cases - summary.refused;
    let mut count = sentences::cases_of_which_solved(&counted(summary.cases as usize, "case"), &solved);
    let lines = lines(summary);
    if lines.len() as u64 != solved {
        count += &sentences::the_lines_show(&lines.len());
    }
    let slots = [
        ("title", escaped(title)),
        ("count", escaped(&count)),
        ("axes", escaped(&plan.design.axes().iter().map(ToString::to_string).collect::<Vec<_>>().join(", "))),
        ("lines", parallel(plan, &lines, goal)),
        ("spread", spread.collect()),
        ("heading", escaped(&heading(plan, goal))),
        ("best", best),
    ];
    filled(include_str!("sweep/page.html"), &slots.each_ref().map(|(name, text)| (*name, text.as_str())))
}

/// Name of every column, and its value in a row with the unit, escaped for HTML.
fn named<'a>(plan: &'a SweepPlan, row: &'a SweepRow) -> impl Iterator<Item = (String, String)> + 'a {
    let values = row.values.iter().chain(&row.figures);
    plan.columns().zip(values).map(|((name, unit), value)| (escaped(name), escaped(&with_unit(&shown(*value), unit))))
}

/// The cases that have a line in the parallel coordinates: the sample, and the best cases that are not in it.
fn lines(summary: &SweepSummary) -> Vec<&SweepRow> {
    let further = summary.best.iter().filter(|own| !summary.sample.iter().any(|row| row.case == own.case));
    summary.sample.iter().chain(further).collect()
}

/// Parallel coordinates: a vertical axis for each varied number and each figure, a line for each case.
/// The colours follow the figure of the goal: the best case is blue, the worst case yellow.
fn parallel(plan: &SweepPlan, cases: &[&SweepRow], goal: Goal) -> String {
    let names: Vec<&str> = plan.columns().map(|(name, _)| name).collect();
    let of = |row: &SweepRow| row.values.iter().chain(&row.figures).copied().collect::<Vec<f64>>();
    let rows: Vec<Vec<f64>> = cases.iter().map(|row| of(row)).collect();
    let ends: Vec<[f64; 2]> = (0..names.len())
        .map(|column| {
            let finite = rows.iter().map(|row| row[column]).filter(|value| value.is_finite());
            finite.fold([f64::INFINITY, f64::NEG_INFINITY], |[from, to], value| {
                [if value < from { value } else { from }, if value > to { value } else { to }]
            })
        })
        .collect();
    let share = |column: usize, value: f64| {
        let [from, to] = ends[column];
        if to > from { (value - from) / (to - from) } else { 0.5 }
    };
    let x = |column: usize| MARGIN[0] + (SIZE[0] - 2.0 * MARGIN[0]) * column as f64 / (names.len().max(2) - 1) as f64;
    let y = |share: f64| SIZE[1] - MARGIN[1] - (SIZE[1] - 2.0 * MARGIN[1]) * share;
    let goal_column = plan.design.axes().len() + goal.figure;
    let mut out = format!("<svg viewBox='0 0 {} {}' role='img'>", SIZE[0], SIZE[1]);
    let mut order: Vec<usize> = (0..rows.len()).collect();
    let worse = |row: usize| {
        let share = share(goal_column, rows[row][goal_column]);
        if goal.is_largest { 1.0 - share } else { share }
    };
    // The best cases are drawn last, above the others.
    order.sort_by(|a, b| worse(*b).total_cmp(&worse(*a)));
    for row in order {
        let points = rows[row].iter().enumerate().filter(|(_, value)| value.is_finite());
        let points: Vec<String> =
            points.map(|(column, value)| format!("{:.1},{:.1}", x(column), y(share(column, *value)))).collect();
        let hue = 220.0 - 170.0 * if worse(row).is_nan() { 1.0 } else { worse(row) };
        let _ = write!(
            out,
            "<polyline points='{}' style='stroke:hsl({hue:.0} 75% 45%)'><title>{}</title></polyline>",
            points.join(" "),
            escaped(&sentences::case_number(&cases[row].case))
        );
    }
    for (column, name) in names.iter().enumerate() {
        let (at, [from, to]) = (x(column), ends[column]);
        let _ = write!(out, "<line x1='{at:.1}' x2='{at:.1}' y1='{:.1}' y2='{:.1}'/>", y(0.0), y(1.0));
        let up = if column % 2 == 0 { 24.0 } else { 40.0 };
        // A long name at the first or last axis begins or ends at the edge of the picture.
        let half = 0.5 * LETTER * name.chars().count() as f64;
        let (name_at, anchor) = match (at - half < 0.0, at + half > SIZE[0]) {
            (true, _) => (EDGE, " style='text-anchor:start'"),
            (false, true) => (SIZE[0] - EDGE, " style='text-anchor:end'"),
            (false, false) => (at, ""),
        };
        let _ = write!(out, "<text x='{name_at:.1}' y='{up:.1}'{anchor}>{}</text>", escaped(name));
        for (text, height) in [(shown(to), MARGIN[1] - 6.0), (shown(from), SIZE[1] - MARGIN[1] + 16.0)] {
            let _ = write!(out, "<text x='{at:.1}' y='{height:.1}'>{}</text>", escaped(&text));
        }
    }
    out + "</svg>"
}
