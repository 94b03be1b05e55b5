//! Every residual of a proof beside its bound, for readers who examine the bounds.

use super::cells::{table, trimmed};
use super::own_forces;
use crate::numbers;
use crate::proof::Proof;

/// One line for every channel of every engine, and for every check.
#[must_use]
pub fn all(proof: &Proof) -> String {
    let mut table = table(["channel or check", "side", "residual", "bound", "unit", "used", "verdict"], &[2, 3, 5]);
    let mut add = |name: String, side: &str, [value, bound]: [f64; 2], unit: &str, verdict: &str| {
        let used = if value == 0.0 { 0.0 } else { value / bound };
        let [value, bound] = [value, bound].map(|number| numbers::significant(number, 4));
        table.add_row([name, side.into(), value, bound, unit.into(), numbers::significant(used, 3), verdict.into()]);
    };
    for engine in &proof.engines {
        for channel in &engine.channels {
            let (residual, verdict) = (&channel.residual, channel.verdict.word());
            let numbers = [residual.max, channel.bound];
            add(residual.channel.to_string(), engine.info.name, numbers, residual.channel.kind.unit.symbol(), verdict);
        }
        for channel in engine.own_forces.iter().flat_map(|own| &own.channels) {
            let (residual, verdict) = (&channel.residual, channel.verdict.word());
            let (name, side) = (own_forces::name(channel), engine.info.name);
            add(name, side, [residual.max, channel.bound], residual.channel.kind.unit.symbol(), verdict);
        }
    }
    for check in proof.all_checks() {
        add(check.name(), "", [check.value, check.bound], check.unit, check.verdict.word());
    }
    format!("\n{}\n", trimmed(&table))
}
