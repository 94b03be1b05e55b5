//! Synthesis files: the dimensions of a drawing that may vary, and the required motion of its output.
//! docs/synthesis.md describes the format.

use crate::sentences;
use std::path::Path;

use crate::synthesize::task::{
    LimitedQuantity, OutputQuantity, Phase, PointPosition, PrecisionPoint, PrecisionPoints, Refinement, SearchEffort,
    Sense, Task, TaskNumber, Timing, Variable, WantedClearance,
};
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::{Vec2, unit};
use linkage::mechanism::{GROUND, Link, LinkId, Mechanism, PerLink};
use scenario::header::{check_format, name};
use scenario::joints::link;
use scenario::reader::{Sign, TomlTable};
use scenario::source::Source;
use scenario::unit::{ACCELERATION, ANGLE, LENGTH, MASS, MASS_PER_LENGTH, UnitFamily};
use scenario::words::suggestion;
use scenario::{Claim, Scenario};

/// Default of the smallest displacement of a moving phase (fraction of the stroke).
const LEAST: f64 = 0.1;

/// A task, and the drawing from which it starts.
#[derive(Clone, Debug)]
pub struct TaskFile {
    /// The task.
    pub task: Task,
    /// The drawing.
    pub drawing: Scenario,
}

impl TaskFile {
    /// Reads the synthesis file at `path` and the scenario that this file names.
    /// The path of the scenario is relative to the directory of the synthesis file.
    ///
    /// # Errors
    /// [`ErrorKind::Io`] if a file cannot be read.
    /// [`ErrorKind::Input`] for a mistake in a file.
    /// The errors of [`Scenario::load`] and [`Task::check`].
    pub fn load(path: &Path) -> Result<Self> {
        let text = source_text(path, sentences::GIVE_THE_PATH_OF_A_SYNTHESIS)?;
        let source = Source::new(path, &text);
        let tree = source.tree()?;
        read(&mut TomlTable::root(&source, &tree)).map_err(|error| source.located(tree.get_ref(), error))
    }
}

/// Text of a synthesis file or a machine file. `help` is the advice if the file does not exist.
pub(super) fn source_text(path: &Path, help: &str) -> Result<String> {
    files::read_text(path).map_err(|error| {
        Error::new(ErrorKind::Io, sentences::the_synthesis_file_cannot_be_read(&path.display(), &error))
            .help(files::way_out(&error, help))
    })
}

/// Loads the file `file` that `key` names. A relative name is relative to the directory of the file that contains the
/// key.
/// An error with a position in the named file is returned unchanged.
/// An error without a position, such as a missing file, is reported at `key`, with the advice `help`.
pub(super) fn beside<T>(
    table: &TomlTable,
    key: &str,
    file: &str,
    help: &str,
    load: impl FnOnce(&Path) -> Result<T>,
) -> Result<T> {
    let path = table.source().path.parent().unwrap_or(Path::new("")).join(file);
    load(&path).map_err(|error| {
        if error.place().is_some() { error } else { table.wrong(error.kind(), key, error.message()).help(help) }
    })
}

fn read(root: &mut TomlTable) -> Result<TaskFile> {
    check_format(root)?;
    let (own_name, title) = (name(root)?, root.string("title")?);
    let file = root.string("scenario")?;
    let (phases, follow) = (root.tables("phases")?, root.optional_boolean("follow")?.unwrap_or(false));
    let points = root.tables("points")?;
    let (output, limits) = (root.table("output")?, root.optional_table("limits")?);
    let (zero, vary) = (root.optional_table("zero")?, root.tables("vary")?);
    let keep = root.tables("keep")?;
    let (effort, bar) = (root.table("search")?, root.optional_quantity("bar", &MASS_PER_LENGTH, Sign::Positive)?);
    root.finish()?;

    let load = |path: &Path| Scenario::load(path);
    let drawing = beside(root, "scenario", &file, sentences::NAME_THE_SCENARIO_FILE_OF_THE_DRAWING, load)?;
    let mechanism = &drawing.case.mechanism;
    let points = points.into_iter().map(point).collect::<Result<Vec<_>>>()?;
    let timing = if phases.is_empty() && !points.is_empty() { Timing::without_phases() } else { timing(phases)? };
    let timing = if follow { timing.followed()? } else { timing };
    let (output, forward) = read_output(output, mechanism)?;
    let family = if matches!(output, OutputQuantity::Angle { .. }) { &ANGLE } else { &LENGTH };
    let Limits { stroke, transmission, acceleration, clearance, mass } = read_limits(limits, family, &drawing)?;
    let (mut variables, mut places) = (Vec::new(), Vec::new());
    for table in vary {
        let found = place(table, mechanism, &mut variables, &places)?;
        places.push(found);
    }
    let zero = match zero {
        None => TaskNumber::Fixed(drawing.case.crank().zero),
        Some(table) => {
            let bounds = bounds(table, &ANGLE)?;
            free(&mut variables, Variable { name: "zero".into(), bounds, is_angle: true })
        }
    };
    let keep = keep.into_iter().map(|table| limited(table, &drawing)).collect::<Result<_>>()?;
    let task = Task {
        name: own_name,
        title,
        case: drawing.case.clone(),
        starts: drawing.starts.clone(),
        variables,
        places,
        zero,
        output,
        forward,
        timing,
        points: PrecisionPoints::of(points, mechanism.size()),
        stroke,
        transmission,
        acceleration,
        keep,
        clearance,
        mass,
        effort: read_effort(effort)?,
        bar,
    };
    task.check()?;
    Ok(TaskFile { task, drawing })
}

fn timing(tables: Vec<TomlTable>) -> Result<Timing> {
    let (mut from, mut phases, mut places) = (0.0, Vec::new(), Vec::new());
    for mut table in tables {
        let to = table.quantity("to", &ANGLE, Sign::Positive)?;
        let word = table.string("sense")?;
        let Some(sense) = Sense::named(&word) else {
            let help = suggestion(&word, Sense::ALL.map(Sense::name), "\"");
            return table.refuse("sense", sentences::is_no_sense_of_a_phase(&word), help);
        };
        let (level, least) = (table.optional_number("level")?, table.optional_number("least")?.unwrap_or(LEAST));
        table.finish()?;
        phases.push(Phase { from, to, sense, level, least });
        places.push(table.fault(""));
        from = to;
    }
    Timing::of(phases).map_err(|error| {
        let own = places.iter().find(|own| own.scenario_key() == error.scenario_key());
        match own.and_then(|own| own.place()).cloned() {
            Some(place) => error.at(place),
            None => error,
        }
    })
}

/// One entry `[[points]]`.
fn point(mut table: TomlTable) -> Result<PrecisionPoint> {
    let turn = table.optional_quantity("crank", &ANGLE, Sign::Any)?;
    let x = table.optional_quantity("x", &LENGTH, Sign::Any)?;
    let y = table.optional_quantity("y", &LENGTH, Sign::Any)?;
    let angle = table.optional_quantity("angle", &ANGLE, Sign::Any)?;
    table.finish()?;
    let place = match (x, y) {
        (Some(x), Some(y)) => Some(Vec2::new(x, y)),
        (None, None) if angle.is_some() => None,
        _ => return Err(table.fault(sentences::A_POINT_HAS_NO_POSITION).help(sentences::GIVE_X_AND_Y_OR_AN_ANGLE)),
    };
    Ok(PrecisionPoint { turn, place, angle })
}

/// Output, and the sense of forward motion.
fn read_output(mut table: TomlTable, mechanism: &Mechanism) -> Result<(OutputQuantity, Option<f64>)> {
    let forward = match table.optional_string("forward")?.as_deref() {
        None => None,
        Some("positive") => Some(1.0),
        Some("negative") => Some(-1.0),
        Some(other) => {
            let help = suggestion(other, ["positive", "negative"], "\"");
            return table.refuse("forward", sentences::is_no_sense_of_an_output(&other), help);
        }
    };
    let (of_link, of_point) = (table.optional_string("link")?, table.optional_string("point")?);
    let working = match of_link {
        Some(_) => table.optional_string("working_point")?,
        None => None,
    };
    let found = match (of_link, of_point) {
        (Some(name), None) => {
            let link = link(&mut table, &name, mechanism.links())?;
            if link == GROUND {
                let help = sentences::NAME_THE_MOVING_LINK_WHOSE;
                return table.refuse("link", sentences::THE_GROUND_DOES_NOT_TURN, help);
            }
            let point = working.map(|name| own_point(&table, "working_point", mechanism.links(), link, &name));
            OutputQuantity::Angle { link, point: point.transpose()? }
        }
        (None, Some(name)) => {
            let along = unit(table.quantity("along", &ANGLE, Sign::Any)?);
            let moving = || mechanism.links().entries().skip(1);
            let found = moving()
                .find_map(|(link, body)| Some((link, body.points.iter().position(|point| point.name == name)?)));
            let Some((link, point)) = found else {
                let names = moving().flat_map(|(_, body)| body.points.iter().map(|point| point.name.as_str()));
                let help = suggestion(&name, names, "\"");
                return table.refuse("point", sentences::no_moving_link_has_a_point(&name), help);
            };
            OutputQuantity::Coordinate { link, point, along }
        }
        _ => {
            let help = sentences::WRITE_LINK_LEVER_FOR_ITS_ANGLE;
            return Err(table.fault(sentences::AN_OUTPUT_IS_ONE_LINK_OR_ONE_POINT).help(help));
        }
    };
    table.finish()?;
    Ok((found, forward))
}

/// Limits of an output (SI).
struct Limits {
    stroke: [f64; 2],
    transmission: f64,
    acceleration: f64,
    clearance: Option<WantedClearance>,
    mass: f64,
}

/// Reads the limits of the stroke, in units of `family`, and all other limits.
fn read_limits(table: Option<TomlTable>, family: &'static UnitFamily, drawing: &Scenario) -> Result<Limits> {
    let unlimited = Limits {
        stroke: [0.0, f64::INFINITY],
        transmission: 0.0,
        acceleration: f64::INFINITY,
        clearance: None,
        mass: f64::INFINITY,
    };
    let Some(mut table) = table else { return Ok(unlimited) };
    let transmission = table.optional_quantity("transmission", &ANGLE, Sign::NotNegative)?.unwrap_or(0.0);
    if transmission >= std::f64::consts::FRAC_PI_2 {
        let message = sentences::a_transmission_angle_of_deg(&transmission.to_degrees());
        return table.refuse("transmission", message, sentences::GIVE_LESS_THAN_DEG_TO_DEG);
    }
    let stroke = table.optional_table("stroke")?.map(|stroke| bounds(stroke, family)).transpose()?;
    let acceleration = table.optional_quantity("acceleration", &ACCELERATION, Sign::Positive)?;
    let mass = table.optional_quantity("mass", &MASS, Sign::Positive)?;
    let clearance = match (table.optional_quantity("clearance", &LENGTH, Sign::NotNegative)?, &drawing.clearance) {
        (None, _) => None,
        (Some(wanted), Some(question)) => Some(WantedClearance { question: question.clone(), wanted }),
        (Some(_), None) => {
            let message = sentences::THE_DRAWING_HAS_NO_OUTLINES;
            return table.refuse("clearance", message, sentences::ADD_CLEARANCE_TO_THE_DRAWING);
        }
    };
    table.finish()?;
    Ok(Limits {
        stroke: stroke.unwrap_or(unlimited.stroke),
        transmission,
        acceleration: acceleration.unwrap_or(unlimited.acceleration),
        clearance,
        mass: mass.unwrap_or(unlimited.mass),
    })
}

/// One entry `[[keep]]`: a quantity with its limits.
fn limited(mut table: TomlTable, drawing: &Scenario) -> Result<LimitedQuantity> {
    let quantity = table.string("quantity")?;
    let limits = [table.optional_number("from")?, table.optional_number("to")?];
    let bounds = [limits[0].unwrap_or(f64::NEG_INFINITY), limits[1].unwrap_or(f64::INFINITY)];
    table.finish()?;
    let claim = match Claim::parse(&quantity, &drawing.case) {
        Ok(claim) => claim,
        Err(fault) => return table.refuse("quantity", fault.message, fault.help.as_str()),
    };
    if !claim.figures.is_empty() || claim.has_masses() {
        let message = sentences::a_reduced_quantity_is_not_differentiated(&quantity);
        return table.refuse("quantity", message, sentences::LIMIT_A_CHANNEL);
    }
    if limits == [None, None] || !(bounds[0] <= bounds[1]) {
        return Err(table.fault(sentences::A_QUANTITY_HAS_NO_LIMITS).help(sentences::GIVE_FROM_OR_TO));
    }
    Ok(LimitedQuantity { claim, bounds })
}

fn read_effort(mut table: TomlTable) -> Result<SearchEffort> {
    let refinement = match table.optional_string("refinement")? {
        None => Refinement::Gradients,
        Some(word) => match Refinement::named(&word) {
            Some(found) => found,
            None => {
                let help = suggestion(&word, Refinement::ALL.map(Refinement::name), "\"");
                return table.refuse("refinement", sentences::is_no_refinement(&word), help);
            }
        },
    };
    let [candidates, evaluations] = match refinement {
        Refinement::Evolution => [200_000, 20_000],
        Refinement::Gradients => [20_000, 200],
    };
    let mut count = |key: &str, default: i64| -> Result<u64> {
        let found = table.optional_integer(key)?.unwrap_or(default);
        let message = || sentences::found_but_a_count_is_not_negative(&found);
        u64::try_from(found).or_else(|_| table.refuse(key, message(), sentences::GIVE_A_WHOLE_NUMBER_FROM_ON))
    };
    let seed = count("seed", 1)?;
    let size = |found: u64| usize::try_from(found).unwrap_or(usize::MAX);
    let (candidates, refined) = (size(count("candidates", candidates)?), size(count("refined", 16)?));
    let evaluations = size(count("evaluations", evaluations)?);
    table.finish()?;
    Ok(SearchEffort { seed, candidates, refined, evaluations, refinement })
}

/// `from` and `to` of a quantity (SI).
fn bounds(mut table: TomlTable, family: &'static UnitFamily) -> Result<[f64; 2]> {
    let (from, to) = (table.quantity("from", family, Sign::Any)?, table.quantity("to", family, Sign::Any)?);
    if !(from <= to) {
        let error = table.fault(sentences::THE_GREATEST_VALUE_IS_BELOW);
        return Err(error.help(sentences::LET_FROM_BE_THE_SMALLER_OF_THE_TWO));
    }
    table.finish()?;
    Ok([from, to])
}

/// Index of the point `name` of a link. A missing point is an error at `key`.
fn own_point(table: &TomlTable, key: &str, links: &PerLink<Link>, link: LinkId, name: &str) -> Result<usize> {
    let own = &links[link];
    let names = || own.points.iter().map(|point| point.name.as_str());
    let message = || sentences::link_has_no_point(&own.name, &name);
    let found = names().position(|point| point == name);
    found.map_or_else(|| table.refuse(key, message(), suggestion(name, names(), "\"")), Ok)
}

fn free(variables: &mut Vec<Variable>, variable: Variable) -> TaskNumber {
    variables.push(variable);
    TaskNumber::Free(variables.len() - 1)
}

/// Reads one entry `[[vary]]`: a point that is given by its coordinates, or relative to another point of its link.
fn place(
    mut table: TomlTable,
    mechanism: &Mechanism,
    variables: &mut Vec<Variable>,
    before: &[PointPosition],
) -> Result<PointPosition> {
    let (link_name, point_name) = (table.string("link")?, table.string("point")?);
    let own = link(&mut table, &link_name, mechanism.links())?;
    let points = &mechanism.links()[own].points;
    let index = |table: &TomlTable, key: &str, name: &str| own_point(table, key, mechanism.links(), own, name);
    let point = index(&table, "point", &point_name)?;
    let Some(handle) = mechanism.handle(own, point) else {
        let message = sentences::point_of_the_drawing_lies(&point_name);
        return table.refuse("point", message, sentences::DRAW_THE_TWO_POINTS_IN_DIFFERENT);
    };
    if before.iter().any(|place| place.handle == handle) {
        return table.refuse("point", sentences::THIS_POINT_VARIES_ALREADY, sentences::PUT_ALL_THAT_VARIES_ABOUT);
    }
    let from = table.optional_string("from")?.map(|name| index(&table, "from", &name)).transpose()?;
    let drawn = points[point].local;
    let (keys, drawn) = match from.map(|from| drawn - points[from].local) {
        None => (["x", "y"], [drawn.x, drawn.y]),
        Some(arm) => (["length", "angle"], [arm.norm(), arm.y.atan2(arm.x)]),
    };
    let mut entries = drawn.map(TaskNumber::Fixed);
    for (entry, key) in entries.iter_mut().zip(keys) {
        if let Some(own) = table.optional_table(key)? {
            let is_angle = key == "angle";
            let bounds = bounds(own, if is_angle { &ANGLE } else { &LENGTH })?;
            let name = format!("{link_name}.{point_name} {key}");
            *entry = free(variables, Variable { name, bounds, is_angle });
        }
    }
    table.finish()?;
    if entries.iter().all(|entry| matches!(entry, TaskNumber::Fixed(_))) {
        let help = format!("add `{0} = {{ from_mm = ..., to_mm = ... }}`", keys[0]);
        return Err(table.fault(sentences::NOTHING_ABOUT_THIS_POINT_VARIES).help(help));
    }
    Ok(PointPosition { handle, from, entries })
}
