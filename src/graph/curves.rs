//! The numbers of curves.

use super::ask::{Chart, Over, Shown};
use super::curve::{Curve, Panel, curve, input_axis, time_axis};
use super::names::{CurveName, common};
use super::source::Source;
use super::{marks, under_motor};
use crate::sentences;
use drawing::plot::PlotAxis;
use formula::Rounded;
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::KeepNan;
use linkage::math::statistics::ascending;
use linkage::trajectory::Trajectory;
use prover::check::KnownTrajectory;
use prover::run::solved::known_at_least;
use scenario::Claim;

/// Values of a claim with the size of their rounding errors.
type Values = (Vec<f64>, f64);

/// The results of one solver or engine, in the order of time.
struct Read<'a> {
    course: &'a KnownTrajectory<'a>,
    order: Vec<usize>,
}

impl Read<'_> {
    fn sorted(&self, values: &[f64]) -> Vec<f64> {
        self.order.iter().map(|&row| values[row]).collect()
    }

    fn values(&self, claim: &Claim) -> Result<Values> {
        let found = self.course.values(claim)?;
        let noise = found.iter().map(|own| own.error).filter(|error| error.is_finite()).fold(0.0, f64::larger);
        // A curve has a gap where its quantity is undefined.
        let number = |own: &Rounded| if own.error.is_finite() { own.value } else { f64::NAN };
        Ok((self.sorted(&found.iter().map(number).collect::<Vec<_>>()), noise))
    }
}

/// Calls `then` with the results of a solver or engine.
fn reading<T>(source: &Source, trajectory: &Trajectory, then: impl FnOnce(&Read) -> Result<T>) -> Result<T> {
    let (least, exact) = (known_at_least(trajectory), |_: usize, _: usize| 0.0);
    let course = KnownTrajectory::new(&source.case, trajectory, &exact);
    let course = course.known_at_least(&least);
    then(&Read { course: &course, order: ascending(trajectory.times()) })
}

/// The panels of the requested chart with the index `chart`; a run-up has two panels. `notes` receives remarks.
pub(super) fn panels(source: &Source, chart: usize, difference: bool, notes: &mut Vec<String>) -> Result<Vec<Panel>> {
    let mut panels = match &source.question.charts[chart] {
        Chart::RunUp => under_motor::run_up(source, notes)?,
        Chart::Delta => vec![under_motor::delta(source)?],
        Chart::Hodograph(vectors) => vec![hodograph(source, vectors, difference)?],
        Chart::Curves(shown) => vec![over(source, shown, difference)?],
    };
    for curve in panels.iter_mut().flat_map(|panel| &mut panel.curves) {
        curve.file = Some(source.scenario.name.clone());
    }
    Ok(panels)
}

/// The chart of curves over the requested horizontal axis.
fn over(source: &Source, shown: &[Shown], difference: bool) -> Result<Panel> {
    let (axis, x_key) = match &source.question.over {
        Over::Time => time_axis(),
        Over::Input => input_axis(source.case.crank().input),
        Over::Value(claim) => {
            let name = CurveName::of(claim);
            let degrees = claim.unit() == "deg";
            (PlotAxis { name: name.full(), unit: name.unit, degrees, rounded: false }, claim.text.clone())
        }
    };
    let mut all: Vec<Vec<Curve>> = Vec::new();
    for (party, trajectory) in &source.parties {
        all.push(reading(source, trajectory, |read| {
            let x = match &source.question.over {
                Over::Time => read.sorted(trajectory.times()),
                Over::Input => {
                    let input = trajectory.input();
                    read.sorted(trajectory.inputs()).into_iter().map(|value| input.shown(value)).collect()
                }
                Over::Value(claim) => read.values(claim)?.0,
            };
            let mut curves = Vec::new();
            for own in shown {
                curves.extend(curves_of(source, read, own, &x_key, &x)?);
            }
            if source.parties.len() > 1 {
                curves.iter_mut().for_each(|curve| curve.who = joined(&curve.who, party));
            }
            Ok(curves)
        })?);
    }
    Ok(Panel { x: axis, curves: together(source, all, difference), equal: false })
}

fn joined(who: &str, party: &str) -> String {
    if who.is_empty() { party.into() } else { format!("{who}, {party}") }
}

/// The curves of all solvers and engines, or the difference: the second result minus the first result.
fn together(source: &Source, all: Vec<Vec<Curve>>, difference: bool) -> Vec<Curve> {
    let count = all.first().map_or(0, Vec::len);
    let mut parties: Vec<_> = all.into_iter().map(Vec::into_iter).collect();
    let mut curves = Vec::new();
    for _ in 0..count {
        let own: Vec<Curve> = parties.iter_mut().filter_map(Iterator::next).collect();
        match own.as_slice() {
            [first, second] if difference => {
                // Angles that differ by whole turns are equal.
                let whole = |off: f64| first.turn.map_or(0.0, |turn| turn * (off / turn).round());
                let y = first.y.iter().zip(&second.y).map(|(a, b)| (b - a) - whole(b - a)).collect();
                let who = sentences::minus(&source.parties[1].0, &source.parties[0].0);
                let noise = first.noise + second.noise;
                curves.push(Curve { y, who, noise, marks: Vec::new(), ..first.clone() });
            }
            _ => curves.extend(own),
        }
    }
    curves
}

/// The curve of an expression, or the curves of a formula and of the quantity that it claims.
fn curves_of(source: &Source, read: &Read, shown: &Shown, x_key: &str, x: &[f64]) -> Result<Vec<Curve>> {
    let of_claim = |claim: &Claim| -> Result<Curve> {
        let (y, noise) = read.values(claim)?;
        let own = curve(CurveName::of(claim), [x_key, &claim.text], [x.to_vec(), y], noise);
        Ok(Curve { turn: claim.turn(), ..own })
    };
    let index = match shown {
        Shown::Claim(claim) => return Ok(vec![of_claim(claim)?]),
        Shown::Formula(index) => *index,
    };
    let formulas = &source.scenario.formulas;
    let formula = &formulas.list[index];
    let claimed = formula.claim.as_ref().map(of_claim).transpose()?;
    let given: Vec<f64> =
        read.course.formula(formulas, formula).into_iter().map(|value| value.unwrap_or(f64::NAN)).collect();
    let mut y = read.sorted(&given);
    // Angles that differ by whole turns are equal, so whole turns are added to the formula's angle until it is nearest
    // to the claimed angle.
    if let (Some(turn), Some(claimed)) = (formula.claim.as_ref().and_then(Claim::turn), &claimed) {
        y.iter_mut().zip(&claimed.y).for_each(|(own, right)| *own -= turn * ((*own - right) / turn).round());
    }
    let name = claimed.as_ref().map(|own| own.name.clone());
    let name = name.unwrap_or_else(|| CurveName { subject: formula.name.clone(), ..CurveName::default() });
    let noise = claimed.as_ref().map_or(0.0, |own| own.noise);
    let who = if claimed.is_some() { sentences::formula(&formula.name) } else { String::new() };
    let own = Curve { who, ..curve(name, [x_key, &formula.name], [x.to_vec(), y], noise) };
    let beside = claimed.map(|claimed| Curve { who: sentences::MECHANISM.into(), ..claimed });
    Ok(beside.into_iter().chain([own]).collect())
}

/// The chart with the hodographs of vectors.
fn hodograph(source: &Source, vectors: &[[Claim; 2]], difference: bool) -> Result<Panel> {
    let names: Vec<[CurveName; 2]> = vectors.iter().map(|both| both.each_ref().map(CurveName::of)).collect();
    let mut all = Vec::new();
    for (party, trajectory) in &source.parties {
        all.push(reading(source, trajectory, |read| {
            let inputs = read.sorted(trajectory.inputs());
            let most = marks::MOST[usize::from(vectors.len() * source.parties.len() > 1)];
            let labels = marks::labelled(trajectory.input(), &inputs, most);
            let one = |(both, [_, name]): (&[Claim; 2], &[CurveName; 2])| -> Result<Curve> {
                let [x, y] = both.each_ref().map(|claim| read.values(claim));
                let ((x, across), (y, noise)) = (x?, y?);
                let marks = labels.iter().map(|(row, text)| ([x[*row], y[*row]], text.clone())).collect();
                let own = curve(name.clone(), [&both[0].text, &both[1].text], [x, y], noise.larger(across));
                let who = if source.parties.len() > 1 { (*party).into() } else { String::new() };
                Ok(Curve { who, marks, ..own })
            };
            vectors.iter().zip(&names).map(one).collect()
        })?);
    }
    let common = common(names.iter().map(|[x, _]| x));
    let x = PlotAxis { name: common.axis, unit: common.unit, ..PlotAxis::default() };
    if difference {
        return Err(Error::new(ErrorKind::Input, sentences::A_DIFFERENCE_HAS_NO_HODOGRAPH)
            .help(sentences::DRAW_BOTH_OR_THE_COMPONENTS));
    }
    Ok(Panel { x, curves: together(source, all, false), equal: true })
}
