//! How a run-up ended.

use analytic::reduced::{End, RunUp};
use prover::numbers;

/// The end of a run-up as text, with an empty line after it.
pub(crate) fn text(run_up: &RunUp) -> String {
    let degrees = |crank: f64| numbers::fixed_in(crank.to_degrees(), 6, "deg");
    let mut text = match run_up.end {
        End::Reached => "run-up followed to its end".to_string(),
        End::Held(t, crank) => format!("run-up: held at {t:.9} s, crank angle {}", degrees(crank)),
        End::Limit(t, crank) => {
            format!("run-up: at a limit of rotation at {t:.9} s, crank angle {}", degrees(crank))
        }
    };
    if let Some(residual) = run_up.power_residual() {
        put!(text, "; motor against reactions: {} of the largest moment", numbers::error(residual));
    }
    text.push_str("\n\n");
    text
}
