//! Several engines side by side, and the one that disagrees with all others.

use comfy_table::Table;

use super::cells::{self, share, used};
use linkage::trajectory::Stage;
use prover::compare::overall;
use prover::proof::{EngineProof, Proof};

/// One row per engine, one column per stage: the channel that uses the largest share of its bound.
pub fn table(engines: &[EngineProof], width: Option<usize>) -> Table {
    let stages = Stage::ALL.map(Stage::name);
    let header = ["engine", stages[0], stages[1], stages[2], stages[3], stages[4], "verdict"];
    let mut table = cells::fitted(header, &[1, 2, 3, 4, 5], width);
    for engine in engines {
        let mut row = vec![engine.info.name.to_string()];
        row.extend(Stage::ALL.map(|stage| worst(engine, stage)));
        row.push(match &engine.failure {
            Some(_) => "failed".into(),
            None => engine.verdict.word().into(),
        });
        table.add_row(row);
    }
    table
}

/// Error and bound of the worst channel of a stage, over its scale, and the verdict if it is not agreement.
fn worst(engine: &EngineProof, stage: Stage) -> String {
    let own = || engine.channels.iter().filter(|channel| channel.residual.channel.kind.stage == stage);
    let Some(worst) = own().max_by(|a, b| used(a).total_cmp(&used(b))) else { return "-".into() };
    let residual = &worst.residual;
    let mark = match overall(own().map(|channel| &channel.verdict)).word() {
        "disagree" => " !",
        "inconclusive" => " ?",
        _ => "",
    };
    format!("{} ({}){mark}", share(residual.max, residual.scale), share(worst.bound, residual.scale))
}

/// Which sides disagree with each other, and the one that disagrees with all others.
pub fn disputes(proof: &Proof) -> String {
    let mut text = String::new();
    for engine in &proof.engines {
        if let Some(error) = &engine.failure {
            say!(text, "{} failed: {}", engine.info.name, error.message());
        }
    }
    if proof.disputes.is_empty() {
        text.push_str("No two of them differ by more than both may be wrong.");
        return text;
    }
    let mut parties: Vec<&str> = vec![proof.reference];
    parties.extend(proof.engines.iter().map(|engine| engine.info.name));
    for party in parties {
        let alone = proof.disputes.iter().filter(|dispute| dispute.odd == Some(party));
        if let Some(first) = alone.clone().next() {
            say!(text, "The odd one out in {} channels is {party}, first in {}.", alone.count(), first.channel);
        }
    }
    let open = proof.disputes.iter().filter(|dispute| dispute.odd.is_none());
    if let Some(first) = open.clone().next() {
        let pairs: Vec<String> = first.pairs.iter().map(|[a, b]| format!("{a} and {b}")).collect();
        let (count, channel, pairs) = (open.count(), &first.channel, pairs.join(", "));
        say!(text, "In {count} channels no single one stands alone, first in {channel}: {pairs} differ.");
    }
    text.truncate(text.trim_end().len());
    text
}
