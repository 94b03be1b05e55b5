//! A layout for PlotJuggler, which reads the recording by itself: plots of both sides and of their errors.

use std::path::Path;

use super::html::escaped;
use recording::{Line, Numbers, Plot};

/// The layout of a recording as XML. `file` is the recording, relative to the layout or absolute.
pub(crate) fn text(numbers: &Numbers, file: &Path) -> String {
    let tab = tab(&numbers.plots);
    let file = escaped(&file.display().to_string());
    let topics = escaped(&numbers.topics.join(";"));
    format!(
        r#"<?xml version="1.0" encoding="UTF-8"?>
<root>
{tab} <previouslyLoaded_Datafiles>
  <fileInfo filename="{file}" prefix="">
   <plugin ID="DataLoad MCAP">
    <parameters use_timestamp="0" use_mcap_log_time="1" clamp_large_arrays="0" max_array_size="500" selected_topics="{topics}"/>
   </plugin>
  </fileInfo>
 </previouslyLoaded_Datafiles>
</root>
"#
    )
}

/// The plots below each other; nothing if there are none, for PlotJuggler ends when it has to divide nothing.
fn tab(plots: &[Plot]) -> String {
    let count = plots.len();
    if count == 0 {
        return String::new();
    }
    let sizes = vec![(1.0 / count as f64).to_string(); count].join(";");
    let areas: String = plots.iter().map(area).collect();
    format!(
        r#" <tabbed_widget name="Main Window" parent="main_window">
  <Tab containers="1" tab_name="values and errors">
   <Container>
    <DockSplitter orientation="-" count="{count}" sizes="{sizes}">
{areas}    </DockSplitter>
   </Container>
  </Tab>
  <currentTabIndex index="0"/>
 </tabbed_widget>
"#
    )
}

/// One plot. Its lines all have one width, and the last is in front.
fn area(plot: &Plot) -> String {
    let curves: String = plot.lines.iter().map(curve).collect();
    let title = escaped(&plot.title);
    format!(
        "     <DockArea name=\"{title}\">\n      \
         <plot mode=\"TimeSeries\" style=\"Lines\" line_width=\"1.5\" flip_x=\"false\" flip_y=\"false\">\n\
         {curves}      </plot>\n     </DockArea>\n"
    )
}

fn curve(line: &Line) -> String {
    const COLOURS: [&str; 4] = ["#56b4e9", "#e67800", "#009e73", "#cc79a7"];
    let colour = line.side.map_or("#c0392b", |side| COLOURS[side % COLOURS.len()]);
    let name = escaped(&format!("{}/{}", line.topic, line.field));
    format!("       <curve name=\"{name}\" color=\"{colour}\"/>\n")
}
