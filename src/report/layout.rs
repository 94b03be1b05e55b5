//! A layout for Foxglove and Lichtblick: the mechanism from above, beside plots of reference, engine and errors.
//! The function `film` gives the same content as JSON, for programs that convert a recording for other viewers.

use serde_json::{Map, Value, json};

use super::pretty::{list, pretty};
use linkage::math::KeepNan;
use recording::{DrawnLink, Film, Line, Plot, View};

/// Playback speeds that the viewers offer.
const SPEEDS: [f64; 8] = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 0.8, 1.0];
/// Shortest duration of a revolution that the eye can follow (s).
pub(super) const TURN: f64 = 4.0;
/// Size of the picture divided by the size of the mechanism, in the direction in which the mechanism fills more of it.
const ROOM: f64 = 1.25;
/// Ratio of width to height of the panel with the picture.
const WIDE: f64 = 1.1;

/// The layout as JSON.
pub(crate) fn text(view: &View) -> String {
    let mut panels = json!({ "3D!mechanism": picture(view) });
    let names: Vec<String> = (0..view.plots.len()).map(|number| format!("Plot!{number}")).collect();
    for (name, plot) in names.iter().zip(&view.plots) {
        panels[name] = graph(plot);
    }
    let picture = Value::from("3D!mechanism");
    let layout = match column(&names) {
        Some(column) => json!({ "direction": "row", "first": picture, "second": column, "splitPercentage": 60 }),
        None => picture,
    };
    pretty(&json!({
        "configById": panels, "globalVariables": {}, "userNodes": {},
        "playbackConfig": { "speed": speed(view.slow, view.turn) }, "layout": layout,
    }))
}

/// Playback speed of a recording with the time scale `slow`; `turn` is the log time of a revolution (s).
/// With `slow` = 1, this is the largest of [`SPEEDS`] at which people can follow a revolution. Otherwise it is 1.
pub(crate) fn speed(slow: f64, turn: f64) -> f64 {
    if slow != 1.0 {
        return 1.0;
    }
    SPEEDS.into_iter().rev().find(|speed| turn / speed >= TURN).unwrap_or(SPEEDS[0])
}

/// Height of the view (m).
pub(crate) fn height(view: &View) -> f64 {
    let size = view.corners[1] - view.corners[0];
    ROOM * size.y.larger(size.x / WIDE)
}

/// The panel with the mechanism: parallel projection from above.
/// The panel shows the whole mechanism; the axes and the names of frames are hidden.
fn picture(view: &View) -> Value {
    let [low, high] = view.corners;
    let (centre, height) = ((low + high) / 2.0, height(view));
    let hidden = |frame: &String| (format!("frame:{frame}"), json!({ "visible": false }));
    let frames: Map<String, Value> = view.frames.iter().map(hidden).chain([hidden(&"world".into())]).collect();
    let mut topics = json!({ "/mechanism/links": { "visible": true }, "/robot_description": { "visible": false } });
    if view.forces {
        topics["/mechanism/forces"] = json!({ "visible": true });
    }
    json!({
        "foxglovePanelTitle": view.name, "lichtblickPanelTitle": view.name,
        "cameraState": {
            "perspective": false, "distance": height, "phi": 0, "thetaOffset": 0,
            "targetOffset": [centre.x, centre.y, 0], "target": [0, 0, 0], "targetOrientation": [0, 0, 0, 1],
            "fovy": 45, "near": 0.01 * height, "far": 100.0 * height,
        },
        "followMode": "follow-none", "followTf": "world",
        "scene": { "transforms": {
            "showLabel": false, "labelSize": 0.02 * height, "axisScale": 0.05 * height, "lineWidth": 0,
            // The viewer loads all poses at once, so that the picture is correct after a jump backwards.
            "enablePreloading": true,
        } },
        "transforms": frames, "topics": topics, "layers": {},
    })
}

fn graph(plot: &Plot) -> Value {
    json!({
        "foxglovePanelTitle": plot.title, "lichtblickPanelTitle": plot.title, "title": plot.title,
        // The viewer draws the first path of the list last, so the list is reversed. The engines are then in front of
        // the reference.
        "paths": list(plot.lines.iter().rev(), path), "showXAxisLabels": true, "showYAxisLabels": true,
        "showLegend": plot.lines.len() > 1, "legendDisplay": "floating", "showPlotValuesInLegend": false,
        "isSynced": true, "xAxisVal": "timestamp", "sidebarDimension": 240,
    })
}

/// A line of a plot, as in the picture: the reference is broad and pale; each engine is thin and in front of the
/// reference.
fn path(line: &Line) -> Value {
    let width = if line.side == Some(0) { 5.0 } else { 1.5 };
    // The title names the quantity, so the label names only the side: a long label would cover the curve.
    let side = line.side.and_then(|_| line.topic.split('/').nth(1));
    json!({
        "value": format!("{}.{}", quoted(&line.topic), line.field), "label": side.unwrap_or(&line.label),
        "enabled": true, "timestampMethod": "receiveTime", "color": colour(line.side), "lineSize": width,
        "showLine": true,
    })
}

/// Colour of a line that shows a side; 0 is the reference. `None`: colour of a line that shows an error.
fn colour(side: Option<usize>) -> &'static str {
    // Viewers draw samples as dots, which are darker than the line on a light background and lighter on a dark one.
    // The colours of this list suit both backgrounds.
    const COLOURS: [&str; 4] = ["#56b4e9", "#ff9f40", "#5fd3ae", "#cc79a7"];
    side.map_or("#9a9a9a", |side| COLOURS[side % COLOURS.len()])
}

/// A topic in message paths: quoted if it has characters other than letters, digits, `_`, `-` and `/`.
fn quoted(topic: &str) -> String {
    let plain = |sign: char| sign.is_ascii_alphanumeric() || matches!(sign, '_' | '-' | '/');
    match topic.chars().all(plain) {
        true => topic.into(),
        false => format!("\"{}\"", topic.replace('\\', "\\\\").replace('"', "\\\"")),
    }
}

/// Panels of equal height, one below the other.
fn column(names: &[String]) -> Option<Value> {
    let (first, rest) = names.split_first()?;
    Some(match column(rest) {
        None => Value::from(first.as_str()),
        Some(below) => {
            let share = 100.0 / names.len() as f64;
            json!({ "direction": "column", "first": first, "second": below, "splitPercentage": share })
        }
    })
}

/// A film as JSON, for programs that convert it for a viewer.
/// Positions are in m, angles in rad, times in simulated seconds.
pub(crate) fn film(film: &Film) -> String {
    let view = &film.view;
    let centre = (view.corners[0] + view.corners[1]) / 2.0;
    let plots = list(view.plots.iter().zip(&film.values), |(plot, values)| {
        let lines = list(
            plot.lines.iter().zip(values),
            |(line, values)| json!({ "label": line.label, "side": line.side, "values": values }),
        );
        json!({ "title": plot.title, "lines": lines })
    });
    let document = json!({
        "name": view.name, "centre": [centre.x, centre.y], "height": height(view),
        "speed": speed(view.slow, view.turn) / view.slow, "times": film.times, "plots": plots,
        "poses": film.poses.iter().map(|(name, poses)| (name.clone(), json!(poses))).collect::<Value>(),
        "parts": list(&film.parts, part),
        "arrows": film.arrows.iter().map(|(name, rows)| (name.clone(), json!(rows))).collect::<Value>(),
    });
    document.to_string()
}

fn part(part: &DrawnLink) -> Value {
    json!({
        "frame": part.frame,
        "lines": list(&part.lines, |(points, thickness, rgba)| {
            json!({ "points": points, "thickness": thickness, "rgba": rgba })
        }),
        "discs": list(&part.discs, |(at, radius, rgba)| json!({ "at": at, "radius": radius, "rgba": rgba })),
        "areas": list(&part.areas, |(points, rgba)| json!({ "points": points, "rgba": rgba })),
        "texts": list(&part.texts, |(at, text)| json!({ "at": at, "text": text })),
    })
}
