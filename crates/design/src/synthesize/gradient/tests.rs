//! Tests of the constraints' derivatives against difference quotients, and of searches whose solutions are known.

use super::rows::Row;
use super::*;
use crate::synthesize::search::share_of;
use crate::synthesize::task::{
    LimitedQuantity, OutputQuantity, Phase, PointPosition, PrecisionPoint, PrecisionPoints, Refinement, SearchEffort,
    Sense, TaskNumber, Timing, Variable, WantedClearance,
};
use crate::synthesize::{reached, search};
use linkage::case::Case;
use linkage::math::Vec2;
use linkage::mechanism::{AssemblyMode, LinkId};
use scenario::Claim;
use scenario::clearance::{ClearanceBody, ClearanceQuestion, Outline};

/// A crank-rocker with a coupler point. Only the coupler has mass.
fn case() -> Case {
    Case::builder()
        .ground(&[("O", [0.0, 0.0]), ("C", [0.4, 0.05])])
        .link("crank", &[("O", [0.0, 0.0]), ("A", [0.1, 0.0])])
        .link("coupler", &[("A", [0.0, 0.0]), ("B", [0.35, 0.0]), ("P", [0.2, 0.15])])
        .link("rocker", &[("C", [0.0, 0.0]), ("B", [0.25, 0.0])])
        .mass("coupler", 2.0, [0.175, 0.05], 0.02)
        .pin("O", "ground", "crank")
        .pin("A", "crank", "coupler")
        .pin("B", "coupler", "rocker")
        .pin("C", "ground", "rocker")
        .crank("O", 10.0)
        .mode(&["coupler", "rocker"], AssemblyMode::Left)
        .build()
        .unwrap()
}

/// Variables: the coupler's point P, the crank's length, the rocker's length and pivot, and the crank's direction at
/// crank angle zero.
fn task(points: Vec<PrecisionPoint>, phases: Vec<Phase>) -> Task {
    let case = case();
    let mechanism = &case.mechanism;
    let mut variables = Vec::new();
    let mut free = |name: &str, from: f64, to: f64| {
        variables.push(Variable { name: name.into(), bounds: [from, to], is_angle: name == "zero" });
        TaskNumber::Free(variables.len() - 1)
    };
    let place = |link: usize, point: usize, from: Option<usize>, entries: [TaskNumber; 2]| PointPosition {
        handle: mechanism.handle(LinkId(link), point).unwrap(),
        from,
        entries,
    };
    let places = vec![
        place(1, 1, Some(0), [free("crank", 0.06, 0.12), TaskNumber::Fixed(0.0)]),
        place(2, 2, None, [free("P x", 0.1, 0.3), free("P y", 0.05, 0.25)]),
        place(3, 1, Some(0), [free("rocker", 0.2, 0.3), TaskNumber::Fixed(0.0)]),
        place(0, 1, None, [free("C x", 0.35, 0.45), free("C y", 0.0, 0.1)]),
    ];
    let zero = free("zero", -0.5, 0.5);
    let keep = |text: &str, bounds| LimitedQuantity { claim: Claim::parse(text, &case).unwrap(), bounds };
    Task {
        name: "found".into(),
        title: "Found".into(),
        keep: vec![keep("joint.B.f_N", [0.0, 2000.0]), keep("point.P.x_mm - 3", [-900.0, f64::INFINITY])],
        clearance: None,
        mass: f64::INFINITY,
        starts: Vec::new(),
        places,
        zero,
        variables,
        output: OutputQuantity::Angle { link: LinkId(2), point: Some(2) },
        forward: None,
        timing: if phases.is_empty() { Timing::without_phases() } else { Timing::of(phases).unwrap() },
        points: PrecisionPoints::of(points, case.mechanism.size()),
        stroke: [0.0, f64::INFINITY],
        transmission: 0.2,
        acceleration: 200.0,
        effort: SearchEffort {
            seed: 1,
            candidates: 400,
            refined: 4,
            evaluations: 200,
            refinement: Refinement::Gradients,
        },
        bar: Some(3.0),
        case,
    }
}

/// Three precision points: two at free crank angles, and one at a given crank angle.
fn two_points() -> Vec<PrecisionPoint> {
    let place = |x: f64, y: f64| Some(Vec2::new(x, y));
    vec![
        PrecisionPoint { turn: None, place: place(0.2, 0.2), angle: Some(0.4) },
        PrecisionPoint { turn: Some(1.0), place: place(0.25, 0.25), angle: None },
        PrecisionPoint { turn: None, place: place(0.15, 0.3), angle: None },
    ]
}

/// Bars along all links, and a housing below the crank.
fn outlines(case: &Case) -> ClearanceQuestion {
    let body =
        |name: &str, link: usize, outline: Outline| ClearanceBody { name: name.into(), link: LinkId(link), outline };
    let of_points = |link: usize| {
        let points: Vec<Vec2> = case.mechanism.links()[LinkId(link)].points.iter().map(|point| point.local).collect();
        Outline::of_points(&points, 0.01).unwrap()
    };
    let wall = [Vec2::new(-0.2, -0.2), Vec2::new(0.5, -0.25), Vec2::new(0.1, -0.3)];
    let bodies = vec![
        body("crank", 1, of_points(1)),
        body("coupler", 2, of_points(2)),
        body("rocker", 3, of_points(3)),
        body("wall", 0, Outline::polygon(&wall, 0.0).unwrap()),
    ];
    ClearanceQuestion { bodies, pairs: vec![[0, 2], [0, 3], [1, 3]], wanted: None, tolerance: None, area: 5e-3 }
}

fn phases() -> Vec<Phase> {
    let phase = |from: f64, to: f64, sense| Phase {
        from: from.to_radians(),
        to: to.to_radians(),
        sense,
        level: None,
        least: 0.1,
    };
    vec![phase(0.0, 120.0, Sense::Forward), phase(120.0, 180.0, Sense::Dwell), phase(180.0, 360.0, Sense::Back)]
}

#[test]
fn derivatives_equal_differences() {
    let mut task = task(two_points(), phases());
    task.mass = 2.0;
    task.clearance = Some(WantedClearance { question: outlines(&task.case), wanted: 0.02 });
    let frame = Rater::fitted(&task.timing, 0.2);
    let wishes = Wishes::of(&task, 1.0, &frame);
    let mut rows = Rows::new(&task, frame.turns.clone()).unwrap();
    let shares = [0.45, 0.52, 0.47, 0.6, 0.4, 0.55, 0.58];
    let turns = [0.3, 1.0, 2.2];
    let first = rows.at(&shares, &turns, Order::Values).unwrap();
    let point = wishes.start(&first, &shares, &turns);
    let mut at = |point: &[f64], order: Order| {
        let found = rows.at(wishes.shares(point), &wishes.turns(point), order).unwrap();
        wishes.constraints(&found, point)
    };
    let exact = at(&point, Order::Slopes);
    let step = 1e-5;
    let mut largest: f64 = 0.0;
    for unknown in 0..point.len() {
        let mut side = |sign: f64| {
            let mut moved = point.clone();
            moved[unknown] += sign * step;
            at(&moved, Order::Values)
        };
        let (ahead, back) = (side(1.0), side(-1.0));
        for ((exact, ahead), back) in exact.iter().zip(&ahead).zip(&back) {
            let difference = (ahead.value - back.value) / (2.0 * step);
            // The error of the difference quotient is of the order of step^2, plus the rounding error divided by the
            // step.
            largest = largest.larger((exact.slopes[unknown] - difference).abs() / (1.0 + difference.abs()));
        }
    }
    assert!(exact.len() > 250 && largest < 1e-7, "{} constraints, {largest:.1e}", exact.len());
}

#[test]
fn a_known_path_is_found() {
    // The precision points lie on the path of P in the unchanged mechanism, whose dimensions are within the bounds.
    let mut task = task(Vec::new(), Vec::new());
    task.keep.clear();
    task.bar = None;
    let known = Task { places: Vec::new(), ..task.clone() };
    let points =
        [0.4, 1.1, 2.0, 3.1, 4.4, 5.5].map(|turn| PrecisionPoint { turn: Some(turn), place: None, angle: None });
    let on_path = Task { points: PrecisionPoints::of(points.to_vec(), 1.0), ..known };
    let wanted = reached::reached(&on_path).unwrap();
    let points = wanted.iter().map(|own| PrecisionPoint { turn: None, place: Some(own.place), angle: None });
    task.points = PrecisionPoints::of(points.collect(), 1.0);
    let found = search(&task, 2, &mut |_| {}).unwrap();
    assert!(found.cost < 1e-7, "{found:?}");
    assert!(found.random_cost > 1e-3 && found.poses[1] > 0);
}

/// The largest value of a quantity over one turn, in rows half a degree apart.
fn largest(task: &Task, values: &[f64], of: impl Fn(&Row) -> f64) -> f64 {
    let mut rows = Rows::new(task, Rater::even(&task.timing, 720).turns.clone()).unwrap();
    let shares: Vec<f64> = values.iter().zip(&task.variables).map(|(value, own)| share_of(*value, own)).collect();
    rows.at(&shares, &[], Order::Values).unwrap().rows.iter().map(of).fold(f64::NEG_INFINITY, f64::larger)
}

#[test]
fn limits_are_kept() {
    let mut task = task(Vec::new(), phases());
    task.keep.truncate(1);
    // The required clearance is negative and sets no limit, but the distances are computed.
    task.clearance = Some(WantedClearance { question: outlines(&task.case), wanted: -1.0 });
    let free = search(&task, 2, &mut |_| {}).unwrap();
    let force = |values: &[f64]| largest(&task, values, |row| row.kept[0].value);
    let gap =
        |values: &[f64]| -largest(&task, values, |row| -row.gaps.iter().map(|own| own.value).fold(1.0, f64::smaller));
    let (most, least) = (force(&free.values), gap(&free.values));
    let limited = |task: Task| search(&task, 2, &mut |_| {}).unwrap();
    let quieter = limited(Task {
        keep: vec![LimitedQuantity { bounds: [0.0, 0.9 * most], ..task.keep[0].clone() }],
        ..task.clone()
    });
    // The programme keeps the limits at its rows, which are 3 degrees apart. Between the rows, a quantity may exceed
    // its limit a little.
    assert!(force(&quieter.values) < 0.902 * most && quieter.cost > free.cost, "{most} {}", force(&quieter.values));
    let wanted = least + 0.01;
    let wider =
        limited(Task { clearance: Some(WantedClearance { question: outlines(&task.case), wanted }), ..task.clone() });
    assert!(gap(&wider.values) > wanted - 1e-4 && wider.cost >= free.cost, "{least} {}", gap(&wider.values));
}

#[test]
fn masses_of_bars_follow_the_dimensions() {
    let task = task(Vec::new(), phases());
    let shares = [0.5; 7];
    let numbers = dimensions::Dimensions::<7>::of(&task, &shares, 0);
    let mass = numbers.number_of(linkage::case::CaseNumber::Mass(LinkId(1)));
    // The crank is a bar of 3 kg/m and 0.09 m long. The bounds of its length are 0.06 m apart.
    assert!((mass.value - 3.0 * 0.09).abs() < 1e-15 && (mass.slopes[0] - 3.0 * 0.06).abs() < 1e-15);
    let inertia = numbers.number_of(linkage::case::CaseNumber::Inertia(LinkId(1)));
    assert!((inertia.value - 3.0 * 0.09f64.powi(3) / 12.0).abs() < 1e-15);
}
