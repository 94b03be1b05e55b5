//! A recording as a moving picture, read back for viewers that know none of its messages.

use super::extent::{corners, placed};
use super::numbers::plotted;
use super::view::{View, turn};
use super::{beside, messages, read, schema};
use crate::viewers::{Color, FrameTransforms, LineType, Point3, Pose, SceneEntity, SceneUpdate};
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::unit;
use mcap::{McapError, Message};
use prost::Message as _;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// Longest message of a picture (bytes), and most parts of all of them, that are looked into: far more than a viewer can
/// show. Parts take up to a hundred times their bytes in memory.
const LONGEST: usize = 1 << 22;
const PARTS: usize = 2_000_000;

/// A recording as a moving picture. Times are simulated ones (s).
#[derive(Clone, Debug)]
pub struct Film {
    /// What to show first.
    pub view: View,
    /// The drawing of every link, in its frame.
    pub parts: Vec<Part>,
    /// Times of the poses.
    pub times: Vec<f64>,
    /// For every frame its place (m) and angle (rad) at these times.
    pub poses: BTreeMap<String, Vec<[f64; 3]>>,
    /// For every arrow its time, its foot (m) and what leads to its tip (m).
    pub arrows: BTreeMap<String, Vec<[f64; 5]>>,
    /// For every line of every plot its times and values.
    pub values: Vec<Vec<Vec<[f64; 2]>>>,
}

/// The drawing of a link, in the frame of this name.
#[derive(Clone, Debug, Default)]
pub struct Part {
    /// Its frame: of a link, or "world".
    pub frame: String,
    /// Lines: corners (m), thickness (m), colour.
    pub lines: Vec<(Vec<[f64; 3]>, f64, [u8; 4])>,
    /// Discs: centre (m), radius (m), colour.
    pub discs: Vec<([f64; 3], f64, [u8; 4])>,
    /// Triangles, three corners each (m), and their colour.
    pub areas: Vec<(Vec<[f64; 3]>, [u8; 4])>,
    /// Letters and their places (m).
    pub texts: Vec<([f64; 3], String)>,
}

/// What is read of a file.
#[derive(Default)]
struct Found {
    topics: BTreeSet<String>,
    links: Option<SceneUpdate>,
    frames: Vec<(u64, FrameTransforms)>,
    arrows: Vec<(u64, SceneUpdate)>,
    /// Number of all frames and arrows.
    parts: usize,
}

/// Reads a recording as a moving picture.
///
/// # Errors
/// Those of [`load`](super::load); [`ErrorKind::Input`](linkage::ErrorKind::Input) if it has no picture.
pub fn film(path: &Path) -> Result<Film> {
    let bytes = read::bytes(path)?;
    let sides = read::of_bytes(&bytes, path)?;
    let damaged = |error: McapError| {
        Error::new(ErrorKind::Io, format!("the recording {} is damaged: {error}", path.display()))
            .help("record it again")
    };
    let metadata = beside::described(&bytes).map(|(_, metadata)| metadata).unwrap_or_default();
    let number = |key: &str, usual: f64| metadata.get(key).and_then(|text| text.parse().ok()).unwrap_or(usual);
    let (slow, zero) = (number("slow", 1.0), number("log_time_zero_s", 0.0));
    let time = |nanoseconds: u64| zero + nanoseconds as f64 * 1e-9 / slow;

    let mut found = Found::default();
    messages::each::<McapError>(&bytes, &mut |message| {
        found.take(message);
        Ok(())
    })
    .map_err(damaged)?;
    let Some(links) = found.links.filter(|_| !found.frames.is_empty()) else {
        let message = format!("the recording {} has no picture: no positions were recorded", path.display());
        return Err(Error::new(ErrorKind::Input, message).help("record the scenario again with its positions"));
    };
    let plots = plotted(&sides, &found.topics);
    let lasts = found.frames.last().map_or(0.0, |(last, _)| *last as f64 * 1e-9);
    let mut poses: BTreeMap<String, Vec<[f64; 3]>> = BTreeMap::new();
    for frame in found.frames.iter().flat_map(|(_, frames)| &frames.transforms) {
        let (at, turn) = (frame.translation.unwrap_or_default(), frame.rotation.unwrap_or_default());
        let pose = [at.x, at.y, 2.0 * turn.z.atan2(turn.w)];
        poses.entry(frame.child_frame_id.clone()).or_default().push(pose);
    }
    let mut arrows: BTreeMap<String, Vec<[f64; 5]>> = BTreeMap::new();
    for (at, entity) in found.arrows.iter().flat_map(|(at, update)| update.entities.iter().map(move |own| (at, own))) {
        for arrow in &entity.arrows {
            let (foot, turn) = placed(arrow.pose.as_ref());
            let tip = unit(turn) * (arrow.shaft_length + arrow.head_length);
            arrows.entry(entity.id.clone()).or_default().push([time(*at), foot.x, foot.y, tip.x, tip.y]);
        }
    }
    let view = View {
        name: metadata.get("scenario").cloned().unwrap_or_else(|| "recording".into()),
        corners: corners(&links, found.frames.iter().map(|(_, frames)| frames.clone())),
        frames: poses.keys().cloned().collect(),
        forces: !arrows.is_empty(),
        slow,
        turn: sides.first().map_or(lasts, |(_, trajectory)| turn(lasts, trajectory)),
        plots,
    };
    let values = values(&bytes, &view, &time).map_err(damaged)?;
    let times = found.frames.iter().map(|(at, _)| time(*at)).collect();
    Ok(Film { parts: links.entities.iter().map(part).collect(), times, poses, arrows, values, view })
}

impl Found {
    fn take(&mut self, message: &Message) {
        let topic = message.channel.topic.as_str();
        if !self.topics.contains(topic) {
            self.topics.insert(topic.into());
        }
        // What cannot be read is not shown.
        match topic {
            _ if message.data.len() > LONGEST || self.parts > PARTS => {}
            "/mechanism/links" => self.links = SceneUpdate::decode(&*message.data).ok(),
            "/tf" => {
                let own = FrameTransforms::decode(&*message.data).ok();
                self.parts += own.as_ref().map_or(0, |own| own.transforms.len());
                self.frames.extend(own.map(|own| (message.log_time, own)));
            }
            "/mechanism/forces" => {
                let own = SceneUpdate::decode(&*message.data).ok();
                self.parts += own.iter().flat_map(|own| &own.entities).map(|own| 1 + own.arrows.len()).sum::<usize>();
                self.arrows.extend(own.map(|own| (message.log_time, own)));
            }
            _ => {}
        }
    }
}

/// Times and values of every line of every plot.
fn values(bytes: &[u8], view: &View, time: &dyn Fn(u64) -> f64) -> mcap::McapResult<Vec<Vec<Vec<[f64; 2]>>>> {
    let mut known = schema::Names::default();
    let mut values: Vec<Vec<Vec<[f64; 2]>>> =
        view.plots.iter().map(|plot| vec![Vec::new(); plot.lines.len()]).collect();
    messages::each::<McapError>(bytes, &mut |message| {
        for (plot, values) in view.plots.iter().zip(&mut values) {
            for (line, values) in plot.lines.iter().zip(values) {
                if line.topic != message.channel.topic {
                    continue;
                }
                let Some(schema) = &message.channel.schema else { continue };
                let Ok(names) = known.of(schema) else { continue };
                let fields = schema::numbers(&message.data).unwrap_or_default();
                let own = fields.iter().find(|(tag, _)| names.get(tag) == Some(&line.field));
                values.extend(own.map(|&(_, value)| [time(message.log_time), value]));
            }
        }
        Ok(())
    })?;
    Ok(values)
}

fn part(entity: &SceneEntity) -> Part {
    let height = |pose: Option<&Pose>| pose.and_then(|pose| pose.position).map_or(0.0, |at| at.z);
    let colour = |colour: Option<&Color>| {
        colour.map_or([128, 128, 128, 255], |Color { r, g, b, a }| [r, g, b, a].map(|part| (part * 255.0) as u8))
    };
    let raised = |points: &[Point3], z: f64| points.iter().map(|at| [at.x, at.y, at.z + z]).collect::<Vec<_>>();
    let at = |pose: Option<&Pose>| {
        let place = placed(pose).0;
        [place.x, place.y, height(pose)]
    };
    let lines = entity.lines.iter().map(|line| {
        let mut points = raised(&line.points, height(line.pose.as_ref()));
        if line.r#type == LineType::LineLoop as i32 {
            points.extend(points.first().copied());
        }
        (points, line.thickness, colour(line.color.as_ref()))
    });
    let round = entity.cylinders.iter().map(|own| (&own.pose, &own.size, &own.color));
    let balls = entity.spheres.iter().map(|own| (&own.pose, &own.size, &own.color));
    let discs = round
        .chain(balls)
        .map(|(pose, size, own)| (at(pose.as_ref()), size.map_or(0.0, |size| size.x / 2.0), colour(own.as_ref())));
    let areas = entity.triangles.iter();
    let areas = areas.map(|own| (raised(&own.points, height(own.pose.as_ref())), colour(own.color.as_ref())));
    Part {
        frame: entity.frame_id.clone(),
        lines: lines.collect(),
        discs: discs.collect(),
        areas: areas.collect(),
        texts: entity.texts.iter().map(|text| (at(text.pose.as_ref()), text.text.clone())).collect(),
    }
}
