//! Initial display of a viewer: the area of the mechanism, the playback speed, and the numbers to plot.

use super::extent::corners;
use super::pour::lasts;
use super::recording::{RecordedSide, Recording};
use super::schema::small_unit;
use super::table::topic_name;
use super::write::as_shown;
use crate::sentences;
use crate::viewers::FrameTransforms;
use linkage::math::Vec2;
use linkage::math::statistics::ends;
use linkage::trajectory::{Channel, ChannelKind, Trajectory, Unit};

/// Number of poses from which the area of the mechanism is determined.
const POSES: usize = 100;

/// Initial display of a viewer.
#[derive(Clone, Debug, PartialEq)]
pub struct View {
    /// Name of the scenario.
    pub name: String,
    /// Lower left and upper right corner of the drawing, over the whole motion (m).
    pub corners: [Vec2; 2],
    /// Names of the links' frames.
    pub frames: Vec<String>,
    /// Whether reactions are recorded as arrows.
    pub forces: bool,
    /// Factor by which playback is slower than the simulation.
    pub slow: f64,
    /// Log time of one revolution of the crank (s). If the recording is shorter than a revolution, its duration is
    /// used.
    pub turn: f64,
    /// Plots in order of importance. For each quantity, a plot of the values of all sides comes before the plot of the
    /// errors.
    pub plots: Vec<Plot>,
}

/// A plot over time.
#[derive(Clone, Debug, PartialEq)]
pub struct Plot {
    /// The plotted quantity and its unit.
    pub title: String,
    /// Lines of the plot.
    pub lines: Vec<Line>,
}

/// A line of a plot.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// Topic of the line's numbers.
    pub topic: String,
    /// Field of the line's numbers in the messages of the topic.
    pub field: String,
    /// Name of the line.
    pub label: String,
    /// Index of the side; 0 is the reference. `None` for errors.
    pub side: Option<usize>,
}

/// Initial display of a recording; `None` if the recording has no positions.
#[must_use]
pub fn view(recording: &Recording) -> Option<View> {
    as_shown(recording, |recording, drawn| {
        let scene = drawn.scene.as_ref()?;
        let links = scene.links();
        let times = scene.times(recording.show.slow);
        let times = times.iter().step_by(times.len() / POSES + 1);
        let frames: Vec<FrameTransforms> = times.map(|&time| scene.frames(time, 0)).collect();
        let lasts = lasts(recording) * recording.show.slow;
        let errors: Option<Vec<Channel>> = recording.errors.map(|errors| errors.channels().to_vec());
        Some(View {
            name: recording.name.into(),
            corners: corners(&links, frames.iter()),
            frames: frames.first()?.transforms.iter().map(|frame| frame.child_frame_id.clone()).collect(),
            forces: drawn.forces.is_some(),
            slow: recording.show.slow,
            turn: turn(lasts, recording.sides[0].trajectory),
            plots: plots(recording.sides, errors.as_deref().unwrap_or_default()),
        })
    })
}

/// Log time of one revolution in a recording of duration `lasts`, at most `lasts`.
pub(super) fn turn(lasts: f64, trajectory: &Trajectory) -> f64 {
    let turns = (range(trajectory.inputs()) / std::f64::consts::TAU).round();
    if turns >= 1.0 { lasts / turns } else { lasts }
}

/// Plots of the two most informative channels, and of their errors if they are recorded.
pub(super) fn plots(sides: &[RecordedSide], errors: &[Channel]) -> Vec<Plot> {
    let mut plots = Vec::new();
    let Some(first) = sides.first() else { return plots };
    for channel in telling(first.trajectory) {
        let (of, kind) = (&channel.of, channel.kind);
        let has = |side: &RecordedSide| side.trajectory.column(channel).is_some();
        let line = |(number, side): (usize, &RecordedSide)| Line {
            topic: topic_name(side.name, kind.subject, of),
            field: kind.suffix.into(),
            label: format!("{} {channel}", side.name),
            side: Some(number),
        };
        let lines = sides.iter().enumerate().filter(|(_, side)| has(side)).map(line).collect();
        plots.push(Plot { title: channel.to_string(), lines });
        if errors.contains(channel) {
            let field = small_unit(kind).0;
            let title = sentences::error_of(&channel.subject(), &field);
            let topic = topic_name("error", kind.subject, of);
            plots.push(Plot { lines: vec![Line { topic, field, label: title.clone(), side: None }], title });
        }
    }
    plots
}

/// The two most informative channels, which have different units.
/// The order of preference is: moment of a drive, largest reaction, accelerations, velocities, positions.
fn telling(trajectory: &Trajectory) -> Vec<&Channel> {
    let place = |unit: Unit| match unit {
        Unit::NewtonMetre => 0,
        Unit::Newton => 1,
        Unit::RadianPerSecondSquared => 2,
        Unit::MetrePerSecondSquared => 3,
        Unit::RadianPerSecond => 4,
        Unit::MetrePerSecond => 5,
        Unit::Metre => 6,
        Unit::Radian => 7,
    };
    let mut units: Vec<Unit> = trajectory.channels().iter().map(|channel| channel.kind.unit).collect();
    units.sort_by_key(|&unit| place(unit));
    units.dedup();
    // A drive's numbers rank first, because users look at them first.
    // The shaking force on the frame ranks last, because it is only a sum.
    let rank = |kind: &ChannelKind| match (kind.subject.is_drive(), kind.subject.is_whole()) {
        (true, _) => 0,
        (false, false) => 1,
        (false, true) => 2,
    };
    let of = |unit: Unit| {
        let own = || trajectory.iter().filter(|(channel, column)| channel.kind.unit == unit && range(column) > 0.0);
        let least = own().map(|(channel, _)| rank(channel.kind)).min()?;
        let best = own().filter(|(channel, _)| rank(channel.kind) == least);
        // If several channels have the largest range, the first of them is used.
        best.reduce(|best, next| if range(next.1) > range(best.1) { next } else { best }).map(|(channel, _)| channel)
    };
    units.into_iter().filter_map(of).take(2).collect()
}

fn range(column: &[f64]) -> f64 {
    let [low, high] = ends(column.iter().copied());
    high - low
}
