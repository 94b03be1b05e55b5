//! The table itself.

use super::Kind::{
    Choice, Integer, IntegerOrBoolean, Number, Numbers, Quantities, Quantity, Table, TableOrTables, Tables, Text, Texts,
};
use super::{Key, Kind, Section};
use crate::scenario::unit::{
    ACCELERATION, ANGLE, ANGULAR_SPEED, DAMPING, FORCE, INERTIA, LENGTH, MASS, MOMENT, MOMENT_PER_SPEED, STIFFNESS,
    TIME, TORSIONAL_STIFFNESS,
};

const fn needed(name: &'static str, kind: Kind, meaning: &'static str) -> Key {
    Key { name, kind, is_needed: true, meaning }
}

const fn optional(name: &'static str, kind: Kind, meaning: &'static str) -> Key {
    Key { name, kind, is_needed: false, meaning }
}

const fn section(path: &'static str, keys: &'static [Key]) -> Section {
    Section { path, keys }
}

const ACCELERATIONS: Kind = Quantity(&[&ACCELERATION]);
const ANGLES: Kind = Quantity(&[&ANGLE]);
const ANGLES_OR_TIMES: Kind = Quantity(&[&ANGLE, &TIME]);
const DAMPINGS_OR_SLOPES: Kind = Quantity(&[&DAMPING, &MOMENT_PER_SPEED]);
const FORCES: Kind = Quantity(&[&FORCE]);
const INERTIAS: Kind = Quantity(&[&INERTIA]);
const LENGTHS: Kind = Quantity(&[&LENGTH]);
const LENGTHS_OR_ANGLES: Kind = Quantity(&[&LENGTH, &ANGLE]);
const MASSES: Kind = Quantity(&[&MASS]);
const MOMENTS: Kind = Quantity(&[&MOMENT]);
const SLOPES: Kind = Quantity(&[&MOMENT_PER_SPEED]);
const SPEEDS: Kind = Quantity(&[&ANGULAR_SPEED]);
const STIFFNESSES_OR_TORSIONAL: Kind = Quantity(&[&STIFFNESS, &TORSIONAL_STIFFNESS]);
const TIMES: Kind = Quantity(&[&TIME]);
const LIST_OF_ANGLES: Kind = Quantities(&ANGLE);
const LIST_OF_TIMES: Kind = Quantities(&TIME);

/// A place: coordinates, or distance and direction from an earlier point.
const PLACE: &[Key] = &[
    optional("x", LENGTHS, "coordinate along x"),
    optional("y", LENGTHS, "coordinate along y"),
    optional("from", Text, "earlier point of the same table from which the place is measured"),
    optional("length", LENGTHS, "distance from that point"),
    optional("angle", ANGLES, "direction from that point"),
];

const NUMBER: &[Key] = &[
    needed("value", Number, "the number, in the printed unit"),
    needed("digits", Integer, "number of printed decimals"),
];

const RADIUS: Key = optional("radius", LENGTHS, "radius of the rounding, or of the capsules");
const CORNERS: Key = optional("corners", Tables, "places, three or more: a polygon with its interior");
const LINE: Key = optional("line", Tables, "places: capsules from place to place; a single one is a disc");
const FINDING: Key = optional("finding", Text, "anchor of the finding that says why the number is wrong");
const RIGHT: Key = optional("right", Table, "the right number instead");
const VALUE: Key = needed("value", Number, "the number, in the unit of the name");
const DIGITS: Key = needed("digits", Integer, "number of printed decimals");
const CRANK: Key = optional("crank", ANGLES, "crank angle");
const AT_TIME: Key = optional("time", TIMES, "time");

/// All sections.
pub static SECTIONS: &[Section] = &[
    section(
        "",
        &[
            needed("format", Integer, "version of this format: 1"),
            needed("name", Text, "short name for file names: a-z, 0-9, _"),
            needed("title", Text, "one line for the reader"),
            optional("source", Text, "where the dimensions come from"),
            optional("parameters", Table, "numbers with names, for other numbers and for formulas"),
            needed("ground", Table, "the frame"),
            needed("links", Table, "moving links by name"),
            needed("joints", Tables, "joints"),
            needed("drive", TableOrTables, "what moves the driving links; the first is the crank"),
            optional("motor", Table, "the motor behind the crank"),
            optional("gravity", Table, "acceleration of gravity; none without the section"),
            optional("loads", Tables, "forces, moments, springs and dampers"),
            needed("start", Table, "pose at t = 0"),
            needed("grid", Table, "the instants of results"),
            optional("channels", Table, "the results that are wanted"),
            optional("engine", Table, "settings of the engine; found where they are not given"),
            optional("tolerances", Table, "what proves something"),
            optional("oracle", Tables, "numbers that the mechanism must reproduce"),
            optional("clearance", Table, "outlines of links and a housing"),
            optional("formula", Tables, "formulas as they were derived, and what they claim to be"),
        ],
    ),
    section("ground", &[needed("points", Table, "fixed points by name")]),
    section("ground.points.*", PLACE),
    section(
        "links.*",
        &[
            needed("points", Table, "points in the link's own frame by name, at least one"),
            optional("mass", MASSES, "mass, not negative"),
            optional("mass_centre", Table, "place of the mass centre in the link's frame"),
            optional("inertia", INERTIAS, "moment of inertia about the mass centre"),
        ],
    ),
    section("links.*.points.*", PLACE),
    section("links.*.mass_centre", PLACE),
    section(
        "joints",
        &[
            needed("name", Text, "name, unique"),
            needed("type", Choice(&["revolute", "prismatic"]), "kind of joint"),
            needed("links", Texts, "first and second link; \"ground\" is the frame"),
            optional("point", Text, "revolute: the point on both links; the joint's name unless given"),
            optional("points", Texts, "prismatic: a point of the first link and one of the second"),
            optional("axis", ANGLES, "prismatic: direction of sliding in the frame of the first link"),
            optional("second_axis", ANGLES, "prismatic: the same in the frame of the second link"),
        ],
    ),
    section(
        "drive",
        &[
            needed("joint", Text, "revolute joint between the ground and the driving link"),
            optional("law", Choice(&["constant", "ramp", "cycloidal", "table"]), "crank angle over time"),
            optional("zero", ANGLES, "world direction from which the crank angle is measured"),
            optional("motion", Choice(&["prescribed", "free"]), "whether forces determine the motion"),
            optional("initial_speed", SPEEDS, "of a free link: angular velocity at t = 0"),
            optional("through", Choice(&["smooth"]), "the mechanism passes change points"),
            optional("start", ANGLES, "of every drive but the first: its angle at t = 0"),
            optional("speed", SPEEDS, "angular velocity, counter-clockwise positive"),
            optional("time", TIMES, "duration of a ramp or of a cycloidal law"),
            optional("to", ANGLES, "last crank angle of a cycloidal law"),
            optional("points", Tables, "points of a table, times ascending from 0"),
        ],
    ),
    section("drive.points", &[needed("time", TIMES, "time"), needed("angle", ANGLES, "crank angle at that time")]),
    section(
        "motor",
        &[
            needed("law", Choice(&["constant", "linear", "kloss", "table"]), "torque over the motor's own speed"),
            needed("ratio", Number, "speed of the motor over that of the crank; 1 without a reducer"),
            optional("efficiency", Number, "share of the power that the reducer transmits"),
            optional("torque", MOMENTS, "constant law: the torque"),
            optional("torque_at_rest", MOMENTS, "linear law: torque at rest"),
            optional("slope", SLOPES, "linear law: change with the speed, negative"),
            optional("breakdown_torque", MOMENTS, "Kloss: largest torque"),
            optional("synchronous_speed", SPEEDS, "Kloss: synchronous speed"),
            optional("breakdown_slip", Number, "Kloss: slip at breakdown"),
            optional("breakdown_speed", SPEEDS, "Kloss: speed at breakdown"),
            optional("points", Tables, "table: speeds ascending, with their torques"),
            optional("rotor_inertia", INERTIAS, "moment of inertia of the rotor"),
            optional("input_inertia", INERTIAS, "of the reducer's input shaft"),
            optional("intermediate_inertia", INERTIAS, "of its intermediate shaft"),
            optional("intermediate_ratio", Number, "speed of the intermediate shaft over that of the crank"),
            optional("output_inertia", INERTIAS, "of its output shaft"),
        ],
    ),
    section("motor.points", &[needed("speed", SPEEDS, "speed of the motor"), needed("torque", MOMENTS, "its torque")]),
    section("gravity", &[needed("x", ACCELERATIONS, "along x"), needed("y", ACCELERATIONS, "along y")]),
    section(
        "loads",
        &[
            needed(
                "type",
                Choice(&[
                    "resistance",
                    "moment",
                    "force",
                    "resisting_force",
                    "spring",
                    "damper",
                    "torsion_spring",
                    "torsion_damper",
                ]),
                "kind of load",
            ),
            optional("link", Text, "the loaded link"),
            optional("point", Text, "the loaded point of that link"),
            optional("links", Texts, "the two links that a spring or damper joins"),
            optional("points", Texts, "a point of each"),
            optional("moment", MOMENTS, "moment"),
            optional("acts", Choice(&["always", "counter-clockwise", "clockwise"]), "when a moment acts"),
            optional("x", FORCES, "force along x"),
            optional("y", FORCES, "force along y"),
            optional("frame", Choice(&["world", "link"]), "axes of a force"),
            optional("force", FORCES, "size of a force against the motion of the point"),
            optional("stiffness", STIFFNESSES_OR_TORSIONAL, "stiffness"),
            optional("free_length", LENGTHS, "length of the spring without force"),
            optional("free_angle", ANGLES, "twist of the spring without moment"),
            optional("damping", DAMPINGS_OR_SLOPES, "damping"),
            optional("table", Tables, "the load over the crank angle, crank angles ascending"),
            optional("interpolation", Choice(&["linear", "smooth"]), "between the points of the table"),
            optional("turns", Integer, "turns of the crank after which the table repeats"),
        ],
    ),
    section(
        "loads.table",
        &[
            needed("crank", ANGLES, "crank angle"),
            optional("moment", MOMENTS, "moment there"),
            optional("x", FORCES, "force along x there"),
            optional("y", FORCES, "force along y there"),
        ],
    ),
    section(
        "start",
        &[
            needed("crank", ANGLES, "crank angle at t = 0"),
            optional("groups", Tables, "configurations of the Assur groups"),
        ],
    ),
    section(
        "start.groups",
        &[
            needed("links", Texts, "all links of the group"),
            optional("mode", Choice(&["left", "right", "ahead", "behind"]), "which of a dyad's two configurations"),
            optional("near", TableOrTables, "approximate place of a point of the group"),
        ],
    ),
    section(
        "start.groups.near",
        &[
            needed("point", Text, "a point of the group"),
            needed("x", LENGTHS, "coordinate along x in the world"),
            needed("y", LENGTHS, "coordinate along y in the world"),
        ],
    ),
    section(
        "grid",
        &[
            optional("from", ANGLES_OR_TIMES, "first instant"),
            optional("to", ANGLES_OR_TIMES, "last instant"),
            optional("step", ANGLES_OR_TIMES, "distance of instants"),
            optional("angles", LIST_OF_ANGLES, "crank angles, one by one"),
            optional("times", LIST_OF_TIMES, "times, one by one"),
        ],
    ),
    section("channels", &[needed("want", Texts, "stages, subjects or channels that are wanted")]),
    section(
        "engine",
        &[
            optional("dt", TIMES, "time step"),
            optional("step", ANGLES, "the same as an angle of the crank"),
            optional("name", Text, "engine that judges unless another is asked for"),
            optional("sweeps", Integer, "sweeps of the engine's iteration in a step"),
            optional("substeps", Integer, "parts into which the engine divides a step"),
            optional("route", Choice(&["differences", "native", "probe"]), "how reactions are obtained"),
            optional("extrapolated", IntegerOrBoolean, "how often runs at half the step are combined"),
        ],
    ),
    section(
        "tolerances",
        &[optional("engine_rel", Number, "largest bound, as a share of a channel's scale, that proves something")],
    ),
    section(
        "clearance",
        &[
            RADIUS,
            optional("wanted", LENGTHS, "distance that no pair may fall to"),
            optional("tolerance", LENGTHS, "error that a smallest distance may have"),
            optional("area_rel", Number, "error that a swept area may have, as a share of it"),
            optional("outlines", Table, "outlines of links by name"),
            optional("housing", Tables, "parts of the housing"),
            optional("ignore", Tables, "pairs that cannot meet"),
        ],
    ),
    section("clearance.outlines.*", &[CORNERS, LINE, RADIUS]),
    section("clearance.outlines.*.corners", PLACE),
    section("clearance.outlines.*.line", PLACE),
    section("clearance.housing", &[needed("name", Text, "name, unique, not that of a link"), CORNERS, LINE, RADIUS]),
    section("clearance.housing.corners", PLACE),
    section("clearance.housing.line", PLACE),
    section("clearance.ignore", &[needed("bodies", Texts, "the two that cannot meet")]),
    section(
        "oracle",
        &[
            needed("source", Text, "author, title, table"),
            optional("name", Text, "name for reports"),
            optional("basis", Choice(&["published", "recomputed", "derived"]), "how the numbers are known"),
            optional("values", Tables, "numbers at one instant"),
            optional("figures", Tables, "figures of the mechanism"),
            optional("file", Text, "table beside the scenario"),
            CRANK,
            optional("crank", Text, "column of the crank angles"),
            AT_TIME,
            optional("time", Text, "column of the times"),
            optional("columns", Table, "what the columns of the table are, by name"),
            optional("digits", Integer, "number of decimals of the table"),
            optional("slack", Number, "known error of the published numbers, in their unit"),
            optional("why", Text, "the reason for it"),
        ],
    ),
    section(
        "oracle.values",
        &[needed("channel", Text, "channel, with the printed unit as its ending"), VALUE, DIGITS, FINDING, RIGHT],
    ),
    section("oracle.values.right", NUMBER),
    section(
        "oracle.figures",
        &[
            needed("figure", Text, "which figure"),
            optional("points", Texts, "the two points of a distance"),
            VALUE,
            DIGITS,
            FINDING,
            RIGHT,
        ],
    ),
    section("oracle.figures.right", NUMBER),
    section(
        "oracle.columns.*",
        &[
            needed("channel", Text, "channel, with the printed unit as its ending"),
            optional("offset", LENGTHS_OR_ANGLES, "printed = channel + offset"),
            optional("expect", Tables, "cells known to be wrong"),
            FINDING,
            RIGHT,
        ],
    ),
    section("oracle.columns.*.expect", &[CRANK, AT_TIME, FINDING, RIGHT]),
    section("oracle.columns.*.expect.right", NUMBER),
    section(
        "oracle.columns.*.right",
        &[needed("values", Numbers, "one for every row"), needed("digits", Integer, "number of printed decimals")],
    ),
    section(
        "formula",
        &[
            needed("name", Text, "name, which formulas after it may use"),
            needed("expression", Text, "arithmetic of numbers, phi, t, pi, parameters and formulas before it"),
            optional("channel", Text, "what it claims: a channel, or an arithmetic of channels"),
            optional("source", Text, "where it comes from"),
            optional("from", ANGLES, "first crank angle for which it is claimed"),
            optional("to", ANGLES, "last crank angle for which it is claimed"),
            optional("error", Number, "error that it is claimed to have, in the unit of the channel"),
        ],
    ),
];
