use formula::{FormulaTree, Function, NodeShape, Operator, Program, Rounded};
use linkage::math::KeepNan;
use prover::check::{FormulaCause, SlipKind};
use scenario::{Formula, Scenario};

use super::{files, is_wrong, judged, load, rewritten};
use crate::common::draws;
use crate::common::sketch::RandomSource;

/// A random slip in a part of a formula, with a description.
/// `None` if the part does not allow the chosen kind of slip.
fn spoiled(part: &FormulaTree, names: &[String], random: &mut RandomSource) -> Option<(&'static str, NodeShape)> {
    use Operator::{Minus, Plus, Power};
    let call = |function: Function, parts: &[FormulaTree]| NodeShape::Call(function, parts.to_vec());
    let whole = |shape: NodeShape| FormulaTree { shape, at: 0..0 };
    let number = |value: f64| whole(NodeShape::Number(value));
    Some(match &part.shape {
        NodeShape::Pair(Plus, parts) => ("sign", NodeShape::Pair(Minus, parts.clone())),
        NodeShape::Pair(Minus, parts) => ("sign", NodeShape::Pair(Plus, parts.clone())),
        NodeShape::Pair(Power, parts) => ("square", parts[0].shape.clone()),
        NodeShape::Negative(inner) => ("sign", inner.shape.clone()),
        NodeShape::Call(Function::Sin, parts) if random.index(2) == 0 => ("function", call(Function::Cos, parts)),
        NodeShape::Call(Function::Cos, parts) if random.index(2) == 0 => ("function", call(Function::Sin, parts)),
        NodeShape::Call(function @ (Function::Sin | Function::Cos | Function::Tan), parts) => {
            let to_degrees =
                whole(NodeShape::Pair(Operator::Over, Box::new([number(180.0), whole(NodeShape::Name("pi".into()))])));
            let degrees = NodeShape::Pair(Operator::Times, Box::new([parts[0].clone(), to_degrees]));
            ("degrees", call(*function, &[whole(degrees)]))
        }
        NodeShape::Call(Function::Sqrt, _) => ("branch", NodeShape::Negative(Box::new(part.clone()))),
        NodeShape::Name(own) if names.contains(own) => {
            let other = &names[random.index(names.len())];
            ("name", NodeShape::Name(other.clone()))
        }
        NodeShape::Number(_) | NodeShape::Name(_) | NodeShape::Pair(..) | NodeShape::Call(..) => return None,
    })
}

/// Names that a diagnosis may give a planted slip.
/// For example, the slip -sqrt(x) is both a different branch and a sign error.
fn of_kind(planted: &str) -> &'static [SlipKind] {
    match planted {
        "sign" => &[SlipKind::Sign],
        "square" => &[SlipKind::Power],
        "function" => &[SlipKind::Function],
        "degrees" => &[SlipKind::Unit],
        "branch" => &[SlipKind::Sign, SlipKind::Branch],
        _ => &[SlipKind::Name, SlipKind::Exchanged],
    }
}

fn places(tree: &FormulaTree) -> Vec<Vec<usize>> {
    let inner = tree
        .parts()
        .iter()
        .enumerate()
        .flat_map(|(index, part)| places(part).into_iter().map(move |place| [vec![index], place].concat()));
    [Vec::new()].into_iter().chain(inner).collect()
}

fn at<'a>(tree: &'a mut FormulaTree, place: &[usize]) -> &'a mut FormulaTree {
    place.iter().fold(tree, |tree, &index| &mut tree.parts_mut()[index])
}

/// Largest change of a formula's value over the grid, divided by the largest value of the formula.
/// The result is infinite if the changed formula is undefined anywhere.
fn change(right: &Scenario, wrong: &Scenario, name: &str) -> f64 {
    let grid = &right.case.grid;
    let values = |scenario: &Scenario| -> Vec<f64> {
        let formula = scenario.formulas.list.iter().find(|own| own.name == name).unwrap();
        let mut program = Program::of(&scenario.formulas.graph, &[formula.id]);
        let rows = (0..grid.len()).filter(|&row| formula.holds_at(grid.inputs[row]));
        rows.map(|row| program.run(&[grid.inputs[row], grid.times[row], 0.0, 0.0].map(Rounded::exact))[0].value)
            .collect()
    };
    let (right, wrong) = (values(right), values(wrong));
    let scale = right.iter().fold(0.0f64, |largest, value| largest.larger(value.abs()));
    let differences = right.iter().zip(&wrong).map(|(right, wrong)| (right - wrong).abs());
    let largest = differences.fold(0.0, |largest, own| if own <= largest { largest } else { own });
    if largest.is_nan() { f64::INFINITY } else { largest / scale }
}

/// Plants mistakes in exact formulas of the library.
/// Asserts that every mistake that changes a value is found.
/// Returns the number of all mistakes, and the number of correctly named mistakes.
fn planted(seed: u64, count: usize) -> (usize, usize) {
    let scenarios: Vec<Scenario> = files().iter().map(|path| load(path)).filter(|own| !own.case.is_free()).collect();
    let mut random = RandomSource::of_sample(seed, 0);
    let (mut all, mut named) = (0, 0);
    while all < count {
        let scenario = &scenarios[random.index(scenarios.len())];
        let exact: Vec<&Formula> =
            scenario.formulas.claims().map(|(formula, _)| formula).filter(|own| own.error.is_none()).collect();
        if exact.is_empty() {
            continue;
        }
        let formula = exact[random.index(exact.len())];
        let names: Vec<String> =
            scenario.formulas.parameters.iter().map(|own| own.short().unwrap_or(&own.key).to_string()).collect();
        let mut tree = formula.tree.clone();
        let places = places(&tree);
        let place = &places[random.index(places.len())];
        let part = at(&mut tree, place);
        let Some((kind, shape)) = spoiled(part, &names, &mut random) else { continue };
        part.shape = shape;
        let text = tree.to_string();
        let wrong = rewritten(scenario, &formula.name, &text);
        // A slip that does not change the formula's values is not a mistake.
        if !(change(scenario, &wrong, &formula.name) > 1e-9) {
            continue;
        }
        let found = judged(&wrong);
        let (name, file) = (&formula.name, &scenario.name);
        assert!(is_wrong(&found, name), "{file}: {name} = {text} for {}", formula.text);
        all += 1;
        // A cause is named only if its correction makes the formula right at all instants.
        // The name is correct if the cause is of the planted kind, in the formula with the mistake.
        let cause = found.judgement.causes.iter().find(|(own, _)| own == name).and_then(|(_, cause)| cause.as_ref());
        match cause {
            Some(FormulaCause::Slip(slip)) if slip.formula == *name && of_kind(kind).contains(&slip.kind) => named += 1,
            other => println!("{file}: {name} = {text} for {}: {other:?}", formula.text),
        }
    }
    (all, named)
}

#[test]
fn planted_mistakes_are_found_and_four_of_five_are_named() {
    let (all, named) = planted(1, draws(100));
    println!("{named} of {all} named");
    assert!(5 * named >= 4 * all, "{named} of {all}");
}
