use approx::assert_relative_eq;
use proptest::prelude::*;

use crate::{FormulaGraph, FormulaTree, Function, NodeShape, Operator, Program, Rounded};

/// The value of a formula in x and y, with its error.
fn at(text: &str, x: Rounded, y: Rounded) -> Rounded {
    let mut graph = FormulaGraph::new(&["x", "y"], 0);
    let id = graph.add(&FormulaTree::parse(text).unwrap_or_else(|fault| panic!("{text}: {fault}"))).unwrap();
    Program::of(&graph, &[id]).run(&[x, y])[0]
}

fn value(text: &str) -> f64 {
    at(text, Rounded::exact(0.3), Rounded::exact(-1.7)).value
}

/// If both arguments of atan2 may be zero, the angle may have any value.
#[test]
fn atan2_of_two_possible_zeros_is_known_to_half_a_turn() {
    let near = Rounded { value: 1e-12, error: 1e-9 };
    assert!(at("atan2(x, y)", near, near).error >= std::f64::consts::PI);
    // The direction is known if the vector is away from zero.
    assert!(at("atan2(x, y)", Rounded { value: 1.0, error: 1e-9 }, near).error < 2e-9);
}

#[test]
fn formulas_parse_with_the_usual_precedence() {
    let (x, y) = (0.3f64, -1.7f64);
    let cases = [
        ("-x^2", -(x * x)),
        ("2^3^2", 512.0),
        ("2^-2", 0.25),
        ("-2^2", -4.0),
        ("(-2)^2", 4.0),
        ("2*-3^2", -18.0),
        ("1 - 2 - 3", -4.0),
        ("8/4/2", 1.0),
        ("8/(4/2)", 4.0),
        ("2 - 3 + 4", 3.0),
        ("1e-3 + 2.5E2", 250.001),
        (".5*x", 0.5 * x),
        ("- - x", x),
        ("-sin(x)^2", -(x.sin().powi(2))),
        ("atan2(y, x)", y.atan2(x)),
        ("x**2", x * x),
        ("-x*y", -x * y),
        ("pi/2", std::f64::consts::FRAC_PI_2),
        ("abs(y) + exp(x) + ln(x) + sqrt(x)", y.abs() + x.exp() + x.ln() + x.sqrt()),
        ("( x + ( y ) )", x + y),
        ("asin(x) + acos(x) + atan(x) + tan(x)", x.asin() + x.acos() + x.atan() + x.tan()),
    ];
    for (text, wanted) in cases {
        assert_relative_eq!(value(text), wanted, max_relative = 1e-15);
    }
}

#[test]
fn syntax_errors_are_reported_with_position_and_remedy() {
    let cases = [
        ("2x", 1..2, "2*phi"),
        ("x y", 2..3, "2*phi"),
        ("sin x", 0..3, "sin(phi)"),
        ("arctan2(y, x)", 0..7, "atan2"),
        ("0,5*x", 1..2, "decimal point"),
        ("(x + y", 0..1, "`)`"),
        ("x + y)", 5..6, "add `(`"),
        ("x +", 3..3, "number"),
        ("x * / y", 4..5, "number"),
        ("s = x", 2..3, "right side"),
        ("atan2(y)", 0..5, "atan2(y, x)"),
        ("sin(x, y)", 5..6, "decimal point"),
        ("φ + 1", 0..2, "phi"),
        ("x·y", 1..3, "`*`"),
        ("x²", 1..3, "x^2"),
        ("log(x)", 0..3, "ln"),
        ("", 0..0, "number"),
        ("sin()", 4..5, "number"),
        ("1e999", 0..5, "1.5e-3"),
    ];
    for (text, place, way_out) in cases {
        let fault = FormulaTree::parse(text).expect_err(text);
        assert_eq!(fault.at, place, "{text}: {fault}");
        assert!(fault.help.contains(way_out), "{text}: {} / {}", fault.message, fault.help);
    }
    let deep = ["(", "-", "2^", "sin("].map(|part| part.repeat(5000));
    for text in deep.iter().chain([&"x+".repeat(50_000)]) {
        assert!(FormulaTree::parse(text).is_err());
    }
    let fault = FormulaGraph::new(&["phi"], 0).add(&FormulaTree::parse("2*(fi + 1)").unwrap()).unwrap_err();
    assert_eq!((fault.at, fault.help.contains("phi")), (3..5, true));
}

/// A long sum does not count as deep nesting.
#[test]
fn a_long_sum_parses() {
    assert_relative_eq!(value(&vec!["x"; 9999].join("+")), 2999.7, max_relative = 1e-12);
}

fn tree() -> impl Strategy<Value = FormulaTree> {
    let leaf = prop_oneof![
        (1u32..40).prop_map(|number| NodeShape::Number(f64::from(number) / 8.0)),
        Just(NodeShape::Name("x".into())),
        Just(NodeShape::Name("y".into())),
    ];
    let whole = |shape| FormulaTree { shape, at: 0..0 };
    leaf.prop_map(whole).prop_recursive(5, 40, 2, move |inner| {
        use Operator::{Minus, Over, Plus, Power, Times};
        let operator = prop_oneof![Just(Plus), Just(Minus), Just(Times), Just(Over)];
        let function = (0..Function::ALL.len()).prop_map(|index| Function::ALL[index]);
        prop_oneof![
            (operator, inner.clone(), inner.clone())
                .prop_map(|(operator, a, b)| NodeShape::Pair(operator, Box::new([a, b]))),
            (inner.clone(), 0u32..5).prop_map(move |(base, power)| {
                let power = FormulaTree::number(f64::from(power));
                NodeShape::Pair(Power, Box::new([base, power]))
            }),
            // Every power of a positive base is defined.
            (inner.clone(), inner.clone()).prop_map(move |(base, power)| {
                NodeShape::Pair(Power, Box::new([FormulaTree::call(Function::Exp, vec![base]), power]))
            }),
            (function, inner.clone(), inner.clone()).prop_map(|(function, a, b)| match function.arity() {
                1 => NodeShape::Call(function, vec![a]),
                _ => NodeShape::Call(function, vec![a, b]),
            }),
            inner.prop_map(|part| NodeShape::Negative(Box::new(part))),
        ]
        .prop_map(whole)
    })
}

fn shape_of(tree: &FormulaTree) -> FormulaTree {
    let mut bare = tree.clone();
    bare.at = 0..0;
    for part in bare.parts_mut() {
        *part = shape_of(part);
    }
    bare
}

fn graph_of(tree: &FormulaTree) -> (FormulaGraph, crate::NodeId) {
    let mut graph = FormulaGraph::new(&["x", "y"], 0);
    let id = graph.add(tree).unwrap();
    (graph, id)
}

/// A formula, its derivative with respect to x, and its mixed derivative with respect to x and y.
fn with_derivatives(tree: &FormulaTree, x: f64, y: f64) -> [Rounded; 3] {
    let (mut graph, id) = graph_of(tree);
    let first = graph.derivative(id, 0);
    let mixed = graph.derivative(first, 1);
    let mut program = Program::of(&graph, &[id, first, mixed]);
    let found = program.run(&[Rounded::exact(x), Rounded::exact(y)]);
    [found[0], found[1], found[2]]
}

/// The limit of central differences by Ridders' extrapolation, with the error of the limit.
/// `None` if the limit is not accurate to five digits. This happens near a kink, a pole, or the end of a domain.
fn limit_of_differences(function: &dyn Fn(f64) -> Rounded) -> Option<(f64, f64)> {
    let (mut before, mut best) = (Vec::<f64>::new(), None::<(f64, f64)>);
    for level in 0..9 {
        let step = 0.02 * 0.6f64.powi(level);
        let [above, below] = [function(step), function(-step)];
        // The arguments x + step are rounded too.
        // The rounding error of an argument changes the value by slope times rounding error.
        let slope = (above.value - below.value).abs() / (2.0 * step);
        let rounding = (above.error + below.error + 4.0 * f64::EPSILON * (1.0 + slope)) / (2.0 * step);
        let mut row = vec![(above.value - below.value) / (2.0 * step)];
        for (order, old) in before.iter().enumerate() {
            let factor = 0.6f64.powi(-2 * (order as i32 + 1));
            let new = (factor * row[order] - old) / (factor - 1.0);
            let error = 10.0 * ((new - row[order]).abs() + (new - old).abs()) + 100.0 * rounding;
            row.push(new);
            if error.is_finite() && best.is_none_or(|(_, least)| error < least) {
                best = Some((new, error));
            }
        }
        before = row;
    }
    best.filter(|(limit, error)| *error < 1e-5 * (1.0 + limit.abs()))
}

fn holds(tree: &FormulaTree, test: &dyn Fn(&NodeShape) -> bool) -> bool {
    test(&tree.shape) || tree.parts().iter().any(|part| holds(part, test))
}

proptest! {
    /// A tree that was written as text is parsed back unchanged.
    #[test]
    fn a_printed_tree_parses_to_itself(tree in tree()) {
        let text = tree.to_string();
        prop_assert_eq!(shape_of(&FormulaTree::parse(&text).unwrap()), shape_of(&tree), "{}", text);
    }

    /// Any text is either parsed or rejected. A rejection has a position inside the text.
    #[test]
    fn any_text_parses_or_is_rejected_with_a_position(text in "[-+*/^(),.0-9a-z φ²=]{0,60}") {
        if let Err(fault) = FormulaTree::parse(&text) {
            prop_assert!(fault.at.start <= fault.at.end && fault.at.end <= text.len(), "{:?}", fault);
            prop_assert!(text.is_char_boundary(fault.at.start) && text.is_char_boundary(fault.at.end));
        }
    }

    /// Derivatives are the limits of differences, for every operator and every function.
    #[test]
    fn derivatives_are_limits_of_differences(tree in tree(), x in 0.1f64..2.0, y in -2.0f64..2.0) {
        let at = |x: f64, y: f64| with_derivatives(&tree, x, y);
        let [_, first, mixed] = at(x, y);
        for (ours, of) in [(first, 0), (mixed, 1)] {
            let function = |step: f64| if of == 0 { at(x + step, y)[0] } else { at(x, y + step)[1] };
            let Some((limit, error)) = limit_of_differences(&function) else { continue };
            prop_assume!(ours.error < 1e-6 * (1.0 + ours.value.abs()));
            prop_assert!((ours.value - limit).abs() <= error + ours.error, "{}: {:?} {} {}", tree, ours, limit, error);
        }
    }

    /// The error bound covers the results for all inputs within their error bounds.
    #[test]
    fn the_bound_covers_input_errors(
        tree in tree(), x in 0.1f64..2.0, y in -2.0f64..2.0, error in 1e-9f64..0.1, share in proptest::array::uniform2(-1.0f64..1.0),
    ) {
        let (graph, id) = graph_of(&tree);
        let mut program = Program::of(&graph, &[id]);
        let known = program.run(&[Rounded { value: x, error }, Rounded { value: y, error }])[0];
        let other = program.run(&[Rounded::exact(x + share[0] * error), Rounded::exact(y + share[1] * error)])[0];
        prop_assume!(known.value.is_finite() && known.error.is_finite() && other.value.is_finite());
        // atan2 jumps by a turn at its branch cut, so it is excluded here. Users of an angle compare it modulo a turn.
        prop_assume!(!holds(&tree, &|shape| matches!(shape, NodeShape::Call(Function::Atan2, _))));
        prop_assert!((known.value - other.value).abs() <= known.error + other.error, "{}: {:?} {:?}", tree, known, other);
    }
}

/// The digits that cancel are lost, and the error bound covers the loss.
#[test]
fn cancellation_widens_the_bound() {
    let x = Rounded::exact(1e-9);
    let lost = at("(1 - cos(x))/x^2", x, x);
    assert!((lost.value - 0.5).abs() <= lost.error && lost.error > 1e-3, "{lost:?}");
    let kept = at("2*sin(x/2)^2/x^2", x, x);
    assert!((kept.value - 0.5).abs() <= kept.error && kept.error < 1e-14, "{kept:?}");
    // At the end of a domain the derivative is unbounded, but the value has a bound.
    let end = at("acos(x)", Rounded { value: 1.0 + 1e-16, error: 1e-15 }, x);
    assert!(end.value == 0.0 && end.error > 4e-8 && end.error < 1e-7, "{end:?}");
    assert!(at("1/x", Rounded { value: 1e-20, error: 1e-15 }, x).error.is_infinite());
    assert!(at("sqrt(x)", Rounded { value: -1.0, error: 1e-15 }, x).value.is_nan());
}

/// For large errors of the arguments, the bound covers the values at both ends of each argument's interval, whatever
/// the curvature.
#[test]
fn a_bound_covers_the_ends_of_wide_arguments() {
    type Case = (&'static str, [f64; 2], [f64; 2], fn(f64, f64) -> f64);
    let wide: [Case; 8] = [
        ("ln(x)", [1.0, 0.5], [0.0, 0.0], |x, _| x.ln()),
        ("sqrt(x)", [1.0, 0.9], [0.0, 0.0], |x, _| x.sqrt()),
        ("exp(x)", [1.0, 2.0], [0.0, 0.0], |x, _| x.exp()),
        ("x*y", [1.0, 0.5], [1.0, 0.5], |x, y| x * y),
        ("x/y", [1.0, 0.5], [1.0, 0.5], |x, y| x / y),
        ("x - y", [1.0, 0.5], [3.0, 0.5], |x, y| x - y),
        ("x^(-2)", [2.0, 1.0], [0.0, 0.0], |x, _| x.powi(-2)),
        ("x^y", [2.0, 0.5], [0.5, 0.25], f64::powf),
    ];
    for (text, [x, dx], [y, dy], f) in wide {
        let bound = at(text, Rounded { value: x, error: dx }, Rounded { value: y, error: dy }).error;
        for (x_end, y_end) in [(x - dx, y - dy), (x - dx, y + dy), (x + dx, y - dy), (x + dx, y + dy)] {
            let change = (f(x_end, y_end) - f(x, y)).abs();
            assert!(change <= bound * (1.0 + 1e-12), "{text}: {change} beyond {bound}");
        }
    }
}

/// A power with any exponent is accurate to a few units in the last place.
/// An error of the argument is multiplied by the slope.
#[test]
fn a_power_is_as_accurate_as_its_base_and_exponent() {
    let known = |x: Rounded, y: Rounded| at("x^y", x, y);
    let exact = Rounded::exact;
    for (x, y) in [(2.0, 0.5), (1.0001, 2000.0), (0.3, -1.7), (-1.001, 1025.0)] {
        let found = known(exact(x), exact(y));
        assert!(found.error <= 1e-14 * found.value.abs(), "{x} {y}: {found:?}");
    }
    for (x, y) in [(2.0, 0.5), (-1.001, 1025.0)] {
        let found = known(Rounded { value: x, error: 1e-6 }, exact(y));
        assert_relative_eq!(found.error, (found.value * y / x).abs() * 1e-6, max_relative = 2e-3);
    }
}

/// A common subexpression of two formulas is evaluated once.
#[test]
fn common_parts_are_evaluated_once() {
    let mut graph = FormulaGraph::new(&["x"], 0);
    let one = graph.add(&FormulaTree::parse("sin(x)^2 + cos(x)").unwrap()).unwrap();
    let alone = Program::of(&graph, &[one]).len();
    let other = graph.add(&FormulaTree::parse("sin(x)^2 - cos(x)").unwrap()).unwrap();
    assert_eq!(Program::of(&graph, &[one, other]).len(), alone + 1);
}

/// The second derivative of x(phi(t), t) with respect to t. The inputs w and a are the first and the second derivative
/// of phi.
#[test]
fn rates_follow_the_chain_rule_over_all_inputs() {
    let mut graph = FormulaGraph::new(&["phi", "t"], 2);
    let place = graph.add(&FormulaTree::parse("t*sin(phi)").unwrap()).unwrap();
    let (w, a) = (graph.input(2), graph.input(3));
    let one = graph.constant(Rounded::exact(1.0));
    let rates = [Some(w), Some(one), Some(a), None];
    let speed = graph.rate(place, &rates);
    let acceleration = graph.rate(speed, &rates);
    let (phi, t, w, a) = (0.7f64, 1.3, 2.0, -5.0);
    let mut program = Program::of(&graph, &[speed, acceleration]);
    let found = program.run(&[phi, t, w, a].map(Rounded::exact));
    assert_relative_eq!(found[0].value, phi.sin() + t * phi.cos() * w, max_relative = 1e-14);
    let wanted = 2.0 * phi.cos() * w - t * phi.sin() * w * w + t * phi.cos() * a;
    assert_relative_eq!(found[1].value, wanted, max_relative = 1e-14);
}

#[test]
fn temporary_nodes_are_removed() {
    let mut graph = FormulaGraph::new(&["x"], 0);
    let place = graph.add(&FormulaTree::parse("x^2").unwrap()).unwrap();
    graph.name("place", place);
    let tried = graph.meanwhile(|graph| {
        let other = graph.add(&FormulaTree::parse("x^2 + sin(x)").unwrap()).unwrap();
        graph.name("place", other);
        graph.derivative(other, 0);
        Program::of(graph, &[other]).run(&[Rounded::exact(2.0)])[0].value
    });
    assert_relative_eq!(tried, 4.0 + 2f64.sin());
    let again = graph.add(&FormulaTree::parse("place + sin(x)").unwrap()).unwrap();
    let speed = graph.derivative(again, 0);
    let found = Program::of(&graph, &[again, speed]).run(&[Rounded::exact(2.0)]).to_vec();
    assert_relative_eq!(found[0].value, 4.0 + 2f64.sin());
    assert_relative_eq!(found[1].value, 4.0 + 2f64.cos());
}

#[test]
fn names_with_other_characters_need_backquotes() {
    let tree = FormulaTree::parse("2*`body 2.x (m)` - a").unwrap();
    assert_eq!(tree.names().iter().map(|(name, _)| *name).collect::<Vec<_>>(), ["body 2.x (m)", "a"]);
    assert_eq!(tree.to_string(), "2*`body 2.x (m)` - a");
    for open in ["`body", "2*`", "``"] {
        assert!(FormulaTree::parse(open).unwrap_err().help.starts_with("close the backquote"), "{open}");
    }
}

/// A new node may later have the position of a removed node. Derivatives of the removed node must not apply to the new
/// node.
#[test]
fn temporary_derivatives_are_removed() {
    let mut graph = FormulaGraph::new(&["x", "y"], 0);
    graph.constant(Rounded::exact(0.0));
    graph.meanwhile(|graph| {
        let other = graph.add(&FormulaTree::parse("sin(y)").unwrap()).unwrap();
        graph.derivative(other, 0);
    });
    let own = graph.add(&FormulaTree::parse("sin(x)").unwrap()).unwrap();
    let slope = graph.derivative(own, 0);
    assert_eq!(Program::of(&graph, &[slope]).run(&[Rounded::exact(0.0)])[0].value, 1.0);
}

/// The derivatives of every operator and function agree with the rules of calculus, while both arguments vary.
/// This test skips no case. The test with random formulas skips cases that it cannot decide.
#[test]
fn derivatives_follow_the_rules_of_calculus() {
    let (x, y) = (0.7f64, 1.3f64);
    let cases: [(&str, f64, f64); 23] = [
        ("x + y", 1.0, 0.0),
        ("x - y*x", 1.0 - y, -1.0),
        ("x*y", y, 1.0),
        ("x/y", 1.0 / y, -1.0 / (y * y)),
        ("y/x", -y / (x * x), -1.0 / (x * x)),
        ("x^y", y * x.powf(y - 1.0), x.powf(y - 1.0) * (1.0 + y * x.ln())),
        ("y^x", y.powf(x) * y.ln(), y.powf(x - 1.0) * (x * y.ln() + 1.0)),
        ("x^x", x.powf(x) * (x.ln() + 1.0), 0.0),
        ("x^2.5", 2.5 * x.powf(1.5), 0.0),
        ("x^-2", -2.0 * x.powi(-3), 0.0),
        ("-x", -1.0, 0.0),
        ("sin(x*y)", y * (x * y).cos(), (x * y).cos() - x * y * (x * y).sin()),
        ("cos(x*y)", -y * (x * y).sin(), -(x * y).sin() - x * y * (x * y).cos()),
        ("tan(x)", 1.0 + x.tan().powi(2), 0.0),
        ("asin(x)", 1.0 / (1.0 - x * x).sqrt(), 0.0),
        ("acos(x)", -1.0 / (1.0 - x * x).sqrt(), 0.0),
        ("atan(x*y)", y / (1.0 + x * x * y * y), (1.0 - x * x * y * y) / (1.0 + x * x * y * y).powi(2)),
        ("atan2(x, y)", y / (x * x + y * y), (x * x - y * y) / (x * x + y * y).powi(2)),
        ("sqrt(x*y)", 0.5 * (y / x).sqrt(), 0.25 / (x * y).sqrt()),
        ("exp(x*y)", y * (x * y).exp(), (1.0 + x * y) * (x * y).exp()),
        ("ln(x*y)", 1.0 / x, 0.0),
        ("abs(x*y - 2)", -y, -1.0),
        ("x*sign(y - x)", 1.0, 0.0),
    ];
    for (text, first, mixed) in cases {
        let found = with_derivatives(&FormulaTree::parse(text).unwrap(), x, y);
        for (found, wanted) in found[1..].iter().zip([first, mixed]) {
            assert!((found.value - wanted).abs() <= 1e-14 * (1.0 + wanted.abs()), "{text}: {found:?} {wanted}");
        }
    }
    for name in Function::ALL.map(Function::name) {
        assert!(cases.iter().any(|(text, ..)| text.contains(&format!("{name}("))), "{name}");
    }
}

/// A function has no derivative at a kink or a jump.
/// At a kink, the two one-sided slopes differ. A derivative from the mean of the two slopes would be wrong.
#[test]
fn a_kink_has_no_derivative() {
    for text in ["abs(x)", "x*sign(x)", "abs(x)*abs(x)"] {
        let [value, slope, _] = with_derivatives(&FormulaTree::parse(text).unwrap(), 0.0, 1.0);
        assert_eq!((value.value, slope.is_undefined()), (0.0, true), "{text}");
    }
    // An undefined number has no derivative, although the number is constant.
    assert!(with_derivatives(&FormulaTree::parse("1/0").unwrap(), 0.5, 1.0).iter().all(|own| own.is_undefined()));
    let slope = with_derivatives(&FormulaTree::parse("abs(x)").unwrap(), -0.5, 1.0)[1];
    assert!(slope.value == -1.0 && slope.error < 1e-15, "{slope:?}");
}

/// Every operation outside its domain is reported, also if algebra (`0*ln(-1)`) or IEEE 754 (`1^ln(-1)`) would hide it.
#[test]
fn undefined_values_stay_undefined_in_every_context() {
    // Each pair is an operation on constants, and the same operation with x, where x = 1.
    let outside = [
        ("ln(-1)", "ln(-x)"),
        ("ln(0)", "ln(x - 1)"),
        ("sqrt(-1)", "sqrt(-x)"),
        ("asin(2)", "asin(2*x)"),
        ("asin(-2)", "asin(x - 3)"),
        ("acos(1.5)", "acos(x + 0.5)"),
        ("acos(-1.5)", "acos(-1.5*x)"),
        ("atan2(0, 0)", "atan2(x - x, 1 - x)"),
        ("1/0", "x/(1 - x)"),
        ("0/0", "(x - 1)/(x - x)"),
        ("0^-1", "(x - 1)^-1"),
        ("0^-0.5", "(x - 1)^(-x/2)"),
        ("(-2)^0.5", "(-2*x)^0.5"),
        ("(-8)^(1/3)", "(-8)^(x/3)"),
        ("ln(-1) - ln(-1)", "ln(-x) - ln(-x)"),
        ("1/(1/0)", "1/(1/(x - x))"),
    ];
    let contexts = [
        "@",
        "1 + 0*@",
        "0*@",
        "@*0",
        "0/@",
        "@^0",
        "1^@",
        "-@",
        "exp(-@)",
        "exp(@)",
        "atan(@)",
        "1/@",
        "1/@^2",
        "sign(@)",
        "abs(@)",
        "atan2(1, @)",
        "atan2(@, 1)",
        "sqrt(@^2)",
        "sin(@)",
        "cos(@)",
        "tan(@)",
        "@ - @",
        "@/@",
        "@*1",
        "@ + 0",
        "0^@",
        "ln(@)",
        "asin(@)",
        "acos(@)",
    ];
    for (operation, varied) in outside {
        for context in contexts {
            // With constants the formula is rejected at once, and the error has the position of the operation.
            let text = context.replace('@', &format!("({operation})"));
            let fault = FormulaGraph::new(&["x"], 0).add_defined(&FormulaTree::parse(&text).unwrap()).expect_err(&text);
            let first = context.find('@').unwrap();
            assert!(fault.at.start >= first && fault.at.end <= first + operation.len() + 2, "{text}: {fault:?}");
            // With inputs the formula has no value, and the error names the operation.
            let varied = context.replace('@', &format!("({varied})"));
            let tree = FormulaTree::parse(&varied).unwrap_or_else(|fault| panic!("{varied}: {fault}"));
            let mut graph = FormulaGraph::new(&["x"], 0);
            let id = graph.add(&tree).unwrap();
            let one = Rounded::exact(1.0);
            assert!(Program::of(&graph, &[id]).run(&[one])[0].is_undefined(), "{varied}");
            assert!(tree.evaluated(&|_| one).is_err(), "{varied}");
        }
    }
}

/// A result too large for a double is unknown, not undefined. A result too small for a double is known to be tiny.
#[test]
fn overflow_and_underflow_are_not_undefined() {
    let one = Rounded::exact(1.0);
    for text in ["exp(1000*x)", "1e300^(2*x)", "(1e200*x)*1e200", "x/(1e-200*1e-200)", "1/(sin(pi) - x + x)"] {
        let found = at(text, one, one);
        assert!(found.value.is_finite() && found.error.is_infinite(), "{text}: {found:?}");
    }
    for text in ["exp(-1000*x)", "(1e-200*x)*1e-200", "1/(1/exp(-1000*x))", "ln(exp(-1000*x))", "1/(1 + exp(1000*x))"] {
        let found = at(text, one, one);
        assert!(!found.is_undefined() && found.error > 0.0, "{text}: {found:?}");
    }
    // If an argument is outside a domain by less than its error, the argument is moved to the end of the domain.
    let near = |value: f64| Rounded { value, error: 1e-15 };
    for (text, value) in [("sqrt(x)", -1e-16), ("acos(x)", 1.0 + 4e-16), ("x^0.5", -1e-16)] {
        let found = at(text, near(value), one);
        assert!(found.value == 0.0 && found.error > 0.0 && found.error < 1e-6, "{text}: {found:?}");
        assert!(at(text, Rounded::exact(value), one).is_undefined(), "{text}");
    }
}
