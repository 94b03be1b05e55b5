//! Tables and cells that several reports use.

use comfy_table::{CellAlignment, Table, presets};

use crate::compare::Verdict;
use crate::proof::ChannelProof;

/// An empty table without lines; the columns in `numbers` are aligned right.
pub(super) fn table<const N: usize>(header: [&str; N], numbers: &[usize]) -> Table {
    let mut table = Table::new();
    table.load_style(presets::NOTHING).set_header(header);
    for &index in numbers {
        if let Some(column) = table.column_mut(index) {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
    table
}

/// Share of its bound that a channel uses. A verdict other than agreement counts more than any share.
pub(super) fn used(channel: &ChannelProof) -> f64 {
    let share = if channel.residual.max == 0.0 { 0.0 } else { channel.residual.max / channel.bound };
    match channel.verdict {
        Verdict::Agree { .. } | Verdict::Expected { .. } => share,
        Verdict::Inconclusive { .. } => 1e3 + share,
        Verdict::Disagree { .. } => 1e6 + share,
    }
}

pub(super) fn share(value: f64, scale: f64) -> String {
    if value == 0.0 { "0".into() } else { format!("{:.1e}", value / scale) }
}
