use approx::assert_relative_eq;
use exmex::{Differentiate, Express};
use proptest::prelude::*;

use crate::{Function, Graph, Operator, Program, Rounded, Shape, Tree};

/// The value of a formula in x and y, with its error.
fn at(text: &str, x: Rounded, y: Rounded) -> Rounded {
    let mut graph = Graph::new(&["x", "y"], 0);
    let id = graph.add(&Tree::parse(text).unwrap_or_else(|fault| panic!("{text}: {fault}"))).unwrap();
    Program::of(&graph, &[id]).run(&[x, y])[0]
}

fn value(text: &str) -> f64 {
    at(text, Rounded::exact(0.3), Rounded::exact(-1.7)).value
}

#[test]
fn formulas_are_read_as_they_are_written_down() {
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
fn what_cannot_be_read_is_told_with_its_place_and_the_way_out() {
    let cases = [
        ("2x", 1..2, "2*phi"),
        ("x y", 2..3, "2*phi"),
        ("sin x", 0..3, "sin(phi)"),
        ("arctan2(y, x)", 0..7, "atan2"),
        ("0,5*x", 1..2, "decimal point"),
        ("(x + y", 0..1, "`)`"),
        ("x + y)", 5..6, "open it"),
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
        let fault = Tree::parse(text).expect_err(text);
        assert_eq!(fault.at, place, "{text}: {fault}");
        assert!(fault.help.contains(way_out), "{text}: {} / {}", fault.message, fault.help);
    }
    let deep = ["(", "-", "2^", "sin("].map(|part| part.repeat(5000));
    for text in deep.iter().chain([&"x+".repeat(50_000)]) {
        assert!(Tree::parse(text).is_err());
    }
    let fault = Graph::new(&["phi"], 0).add(&Tree::parse("2*(fi + 1)").unwrap()).unwrap_err();
    assert_eq!((fault.at, fault.help.contains("phi")), (3..5, true));
}

/// Long sums are no nesting.
#[test]
fn a_long_sum_is_read() {
    assert_relative_eq!(value(&vec!["x"; 5000].join(" + ")), 1500.0, max_relative = 1e-12);
}

fn tree() -> impl Strategy<Value = Tree> {
    let leaf = prop_oneof![
        (1u32..40).prop_map(|number| Shape::Number(f64::from(number) / 8.0)),
        Just(Shape::Name("x".into())),
        Just(Shape::Name("y".into())),
    ];
    let whole = |shape| Tree { shape, at: 0..0 };
    leaf.prop_map(whole).prop_recursive(5, 40, 2, move |inner| {
        use Operator::{Minus, Over, Plus, Power, Times};
        let operator = prop_oneof![Just(Plus), Just(Minus), Just(Times), Just(Over)];
        let function = (0..Function::ALL.len() - 1).prop_map(|index| Function::ALL[index]);
        prop_oneof![
            (operator, inner.clone(), inner.clone())
                .prop_map(|(operator, a, b)| Shape::Pair(operator, Box::new([a, b]))),
            (inner.clone(), 2u32..4).prop_map(move |(base, power)| {
                Shape::Pair(Power, Box::new([base, whole(Shape::Number(f64::from(power)))]))
            }),
            (function, inner.clone(), inner.clone()).prop_map(|(function, a, b)| match function.arity() {
                1 => Shape::Call(function, vec![a]),
                _ => Shape::Call(function, vec![a, b]),
            }),
            inner.prop_map(|part| Shape::Negative(Box::new(part))),
        ]
        .prop_map(whole)
    })
}

fn shape_of(tree: &Tree) -> Tree {
    let mut bare = tree.clone();
    bare.at = 0..0;
    for part in bare.parts_mut() {
        *part = shape_of(part);
    }
    bare
}

fn graph_of(tree: &Tree) -> (Graph, crate::Id) {
    let mut graph = Graph::new(&["x", "y"], 0);
    let id = graph.add(tree).unwrap();
    (graph, id)
}

/// Written for exmex, in parentheses everywhere: what binds closer is not its business here.
fn in_parentheses(tree: &Tree) -> String {
    match &tree.shape {
        Shape::Number(number) => format!("{number}"),
        Shape::Name(name) => name.clone(),
        Shape::Negative(part) => format!("(0-({}))", in_parentheses(part)),
        Shape::Pair(operator, parts) => {
            format!("(({}){}({}))", in_parentheses(&parts[0]), operator.sign(), in_parentheses(&parts[1]))
        }
        Shape::Call(function, parts) => format!("{}({})", function.name(), in_parentheses(&parts[0])),
    }
}

fn holds(tree: &Tree, test: &dyn Fn(&Shape) -> bool) -> bool {
    test(&tree.shape) || tree.parts().iter().any(|part| holds(part, test))
}

proptest! {
    /// What is written is read back.
    #[test]
    fn a_tree_is_read_as_it_is_written(tree in tree()) {
        let text = tree.to_string();
        prop_assert_eq!(shape_of(&Tree::parse(&text).unwrap()), shape_of(&tree), "{}", text);
    }

    /// Any text is read or refused, with a place inside it.
    #[test]
    fn any_text_has_an_answer(text in "[-+*/^(),.0-9a-z φ²=]{0,60}") {
        if let Err(fault) = Tree::parse(&text) {
            prop_assert!(fault.at.start <= fault.at.end && fault.at.end <= text.len(), "{:?}", fault);
            prop_assert!(text.is_char_boundary(fault.at.start) && text.is_char_boundary(fault.at.end));
        }
    }

    /// Derivatives are those of somebody else's rules.
    #[test]
    fn derivatives_are_those_of_exmex(tree in tree(), x in 0.1f64..2.0, y in -2.0f64..2.0) {
        // exmex has none of atan2 and abs.
        let unknown = |shape: &Shape| matches!(shape, Shape::Call(Function::Atan2 | Function::Abs, _));
        prop_assume!(!holds(&tree, &unknown));
        let (mut graph, id) = graph_of(&tree);
        let first = graph.derivative(id, 0);
        let mixed = graph.derivative(first, 1);
        let mut program = Program::of(&graph, &[first, mixed]);
        let ours = program.run(&[Rounded::exact(x), Rounded::exact(y)]).to_vec();
        // Both names are in it, so that exmex counts them alike.
        let text = format!("{}+0*x+0*y", in_parentheses(&tree));
        let theirs = exmex::parse::<f64>(&text).unwrap().partial(0).unwrap();
        let theirs = [theirs.eval(&[x, y]).unwrap(), theirs.partial(1).unwrap().eval(&[x, y]).unwrap()];
        for (ours, theirs) in ours.into_iter().zip(theirs) {
            prop_assume!(theirs.is_finite() && ours.error < 1e-6 * (1.0 + ours.value.abs()));
            let bound = (ours.error + 1e-12 * ours.value.abs()) * 1e3 + 1e-9;
            prop_assert!((ours.value - theirs).abs() <= bound, "{}: {:?} {}", tree, ours, theirs);
        }
    }

    /// The bound holds what inputs anywhere within theirs give.
    #[test]
    fn errors_of_inputs_are_within_the_bound(
        tree in tree(), x in 0.1f64..2.0, y in -2.0f64..2.0, error in 1e-9f64..0.1, share in proptest::array::uniform2(-1.0f64..1.0),
    ) {
        let (graph, id) = graph_of(&tree);
        let mut program = Program::of(&graph, &[id]);
        let known = program.run(&[Rounded { value: x, error }, Rounded { value: y, error }])[0];
        let other = program.run(&[Rounded::exact(x + share[0] * error), Rounded::exact(y + share[1] * error)])[0];
        prop_assume!(known.value.is_finite() && known.error.is_finite() && other.value.is_finite());
        // The branch cut of atan2 is a jump by a turn; angles are compared modulo a turn.
        prop_assume!(!holds(&tree, &|shape| matches!(shape, Shape::Call(Function::Atan2, _))));
        prop_assert!((known.value - other.value).abs() <= known.error + other.error, "{}: {:?} {:?}", tree, known, other);
    }
}

/// Digits that cancel are gone, and the bound says so.
#[test]
fn cancellation_is_told() {
    let x = Rounded::exact(1e-9);
    let lost = at("(1 - cos(x))/x^2", x, x);
    assert!((lost.value - 0.5).abs() <= lost.error && lost.error > 1e-3, "{lost:?}");
    let kept = at("2*sin(x/2)^2/x^2", x, x);
    assert!((kept.value - 0.5).abs() <= kept.error && kept.error < 1e-14, "{kept:?}");
    // At the end of a domain the derivative has no bound, the value has.
    let end = at("acos(x)", Rounded { value: 1.0 + 1e-16, error: 1e-15 }, x);
    assert!(end.value == 0.0 && end.error > 4e-8 && end.error < 1e-7, "{end:?}");
    assert!(at("1/x", Rounded { value: 1e-20, error: 1e-15 }, x).error.is_infinite());
    assert!(at("sqrt(x)", Rounded { value: -1.0, error: 1e-15 }, x).value.is_nan());
}

/// What two formulas share is evaluated once.
#[test]
fn common_parts_are_evaluated_once() {
    let mut graph = Graph::new(&["x"], 0);
    let one = graph.add(&Tree::parse("sin(x)^2 + cos(x)").unwrap()).unwrap();
    let alone = Program::of(&graph, &[one]).len();
    let other = graph.add(&Tree::parse("sin(x)^2 - cos(x)").unwrap()).unwrap();
    assert_eq!(Program::of(&graph, &[one, other]).len(), alone + 1);
}

/// The rate of x(phi(t), t), twice: w and a are the first and second derivative of phi.
#[test]
fn rates_go_through_all_inputs() {
    let mut graph = Graph::new(&["phi", "t"], 2);
    let place = graph.add(&Tree::parse("t*sin(phi)").unwrap()).unwrap();
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
fn what_was_added_meanwhile_is_forgotten() {
    let mut graph = Graph::new(&["x"], 0);
    let place = graph.add(&Tree::parse("x^2").unwrap()).unwrap();
    graph.name("place", place);
    let tried = graph.meanwhile(|graph| {
        let other = graph.add(&Tree::parse("x^2 + sin(x)").unwrap()).unwrap();
        graph.name("place", other);
        graph.derivative(other, 0);
        Program::of(graph, &[other]).run(&[Rounded::exact(2.0)])[0].value
    });
    assert_relative_eq!(tried, 4.0 + 2f64.sin());
    let again = graph.add(&Tree::parse("place + sin(x)").unwrap()).unwrap();
    let speed = graph.derivative(again, 0);
    let found = Program::of(&graph, &[again, speed]).run(&[Rounded::exact(2.0)]).to_vec();
    assert_relative_eq!(found[0].value, 4.0 + 2f64.sin());
    assert_relative_eq!(found[1].value, 4.0 + 2f64.cos());
}

#[test]
fn a_name_with_other_signs_stands_between_backquotes() {
    let tree = Tree::parse("2*`body 2.x (m)` - a").unwrap();
    assert_eq!(tree.names().iter().map(|(name, _)| *name).collect::<Vec<_>>(), ["body 2.x (m)", "a"]);
    assert_eq!(tree.to_string(), "2*`body 2.x (m)` - a");
    for open in ["`body", "2*`", "``"] {
        assert!(Tree::parse(open).unwrap_err().help.starts_with("close it"), "{open}");
    }
}

/// The place of a node may be taken by another one afterwards: what was known of the first is no derivative of it.
#[test]
fn derivatives_taken_meanwhile_are_forgotten() {
    let mut graph = Graph::new(&["x", "y"], 0);
    graph.constant(Rounded::exact(0.0));
    graph.meanwhile(|graph| {
        let other = graph.add(&Tree::parse("sin(y)").unwrap()).unwrap();
        graph.derivative(other, 0);
    });
    let own = graph.add(&Tree::parse("sin(x)").unwrap()).unwrap();
    let slope = graph.derivative(own, 0);
    assert_eq!(Program::of(&graph, &[slope]).run(&[Rounded::exact(0.0)])[0].value, 1.0);
}
