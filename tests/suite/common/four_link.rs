//! Random mechanisms with one group of four links; every run has the same mechanisms.

use std::fmt::Write;
use std::path::Path;

use scenario::Scenario;

pub use super::sketch::RandomSource;

fn place(random: &mut RandomSource) -> [f64; 2] {
    [random.number(-0.5, 0.5), random.number(-0.5, 0.5)]
}

/// A link whose frame has its origin at the first point and axes parallel to the world's.
/// Local points are therefore differences of coordinates.
fn link(text: &mut String, random: &mut RandomSource, name: &str, points: &[(&str, [f64; 2])]) {
    let origin = points[0].1;
    let local = |p: [f64; 2]| format!("{{ x_m = {:?}, y_m = {:?} }}", p[0] - origin[0], p[1] - origin[1]);
    let (mass, inertia, centre) = (random.number(0.2, 3.0), random.number(0.01, 0.1), place(random));
    let _ = write!(
        text,
        "[links.{name}]\nmass_kg = {mass:?}\ninertia_kg_m2 = {inertia:?}\nmass_centre = {}\n[links.{name}.points]\n",
        local(centre)
    );
    for (point, place) in points {
        let _ = writeln!(text, "{point} = {}", local(*place));
    }
}

/// A mechanism with one group of four links, of class III if `triad`, otherwise of class IV.
/// The dimensions come from a drawn pose, so the mechanism can be assembled.
pub fn scenario(random: &mut RandomSource, triad: bool) -> Scenario {
    let mut text = String::from("format = 1\nname = \"random\"\ntitle = \"random\"\n[ground.points]\n");
    let places: Vec<[f64; 2]> = (0..8).map(|_| place(random)).collect();
    let at = |k: usize| places[k];
    let crank = random.number(0.02, 0.05);
    let c = [at(0)[0] + crank, at(0)[1]];
    for (name, place) in [("O", at(0)), ("A", at(1)), ("B", at(2))] {
        let _ = writeln!(text, "{name} = {{ x_m = {:?}, y_m = {:?} }}", place[0], place[1]);
    }
    link(&mut text, random, "crank", &[("O", at(0)), ("C", c)]);
    let joints: &[(&str, &str, &str)] = if triad {
        link(&mut text, random, "lead", &[("C", c), ("F", at(3))]);
        link(&mut text, random, "base", &[("F", at(3)), ("D", at(4)), ("E", at(5))]);
        link(&mut text, random, "left", &[("A", at(1)), ("D", at(4))]);
        link(&mut text, random, "right", &[("B", at(2)), ("E", at(5))]);
        &[
            ("C", "crank", "lead"),
            ("F", "base", "lead"),
            ("D", "base", "left"),
            ("E", "right", "base"),
            ("A", "ground", "left"),
            ("B", "right", "ground"),
        ]
    } else {
        link(&mut text, random, "lead", &[("C", c), ("F", at(3)), ("G", at(6))]);
        link(&mut text, random, "base", &[("F", at(3)), ("D", at(4))]);
        link(&mut text, random, "left", &[("A", at(1)), ("D", at(4)), ("H", at(7))]);
        link(&mut text, random, "right", &[("G", at(6)), ("H", at(7))]);
        &[
            ("C", "crank", "lead"),
            ("F", "base", "lead"),
            ("D", "base", "left"),
            ("G", "right", "lead"),
            ("H", "left", "right"),
            ("A", "ground", "left"),
        ]
    };
    for (name, a, b) in [("O", "ground", "crank")].iter().chain(joints) {
        let _ = writeln!(text, "[[joints]]\nname = \"{name}\"\ntype = \"revolute\"\nlinks = [\"{a}\", \"{b}\"]");
    }
    let (x, y) = (at(4)[0], at(4)[1]);
    let _ = write!(
        text,
        "[drive]\njoint = \"O\"\nspeed_rad_s = 7\n[gravity]\nx_m_s2 = 1\ny_m_s2 = -9.8\n[[loads]]\ntype = \"resistance\"\nlink = \"left\"\nmoment_N_m = 3\n\
         [start]\ncrank_deg = 0\n[[start.groups]]\nlinks = [\"lead\", \"base\", \"left\", \"right\"]\nnear = {{ point = \"D\", x_m = {x:?}, y_m = {y:?} }}\n\
         [grid]\nfrom_deg = -15\nto_deg = 15\nstep_deg = 5\n[engine]\ndt_s = 1e-3\n"
    );
    Scenario::parse(&text, Path::new("random.toml")).unwrap_or_else(|error| panic!("{error}\n{text}"))
}
