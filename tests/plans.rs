//! Graphical methods: plans close and are images of the links, drawings hold what they say, the chord method has its known error, and the
//! published graphical figures are what they are.

use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::path::Path;

use linkproof::diagram::motion::Method;
use linkproof::diagram::{Course, MotionDiagram, Part, Plan, Plans, SingularPoint, TipKind, draw};
use linkproof::math::{Vec2, rotated, unit};
use linkproof::reference::{AssurSolver, NewtonSolver};
use linkproof::scenario::Scenario;
use linkproof::solver::Solver;

const ALL: [&str; 5] = ["crank_rocker", "ov7_base", "ov7_new", "ov7_new_tabulated", "fourth_class"];

fn scenario(name: &str) -> Scenario {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios").join(format!("{name}.toml"));
    Scenario::load(&path).unwrap_or_else(|error| panic!("{error}"))
}

fn plans_with(name: &str, solver: &dyn Solver, degrees: f64) -> Plans {
    Plans::at(&scenario(name).case, solver, degrees.to_radians()).unwrap_or_else(|error| panic!("{name}: {error}"))
}

fn plans(name: &str, degrees: f64) -> Plans {
    plans_with(name, &AssurSolver, degrees)
}

/// Crank angles all over the turn.
fn angles() -> impl Iterator<Item = f64> {
    (0..12).map(|k| 7.0 + 30.0 * f64::from(k))
}

fn longest(plan: &Plan) -> f64 {
    plan.vectors.iter().map(|vector| vector.value.norm()).fold(0.0, f64::max)
}

/// Walks from the pole along vectors to every letter; each vector not needed for that closes a contour. Returns the number of contours
/// and the largest gap.
fn contours(plan: &Plan) -> (usize, f64) {
    let pole = |letter: &str| {
        let fixed = plan.tips.iter().any(|tip| tip.letter == letter && tip.kind == TipKind::Fixed);
        if fixed { plan.quantity.pole().to_string() } else { letter.to_string() }
    };
    let mut reached: BTreeMap<String, Vec2> = BTreeMap::from([(plan.quantity.pole().to_string(), Vec2::zeros())]);
    let (mut used, mut closed, mut gap) = (vec![false; plan.vectors.len()], 0, 0.0f64);
    while let Some(next) = (0..used.len()).find(|&k| {
        !used[k]
            && (reached.contains_key(&pole(&plan.vectors[k].from)) || reached.contains_key(&pole(&plan.vectors[k].to)))
    }) {
        used[next] = true;
        let vector = &plan.vectors[next];
        let (from, to) = (pole(&vector.from), pole(&vector.to));
        match (reached.get(&from).copied(), reached.get(&to).copied()) {
            (Some(start), Some(end)) => {
                closed += 1;
                gap = gap.max((start + vector.value - end).norm());
            }
            (Some(start), None) => drop(reached.insert(to, start + vector.value)),
            (None, end) => drop(reached.insert(from, end.unwrap() - vector.value)),
        }
    }
    assert!(used.iter().all(|&used| used), "a vector hangs in the air");
    (closed, gap)
}

#[test]
fn every_contour_of_every_plan_closes() {
    for name in ALL {
        for degrees in angles() {
            for solver in [&AssurSolver as &dyn Solver, &NewtonSolver] {
                let plans = plans_with(name, solver, degrees);
                for plan in [&plans.velocity, &plans.acceleration] {
                    let (count, gap) = contours(plan);
                    // Each moving loop of links gives one at least: crank, coupler and rocker at the very least.
                    assert!(count >= 1, "{name}: nothing closes");
                    // Eleven digits of velocities and accelerations are what the solvers promise.
                    assert!(gap <= 1e-11 * longest(plan), "{name} at {degrees}: {:e}", gap / longest(plan));
                }
            }
        }
    }
}

/// Burmester and Mehmke: the image of a link is the link, turned and enlarged. Compares sides of drawn mechanism and plans, and omega and alpha
/// as listed; the vectors themselves are not asked.
#[test]
fn the_image_of_a_link_is_similar_to_it() {
    for name in ALL {
        let mechanism = scenario(name).case.mechanism;
        for degrees in angles() {
            let plans = plans(name, degrees);
            let place = |name: &str| plans.scheme.points.iter().find(|(own, _)| own == name).unwrap().1;
            let mut compared = 0;
            for link in &plans.scheme.links {
                let names: Vec<&str> =
                    mechanism.links()[link.number].points.iter().map(|point| point.name.as_str()).collect();
                for (k, a) in names.iter().enumerate() {
                    for b in &names[k + 1..] {
                        let side = place(b) - place(a);
                        let (omega, alpha) = (link.omega, link.alpha);
                        let image =
                            |plan: &Plan| plan.tip(&b.to_lowercase()).unwrap() - plan.tip(&a.to_lowercase()).unwrap();
                        let turned = rotated(unit(PI / 2.0 * omega.signum()), side) * omega.abs();
                        let size = (alpha * alpha + omega.powi(4)).sqrt();
                        let spun = rotated(unit(PI - alpha.atan2(omega * omega)), side) * size;
                        assert!(
                            (image(&plans.velocity) - turned).norm() <= 1e-11 * longest(&plans.velocity),
                            "{name} {a}{b}"
                        );
                        assert!(
                            (image(&plans.acceleration) - spun).norm() <= 1e-11 * longest(&plans.acceleration),
                            "{name} {a}{b}"
                        );
                        compared += 1;
                    }
                }
            }
            assert!(compared >= plans.scheme.links.len());
        }
    }
}

#[test]
fn parts_stand_as_their_names_say() {
    let plans = plans("fourth_class", 70.0);
    let place = |name: char| plans.scheme.points.iter().find(|(own, _)| own.starts_with(name)).unwrap().1;
    let plan = &plans.acceleration;
    let mut seen = 0;
    for vector in plan.vectors.iter().filter(|v| matches!(v.part, Part::Normal | Part::Tangential)) {
        let letters: Vec<char> = vector.name.trim_start_matches("a_").chars().collect();
        let line = place(letters[0]) - place(letters[1]);
        let share = vector.value.dot(&line) / (vector.value.norm() * line.norm());
        // Rounding of a product of unit vectors.
        let want = if vector.part == Part::Normal { -1.0 } else { 0.0 };
        assert!((share - want).abs() < 1e-12, "{}: {share}", vector.name);
        seen += 1;
    }
    assert_eq!(seen, 17);
    // a_EC = a_EC^n + a_EC^t, omega^2 l and alpha l with the published magnitudes to their printed digits.
    let size = |name: &str| plan.vector(name).unwrap().value.norm();
    assert!((size("a_EC^n") - 31.87948f64.powi(2) * 0.04).abs() < 2.0 * 31.88 * 0.04 * 0.5e-5);
    assert!((size("a_EC^t") - 48.4440 * 0.04).abs() < 0.5e-4 * 0.04);
    let sum = plan.vector("a_EC^n").unwrap().value + plan.vector("a_EC^t").unwrap().value;
    assert!((sum - plan.vector("a_EC").unwrap().value).norm() < 1e-12);
    // The crank turns uniformly: its normal part is the whole.
    assert_eq!(plan.vector("a_AO^n").unwrap().to, "a");
    assert!(plan.vector("a_AO^t").is_none());
}

#[test]
fn scale_factors_are_round_and_fill_the_paper() {
    for name in ALL {
        for degrees in angles() {
            let plans = plans(name, degrees);
            for plan in [&plans.velocity, &plans.acceleration] {
                let text = format!("{:e}", plan.scale);
                assert!(["1", "2", "2.5", "5"].contains(&text.split('e').next().unwrap()), "{text}");
                let most = plan.vectors.iter().map(|vector| plan.paper(vector)).fold(0.0, f64::max);
                assert!(most > 50.0 && most <= 100.0 + 1e-9, "{name}: {most} mm");
            }
        }
    }
}

#[test]
fn drawings_are_well_formed_and_hold_every_vector() {
    for (name, degrees) in ALL.into_iter().flat_map(|name| [0.0, 70.0, -150.0].map(|degrees| (name, degrees))) {
        let plans = plans(name, degrees);
        let text = draw::plans(&plans, name, "a < b & \"c\"");
        let document = roxmltree::Document::parse(&text).unwrap_or_else(|error| panic!("{name}: {error}"));
        let root = document.root_element();
        let size = |key: &str| root.attribute(key).unwrap().trim_end_matches("mm").parse::<f64>().unwrap();
        assert_eq!(root.attribute("viewBox").unwrap(), format!("0 0 {} {}", size("width"), size("height")));
        let titles: Vec<&str> =
            document.descendants().filter(|n| n.has_tag_name("title")).filter_map(|n| n.text()).collect();
        let words: Vec<String> = document
            .descendants()
            .filter(|node| node.has_tag_name("text"))
            .map(|node| node.descendants().filter(|n| n.is_text()).filter_map(|n| n.text()).collect::<String>())
            .map(|text| text.trim().to_string())
            .collect();
        for plan in [&plans.velocity, &plans.acceleration] {
            for vector in &plan.vectors {
                let plain = vector.name.replace(['_', '^'], "");
                assert!(words.contains(&plain), "{name}: {} is not in the table", vector.name);
                let arrow = titles.iter().find(|title| title.trim().starts_with(&format!("{} = ", vector.name)));
                assert!(arrow.is_some() || plan.paper(vector) <= 0.15, "{name}: {} is not drawn", vector.name);
            }
        }
        // Nothing is clipped: every coordinate lies on the sheet.
        for (key, most) in
            [("x", "width"), ("x1", "width"), ("x2", "width"), ("y", "height"), ("y1", "height"), ("y2", "height")]
        {
            for value in document.descendants().filter_map(|node| node.attribute(key)) {
                let value: f64 = value.parse().unwrap();
                assert!(value >= 0.0 && value <= size(most), "{name}: {key} = {value}");
            }
        }
        assert_eq!(text, draw::plans(&plans, name, "a < b & \"c\""), "same input, same bytes");
    }
}

/// Letters stand apart from each other, and none on a line: boxes as large as the letters themselves, a little less than what was kept free.
#[test]
fn letters_can_be_read() {
    let (mut letters, mut crossed) = (0, 0);
    for (name, degrees) in ALL.into_iter().flat_map(|name| angles().step_by(2).map(move |degrees| (name, degrees))) {
        let text = draw::plans(&plans(name, degrees), name, "");
        let document = roxmltree::Document::parse(&text).unwrap();
        let number = |node: &roxmltree::Node, key: &str| node.attribute(key).unwrap().parse::<f64>().unwrap();
        let italic = document.descendants().filter(|node| node.attribute("font-style") == Some("italic"));
        let boxes: Vec<(Vec2, Vec2)> = italic
            .map(|node| {
                let signs = node.descendants().filter(|n| n.is_text()).filter_map(|n| n.text()).collect::<String>();
                let wide =
                    0.5 * 4.2 * signs.trim().chars().count() as f64 * if signs.trim().len() > 1 { 0.85 } else { 1.0 };
                let middle = node.attribute("text-anchor") == Some("middle");
                let left = number(&node, "x") - if middle { wide / 2.0 } else { 0.0 };
                (Vec2::new(left + wide / 2.0, number(&node, "y") - 1.2), Vec2::new(wide / 2.0, 1.3))
            })
            .collect();
        let arrows: Vec<[Vec2; 2]> = document
            .descendants()
            .filter(|node| node.has_tag_name("line") && node.parent().is_some_and(|parent| parent.has_tag_name("g")))
            .map(|node| [["x1", "y1"], ["x2", "y2"]].map(|[x, y]| Vec2::new(number(&node, x), number(&node, y))))
            .collect();
        for (index, (centre, half)) in boxes.iter().enumerate() {
            letters += 1;
            for (other, size) in &boxes[index + 1..] {
                let gap = (centre - other).abs() - half - size;
                assert!(gap.x > 0.0 || gap.y > 0.0, "{name} at {degrees}: letters at {centre:?} and {other:?}");
            }
            let inside = |[a, b]: &[Vec2; 2]| {
                (0..=400)
                    .map(|k| a + (b - a) * (f64::from(k) / 400.0) - centre)
                    .any(|d| d.x.abs() < half.x && d.y.abs() < half.y)
            };
            crossed += usize::from(arrows.iter().any(inside));
        }
    }
    assert!(letters > 1000);
    assert_eq!(crossed, 0, "of {letters} letters");
}

/// The arrow of a vector is as long as its size over the scale factor says, to the hundredths of a millimetre that are written.
#[test]
fn drawings_are_true_to_scale() {
    let plans = plans("crank_rocker", 70.0);
    let text = draw::plans(&plans, "crank_rocker", "");
    let document = roxmltree::Document::parse(&text).unwrap();
    let mut checked = 0;
    for group in document.descendants().filter(|node| node.has_tag_name("g")) {
        let title =
            group.children().find(|n| n.has_tag_name("title")).and_then(|n| n.text()).unwrap_or_default().trim();
        let name = title.split(" = ").next().unwrap();
        let plan = if name.starts_with('v') { &plans.velocity } else { &plans.acceleration };
        let number = |node: roxmltree::Node, key: &str| node.attribute(key).unwrap().parse::<f64>().unwrap();
        let line = group.children().find(|n| n.has_tag_name("line")).unwrap();
        let head = group.children().find(|n| n.has_tag_name("path")).unwrap().attribute("d").unwrap().to_string();
        let tip: Vec<f64> = head[1..].split('L').next().unwrap().split(' ').map(|part| part.parse().unwrap()).collect();
        let drawn = Vec2::new(tip[0] - number(line, "x1"), number(line, "y1") - tip[1]);
        let vector = plan.vector(name).unwrap();
        assert!((drawn - vector.value / plan.scale).norm() < 0.015, "{name}: {drawn:?}");
        checked += 1;
    }
    assert!(checked > 20);
}

#[test]
fn both_solvers_draw_the_same_plans() {
    for name in ALL {
        let [a, b] = [&AssurSolver as &dyn Solver, &NewtonSolver].map(|solver| plans_with(name, solver, 70.0));
        for (a, b) in [(&a.velocity, &b.velocity), (&a.acceleration, &b.acceleration)] {
            assert_eq!(a.scale, b.scale);
            for (x, y) in a.vectors.iter().zip(&b.vectors) {
                assert_eq!(x.name, y.name);
                assert!((x.value - y.value).norm() <= 1e-11 * longest(a), "{name} {}", x.name);
            }
        }
    }
}

/// The method through the singular point has no error of its own: it gives what both solvers give.
#[test]
fn the_singular_point_gives_the_solvers_velocities_and_accelerations() {
    let case = scenario("fourth_class").case;
    let group = &case.structure.groups[0];
    for solver in [&AssurSolver as &dyn Solver, &NewtonSolver] {
        for degrees in 0..72 {
            let state =
                linkproof::diagram::plan::state_at(&case, solver, (5.0 * f64::from(degrees)).to_radians()).unwrap();
            let point = SingularPoint::of(&case, group, &state.motions).unwrap().unwrap();
            assert_eq!(point.lines(), "BD x CE");
            // The farther S is from the group, the more digits cancel; its distance over the size of the group measures that.
            let far = 1.0 + point.at.norm() / 0.1;
            for (link, omega, alpha) in point.links {
                let motion = &state.motions[link];
                assert!((omega - motion.omega).abs() <= 1e-12 * 100.0 * far, "{degrees}: {omega} {}", motion.omega);
                assert!((alpha - motion.alpha).abs() <= 1e-12 * 1e4 * far, "{degrees}: {alpha} {}", motion.alpha);
            }
            for (side, link) in [point.links[0].0, point.links[1].0].into_iter().enumerate() {
                let motion = &state.motions[link];
                let local = rotated(Vec2::new(motion.direction.x, -motion.direction.y), point.at - motion.origin);
                let speed = point.velocity.norm().max(1.0);
                assert!((motion.point_velocity(local) - point.velocity).norm() <= 1e-12 * speed * far);
                let strong = point.accelerations[side].norm().max(100.0);
                assert!((motion.point_acceleration(local) - point.accelerations[side]).norm() <= 1e-12 * strong * far);
            }
        }
    }
    for name in ["crank_rocker", "ov7_new"] {
        let case = scenario(name).case;
        let state = linkproof::diagram::plan::state_at(&case, &AssurSolver, 0.3).unwrap();
        for group in &case.structure.groups {
            assert_eq!(SingularPoint::of(&case, group, &state.motions).unwrap(), None, "{name}");
        }
    }
}

/// Magnitudes at 70 deg by the authors' analytic and graphical methods, and their percentages, beside the exact ones.
#[test]
fn val_fourth_class_published_graphical_figures() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios/fourth_class/published.csv");
    let mut reader = csv::Reader::from_path(path).unwrap();
    let rows: Vec<Vec<String>> = reader.records().map(|row| row.unwrap().iter().map(Into::into).collect()).collect();
    assert_eq!(rows.len(), 4);
    let plans = plans("fourth_class", 70.0);
    let mut wrong = Vec::new();
    for row in &rows {
        let link = &plans.scheme.links[row[0].parse::<usize>().unwrap() - 1];
        for (what, exact, cells) in [("omega", link.omega.abs(), &row[1..4]), ("eps", link.alpha.abs(), &row[4..7])] {
            let decimals = |cell: &String| cell.split_once('.').map_or(0, |(_, decimals)| decimals.len());
            let shown = |value: f64, cell: &String| format!("{value:.*}", decimals(cell));
            assert_eq!(shown(exact, &cells[0]), cells[0], "analytic {what} of link {}", row[0]);
            let graphical: f64 = cells[1].parse().unwrap();
            let error = (graphical / exact - 1.0).abs() * 100.0;
            // The authors' own criterion: agreement of 95 %.
            assert!(error < 5.0);
            if shown(error, &cells[2]) != cells[2] {
                wrong.push(format!("{what}{} printed {} is {error:.2}", row[0], cells[2]));
            }
        }
    }
    // docs/findings.md, fourth_class-percentages.
    assert_eq!(wrong, ["eps2 printed 0.0 is 0.13", "eps4 printed 2.3 is 2.18", "omega5 printed 1.0 is 1.06"]);
}

fn motion(name: &str, channel: &str, divisions: usize) -> MotionDiagram {
    let case = scenario(name).case;
    let course = Course::named(&case, channel).unwrap();
    MotionDiagram::of(&case, &AssurSolver, &course, divisions).unwrap()
}

/// The pin of a uniformly turning crank moves as a sine: the chord method makes it smaller by sin(h/2)/(h/2) and its square.
#[test]
fn the_chord_method_on_the_crank_pin_has_its_known_factor() {
    for n in [12, 24, 48] {
        let diagram = motion("crank_rocker", "point.A.x_m", n);
        let half = PI / n as f64;
        let factor = half.sin() / half;
        for (method, factor) in [(Method::ChordVelocity, factor), (Method::ChordAcceleration, factor * factor)] {
            let found = diagram.by(method).unwrap();
            let exact = &diagram.exact[method.gives()];
            for (&row, value) in found.rows.iter().zip(&found.values) {
                // Rounding of positions (1e-15 of their range) over the interval, once or twice.
                let bound = 1e-15 * (n * n) as f64 * diagram.half_range(method.gives());
                assert!((value - factor * exact[row]).abs() <= bound, "{n} {method:?}");
            }
        }
    }
}

#[test]
fn the_error_of_all_four_methods_is_of_second_order() {
    // So many divisions that the next term, of fourth order, no longer shows; the class IV group moves by far the most sharply.
    for (name, channel, divisions) in [
        ("crank_rocker", "point.B.x_m", 48),
        ("crank_rocker", "link.rocker.angle_rad", 48),
        ("ov7_base", "point.9.y_m", 48),
        ("ov7_new", "link.base_345.angle_rad", 48),
        ("fourth_class", "point.E.x_m", 192),
    ] {
        for found in &motion(name, channel, divisions).found {
            for order in found.orders {
                assert!((order.unwrap() - 2.0).abs() <= 0.05, "{name} {channel} {:?}: {order:?}", found.method);
            }
        }
    }
    // What a draughtsman takes: 12 divisions, then 24 and 48.
    for found in &motion("crank_rocker", "link.coupler.angle_rad", 12).found {
        assert!((found.orders[1].unwrap() - 2.0).abs() <= 0.05, "{:?}", found.orders);
    }
}

#[test]
fn a_link_that_turns_uniformly_has_no_error() {
    let diagram = motion("crank_rocker", "link.crank.angle_rad", 12);
    for found in &diagram.found {
        // The angle grows by 2 pi: rounding of it over the interval, once or twice.
        assert!(found.largest <= 1e-11 && found.share <= 1e-11 && found.orders == [None; 2], "{found:?}");
    }
}

#[test]
fn diagrams_are_well_formed_and_carry_their_errors() {
    for (name, channel, n) in [("crank_rocker", "point.B.x_m", 12), ("ov7_base", "link.rocker_87.angle_rad", 36)] {
        let diagram = motion(name, channel, n);
        let text = draw::motion(&diagram, name);
        let document = roxmltree::Document::parse(&text).unwrap();
        let words: String = document.descendants().filter(|n| n.is_text()).filter_map(|n| n.text()).collect();
        for found in &diagram.found {
            assert!(words.contains(&format!(
                "{}: largest error {}",
                found.method.words(),
                draw::significant(found.largest)
            )));
        }
        let circles = document.descendants().filter(|node| node.has_tag_name("circle")).count();
        // One at every middle and every end but the first, and one in each of two captions.
        assert_eq!(circles, 2 * n + 2);
    }
}

#[test]
fn bad_questions_are_answered_with_the_way_out() {
    let case = scenario("crank_rocker").case;
    for (channel, message, way_out) in [
        ("point.B.z_m", "no channel", "point.B.x_m"),
        ("point.Q.x_m", "no channel", "point.A.x_m"),
        ("link.roker.angle_rad", "no channel", "link.rocker.angle_rad"),
        ("point.B.vx_m_s", "a derivative already", "point.B.x_m"),
        ("joint.B.fx_N", "neither a position nor an angle", "point.B.x_m"),
        ("", "no channel", "point.B.x_m"),
    ] {
        let error = Course::named(&case, channel).unwrap_err();
        assert!(error.message().contains(message), "{channel}: {error}");
        assert!(error.way_out().unwrap().contains(way_out), "{channel}: {error}");
    }
    let course = Course::named(&case, "point.B.x_m").unwrap();
    for divisions in [0, 3, 1001] {
        let error = MotionDiagram::of(&case, &AssurSolver, &course, divisions).unwrap_err();
        assert!(error.way_out().unwrap().contains("from 4 to 1000"), "{error}");
    }
    for crank in [f64::NAN, f64::INFINITY, 1e30] {
        assert!(Plans::at(&case, &AssurSolver, crank).is_err());
    }
}
