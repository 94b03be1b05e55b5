//! A moving picture as JSON, for programs that write it for a viewer.

use serde_json::{Map, Value, json};

use super::layout::{height, speed};
use recording::{Film, Part};

/// The film as JSON: places in m, angles in rad, times in simulated seconds.
pub(crate) fn text(film: &Film) -> String {
    let view = &film.view;
    let centre = (view.corners[0] + view.corners[1]) / 2.0;
    let plots = view.plots.iter().zip(&film.values).map(|(plot, values)| {
        let lines = plot.lines.iter().zip(values);
        let lines = lines.map(|(line, values)| json!({ "label": line.label, "side": line.side, "values": values }));
        json!({ "title": plot.title, "lines": lines.collect::<Vec<Value>>() })
    });
    let document = json!({
        "name": view.name,
        "centre": [centre.x, centre.y],
        "height": height(view),
        "speed": speed(view.slow, view.turn) / view.slow,
        "times": film.times,
        "poses": film.poses.iter().map(|(name, poses)| (name.clone(), json!(poses))).collect::<Map<_, _>>(),
        "parts": film.parts.iter().map(part).collect::<Vec<Value>>(),
        "arrows": film.arrows.iter().map(|(name, rows)| (name.clone(), json!(rows))).collect::<Map<_, _>>(),
        "plots": plots.collect::<Vec<Value>>(),
    });
    document.to_string()
}

fn part(part: &Part) -> Value {
    let lines = part.lines.iter();
    let lines =
        lines.map(|(points, thickness, rgba)| json!({ "points": points, "thickness": thickness, "rgba": rgba }));
    let discs = part.discs.iter().map(|(at, radius, rgba)| json!({ "at": at, "radius": radius, "rgba": rgba }));
    let areas = part.areas.iter().map(|(points, rgba)| json!({ "points": points, "rgba": rgba }));
    let texts = part.texts.iter().map(|(at, text)| json!({ "at": at, "text": text }));
    json!({
        "frame": part.frame,
        "lines": lines.collect::<Vec<Value>>(),
        "discs": discs.collect::<Vec<Value>>(),
        "areas": areas.collect::<Vec<Value>>(),
        "texts": texts.collect::<Vec<Value>>(),
    })
}
