//! The drawn content of a file: the mechanism in its poses, or, if it cannot be assembled completely, the part that can
//! be placed.

use super::media::{Medium, PictureOptions};
use super::motion::{Course, swung, turned, with_travels};
use super::points::{NamedPoint, RequestedPoints};
use super::positions::{DrawnPositions, is_same_pose, poses};
use crate::sentences;
use design::draw::significant;
use design::plan::{grid_at, state_at};
use drawing::groups::group_cells;
use drawing::lay::{GroupPlacement, Laid, all_modes, lay, lay_loose};
use drawing::sheet::SheetCell;
use drawing::view::{DrawnSubject, Extras, Shot, ShownMotion, Trace, cells};
use drawing::{Sketch, Travels, acting, unit};
use linkage::case::When;
use linkage::drive::Drive;
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::Vec2;
use linkage::math::statistics::ends;
use linkage::mechanism::assembly::ConfigurationChoice;
use linkage::mechanism::{
    AssemblyMode, DrivingLink, GROUND, JointId, JointSide, Mechanism, StartGroup, Structure, roman,
};
use linkage::solver::State;
use scenario::{Draft, Scenario};

/// Largest number of configurations on a sheet, and of mistakes listed below a picture.
const MOST: usize = 24;
const SHOWN: usize = 3;
/// A point stays on a circle if its distance from the centre changes by less than this fraction of the mechanism's
/// size.
const STILL: f64 = 1e-6;

/// A note beside a picture.
pub(crate) enum Note {
    /// A fault, or an assumption made for the drawing.
    Said(String),
    /// The picture shows one of several configurations.
    OneOfMany,
}

/// A file as it is drawn.
pub(crate) struct Drawn {
    pub(crate) name: String,
    pub(super) title: String,
    /// The name, and in words the value of the input in the first frame. A structure without a drive has only its name.
    pub(super) headline: String,
    mechanism: Mechanism,
    drives: Vec<Drive>,
    loads: Vec<linkage::drive::Load>,
    gravity: Vec2,
    pub(super) shots: Vec<Shot>,
    /// Lines of text above each picture in `shots`.
    headings: Vec<Vec<String>>,
    travels: Travels,
    traces: Vec<Trace>,
    positions: DrawnPositions,
    /// The structure, if the links form one.
    structure: Option<Structure>,
    /// Fault of the file or of the request.
    pub(crate) fault: Option<Error>,
    /// Whether the file has mistakes. The mistakes of a file are listed below the picture.
    has_mistakes: bool,
    pub(crate) note: Option<Note>,
}

impl Drawn {
    /// A mechanism that can be assembled at some crank angle.
    pub(crate) fn of(scenario: Scenario, wish: &PictureOptions, medium: Medium) -> Result<Drawn> {
        wish.check(medium)?;
        let when = wish.at.unwrap_or(When::Crank(scenario.case.crank().start));
        // Configurations exist at any crank angle, but a time must lie within the laws of motion.
        if let When::Time(_) = when {
            grid_at(&scenario.case.nominal().drives, when)?;
        }
        let drawn = match wish.each_mode {
            true => Drawn::each_mode(draft_of(&scenario), when, None),
            false => Drawn::whole(scenario, when, wish, medium),
        };
        Ok(drawn?.with_unknown_traces(wish))
    }

    /// The readable part of a mechanism. Its file is not a valid scenario; `error` is the reason.
    pub(crate) fn of_draft(draft: Draft, wish: &PictureOptions, medium: Medium, error: Error) -> Result<Drawn> {
        wish.check(medium)?;
        let when = wish.at.unwrap_or(When::Crank(draft.crank));
        // If the links cannot move, they need no drive, so the error of the missing drive is dropped.
        let error = Some(error).filter(|_| !draft.is_fixed());
        if let (true, Some(_)) = (draft.is_fixed(), wish.course()) {
            let [_, enlarged, positions, _] = wish.keys();
            let key = if wish.positions.is_some() { positions } else { enlarged };
            let error = Error::new(ErrorKind::Input, sentences::THE_STRUCTURE_DOES_NOT_MOVE).key(key);
            return Err(error.help(sentences::TAKE_IT_OUT_OR_ADD_A_DRIVE));
        }
        let drawn = match wish.each_mode && draft.structure.is_ok() {
            true => Drawn::each_mode(draft, when, error)?,
            false => Drawn::partial(draft, when, error),
        };
        Ok(drawn.with_unknown_traces(wish))
    }

    fn with_unknown_traces(mut self, wish: &PictureOptions) -> Drawn {
        let unknown = RequestedPoints::of(&self.mechanism, wish).unknown;
        self.fault = Error::all(self.fault.take().into_iter().chain(unknown));
        self
    }

    /// The same mechanism, with the groups of the structure in which the first drive moves `joint`.
    pub(crate) fn with_structure(self, (joint, structure): (JointId, Structure)) -> Drawn {
        let headline = sentences::driven_at_joint(&self.headline, &self.mechanism.joints()[joint].name);
        Drawn { headline, structure: Some(structure), ..self }
    }

    /// Structural formula and class, for a picture of the groups.
    pub(super) fn formula(&self) -> Option<String> {
        let structure = self.structure.as_ref()?;
        let formula = structure.numbered_formula(&self.mechanism).replace("->", "→");
        Some(sentences::formula_and_class(&formula, &roman(structure.class())))
    }

    /// Number of cells in a picture that does not move.
    pub(super) fn count(&self, wish: &PictureOptions) -> usize {
        match &self.structure {
            Some(structure) if wish.groups => structure.leading().count() + structure.groups.len(),
            _ if wish.each_mode => self.shots.len(),
            _ => 1 + self.positions.count(),
        }
    }

    /// The cells of all frames; `room` is the size of the area (mm).
    pub(super) fn cells(&self, wish: &PictureOptions, medium: Medium, room: Vec2) -> Vec<SheetCell> {
        let Drawn { mechanism, drives, loads, gravity, .. } = self;
        let subject = DrawnSubject { mechanism, drives, loads, gravity: *gravity };
        let extras =
            Extras { loads: wish.loads, dimensions: wish.dimensions, is_moving: medium.moves(), is_small: wish.small };
        if let (true, Some(structure), [shot, ..]) = (wish.groups, &self.structure, &self.shots[..]) {
            return group_cells(mechanism, structure, drives, &shot.laid.places, room);
        }
        let motion =
            ShownMotion { travels: &self.travels, traces: &self.traces, series: self.positions.series.as_ref() };
        let mut all = cells(&subject, &self.shots, motion, extras, room);
        for (index, cell) in all.iter_mut().enumerate() {
            let own = self.headings.get(index).cloned().unwrap_or_default();
            cell.heading = own.into_iter().chain(std::mem::take(&mut cell.heading)).collect();
            cell.heading.extend(self.positions.scale(cell));
            let faults = self.shots[index].laid.faults.iter().map(|fault| fault.message().to_string());
            cell.faults = match &self.fault {
                Some(fault) if self.has_mistakes => mistakes(fault),
                _ => faults.collect(),
            };
            // The fault of the file is shown only if the cell lists no faults and the configurations have no headings.
            if let (true, Some(fault), true) = (cell.faults.is_empty(), &self.fault, self.headings.is_empty()) {
                cell.faults.push(fault.message().to_string());
            }
        }
        all.extend(self.positions.cells(room));
        all
    }

    fn new(draft: Draft, when: When, shots: Vec<Shot>) -> Drawn {
        let has_mistakes = draft.mistakes.is_some();
        let crank = draft.drives.first().map_or(draft.crank, |drive| when.grid(drive).inputs[0]);
        let input = (!draft.is_fixed()).then(|| format!(", {}", draft.input().marked(crank)));
        let headline = draft.name.clone() + &input.unwrap_or_default();
        let drives = if draft.is_driven_by_guess { Vec::new() } else { draft.drives };
        let Draft { name, title, mechanism, structure, loads, gravity, .. } = draft;
        let mut travels = Travels::none(&mechanism);
        for shot in &shots {
            travels.take_in(&mechanism, |link, local| shot.laid.places[link].pose().map(|pose| pose.point(local)));
        }
        Drawn {
            name,
            title,
            headline,
            mechanism,
            drives,
            loads,
            gravity,
            shots,
            headings: Vec::new(),
            travels,
            traces: Vec::new(),
            positions: DrawnPositions::default(),
            structure: structure.ok(),
            fault: None,
            has_mistakes,
            note: None,
        }
    }

    /// The mechanism at an instant, or its motion.
    fn whole(scenario: Scenario, when: When, wish: &PictureOptions, medium: Medium) -> Result<Drawn> {
        let (frames, solver) = (medium.frames(wish), wish.solver.solver());
        let points = RequestedPoints::of(&scenario.case.mechanism, wish);
        let course = wish.course().map(|count| Course::of(&scenario.case, solver, count));
        let is_traced = !points.traced.is_empty() || !points.joints.is_empty();
        let is_motion_seen = course.is_none() && (frames > 1 || is_traced);
        let own = if is_motion_seen { swung(&scenario.case, solver) } else { None };
        let free = scenario.case.clone();
        let scenario = scenario.nominal();
        let case = &scenario.case;
        // A time within a free motion selects an instant of this motion, so that the position with full lines belongs
        // to the same motion as the positions with thin lines.
        let shown = match (&course, when) {
            (Some(Ok(course)), When::Time(_)) if course.is_timed => &free,
            _ => case,
        };
        let first = match state_at(shown, solver, when) {
            Ok(state) => state,
            Err(error) if error.kind() == ErrorKind::Input => return Err(error),
            Err(error) => {
                let error = analytic::range::explained(case, error);
                let travels = turned(case, solver).1;
                return Ok(Drawn {
                    travels,
                    drives: free.drives.to_vec(),
                    ..Drawn::partial(draft_of(&scenario), when, Some(error))
                });
            }
        };
        let course = course.transpose()?;
        let states = course.as_ref().map(|course| course.states.clone()).or(own);
        let (states, travels) = states.map_or_else(|| turned(case, solver), |states| with_travels(case, states));
        let sketch = Sketch::of_case(case, &travels, unit(&case.mechanism));
        let shot = |state: &State| Shot {
            laid: Laid::whole(poses(state)),
            acting: acting(case, &sketch, &state.motions, &state.angles),
        };
        let shots: Vec<Shot> = match frames {
            1 => vec![shot(&first)],
            frames => {
                let row = |k: usize| k * states.len() / frames;
                (0..frames).filter_map(|k| states.get(row(k))).map(shot).collect()
            }
        };
        let is_series = wish.positions.is_some();
        // With several positions, the numbered paths of the positions replace the plain paths.
        let of = |own: &NamedPoint| -> Trace {
            let JointSide { link, local } = own.side;
            (link, states.iter().map(|state| state.motions[link].point(local)).collect())
        };
        let joints = points.joints.iter().map(of).filter(|(_, path)| !is_arc(&case.mechanism, path));
        let traces = points.traced.iter().map(of).chain(joints).filter(|_| !is_series).collect();
        let positions = course.map_or_else(DrawnPositions::default, |course| {
            DrawnPositions::of(case, &course, &first, points, is_series)
        });
        let headings = if positions.heading.is_empty() { Vec::new() } else { vec![positions.heading.clone()] };
        // A free motion is drawn as a prescribed motion. But a link that is moved by forces has no arrow of a drive.
        let drives = free.drives.to_vec();
        let mut drawn = Drawn { traces, positions, headings, drives, ..Drawn::new(draft_of(&scenario), when, shots) };
        let own = std::mem::replace(&mut drawn.travels, travels);
        // A single picture shows the requested instant, which may lie between two instants of the computed path.
        // The travels are therefore widened by the pose at this instant.
        if frames == 1 {
            drawn.travels.widen(&own);
        }
        Ok(drawn)
    }

    /// A mechanism, placed as far as possible at an instant, with the error that prevents its complete assembly.
    fn partial(draft: Draft, when: When, error: Option<Error>) -> Drawn {
        let angles = angles(&draft.drives, when);
        let laid = match &draft.structure {
            Ok(structure) => lay(&draft.mechanism, structure, &angles, &draft.starts),
            Err(fault) => {
                let driving = |drive: &Drive| {
                    let &Drive { link, joint, input, .. } = drive;
                    DrivingLink { link, joint, input, in_group: draft.mechanism.joints()[joint].on(GROUND).is_none() }
                };
                let drivers: Vec<DrivingLink> = draft.drives.iter().map(driving).collect();
                lay_loose(&draft.mechanism, &drivers, &angles, fault.clone())
            }
        };
        let gaps: Vec<String> = laid
            .gaps
            .iter()
            .map(|(joint, [from, to])| {
                let name = &draft.mechanism.joints()[*joint].name;
                sentences::joint_stays_open_by_mm(&name, &significant((to - from).norm() * 1e3))
            })
            .collect();
        let note = match (&gaps[..], &draft.structure) {
            _ if draft.mistakes.is_some() => of_guess(&draft).map(Note::Said),
            ([], Ok(_)) => Some(Note::OneOfMany),
            ([], Err(_)) => None,
            (gaps, _) => Some(Note::Said(format!("{}: {}", draft.name, gaps.join(", ")))),
        };
        let shots = vec![Shot { laid, acting: Vec::new() }];
        Drawn { fault: error, note, ..Drawn::new(draft, when, shots) }
    }

    /// All configurations at an instant.
    fn each_mode(draft: Draft, when: When, error: Option<Error>) -> Result<Drawn> {
        let structure = draft.structure.clone()?;
        let angles = structure.given_at_start(&draft.mechanism, &angles(&draft.drives, when));
        let structure = structure.at_start();
        let mut all = all_modes(&draft.mechanism, structure, &angles, &draft.starts, MOST + 1);
        let is_cut = all.len() > MOST;
        all.truncate(MOST);
        let own = lay(&draft.mechanism, structure, &angles, &draft.starts);
        let headings = all.iter().map(|laid| heading(&draft.mechanism, structure, laid, &own)).collect();
        // If the file states no mode, the list of configurations shows the possible modes, so the missing mode is not a
        // fault.
        // A configuration that does not close is not a fault either.
        let is_answered = draft.mistakes.is_none() && all.iter().any(Laid::is_whole);
        let cut = is_cut.then(|| sentences::only_the_first_configurations_are_drawn(&MOST));
        let open = error.as_ref().filter(|_| is_answered).map(|error| error.message().to_string());
        let told: Vec<String> = open.into_iter().chain(cut).collect();
        let note = (!told.is_empty()).then(|| Note::Said(format!("{}: {}", draft.name, told.join("; "))));
        let first = all.first().and_then(|laid| laid.faults.first().cloned());
        let fault = error.or(first).filter(|_| !is_answered);
        let shots = all.into_iter().map(|laid| Shot { laid, acting: Vec::new() }).collect();
        Ok(Drawn { headings, note, fault, ..Drawn::new(draft, when, shots) })
    }
}

/// Whether a path is a point, or a part of a circle about a pivot of the ground.
fn is_arc(mechanism: &Mechanism, path: &[Vec2]) -> bool {
    let near = STILL * mechanism.size();
    let spread = |from: Vec2| {
        let [least, most] = ends(path.iter().map(|at| (at - from).norm()));
        most - least
    };
    let mut pivots = mechanism.joints().iter().filter(|joint| joint.is_pin()).filter_map(|joint| joint.on(GROUND));
    path.first().is_none_or(|first| spread(*first) < near) || pivots.any(|pivot| spread(pivot) < near)
}

/// A short list of mistakes: the first mistakes with their lines, and the number of further mistakes.
fn mistakes(fault: &Error) -> Vec<String> {
    let short = |own: &Error| {
        let line = own.place().map_or_else(String::new, |place| format!("line {}: ", place.line()));
        let key = own.scenario_key().map_or_else(String::new, |key| format!("{key}: "));
        format!("{line}{key}{}", own.message())
    };
    let mut lines: Vec<String> = fault.each().take(SHOWN).map(short).collect();
    let more = fault.each().count().saturating_sub(SHOWN) + fault.left_out();
    lines.extend((more > 0).then(|| sentences::and_more(&more)));
    lines
}

/// A note that names the link assumed to be driven, if no drive could be read.
fn of_guess(draft: &Draft) -> Option<String> {
    let drive = draft.drives.first().filter(|_| draft.is_driven_by_guess)?;
    let link = &draft.mechanism.links()[drive.link].name;
    Some(sentences::no_drive_could_be_read_drawn(&draft.name, &link))
}

/// Coordinates of the drives at an instant.
/// If the time is not known, as in a free motion, all drives except the first have their coordinates at the start.
fn angles(drives: &[Drive], when: When) -> Vec<f64> {
    let at = drives.first().map(|drive| when.grid(drive)).unwrap_or_default();
    let angle = |(index, drive): (usize, &Drive)| {
        let value = if index == 0 { at.inputs[0] } else { drive.at(at.times[0]).value };
        drive.coordinate(if value.is_finite() { value } else { drive.start })
    };
    drives.iter().enumerate().map(angle).collect()
}

fn draft_of(scenario: &Scenario) -> Draft {
    let case = &scenario.case;
    let standing = |(choice, start): (&ConfigurationChoice, &StartGroup)| match choice.mode {
        AssemblyMode::Followed => start.clone(),
        AssemblyMode::Left | AssemblyMode::Right | AssemblyMode::Ahead | AssemblyMode::Behind => {
            StartGroup { mode: Some(choice.mode), ..StartGroup::default() }
        }
        AssemblyMode::Only => StartGroup::default(),
    };
    Draft {
        name: scenario.name.clone(),
        title: scenario.title.clone(),
        mechanism: case.mechanism.clone(),
        structure: Ok(case.structure.clone()),
        drives: case.drives.to_vec(),
        is_driven_by_guess: false,
        loads: case.loads.clone(),
        gravity: case.gravity,
        crank: case.crank().start,
        starts: scenario.choices.iter().zip(&scenario.starts).map(standing).collect(),
        mistakes: None,
    }
}

/// The modes of a configuration: values for the key `mode`, or the number if the modes have no names.
fn heading(mechanism: &Mechanism, structure: &Structure, laid: &Laid, own: &Laid) -> Vec<String> {
    let line = |&GroupPlacement { group, mode, number }: &GroupPlacement| {
        let names = structure.groups[group].names(mechanism).replace(", ", ",");
        match mode {
            AssemblyMode::Left | AssemblyMode::Right | AssemblyMode::Ahead | AssemblyMode::Behind => {
                Some(format!("{names} = {}", mode.name()))
            }
            AssemblyMode::Followed if number > 0 => Some(format!("{names} = {number}")),
            AssemblyMode::Followed | AssemblyMode::Only => None,
        }
    };
    let mut lines: Vec<String> = laid.modes.iter().filter_map(line).collect();
    if lines.is_empty() {
        lines.push(sentences::THE_ONLY_CONFIGURATION.into());
    }
    let is_own = own.is_whole() && is_same_pose(mechanism, &laid.places, &own.places);
    let remark = match laid.is_whole() {
        _ if is_own => sentences::AS_IN_THE_FILE,
        true => "",
        false => sentences::DOES_NOT_CLOSE,
    };
    lines.last_mut().into_iter().for_each(|last| *last += remark);
    lines
}
