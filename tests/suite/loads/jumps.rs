//! A load whose law changes where a motion reverses jumps there, or has a kink only.

use linkproof::proof::{Options, prove};
use linkproof::scenario::Scenario;

use crate::common::{from_outside, shipped};

/// Largest number of instants that are left out in a channel of the pendulum under a load.
fn left_out(load: &str) -> usize {
    let path = shipped("pendulum.toml").path;
    let text = std::fs::read_to_string(&path).unwrap();
    let text = text.strip_suffix(from_outside(&text)).unwrap();
    let scenario =
        Scenario::parse(&format!("{text}[[loads]]\n{load}\n"), &path).unwrap_or_else(|error| panic!("{error}"));
    let proof = prove(&scenario, &Options::default()).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(proof.verdict.word(), "agree", "{load}");
    proof.engine().channels.iter().map(|channel| channel.left_out).max().unwrap()
}

/// The pendulum reverses at 150 deg to either side of where it hangs.
#[test]
fn instants_are_left_out_where_a_load_jumps_and_nowhere_else() {
    let table = |away: f64| {
        format!(
            "type = \"moment\"\nlink = \"rod\"\nacts = \"clockwise\"\ntable = [{{ crank_deg = -40, moment_N_m = {away} }}, \
             {{ crank_deg = 0, moment_N_m = 1 }}, {{ crank_deg = 40, moment_N_m = {away} }}]"
        )
    };
    let none = left_out(&table(0.0));
    assert_eq!(left_out("type = \"resistance\"\nlink = \"rod\"\nmoment_N_m = 0"), none);
    for jumping in [table(0.5), "type = \"resistance\"\nlink = \"rod\"\nmoment_N_m = 0.5".into()] {
        assert!(left_out(&jumping) > none, "{jumping}");
    }
}
