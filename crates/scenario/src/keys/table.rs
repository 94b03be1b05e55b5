//! The table itself.

use super::key::Kind::{
    Choice, Integer, Number, Numbers, Quantities, Quantity, Table, TableOrTables, Tables, Text, Texts,
};
use super::key::{Key, Kind, Section, needed, optional};
use crate::engine::KEYS;
use crate::unit::{
    ACCELERATION, ANGLE, ANGULAR_SPEED, DAMPING, FORCE, INERTIA, LENGTH, MASS, MOMENT, MOMENT_PER_SPEED, STIFFNESS,
    TIME, TORSIONAL_STIFFNESS,
};

const fn section(path: &'static str, keys: &'static [Key]) -> Section {
    Section { path, keys }
}

const ACCELERATIONS: Kind = Quantity(&[&ACCELERATION]);
const ANGLES: Kind = Quantity(&[&ANGLE]);
/// Values of an input: see [`unit::of_input`](crate::unit::of_input).
const INPUTS: Kind = Quantity(&[&ANGLE]);
const INPUTS_OR_TIMES: Kind = Quantity(&[&ANGLE, &TIME]);
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
    optional("x", LENGTHS, "coordinate along x", "given with `y`, in place of `from`"),
    optional("y", LENGTHS, "coordinate along y", "given with `x`"),
    optional("from", Text, "point that stands earlier in the same table", "given in place of `x` and `y`"),
    optional("length", LENGTHS, "distance from that point", "given with `from`"),
    optional(
        "angle",
        ANGLES,
        "direction from that point, counted from the x axis of the link; for ground points, from the x axis of the world",
        "given with `from`",
    ),
];

const NUMBER: &[Key] = &[
    needed("value", Number, "the number, in the printed unit"),
    needed("digits", Integer, "number of printed decimals"),
];

const RADIUS: Key = optional(
    "radius",
    LENGTHS,
    "radius of the rounding: positive of a line, not negative of a polygon or of a part of the housing",
    "that of the section; of a polygon 0",
);
const CORNERS: Key = optional(
    "corners",
    Tables,
    "places, three or more: a polygon with its interior, convex or not, in either sense",
    "a line",
);
const LINE: Key = optional(
    "line",
    Tables,
    "places: capsules from place to place; a single one is a disc",
    "through the link's points, if there are no corners",
);
const FINDING: Key = optional(
    "finding",
    Text,
    "anchor of the section of `docs/findings.md` that says why the number is wrong",
    "the number is right",
);
const RIGHT: Key = optional("right", Table, "what is right instead, in the printed unit", "required with `finding`");
const VALUE: Key = needed("value", Number, "the number, in the unit of the name");
const DIGITS: Key = needed("digits", Integer, "number of printed decimals");
const CRANK: Key = optional("crank", INPUTS, "crank angle", "a time is given");
const AT_TIME: Key = optional("time", TIMES, "time", "a crank angle is given");

/// All sections.
pub static SECTIONS: &[Section] = &[
    section(
        "",
        &[
            needed("format", Integer, "version of this format: 1"),
            needed("name", Text, "short name for file names: `a`-`z`, `0`-`9`, `_`"),
            needed("title", Text, "one line for the reader"),
            optional("source", Text, "where the dimensions come from", "none"),
            optional("parameters", Table, "numbers with names, for other numbers and for formulas", "none"),
            needed("ground", Table, "the frame"),
            needed("links", Table, "moving links by name"),
            needed("joints", Tables, "joints"),
            needed("drive", TableOrTables, "what moves the driving links; the first is the crank"),
            optional("motor", Table, "the motor behind the crank", "none"),
            optional("gravity", Table, "acceleration of gravity", "none"),
            optional("loads", Tables, "forces, moments, springs and dampers", "none"),
            needed("start", Table, "pose at t = 0"),
            needed("grid", Table, "the instants of results"),
            optional("channels", Table, "the results that are wanted", "all"),
            optional("engine", Table, "settings of the engine", "found by `run`"),
            optional("tolerances", Table, "at what bound agreement still proves something", "its defaults"),
            optional("oracle", Tables, "numbers that the mechanism must reproduce", "none"),
            optional(
                "clearance",
                Table,
                "outlines of links and a housing: do they meet, and how near are they?",
                "none",
            ),
            optional("formula", Tables, "formulas as they were derived, and what they claim to be", "none"),
        ],
    ),
    section("ground", &[needed("points", Table, "fixed points by name")]),
    section("ground.points.*", PLACE),
    section(
        "links.*",
        &[
            needed("points", Table, "points in the link's own frame by name, at least one"),
            optional("mass", MASSES, "mass, not negative", "none: a massless link"),
            optional(
                "mass_centre",
                Table,
                "place of the mass centre in the link's frame; may refer to any point of the link",
                "required with a mass, refused without",
            ),
            optional("inertia", INERTIAS, "moment of inertia about the mass centre, not negative; needs a mass", "0"),
        ],
    ),
    section("links.*.points.*", PLACE),
    section("links.*.mass_centre", PLACE),
    section(
        "joints",
        &[
            needed("name", Text, "name, unique"),
            needed("type", Choice(&["revolute", "prismatic"]), "kind of joint"),
            needed(
                "links",
                Texts,
                "first and second link; `\"ground\"` is the frame. The reaction of the joint is what the first exerts on the second",
            ),
            optional(
                "point",
                Text,
                "revolute: the joint is at the point of this name, on both links",
                "the joint's name",
            ),
            optional(
                "points",
                Texts,
                "prismatic: `[\"G\", \"B\"]`, a point of the first link and one of the second; the line through the first point along the axis passes through the second point",
                "required of a prismatic joint",
            ),
            optional(
                "axis",
                ANGLES,
                "prismatic: direction of sliding in the frame of the first link",
                "required of a prismatic joint",
            ),
            optional(
                "second_axis",
                ANGLES,
                "prismatic: the same direction in the frame of the second link; it fixes the angle of the second link to the first",
                "0: along its x axis",
            ),
            optional(
                "drawn",
                Choice(&["cylinder", "block"]),
                "prismatic: what pictures show, a piston in a cylinder, or a block on rails or in a slot; nothing is calculated from it",
                "guessed from names and places: docs/draw.md",
            ),
        ],
    ),
    section(
        "drive",
        &[
            needed("joint", Text, "revolute joint between the ground and the driving link"),
            optional(
                "law",
                Choice(&["constant", "ramp", "cycloidal", "table"]),
                "crank angle over time; below",
                "`\"constant\"`",
            ),
            optional("zero", INPUTS, "world direction from which the crank angle is measured", "0"),
            optional(
                "motion",
                Choice(&["prescribed", "free"]),
                "`\"free\"`: forces determine the motion, see below",
                "`\"prescribed\"`",
            ),
            optional("initial_speed", SPEEDS, "of a free link: its angular velocity at t = 0", "0"),
            optional(
                "through",
                Choice(&["smooth"]),
                "the mechanism passes change points on the branch on which velocities go on; see below",
                "a change point is an error; a free motion passes it",
            ),
            optional(
                "start",
                ANGLES,
                "of every drive but the first: its angle at t = 0",
                "required there, refused on the first",
            ),
            optional(
                "speed",
                SPEEDS,
                "angular velocity, counter-clockwise positive, not zero",
                "required but of the laws `\"cycloidal\"` and `\"table\"`",
            ),
            optional("time", TIMES, "duration of a ramp, or of a cycloidal law", "required of these laws"),
            optional("to", INPUTS, "last crank angle of a cycloidal law", "required of this law"),
            optional(
                "points",
                Tables,
                "points of a table, two or more: times ascending from 0, the first angle that of the start",
                "required of the law `\"table\"`",
            ),
        ],
    ),
    section("drive.points", &[needed("time", TIMES, "time"), needed("angle", INPUTS, "crank angle at that time")]),
    section(
        "motor",
        &[
            needed("law", Choice(&["constant", "linear", "kloss", "table"]), "torque over the motor's own speed"),
            needed("ratio", Number, "speed of the motor over that of the crank; 1 without a reducer"),
            optional(
                "efficiency",
                Number,
                "share of the power that the reducer transmits, above 0 and at most 1, the same in both directions",
                "1",
            ),
            optional("torque", MOMENTS, "constant law: the torque, positive", "required of this law"),
            optional("torque_at_rest", MOMENTS, "linear law: torque at rest, positive", "required of this law"),
            optional("slope", SLOPES, "linear law: change with the speed, negative", "required of this law"),
            optional("breakdown_torque", MOMENTS, "Kloss: largest torque", "required of this law"),
            optional("synchronous_speed", SPEEDS, "Kloss: synchronous speed", "required of this law"),
            optional("breakdown_slip", Number, "Kloss: slip at breakdown, or", "the speed is given"),
            optional("breakdown_speed", SPEEDS, "Kloss: speed at breakdown", "the slip is given"),
            optional("points", Tables, "table: two or more, speeds ascending", "required of this law"),
            optional("rotor_inertia", INERTIAS, "moment of inertia of the rotor about its shaft", "0"),
            optional("input_inertia", INERTIAS, "of the reducer's input shaft, which turns with the motor", "0"),
            optional("intermediate_inertia", INERTIAS, "of its intermediate shaft", "0"),
            optional(
                "intermediate_ratio",
                Number,
                "speed of the intermediate shaft over that of the crank",
                "required with its inertia",
            ),
            optional("output_inertia", INERTIAS, "of its output shaft, which turns with the crank", "0"),
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
            optional("link", Text, "the loaded link", "required by the type"),
            optional("point", Text, "the loaded point of that link", "required by the type"),
            optional(
                "links",
                Texts,
                "the two links that a spring or damper joins; one may be `\"ground\"`",
                "required by the type",
            ),
            optional("points", Texts, "a point of each of them", "required by the type"),
            optional(
                "moment",
                MOMENTS,
                "moment, counter-clockwise positive; of a resistance its size, not negative",
                "required by the type, or a table",
            ),
            optional(
                "acts",
                Choice(&["always", "counter-clockwise", "clockwise"]),
                "of a moment: the sense of rotation of the link in which it acts",
                "`\"always\"`",
            ),
            optional("x", FORCES, "force along x", "required by the type, or a table"),
            optional("y", FORCES, "force along y", "required by the type, or a table"),
            optional(
                "frame",
                Choice(&["world", "link"]),
                "axes of a force: those of the world, or of the link, turning with it",
                "`\"world\"`",
            ),
            optional(
                "force",
                FORCES,
                "size of a force against the motion of the point, not negative",
                "required by the type",
            ),
            optional(
                "stiffness",
                STIFFNESSES_OR_TORSIONAL,
                "stiffness of a spring, not negative",
                "required by the type",
            ),
            optional(
                "free_length",
                LENGTHS,
                "length of the spring without force, not negative",
                "required by the type",
            ),
            optional("free_angle", ANGLES, "twist of the spring without moment", "required by the type"),
            optional("damping", DAMPINGS_OR_SLOPES, "damping, not negative", "required by the type"),
            optional(
                "table",
                Tables,
                "the load over the crank angle: crank angles ascending, within one period",
                "the constants",
            ),
            optional(
                "interpolation",
                Choice(&["linear", "smooth"]),
                "of the table: straight lines, which do not overshoot, or a periodic cubic spline with continuous second derivatives",
                "`\"linear\"`",
            ),
            optional(
                "turns",
                Integer,
                "turns of the crank after which the table repeats; 2 for a four-stroke engine",
                "1",
            ),
        ],
    ),
    section(
        "loads.table",
        &[
            needed("crank", INPUTS, "crank angle"),
            optional("moment", MOMENTS, "moment there", "of a moment"),
            optional("x", FORCES, "force along x there", "of a force"),
            optional("y", FORCES, "force along y there", "of a force"),
        ],
    ),
    section(
        "start",
        &[
            needed("crank", INPUTS, "crank angle at t = 0, of the first drive"),
            optional("groups", Tables, "one table for each Assur group", "none: a mechanism without groups"),
        ],
    ),
    section(
        "start.groups",
        &[
            needed("links", Texts, "all links of the group"),
            optional(
                "mode",
                Choice(&["left", "right", "ahead", "behind"]),
                "which of a dyad's two configurations; below. RPP and PRP dyads have one, and need no table",
                "by `near`",
            ),
            optional(
                "near",
                TableOrTables,
                "approximate position in the world of one point of the group; or an array of several such tables",
                "by `mode`",
            ),
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
            optional(
                "from",
                INPUTS_OR_TIMES,
                "first crank angle, or first time from the start",
                "given with `to` and `step`",
            ),
            optional("to", INPUTS_OR_TIMES, "last one, in the same kind of unit", "given with `from`"),
            optional("step", INPUTS_OR_TIMES, "distance of instants; may be negative", "given with `from`"),
            optional(
                "angles",
                LIST_OF_ANGLES,
                "crank angles, one by one, in any order; not for a free motion",
                "a range",
            ),
            optional("times", LIST_OF_TIMES, "times, one by one, in any order", "a range"),
        ],
    ),
    section("channels", &[needed("want", Texts, "stages, subjects or channels that are wanted")]),
    section("engine", &KEYS),
    section(
        "tolerances",
        &[optional(
            "engine_rel",
            Number,
            "largest bound on the engine's error, as a share of a channel's scale, at which agreement still proves something; between 0 and 1",
            "1e-2",
        )],
    ),
    section(
        "clearance",
        &[
            optional(
                "radius",
                LENGTHS,
                "radius, positive, of the capsules between the points of every link that has no outline of its own",
                "every link needs an outline of its own",
            ),
            optional("wanted", LENGTHS, "distance that no pair may fall to", "only collisions count"),
            optional(
                "tolerance",
                LENGTHS,
                "error that a smallest distance may have",
                "a millionth of the mechanism's size",
            ),
            optional("area_rel", Number, "error that a swept area may have, as a share of it; from 1e-5 to 1", "5e-3"),
            optional("outlines", Table, "outlines of links by name", "capsules between the points"),
            optional("housing", Tables, "parts of the housing", "none"),
            optional("ignore", Tables, "pairs that cannot meet, because they lie in different planes", "none"),
        ],
    ),
    section("clearance.outlines.*", &[CORNERS, LINE, RADIUS]),
    section("clearance.outlines.*.corners", PLACE),
    section("clearance.outlines.*.line", PLACE),
    section("clearance.housing", &[needed("name", Text, "name, unique, not that of a link"), CORNERS, LINE, RADIUS]),
    section("clearance.housing.corners", PLACE),
    section("clearance.housing.line", PLACE),
    section(
        "clearance.ignore",
        &[needed("bodies", Texts, "the two that cannot meet; `\"housing\"` stands for all its parts")],
    ),
    section(
        "oracle",
        &[
            needed("source", Text, "author, title, table"),
            optional("name", Text, "name for reports", "none"),
            optional(
                "basis",
                Choice(&["published", "recomputed", "derived"]),
                "how the numbers are known: printed in the source, computed anew from what it gives, or a formula from given data",
                "`\"published\"`",
            ),
            optional("values", Tables, "numbers at one instant", "one of `file`, `values` and `figures`"),
            optional("figures", Tables, "figures of the mechanism", "one of `file`, `values` and `figures`"),
            optional(
                "file",
                Text,
                "path of a table, relative to the scenario's directory",
                "one of `file`, `values` and `figures`",
            ),
            CRANK,
            optional(
                "crank",
                Text,
                "column of the crank angles of the file, as this scenario measures them (ends in `_deg` or `_rad`)",
                "with `file`: the other column is given",
            ),
            AT_TIME,
            optional(
                "time",
                Text,
                "column of the times of the file (ends in `_s` or `_ms`)",
                "with `file`: the other column is given",
            ),
            optional("columns", Table, "what the columns of the table are, by name", "required with `file`"),
            optional(
                "digits",
                Integer,
                "number of decimals of the table, where trailing zeros are not printed",
                "the printed ones",
            ),
            optional(
                "slack",
                Number,
                "known error of the published numbers, in their printed unit, added to their bounds",
                "0",
            ),
            optional("why", Text, "the reason for it", "required with `slack`"),
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
            optional("points", Texts, "the two points of a distance", "required of a distance"),
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
            optional("offset", LENGTHS_OR_ANGLES, "printed = channel + offset; for coordinates and angles", "0"),
            optional("expect", Tables, "cells known to be wrong, by crank angle or time as the table", "none"),
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
            needed("name", Text, "letters, digits and `_`; formulas after it may use it"),
            needed(
                "expression",
                Text,
                "arithmetic of numbers, `phi`, `t`, `pi`, parameters (in SI, or by their keys as plain numbers) and formulas before it",
            ),
            optional(
                "channel",
                Text,
                "what it claims: a channel, with the unit of its name (`link.rocker.angle_deg`, `point.B.x_mm`, `joint.B.f_N`), or an arithmetic of channels; also what is reduced to the crank",
                "none: a step of a derivation",
            ),
            optional("source", Text, "where it comes from", "none"),
            optional("from", INPUTS, "first crank angle for which it is claimed", "the whole run"),
            optional("to", INPUTS, "last crank angle for which it is claimed", "the whole run"),
            optional(
                "error",
                Number,
                "error that it is claimed to have, in the unit of the channel: for series and approximations",
                "none: it is exact",
            ),
        ],
    ),
];
