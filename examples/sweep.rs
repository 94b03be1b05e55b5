//! Largest balancing moment of a turn, from ten thousand poses solved in one batch call.
//!
//! `cargo run --release --example sweep -- scenarios/ov7_base.toml`

use std::f64::consts::TAU;

use analytic::assur::batch::{Batch, Poses};
use linkproof::Scenario;
use linkproof::parts::{Error, Stage};

const POSES: usize = 10_000;

fn main() -> Result<(), Error> {
    let file = std::env::args().nth(1).unwrap_or_else(|| "scenarios/crank_rocker.toml".into());
    let case = Scenario::load(file)?.case;
    let (start, speed) = (case.crank().start, case.crank().top_speed());
    let cranks: Vec<f64> = (0..POSES).map(|k| start + speed.signum() * TAU * k as f64 / POSES as f64).collect();
    let (mut batch, mut poses) = (Batch::of(&case)?, Poses::new());
    batch.solve(&cranks, speed, 0.0, Stage::BalancingMoment, &mut poses)?;
    let largest = (0..poses.len()).max_by(|&a, &b| poses.torque(a, 0).abs().total_cmp(&poses.torque(b, 0).abs()));
    if let Some(row) = largest {
        let (moment, crank) = (poses.torque(row, 0), cranks[row].to_degrees());
        println!("{POSES} poses: the balancing moment is largest, {moment:.4} N m, at {crank:.3} deg");
    }
    Ok(())
}
