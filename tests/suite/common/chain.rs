//! The N-four-bar mechanism: a chain of parallelograms that are singular at the same crank angles.

use std::fmt::Write;
use std::path::Path;

use linkage::case::Case;
use scenario::Scenario;

/// Scenario of `pairs` parallelograms of slender rods of 1 m and 1 kg.
/// At t = 0 the parallelograms are upright, and the first coupler moves at 1 m/s.
/// The grid goes to `to` (s) in steps of `step` (s).
pub fn text(pairs: usize, to: f64, step: f64) -> String {
    let mut text = "format = 1\nname = \"chain\"\ntitle = \"chain\"\n[ground.points]\n".to_string();
    for k in 0..=pairs {
        writeln!(text, "O{k} = {{ x_m = {k}, y_m = 0 }}").unwrap();
    }
    let link = "mass_kg = 1\ninertia_kg_m2 = 0.08333333333333333\nmass_centre = { x_m = 0.5, y_m = 0 }\n";
    let (mut joints, mut groups) = (String::new(), String::new());
    let mut joint = |point: &str, a: &str, b: &str| {
        let name = format!("{point}_{b}");
        joints += &format!(
            "[[joints]]\nname = \"{name}\"\npoint = \"{point}\"\ntype = \"revolute\"\nlinks = [\"{a}\", \"{b}\"]\n"
        );
    };
    for k in 0..=pairs {
        text += &format!(
            "[links.bar{k}]\n{link}[links.bar{k}.points]\nO{k} = {{ x_m = 0, y_m = 0 }}\nA{k} = {{ x_m = 1, y_m = 0 }}\n"
        );
        joint(&format!("O{k}"), "ground", &format!("bar{k}"));
    }
    for k in 1..=pairs {
        let before = k - 1;
        text += &format!(
            "[links.rod{k}]\n{link}[links.rod{k}.points]\nA{before} = {{ x_m = 0, y_m = 0 }}\nA{k} = {{ x_m = 1, y_m = 0 }}\n"
        );
        joint(&format!("A{before}"), &format!("bar{before}"), &format!("rod{k}"));
        joint(&format!("A{k}"), &format!("bar{k}"), &format!("rod{k}"));
        groups += &format!("[[start.groups]]\nlinks = [\"rod{k}\", \"bar{k}\"]\nmode = \"left\"\n");
    }
    format!(
        "{text}{joints}[drive]\njoint = \"O0_bar0\"\nmotion = \"free\"\ninitial_speed_rad_s = -1\nspeed_rad_s = -1\n\
         [gravity]\nx_m_s2 = 0\ny_m_s2 = -9.81\n[start]\ncrank_deg = 90\n{groups}\
         [grid]\nfrom_s = 0\nto_s = {to:?}\nstep_s = {step:?}\n"
    )
}

/// The case of the scenario with `pairs` parallelograms and a grid up to `to` (s) in steps of `step` (s).
pub fn four_bars(pairs: usize, to: f64, step: f64) -> Case {
    let text = text(pairs, to, step);
    Scenario::parse(&text, Path::new("chain.toml")).unwrap_or_else(|error| panic!("{error}")).case
}
