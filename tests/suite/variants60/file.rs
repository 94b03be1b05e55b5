//! A variant as a scenario file.

use std::fmt::Write;

use super::plan::Plan;

const SOURCE: &str = "Sixty study variants of a crank mechanism with a second rocker and a slider: lengths, angles and speed as given (variants.csv), \
the drawings are not available";
const READING: &str = "Topology is our own reading (docs/variants60.md): crank 1 = O1A, connecting rod 2 = AB with a slider at B, point C on link 2, \
link 3 = CD, rocker 4 = O2D";
const READING_4: &str = "Topology is our own reading (docs/variants60.md): crank 1 = O1A, coupler 2 = AB with point C on it, rocker 3 = O2B; \
gamma is the angle at B between links 2 and 3, phi and theta are not used";

/// Twelve decimals without trailing zeros.
/// At a resolution of 1e-12 m, the last bit of a sine has no effect.
pub fn number(value: f64) -> String {
    let text = format!("{value:.12}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".into() } else { text.into() }
}

fn place(name: &str, x: f64, y: f64) -> String {
    format!("{name} = {{ x_m = {}, y_m = {} }}\n", number(x), number(y))
}

/// A uniform bar of 10 kg/m along its x axis.
fn bar(name: &str, length: f64, points: &[(&str, f64)]) -> String {
    let mut text = format!("[links.{name}]\nmass_kg = {}\n", number(10.0 * length));
    text += &format!("mass_centre = {{ x_m = {}, y_m = 0 }}\n", number(length / 2.0));
    text += &format!("inertia_kg_m2 = {}\n[links.{name}.points]\n", number(10.0 * length.powi(3) / 12.0));
    points.iter().for_each(|&(name, x)| text += &place(name, x, 0.0));
    text + "\n"
}

fn pin(name: &str, first: &str, second: &str) -> String {
    format!("[[joints]]\nname = \"{name}\"\ntype = \"revolute\"\nlinks = [\"{first}\", \"{second}\"]\n\n")
}

fn group(first: &str, second: &str, mode: &str) -> String {
    format!("[[start.groups]]\nlinks = [\"{first}\", \"{second}\"]\nmode = \"{mode}\"\n")
}

/// The words of the title about the range, with limits rounded to 1e-6 deg.
pub fn range(plan: &Plan) -> String {
    match plan.limits {
        None => "turns fully".into(),
        Some([from, to]) => format!("cannot turn fully: from {from:.6} to {to:.6} deg"),
    }
}

/// The whole file.
pub fn text(plan: &Plan) -> String {
    let v = &plan.linkage.variant;
    let what = if v.rocker.is_some() {
        "crank, connecting rod with a slider, link 3 and rocker 4"
    } else {
        "crank, coupler and rocker 3"
    };
    let reading = if v.rocker.is_some() { READING } else { READING_4 };
    let mut text = format!("format = 1\nname = \"variant_{:02}\"\n", v.number);
    let _ = writeln!(text, "title = \"Study variant {} (scheme {}): {what}; {}\"", v.number, v.scheme, range(plan));
    let _ = writeln!(text, "source = \"{SOURCE}. {reading}\"\n\n{}", comment(plan));
    text + &mechanism(plan) + &run(plan)
}

fn comment(plan: &Plan) -> String {
    let v = &plan.linkage.variant;
    let mut text = format!("# Given pose: alpha = {}, beta = {}, gamma = {}", v.alpha, v.beta, v.gamma);
    text += &if v.rocker.is_some() { format!(", phi = {}, theta = {} deg.", v.phi, v.theta) } else { " deg.".into() };
    text += if v.rocker.is_some() {
        " It determines O2 and the guide,\n# which passes through G, the position of B in this pose.\n"
    } else {
        " It determines O2.\n"
    };
    text += "# ASSUMED masses: uniform bars of 10 kg/m (inertia m l^2 / 12)";
    text += if v.rocker.is_some() { "; slider 1 kg at B, without inertia.\n" } else { ".\n" };
    if plan.limits.is_some() {
        let _ = writeln!(text, "# The grid keeps both transmission angles above {} deg.{}", plan.kept, bad_pose(plan));
    }
    text
}

fn bad_pose(plan: &Plan) -> String {
    if plan.start == plan.linkage.variant.alpha {
        return String::new();
    }
    match plan.given {
        given if given < 1e-4 => {
            "\n# The given pose is singular (rod perpendicular to the guide) and is not in the grid.".into()
        }
        given => {
            format!("\n# In the given pose, a transmission angle is {given:.2} deg; this pose is not in the grid.")
        }
    }
}

fn mechanism(plan: &Plan) -> String {
    let Plan { linkage, .. } = plan;
    let v = &linkage.variant;
    let [l1, l2, l3] = v.lengths;
    let mut text = String::from("[ground.points]\nO1 = { x_m = 0, y_m = 0 }\n");
    text += &place("O2", linkage.o2.x, linkage.o2.y);
    let crank = bar("crank", l1, &[("O1", 0.0), ("A", l1)]);
    let Some(l4) = v.rocker else {
        text += "\n";
        text += &crank;
        text += &bar("coupler_2", l2, &[("A", 0.0), ("C", v.ac), ("B", l2)]);
        text += &bar("rocker_3", l3, &[("O2", 0.0), ("B", l3)]);
        text += &pin("O1", "ground", "crank");
        text += &pin("A", "crank", "coupler_2");
        text += &pin("B", "coupler_2", "rocker_3");
        return text + &pin("O2", "ground", "rocker_3");
    };
    text += &place("G", linkage.b.x, linkage.b.y);
    text += "\n";
    text += &crank;
    text += &bar("rod_2", l2, &[("A", 0.0), ("C", v.ac), ("B", l2)]);
    text += "[links.slider]\nmass_kg = 1\nmass_centre = { x_m = 0, y_m = 0 }\n[links.slider.points]\nB = { x_m = 0, y_m = 0 }\n\n";
    text += &bar("link_3", l3, &[("C", 0.0), ("D", l3)]);
    text += &bar("rocker_4", l4, &[("O2", 0.0), ("D", l4)]);
    text += &pin("O1", "ground", "crank");
    text += &pin("A", "crank", "rod_2");
    text += &pin("B", "rod_2", "slider");
    text += "[[joints]]\nname = \"guide\"\ntype = \"prismatic\"\nlinks = [\"ground\", \"slider\"]\npoints = [\"G\", \"B\"]\n";
    text += &format!("axis_deg = {}\n\n", v.theta);
    text += &pin("C", "rod_2", "link_3");
    text += &pin("D", "link_3", "rocker_4");
    text + &pin("O2", "ground", "rocker_4")
}

fn run(plan: &Plan) -> String {
    let mut text = format!("[drive]\njoint = \"O1\"\nspeed_rad_s = {}\n\n", plan.linkage.variant.omega);
    text += "[gravity]\nx_m_s2 = 0\ny_m_s2 = -9.81\n\n";
    text += &format!("[start]\ncrank_deg = {}\n", number(plan.start));
    let side = if plan.linkage.is_left() { "left" } else { "right" };
    match plan.linkage.is_ahead() {
        Some(is_ahead) => {
            text += &group("rod_2", "slider", if is_ahead { "ahead" } else { "behind" });
            text += &group("link_3", "rocker_4", side);
        }
        None => text += &group("coupler_2", "rocker_3", side),
    }
    let [from, to] = plan.grid.map(number);
    text += &format!("\n[grid]\nfrom_deg = {from}\nto_deg = {to}\nstep_deg = {}\n\n", number(plan.grid_step));
    text + &format!("[engine]\nstep_deg = {}\n", number(plan.engine_step))
}
