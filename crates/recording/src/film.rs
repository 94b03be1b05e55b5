//! Reads a recording for viewers that cannot decode its messages. The result is a moving picture, or only numbers.

use super::extent::{corners, placed};
use super::recording::RecordedSide;
use super::shapes::rgba;
use super::table::topic_name;
use super::view::{Plot, View, plots, turn};
use super::{beside, messages, read, schema};
use crate::sentences;
use crate::viewers::{FrameTransforms, LineType, Pose, SceneEntity, SceneUpdate, Vector3};
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::unit;
use linkage::mechanism::LinkPose;
use linkage::trajectory::{Channel, Trajectory};
use mcap::Message;
use prost::Message as _;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// `LONGEST` is the size of the largest message that is decoded (bytes).
/// `PARTS` limits the number of parts in all messages together.
/// Both limits are far beyond what a viewer can show.
/// The limits are needed because a part in memory takes up to a hundred times its size in the file.
const LONGEST: usize = 1 << 22;
const PARTS: usize = 2_000_000;

/// A recording as a moving picture. Times are simulated times (s).
#[derive(Clone, Debug)]
pub struct Film {
    /// Initial display.
    pub view: View,
    /// The drawing of every link, in the link's frame.
    pub parts: Vec<DrawnLink>,
    /// Times of the poses.
    pub times: Vec<f64>,
    /// For the frame of every link: positions (m) and angles (rad) at the times of the film.
    pub poses: BTreeMap<String, Vec<[f64; 3]>>,
    /// For every arrow: time, foot (m), and vector from foot to tip (m).
    pub arrows: BTreeMap<String, Vec<[f64; 5]>>,
    /// Times and values, for every line of every plot.
    pub values: Vec<Vec<Vec<[f64; 2]>>>,
}

/// The drawing of a link, in the named frame.
#[derive(Clone, Debug, Default)]
pub struct DrawnLink {
    /// Name of the frame in which the drawing is given: the frame of a link, or "world".
    pub frame: String,
    /// Lines: corners (m), thickness (m), colour.
    pub lines: Vec<(Vec<[f64; 3]>, f64, [u8; 4])>,
    /// Discs: centre (m), radius (m), colour.
    pub discs: Vec<([f64; 3], f64, [u8; 4])>,
    /// Triangles: three corners for each triangle (m), and the colour of the triangles.
    pub areas: Vec<(Vec<[f64; 3]>, [u8; 4])>,
    /// Texts and their positions (m).
    pub texts: Vec<([f64; 3], String)>,
}

/// The parts of a recording that a film needs.
#[derive(Default)]
struct Found {
    topics: BTreeSet<String>,
    links: Option<SceneUpdate>,
    frames: Vec<(u64, FrameTransforms)>,
    arrows: Vec<(u64, SceneUpdate)>,
    /// Number of frames, scene entities and arrows read so far.
    parts: usize,
}

/// Reads a recording as a moving picture.
///
/// # Errors
/// The errors of [`load`](super::load); [`ErrorKind::Input`](linkage::ErrorKind::Input) if there is no picture.
pub fn film(path: &Path) -> Result<Film> {
    let bytes = read::bytes(path)?;
    let sides = read::read_bytes(&bytes, path)?;
    let metadata = beside::described(&bytes).map(|(_, metadata)| metadata).unwrap_or_default();
    let number = |key: &str, usual: f64| metadata.get(key).and_then(|text| text.parse().ok()).unwrap_or(usual);
    let (slow, zero) = (number("slow", 1.0), number("log_time_zero_s", 0.0));
    let time = |nanoseconds: u64| zero + nanoseconds as f64 * 1e-9 / slow;

    let mut found = Found::default();
    messages::each(&bytes, path, |message| {
        found.take(message);
        Ok(())
    })?;
    let Some(links) = found.links.filter(|_| !found.frames.is_empty()) else {
        let message = sentences::the_recording_has_no_picture(&path.display());
        return Err(Error::new(ErrorKind::Input, message).help(sentences::RECORD_THE_SCENARIO_AGAIN_WITH_ITS_POSITIONS));
    };
    let plots = plotted(&sides, &found.topics);
    let lasts = found.frames.last().map_or(0.0, |(last, _)| *last as f64 * 1e-9);
    let mut poses: BTreeMap<String, Vec<[f64; 3]>> = BTreeMap::new();
    for frame in found.frames.iter().flat_map(|(_, frames)| &frames.transforms) {
        let LinkPose { origin, angle } = frame.pose();
        poses.entry(frame.child_frame_id.clone()).or_default().push([origin.x, origin.y, angle]);
    }
    let mut arrows: BTreeMap<String, Vec<[f64; 5]>> = BTreeMap::new();
    for (at, entity) in found.arrows.iter().flat_map(|(at, update)| update.entities.iter().map(move |own| (at, own))) {
        for arrow in &entity.arrows {
            let LinkPose { origin: foot, angle } = placed(arrow.pose);
            let tip = unit(angle) * (arrow.shaft_length + arrow.head_length);
            arrows.entry(entity.id.clone()).or_default().push([time(*at), foot.x, foot.y, tip.x, tip.y]);
        }
    }
    let view = View {
        name: metadata.get("scenario").cloned().unwrap_or_else(|| "recording".into()),
        corners: corners(&links, found.frames.iter().map(|(_, frames)| frames)),
        frames: poses.keys().cloned().collect(),
        forces: !arrows.is_empty(),
        slow,
        turn: sides.first().map_or(lasts, |(_, trajectory)| turn(lasts, trajectory)),
        plots,
    };
    let values = values(&bytes, path, &view, &time)?;
    let times = found.frames.iter().map(|(at, _)| time(*at)).collect();
    Ok(Film { parts: links.entities.iter().map(part).collect(), times, poses, arrows, values, view })
}

impl Found {
    fn take(&mut self, message: &Message) {
        let topic = message.channel.topic.as_str();
        if !self.topics.contains(topic) {
            self.topics.insert(topic.into());
        }
        // Messages that cannot be decoded are skipped.
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
fn values(bytes: &[u8], path: &Path, view: &View, time: &dyn Fn(u64) -> f64) -> Result<Vec<Vec<Vec<[f64; 2]>>>> {
    let mut known = schema::Names::default();
    let mut values: Vec<Vec<Vec<[f64; 2]>>> =
        view.plots.iter().map(|plot| vec![Vec::new(); plot.lines.len()]).collect();
    messages::each(bytes, path, |message| {
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

fn part(entity: &SceneEntity) -> DrawnLink {
    let height = |pose: Option<Pose>| pose.and_then(|pose| pose.position).map_or(0.0, |at| at.z);
    let raised = |points: &[Vector3], z: f64| points.iter().map(|at| [at.x, at.y, at.z + z]).collect::<Vec<_>>();
    let at = |pose: Option<Pose>| {
        let place = placed(pose).origin;
        [place.x, place.y, height(pose)]
    };
    let lines = entity.lines.iter().map(|line| {
        let mut points = raised(&line.points, height(line.pose));
        if line.r#type == LineType::LineLoop as i32 {
            points.extend(points.first().copied());
        }
        (points, line.thickness, rgba(line.color))
    });
    let round = entity.cylinders.iter().map(|own| (own.pose, own.size, own.color));
    let balls = entity.spheres.iter().map(|own| (own.pose, own.size, own.color));
    let disc =
        |(pose, size, color): (_, Option<Vector3>, _)| (at(pose), size.map_or(0.0, |size| size.x / 2.0), rgba(color));
    let areas = entity.triangles.iter().map(|own| (raised(&own.points, height(own.pose)), rgba(own.color)));
    DrawnLink {
        frame: entity.frame_id.clone(),
        lines: lines.collect(),
        discs: round.chain(balls).map(disc).collect(),
        areas: areas.collect(),
        texts: entity.texts.iter().map(|text| (at(text.pose), text.text.clone())).collect(),
    }
}

/// The numbers of a recording.
#[derive(Clone, Debug)]
pub struct Numbers {
    /// Topics of the sides and of their errors.
    pub topics: Vec<String>,
    /// Plots in order of importance. For each quantity, a plot of the values of all sides comes before the plot of the
    /// errors.
    pub plots: Vec<Plot>,
}

/// Lists the numbers that a recording contains.
///
/// # Errors
/// The errors of [`load`](super::load).
pub fn numbers(path: &Path) -> Result<Numbers> {
    let bytes = read::bytes(path)?;
    let sides = read::read_bytes(&bytes, path)?;
    let mut topics = BTreeSet::new();
    messages::each(&bytes, path, |message| {
        let topic = message.channel.topic.as_str();
        let side = topic.strip_prefix('/').and_then(|rest| rest.split_once('/')).map(|(side, _)| side);
        if side.is_some_and(|side| side == "error" || sides.iter().any(|(own, _)| own == side)) {
            topics.insert(topic.to_string());
        }
        Ok(())
    })?;
    Ok(Numbers { plots: plotted(&sides, &topics), topics: topics.into_iter().collect() })
}

/// Plots of the sides, and of the errors that have a topic in the recording.
fn plotted(sides: &[(String, Trajectory)], topics: &BTreeSet<String>) -> Vec<Plot> {
    let named: Vec<RecordedSide> = sides.iter().map(|(name, trajectory)| RecordedSide { name, trajectory }).collect();
    let errors: Vec<Channel> = (named.first().iter().flat_map(|side| side.trajectory.channels()))
        .filter(|channel| topics.contains(&topic_name("error", channel.kind.subject, &channel.of)))
        .cloned()
        .collect();
    plots(&named, &errors)
}
