//! The requested start, which replaces the start of the file: assembly modes, and the first drive's input at t = 0.

use super::start::{self, Lists};
use crate::sentences;
use linkage::drive::Drives;
use linkage::error::{Advice, Error, ErrorKind, Result};
use linkage::input::Input;
use linkage::math::{KeepNan, unit};
use linkage::mechanism::assembly::{ConfigurationChoice, blame, blamed, first_choices, group_of};
use linkage::mechanism::pose::SidePoint;
use linkage::mechanism::{Group, GroupId, GroupKind, JointSide, LinkId, Mechanism, Pose, StartGroup, Structure};

/// A start that replaces the start of the scenario file. The default replaces nothing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StartRequest {
    /// Groups and their modes, each as `LINK,LINK=MODE` or `LINK,LINK=NUMBER`.
    /// LINK and MODE are names in the file. If the links are in another order than in the file, left and right are
    /// exchanged.
    /// NUMBER is the position of the requested configuration in the list of
    /// [`configurations`](linkage::mechanism::assembly::configurations) at the start, counted from 1.
    pub modes: Vec<String>,
    /// Requested input at t = 0 (rad or m), in place of `crank` in `[start]` or of `start` of the first drive.
    /// Modes of the file also apply at the requested input.
    /// Approximate positions (`near`) apply at the file's input only. These positions choose a configuration at the
    /// file's input.
    /// The chosen configuration is followed to the requested input.
    pub crank: Option<f64>,
    /// Whether `crank` is in deg or mm instead of rad or m. A caller that does not know what the input measures passes
    /// the number in the unit in which people write it.
    pub is_shown: bool,
    /// Whether the caller defines a grid in place of the file's grid.
    /// If so, the case is built with an empty grid, and the drive need not reach the instants of the file's grid.
    pub without_grid: bool,
    /// Parameters, given by their keys, and other numbers, given by their paths such as `links.crank.mass_kg`.
    /// Each value is in the unit of its key, and replaces the value of the file.
    pub set: Vec<(String, f64)>,
    /// Limit on the memory for the numbers of the file's tables (bytes); `None` for the default limit of a proof.
    pub memory: Option<f64>,
    /// Whether drive, start and grid may be missing in the file.
    pub without_drive: bool,
    /// Whether the parameters in `set` that the file does not define are added. If not, these parameters are refused.
    pub adds_parameters: bool,
}

/// A group whose configuration the file leaves undecided.
#[derive(Clone, Debug)]
pub struct Undecided {
    /// Index of the group in the structure.
    pub group: GroupId,
    /// Why the configuration is undecided.
    pub why: Error,
}

/// A mechanism at its start.
pub(super) struct Placed {
    pub pose: Pose,
    pub choices: Vec<ConfigurationChoice>,
    pub starts: Vec<StartGroup>,
    /// Whether the pose lies on the branch of the file's start.
    pub is_own_branch: bool,
    pub undecided: Vec<Undecided>,
}

/// The mechanism, with the start that the file states for it.
pub(super) struct Start<'a> {
    pub mechanism: &'a Mechanism,
    pub structure: &'a Structure,
    pub drives: &'a Drives,
    /// Input of the first drive at t = 0 that the file states (rad or m).
    pub crank: f64,
    /// The start that the file requests for each group.
    pub starts: &'a [StartGroup],
    pub lists: Lists,
}

/// Upper limit of a step of the first drive when a configuration is followed: a rotation (rad), or a slide divided by
/// the mechanism's size.
const STEP: f64 = std::f64::consts::PI / 180.0;

/// If a link's unit direction vectors in two poses differ by at most this length, the link has the same direction in
/// the two poses.
const SAME: f64 = 1e-9;

impl StartRequest {
    /// The requested groups with their starts.
    pub fn groups(&self, mechanism: &Mechanism, structure: &Structure) -> Result<Vec<(GroupId, StartGroup)>> {
        self.modes.iter().map(|text| start::asked(text, mechanism, structure)).collect()
    }

    /// The requested input at t = 0 (SI); `input` is the kind of input of the first drive. `None` if no input is
    /// requested.
    #[must_use]
    pub fn start(&self, input: Input) -> Option<f64> {
        self.crank.map(|value| if self.is_shown { input.read(value) } else { value })
    }
}

impl Start<'_> {
    /// Places all groups: the groups in `groups` as requested, all other groups as the file states.
    /// `crank` is the input of the first drive at t = 0 (rad or m).
    ///
    /// # Errors
    /// The errors of [`first_choices`], with the group that causes the error.
    /// [`ErrorKind::Geometry`] if the file's configuration cannot be followed to the input `crank`.
    pub fn placed(&self, crank: f64, groups: &[(GroupId, StartGroup)]) -> Result<Placed> {
        let moved = crank != self.crank;
        if groups.is_empty() && !moved {
            return self.settled(crank, self.starts.to_vec());
        }
        let own = first_choices(self.mechanism, self.structure, &self.angles(self.crank), self.starts);
        let is_asked = |index: GroupId| groups.iter().any(|(asked, _)| *asked == index);
        let mut starts = self.starts.to_vec();
        let mut followed = None;
        if moved {
            followed = own.as_ref().ok().and_then(|own| self.followed(own, crank));
            for (index, group) in self.structure.groups.entries().filter(|(index, _)| !is_asked(*index)) {
                starts[index] = match (&own, &followed, &starts[index]) {
                    (_, _, start) if start.near.is_empty() => start.clone(),
                    (_, _, start) if start.mode.is_some() => StartGroup { near: Vec::new(), ..start.clone() },
                    (Ok((_, choices)), _, _) if group.kind != GroupKind::Higher => {
                        StartGroup { mode: Some(choices[index].mode), ..StartGroup::default() }
                    }
                    (Ok(_), Some(pose), _) => self.standing(group, pose),
                    (Ok(_), None, _) => return Err(self.lost(group, crank)),
                    (Err(error), _, _) => return Err(self.blamed(self.crank, self.starts, error.clone())),
                };
            }
        }
        for (index, start) in groups {
            starts[*index] = start.clone();
        }
        let mut placed = self.settled(crank, starts)?;
        placed.is_own_branch &= own.is_ok_and(|(own, _)| {
            let own = if moved { followed } else { Some(own) };
            own.is_some_and(|own| is_same(&own, &placed.pose))
        });
        Ok(placed)
    }

    /// Coordinates of all drives at t = 0 (rad or m), with the first drive at the input `crank`.
    fn angles(&self, crank: f64) -> Vec<f64> {
        let angle = |(index, drive): (usize, &linkage::drive::Drive)| {
            drive.coordinate(if index == 0 { crank } else { drive.start })
        };
        self.drives.iter().enumerate().map(angle).collect()
    }

    /// Places all groups by the starts `starts`. `crank` is the input of the first drive (rad or m).
    /// With [`Lists::Undecided`], each undecided group is placed in one of its configurations and listed.
    /// If no group is undecided, the pose counts as lying on the branch of the file's start.
    fn settled(&self, crank: f64, mut starts: Vec<StartGroup>) -> Result<Placed> {
        let angles = self.angles(crank);
        let mut undecided: Vec<Undecided> = Vec::new();
        loop {
            let error = match first_choices(self.mechanism, self.structure, &angles, &starts) {
                Ok((pose, choices)) => {
                    return Ok(Placed { pose, choices, starts, is_own_branch: undecided.is_empty(), undecided });
                }
                Err(error) => error,
            };
            let found = blame(self.mechanism, self.structure, &angles, &starts, &error);
            let (why, group, rank) = match found {
                Some(found) => (blamed(self.mechanism, self.structure, &found, &error), Some(found.group), found.rank),
                None => {
                    let group = group_of(self.mechanism, self.structure, &error);
                    (error, group, 1)
                }
            };
            match group {
                Some(group)
                    if self.lists == Lists::Undecided
                        && (why.kind() == ErrorKind::Geometry || starts[group] == StartGroup::default())
                        && undecided.iter().all(|before| before.group != group) =>
                {
                    starts[group] = StartGroup { rank: Some(rank), ..StartGroup::default() };
                    undecided.push(Undecided { group, why });
                }
                Some(_) | None => return Err(undecided.into_iter().next().map_or(why, |first| first.why)),
            }
        }
    }

    fn blamed(&self, crank: f64, starts: &[StartGroup], error: Error) -> Error {
        match blame(self.mechanism, self.structure, &self.angles(crank), starts, &error) {
            Some(found) => blamed(self.mechanism, self.structure, &found, &error),
            None => error,
        }
    }

    /// The pose of the file's configuration, followed until the first drive is at the input `crank` (rad or m).
    /// The direct path is tried first. If the direct path fails and the first drive moves a crank, the crank turns to
    /// the requested angle in the opposite direction.
    /// A dyad keeps its mode; a higher group is followed step by step.
    fn followed(&self, own: &(Pose, Vec<ConfigurationChoice>), crank: f64) -> Option<Pose> {
        let period = self.drives.crank().input.period();
        self.walked(own, crank).or_else(|| self.walked(own, crank - period?.0.copysign(crank - self.crank)))
    }

    fn walked(&self, (pose, choices): &(Pose, Vec<ConfigurationChoice>), crank: f64) -> Option<Pose> {
        let way = crank - self.crank;
        let has_higher = self.structure.groups.iter().any(|group| group.kind == GroupKind::Higher);
        let size = self.mechanism.size();
        let turned = way.abs() / self.drives.crank().input.span(size);
        let steps = if has_higher { (turned / STEP).ceil().larger(1.0) as usize } else { 1 };
        let mut pose = pose.clone();
        for step in 1..=steps {
            let angles = self.angles(self.crank + way * step as f64 / steps as f64);
            let wanted: Vec<StartGroup> = self
                .structure
                .groups
                .iter()
                .zip(choices)
                .map(|(group, choice)| match group.kind == GroupKind::Higher {
                    true => self.standing(group, &pose),
                    false => StartGroup { mode: Some(choice.mode), ..StartGroup::default() },
                })
                .collect();
            pose = first_choices(self.mechanism, self.structure, &angles, &wanted).ok()?.0;
        }
        Some(pose)
    }

    /// The start that describes a group's position in `pose`.
    fn standing(&self, group: &Group, pose: &Pose) -> StartGroup {
        let of_link = |&link: &LinkId| {
            self.mechanism.links()[link].points.iter().map(move |point| {
                let side = JointSide { link, local: point.local };
                (SidePoint { name: point.name.clone(), side }, pose.0[link].point(point.local))
            })
        };
        StartGroup { near: group.links.iter().flat_map(of_link).collect(), ..StartGroup::default() }
    }

    fn lost(&self, group: &Group, crank: f64) -> Error {
        let names = group.names(self.mechanism);
        let (drive, input) = (self.drives.crank(), self.drives.crank().input);
        let (to, unit) = (input.shown(crank), input.shown_in().0);
        let message = sentences::the_configuration_of_the_group(&names, &drive.told(self.crank), &to, &unit);
        let give = sentences::an_input_nearer_to_the_file(&input.noun());
        Error::new(ErrorKind::Geometry, message)
            .help(Advice::Configuration { give })
            .key(group.key(self.mechanism))
            .of_group(names)
    }
}

/// Whether every link has the same direction in two poses, except for rounding errors.
fn is_same(one: &Pose, other: &Pose) -> bool {
    one.0.iter().zip(&other.0).all(|(a, b)| (unit(a.angle) - unit(b.angle)).norm() <= SAME)
}
