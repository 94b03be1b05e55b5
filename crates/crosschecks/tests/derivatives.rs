//! Derivatives of formulas agree with those of the library exmex.

use exmex::{Differentiate, Express};
use formula::{FormulaGraph, FormulaTree, Function, Program, Rounded};
use proptest::prelude::*;
use proptest::sample::select;

/// Formulas with parentheses everywhere, because this test does not test precedence.
fn text() -> impl Strategy<Value = String> {
    let number = (1u32..40).prop_map(|number| (f64::from(number) / 8.0).to_string());
    let leaf = prop_oneof![number, Just("x".to_string()), Just("y".to_string())];
    leaf.prop_recursive(5, 40, 2, |inner| {
        // exmex does not have atan2, abs and sign.
        let is_known = |own: &Function| !matches!(own, Function::Atan2 | Function::Abs | Function::Sign);
        let known: Vec<Function> = Function::ALL.into_iter().filter(is_known).collect();
        prop_oneof![
            (select(vec!['+', '-', '*', '/']), inner.clone(), inner.clone())
                .prop_map(|(sign, a, b)| format!("({a}{sign}{b})")),
            (inner.clone(), 0u32..5).prop_map(|(base, power)| format!("({base}^{power})")),
            // Every power of a positive base is defined.
            (inner.clone(), inner.clone()).prop_map(|(base, power)| format!("(exp({base})^{power})")),
            (select(known), inner.clone()).prop_map(|(function, part)| format!("{}({part})", function.name())),
            inner.prop_map(|part| format!("(-{part})")),
        ]
    })
}

/// The formula and all its parts.
fn parts(tree: &FormulaTree) -> Vec<&FormulaTree> {
    std::iter::once(tree).chain(tree.parts().iter().flat_map(parts)).collect()
}

proptest! {
    #[test]
    fn derivatives_agree_with_exmex(text in text(), x in 0.1f64..2.0, y in -2.0f64..2.0) {
        let mut graph = FormulaGraph::new(&["x", "y"], 0);
        let tree = FormulaTree::parse(&text).unwrap();
        let mut ids: Vec<_> = parts(&tree).into_iter().map(|part| graph.add(part).unwrap()).collect();
        let first = graph.derivative(ids[0], 0);
        ids.extend([first, graph.derivative(first, 1)]);
        let found = Program::of(&graph, &ids).run(&[Rounded::exact(x), Rounded::exact(y)]).to_vec();
        let (values, ours) = found.split_at(ids.len() - 2);
        // exmex squares divisors, and loses digits if the square is a subnormal number or an infinite one.
        prop_assume!(values.iter().all(|own| own.value == 0.0 || (1e-100..1e100).contains(&own.value.abs())));
        // With both names in the text, exmex numbers the names as this graph does.
        let theirs = exmex::parse::<f64>(&format!("{text}+0*x+0*y")).unwrap().partial(0).unwrap();
        let theirs = [theirs.eval(&[x, y]).unwrap(), theirs.partial(1).unwrap().eval(&[x, y]).unwrap()];
        for (ours, theirs) in ours.iter().zip(theirs) {
            prop_assume!(theirs.is_finite() && ours.error < 1e-6 * (1.0 + ours.value.abs()));
            let bound = (ours.error + 1e-12 * ours.value.abs()) * 1e3 + 1e-9;
            prop_assert!((ours.value - theirs).abs() <= bound, "{}: {:?} {}", text, ours, theirs);
        }
    }
}
