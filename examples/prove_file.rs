//! Proves a scenario file, and prints the channel with the largest ratio of error to bound.
//!
//! `cargo run --release --example prove_file -- scenarios/ov7_base.toml`

use linkproof::parts::Error;
use linkproof::{Options, Scenario, prove};

fn main() -> Result<(), Error> {
    let file = std::env::args().nth(1).unwrap_or_else(|| "scenarios/crank_rocker.toml".into());
    let proof = prove(&Scenario::load(file)?, &Options::default())?;
    let used = |channel: &linkproof::parts::ChannelProof| channel.residual.max / channel.bound;
    let worst = proof.engine().channels.iter().max_by(|a, b| used(a).total_cmp(&used(b)));
    println!("{}: {}", proof.scenario, proof.verdict.word());
    if let Some(worst) = worst {
        println!("{} uses {:.0} % of its bound", worst.residual.channel, 100.0 * used(worst));
    }
    Ok(())
}
