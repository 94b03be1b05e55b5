//! Figures of a proven motion, for reports.
//! All figures follow from the reference's trajectory, so no further solution is needed.

use super::Proof;
use super::reported_figure::ReportedFigure;
use crate::sentences;
use linkage::case::Case;
use linkage::drive::Drive;
use linkage::input::Input;
use linkage::math::{KeepNan, Vec2};
use linkage::mechanism::assembly::transmission_sine;
use linkage::mechanism::{GROUND, Group, JointKind, LinkId, LinkPose, Mechanism, Pose};
use linkage::trajectory::Trajectory;
use scenario::{CaseFigure, FigureKind, TRANSMISSION_ANGLE, TurnFigure};

/// Largest number of output links, and of drives, in the usual figures.
const OUTPUTS: usize = 2;
/// Number of joints with the largest forces in the usual figures.
const JOINTS: usize = 3;
/// Largest number of usual figures.
const MOST: usize = 10;
/// A joint force below this fraction of the largest joint force counts as zero.
const ROUNDING: f64 = 1e-9;
/// A link counts as turning fully if its range of rotation is at least this angle (deg).
const FULL_TURN: f64 = 359.9;

/// A usual figure: its label in words, and its text as in a scenario file.
struct Usual {
    label: String,
    figure: String,
}

impl Usual {
    fn of(label: String, figure: String) -> Usual {
        Usual { label, figure }
    }
}

impl Proof {
    /// The figures that the file requests in `[report]`, otherwise the usual figures of the mechanism.
    /// A figure is left out if its channels were not solved or if it has no value.
    #[must_use]
    pub fn figures(&self) -> Vec<ReportedFigure> {
        if !self.asked.is_empty() {
            let asked = self.asked.iter();
            return asked.filter_map(|own| self.found(own, own.text.clone())).collect();
        }
        let outputs = self.of_outputs();
        let drives = self.scene.case.drives.iter().enumerate().take(OUTPUTS);
        let of_drives = drives.flat_map(|(number, drive)| self.of_drive(number, drive));
        let mut found: Vec<ReportedFigure> = outputs.into_iter().chain(of_drives).collect();
        found.extend(self.of_joints());
        found.extend(self.usual(Usual::of(String::new(), TRANSMISSION_ANGLE.into())));
        found.extend(of_points(&self.scene.case.mechanism).into_iter().filter_map(|own| self.usual(own)));
        found.truncate(MOST);
        found
    }

    fn usual(&self, usual: Usual) -> Option<ReportedFigure> {
        let found = self.found(&CaseFigure::unchecked(&usual.figure).ok()?, usual.label)?;
        // A quantity that is zero at every instant, such as a force between massless links, is left out.
        (found.value != 0.0).then_some(found)
    }

    /// A figure of several channels (SI), combined instant by instant. The figure is not written as a formula, because
    /// a formula cannot contain all possible names of links.
    fn combined(
        &self,
        Usual { label, figure }: Usual,
        unit: &str,
        channels: &[String],
        combine: fn(&[f64]) -> f64,
    ) -> Option<ReportedFigure> {
        let run = &self.reference_trajectory;
        let columns = channels.iter().map(|name| run.named(name)).collect::<Option<Vec<_>>>()?;
        let at = |row: usize| combine(&columns.iter().map(|column| column[row]).collect::<Vec<_>>());
        let values: Vec<f64> = (0..run.times().len()).map(at).collect();
        let found = figure.parse::<TurnFigure>().ok()?.of(run, &values).ok()?;
        let reported = ReportedFigure { label, figure, value: found.value, unit: unit.into(), rows: found.rows };
        (reported.value != 0.0).then_some(reported)
    }

    fn found(&self, asked: &CaseFigure, label: String) -> Option<ReportedFigure> {
        let (case, run) = (&self.scene.case, &self.reference_trajectory);
        let unit = asked.unit(case, &self.formulas);
        let figure = asked.text.clone();
        if asked.kind == FigureKind::TransmissionAngle {
            let (sine, row, dyad) = smallest_sine(case, run)?;
            let label = if label.is_empty() { sentences::smallest_transmission_angle(&dyad) } else { label };
            return Some(ReportedFigure { label, figure, value: sine.asin().to_degrees(), unit, rows: vec![row] });
        }
        let (FigureKind::Turn(own) | FigureKind::Place(own)) = &asked.kind else { return None };
        let claim = asked.claim(case, &self.formulas).ok()??;
        let found = own.sampled(&claim, run).ok()?;
        let value = match (&asked.kind, found.rows.first()) {
            (FigureKind::Place(_), Some(row)) => run.input().shown(run.inputs()[*row]),
            _ => found.value,
        };
        Some(ReportedFigure { label, figure, value, unit, rows: found.rows })
    }

    /// Swing or stroke, and largest speed, of the output links: the links on the ground that have no drive of their
    /// own. If there is no such link, the driven links count as outputs.
    fn of_outputs(&self) -> Vec<ReportedFigure> {
        let case = &self.scene.case;
        let driven = |link: LinkId| {
            let mut drives = case.drives.iter();
            drives.any(|drive| {
                let joint = &case.mechanism.joints()[drive.joint];
                [drive.link, joint.first.link, joint.second.link].contains(&link)
            })
        };
        let on_ground = case
            .mechanism
            .joints()
            .iter()
            .filter(|joint| [joint.first, joint.second].iter().any(|side| side.link == GROUND));
        let moved = |joint: &&linkage::mechanism::Joint| {
            [joint.first, joint.second].map(|side| side.link).into_iter().find(|link| *link != GROUND)
        };
        let all: Vec<_> = on_ground.filter_map(|joint| Some((joint, moved(&joint)?))).collect();
        let free: Vec<_> = all.iter().filter(|(_, link)| !driven(*link)).copied().collect();
        let outputs = if free.is_empty() { all } else { free };
        let each = |(joint, link): (&linkage::mechanism::Joint, LinkId)| {
            let name = &case.mechanism.links()[link].name;
            match joint.kind {
                JointKind::Revolute => self.of_turning(name),
                JointKind::Prismatic { .. } => {
                    let joint = &joint.name;
                    let stroke = Usual::of(sentences::stroke_of(name), format!("range:joint.{joint}.slide_mm"));
                    let speed =
                        Usual::of(sentences::top_speed_of(name), format!("maxabs:joint.{joint}.slide_speed_m_s"));
                    [stroke, speed].into_iter().filter_map(|own| self.usual(own)).collect()
                }
            }
        };
        outputs.into_iter().take(OUTPUTS).flat_map(each).collect()
    }

    fn of_turning(&self, name: &str) -> Vec<ReportedFigure> {
        let crank = self.scene.case.crank();
        let driving = &self.scene.case.mechanism.links()[crank.link].name;
        let swing = self.usual(Usual::of(sentences::swing_of(&name), format!("range:link.{name}.angle_deg")));
        let turns = swing.as_ref().is_some_and(|own| own.value >= FULL_TURN);
        let first = match turns && crank.input == Input::Angle && driving != name {
            true => {
                let speeds = [name, driving].map(|link| format!("link.{link}.omega_rad_s"));
                let figure = format!("mean:{}", speeds.join(" / "));
                let usual = Usual::of(sentences::speed_ratio_of(&name, driving), figure);
                self.combined(usual, "", &speeds, |at| at[0] / at[1])
            }
            false => swing,
        };
        let speed = Usual::of(sentences::top_speed_of(&name), format!("maxabs:link.{name}.omega_rad_s"));
        first.into_iter().chain(self.usual(speed)).collect()
    }

    /// The joints with the largest forces.
    fn of_joints(&self) -> Vec<ReportedFigure> {
        let joints = self.scene.case.mechanism.joints().iter();
        let force = |joint: &linkage::mechanism::Joint| {
            self.usual(Usual::of(sentences::joint_force_in(&joint.name), format!("max:joint.{}.f_N", joint.name)))
        };
        let mut found: Vec<ReportedFigure> = joints.filter_map(force).collect();
        found.sort_by(|a, b| b.value.total_cmp(&a.value));
        // Forces that are zero except for rounding are left out.
        let least = ROUNDING * found.first().map_or(0.0, |own| own.value);
        found.retain(|own| own.value > least);
        found.truncate(JOINTS);
        let transmissions = self.scene.case.mechanism.transmissions().iter().take(1);
        found.extend(transmissions.filter_map(|own| {
            let name = own.name();
            self.usual(Usual::of(sentences::contact_force_in(&name), format!("maxabs:transmission.{name}.force_N")))
        }));
        found
    }

    /// Largest moment or force of a drive, and its largest power.
    fn of_drive(&self, number: usize, drive: &Drive) -> Vec<ReportedFigure> {
        let mechanism = &self.scene.case.mechanism;
        let joint = &mechanism.joints()[drive.joint];
        let omega = |link: LinkId| format!("link.{}.omega_rad_s", mechanism.links()[link].name);
        let (word, rates) = match drive.input {
            Input::Slide => ("force_N", vec![format!("joint.{}.slide_speed_m_s", joint.name)]),
            Input::Angle => ("torque_N_m", vec![omega(drive.link)]),
            Input::Turn => ("torque_N_m", vec![omega(joint.second.link), omega(joint.first.link)]),
        };
        let effort = match number {
            0 => format!("drive.{word}"),
            _ => format!("drive.{}.{word}", joint.name),
        };
        let told = match drive.input {
            Input::Slide => sentences::driving_force_at(&joint.name),
            Input::Angle | Input::Turn => sentences::driving_torque_at(&joint.name),
        };
        let rate = match &rates[..] {
            [one] => one.clone(),
            all => format!("({})", all.join(" - ")),
        };
        let power = Usual::of(sentences::driving_power_at(&joint.name), format!("max:{effort} * {rate}"));
        let largest = self.usual(Usual::of(told, format!("maxabs:{effort}")));
        let channels = [vec![effort], rates].concat();
        let product = |at: &[f64]| at[0] * (at[1] - at.get(2).unwrap_or(&0.0));
        largest.into_iter().chain(self.combined(power, "W", &channels, product)).collect()
    }
}

/// Extents of the path of a coupler point: a named point without a joint, on a link without a joint on the ground.
fn of_points(mechanism: &Mechanism) -> Vec<Usual> {
    let sides = || mechanism.joints().iter().map(|joint| [joint.first, joint.second]);
    let is_on_ground = |link: LinkId| {
        sides().any(|ends| ends.iter().any(|end| end.link == link) && ends.iter().any(|end| end.link == GROUND))
    };
    let has_joint = |link: LinkId, at: Vec2| sides().flatten().any(|side| side.link == link && side.local == at);
    let points = mechanism.links().entries().skip(1).filter(|(link, _)| !is_on_ground(*link));
    let point = points
        .flat_map(|(link, own)| own.points.iter().map(move |point| (link, point)))
        .find(|(link, point)| !has_joint(*link, point.local));
    let each = |(_, point): (LinkId, &linkage::mechanism::Point)| {
        ["x", "y"].map(|axis| {
            let label = sentences::extent_of_the_path_of(&point.name, &axis);
            Usual::of(label, format!("range:point.{}.{axis}_mm", point.name))
        })
    };
    point.map(each).into_iter().flatten().collect()
}

/// The smallest absolute sine of a transmission angle over all instants and dyads, with the row of the instant and the
/// links of the dyad. `None` if there is no dyad, or if the position of a moving link was not solved.
fn smallest_sine(case: &Case, run: &Trajectory) -> Option<(f64, usize, String)> {
    let mechanism = &case.mechanism;
    let columns = |name: &str| {
        let [angle, x, y] = ["angle_rad", "x_m", "y_m"].map(|ending| run.named(&format!("link.{name}.{ending}")));
        Some([angle?, x?, y?])
    };
    let columns: Vec<[&[f64]; 3]> =
        mechanism.links().iter().skip(1).map(|link| columns(&link.name)).collect::<Option<_>>()?;
    let pose = |row: usize| {
        let moving = mechanism.links().iter().skip(1).zip(&columns).map(|(link, own)| {
            let [angle, x, y] = own.map(|column| column[row]);
            LinkPose::through(link.mass_centre, Vec2::new(x, y), angle)
        });
        Pose(std::iter::once(LinkPose::GROUND).chain(moving).collect())
    };
    let groups: Vec<&Group> = case.structure.groups.iter().collect();
    let mut least: Option<(f64, usize, &Group)> = None;
    for row in 0..run.times().len() {
        let pose = pose(row);
        for group in &groups {
            let Some(sine) = transmission_sine(mechanism, group, &pose).map(|sine| sine.abs().smaller(1.0)) else {
                continue;
            };
            if least.is_none_or(|(own, ..)| sine < own) {
                least = Some((sine, row, group));
            }
        }
    }
    least.map(|(sine, row, group)| (sine, row, group.names(mechanism)))
}
