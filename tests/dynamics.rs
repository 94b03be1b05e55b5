//! Motion under forces, from outside.

mod common;
use common::shipped;
use linkproof::reference::dynamics::{ACCURACY, Model, RunUp, motion};
use linkproof::reference::{AssurSolver, reduced};

#[test]
fn probe() {
    let s = shipped("crank_rocker.toml");
    let model = Model::of(&s.case).unwrap();
    println!("{:?}", model.kinks());
    let m = reduced::means_over_turn(&s.case, &AssurSolver).unwrap();
    println!("{:.12} {:.12} {}", m.inertia, m.resistance, 100.0 * 2.0 * 32.0 / 360.0 - m.resistance);
    for acc in [1e-10, 1e-12, 1e-13] {
        let t = std::time::Instant::now();
        let r = model.regime(&[], acc).unwrap();
        println!(
            "{acc:e} {:?} T {:.14} mean {:.12} start {:.12} mult {:e} delta {}",
            t.elapsed(),
            r.period,
            r.mean_speed,
            r.start_speed,
            r.multiplier,
            r.non_uniformity()
        );
        println!("{:?} {:?}", r.fastest, r.slowest);
    }
    let times: Vec<f64> = (0..=500).map(|k| k as f64 * 1e-3).collect();
    let exact = motion(&model, 0.0, &times, 1e-14).unwrap().0;
    for acc in [1e-9, 1e-10, 1e-11, 1e-12, 1e-13] {
        let t = std::time::Instant::now();
        let (m, e) = motion(&model, 0.0, &times, acc).unwrap();
        let d = t.elapsed();
        let worst = m.iter().zip(&exact).map(|(a, b)| (a.crank - b.crank).abs()).fold(0.0, f64::max);
        let worsta = m.iter().zip(&exact).map(|(a, b)| (a.alpha - b.alpha).abs()).fold(0.0, f64::max);
        println!("{acc:e} {d:?} {e:?} crank {worst:e} alpha {worsta:e} {:?}", m.last());
    }
    let t = std::time::Instant::now();
    let run = RunUp::of(&model, 0.0, &times, ACCURACY).unwrap();
    println!("{:?} residual {:?}", t.elapsed(), run.power_residual());
    for want in [0.5, 0.1, 0.02] {
        let t = std::time::Instant::now();
        let f = model.flywheel(want, ACCURACY).unwrap();
        println!("{:?} {} {:e}", t.elapsed(), f.inertia, f.regime.non_uniformity() - want);
    }
}
