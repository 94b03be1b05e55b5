//! Builds a four-bar in code, reads its reactions as slices, and proves it.
//!
//! `cargo run --release --example four_bar`

use linkproof::parts::{AssemblyMode, Error};
use linkproof::{Case, Options, Scenario, prove, solve};

fn main() -> Result<(), Error> {
    let case = Case::builder()
        .ground(&[("O", [0.0, 0.0]), ("C", [0.4, 0.0])])
        .link("crank", &[("O", [0.0, 0.0]), ("A", [0.1, 0.0])])
        .link("coupler", &[("A", [0.0, 0.0]), ("B", [0.35, 0.0])])
        .link("rocker", &[("C", [0.0, 0.0]), ("B", [0.25, 0.0])])
        .mass("crank", 1.0, [0.05, 0.0], 0.002)
        .mass("coupler", 2.0, [0.175, 0.0], 0.02)
        .mass("rocker", 1.5, [0.125, 0.0], 0.01)
        .pin("O", "ground", "crank")
        .pin("A", "crank", "coupler")
        .pin("B", "coupler", "rocker")
        .pin("C", "ground", "rocker")
        .crank("O", 10.0)
        .mode(&["coupler", "rocker"], AssemblyMode::Left)
        .gravity([0.0, -9.81])
        .build()?;
    let solution = solve(&case)?;
    let (x, y) = (solution.named("joint.B.fx_N"), solution.named("joint.B.fy_N"));
    let (x, y) = (x.expect("B is a joint"), y.expect("B is a joint"));
    let largest = x.iter().zip(y).map(|(x, y)| x.hypot(*y)).enumerate().max_by(|a, b| a.1.total_cmp(&b.1));
    if let Some((row, force)) = largest {
        println!("largest reaction in B: {force:.2} N at {:.0} deg", solution.inputs()[row].to_degrees());
    }
    let proof = prove(&Scenario::of_case("four_bar", case)?, &Options::default())?;
    println!("{}", proof.verdict.word());
    Ok(())
}
