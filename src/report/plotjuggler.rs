//! A layout for PlotJuggler: plots of reference, engine and errors. The layout also loads the recording.

use std::path::Path;

use super::html::{escaped, filled};
use recording::{Line, Numbers, Plot};

/// The layout of a recording as XML. `file` is the recording, relative to the layout or absolute.
pub(crate) fn text(numbers: &Numbers, file: &Path) -> String {
    let (file, topics) = (escaped(&file.display().to_string()), escaped(&numbers.topics.join(";")));
    let slots = [("plots", &*plots(&numbers.plots)), ("file", &*file), ("topics", &*topics)];
    filled(include_str!("plotjuggler.xml"), &slots)
}

/// The plots, one below the other.
/// Without plots the text is empty, because PlotJuggler exits on a layout whose area is divided among no plots.
fn plots(plots: &[Plot]) -> String {
    let count = plots.len();
    if count == 0 {
        return String::new();
    }
    let sizes = vec![(1.0 / count as f64).to_string(); count].join(";");
    let areas: String = plots.iter().map(area).collect();
    let slots = [("count", &*count.to_string()), ("sizes", &*sizes), ("areas", &*areas)];
    filled(include_str!("plotjuggler_plots.xml"), &slots)
}

/// One plot; its lines have the same width, and the last line is in front.
fn area(plot: &Plot) -> String {
    let curves: String = plot.lines.iter().map(curve).collect();
    let slots = [("title", &*escaped(&plot.title)), ("curves", &*curves)];
    filled(include_str!("plotjuggler_plot.xml"), &slots)
}

fn curve(line: &Line) -> String {
    const COLOURS: [&str; 4] = ["#56b4e9", "#e67800", "#009e73", "#cc79a7"];
    let colour = line.side.map_or("#c0392b", |side| COLOURS[side % COLOURS.len()]);
    let name = escaped(&format!("{}/{}", line.topic, line.field));
    format!("       <curve name=\"{name}\" color=\"{colour}\"/>\n")
}
