//! A case as JSON for other programs: all data needed to solve it, in SI units.
//! docs/peers.md lists the keys.

use serde_json::{Map, Value, json};

use super::pretty::pretty;
use linkage::case::Case;
use linkage::drive::load::{Acts, LoadPart};
use linkage::drive::{Course, Drive, DriveMotion, Load, MotionLaw, Motor, MotorLaw, On};
use linkage::input::Input;
use linkage::math::Vec2;
use linkage::mechanism::{JointSide, LinkId};
use linkage::solver::State;

/// Version of the JSON format.
const FORMAT: u32 = 1;

/// The case called `name`, as JSON.
/// The JSON includes the poses, velocities and accelerations of `start`, the state at t = 0.
pub(crate) fn text(name: &str, case: &Case, start: &State) -> String {
    let links = case.mechanism.links().iter().zip(&start.motions).zip(&start.angles);
    let links = links.map(|((link, motion), angle)| {
        let points: Map<String, Value> =
            link.points.iter().map(|point| (point.name.clone(), pair(point.local))).collect();
        json!({
            "name": link.name, "mass_kg": link.mass, "inertia_kg_m2": link.inertia,
            "mass_centre_m": pair(link.mass_centre), "points_m": points,
            "start": {
                "origin_m": pair(motion.origin), "angle_rad": angle,
                "velocity_m_s": pair(motion.velocity), "omega_rad_s": motion.omega,
                "acceleration_m_s2": pair(motion.acceleration), "alpha_rad_s2": motion.alpha,
            },
        })
    });
    let joints = case.mechanism.joints().iter().map(|joint| {
        json!({
            "name": joint.name, "type": joint.kind.name(),
            "first": side(case, joint.first), "second": side(case, joint.second),
            "axes": joint.kind.axes().map(|axes| axes.map(pair)),
        })
    });
    let transmissions = case.mechanism.transmissions().iter().map(|own| {
        let (design, joints) = (&own.design, case.mechanism.joints());
        json!({
            "name": design.name, "type": design.kind.name(), "links": design.links.map(|link| self::name(case, link)),
            "carrier": self::name(case, design.carrier), "joint": joints[design.joint].name, "start": design.start,
            "ratio": own.ratio(), "efficiency": design.efficiency,
        })
    });
    let value = json!({
        "format": FORMAT, "name": name, "gravity_m_s2": pair(case.gravity),
        "links": links.collect::<Vec<_>>(), "joints": joints.collect::<Vec<_>>(),
        "transmissions": transmissions.collect::<Vec<_>>(),
        "drives": case.drives.iter().map(|own| drive(case, own)).collect::<Vec<_>>(),
        "loads": case.loads.iter().map(|own| load(case, own)).collect::<Vec<_>>(),
        "size_m": case.mechanism.size(), "top_speed_rad_s": case.drives.top_speed(case.mechanism.size()),
        "free": case.is_free(), "times_s": case.grid.times,
        "channels": case.channels().iter().map(|channel| json!({
            "name": channel.to_string(), "stage": channel.kind.stage.name(), "unit": channel.kind.unit.symbol(),
        })).collect::<Vec<_>>(),
    });
    pretty(&value)
}

fn pair(vector: Vec2) -> Value {
    json!([vector.x, vector.y])
}

fn name(case: &Case, link: LinkId) -> &str {
    &case.mechanism.links()[link].name
}

fn side(case: &Case, side: JointSide) -> Value {
    json!({ "link": name(case, side.link), "at_m": pair(side.local) })
}

fn drive(case: &Case, drive: &Drive) -> Value {
    let unit = if drive.input == Input::Slide { "m" } else { "rad" };
    let motion = match &drive.motion {
        DriveMotion::Prescribed { law, .. } => law_of(law, unit),
        DriveMotion::Free { initial_speed, nominal_speed, motor } => json!({
            "law": "free", format!("initial_speed_{unit}_s"): initial_speed, "sense": nominal_speed.signum(),
            "motor": motor.as_ref().map(motor_of),
        }),
    };
    json!({
        "joint": case.mechanism.joints()[drive.joint].name, "link": name(case, drive.link),
        format!("zero_{unit}"): drive.zero, format!("start_{unit}"): drive.start, "motion": motion,
    })
}

/// A motion law of an input in the unit `unit`: rad or m.
fn law_of(law: &MotionLaw, unit: &str) -> Value {
    let speed_key = format!("speed_{unit}_s");
    match law {
        MotionLaw::ConstantSpeed(omega) => json!({ "law": law.name(), speed_key: omega }),
        MotionLaw::Ramp { speed, time } => json!({ "law": law.name(), speed_key: speed, "time_s": time }),
        MotionLaw::Cycloidal { rise, time } => {
            json!({ "law": law.name(), format!("rise_{unit}"): rise, "time_s": time })
        }
        // For a law given as a curve, only the law's name is written, because a spline has no short form.
        MotionLaw::Curve(_) => json!({ "law": law.name() }),
    }
}

fn motor_of(motor: &Motor) -> Value {
    let law = match &motor.law {
        MotorLaw::Constant { torque } => json!({ "law": "constant", "torque_N_m": torque }),
        MotorLaw::Linear { at_rest, slope } => {
            json!({ "law": "linear", "torque_at_rest_N_m": at_rest, "slope_N_m_s": slope })
        }
        MotorLaw::Kloss { breakdown_torque, breakdown_slip, synchronous_speed } => json!({
            "law": "kloss", "breakdown_torque_N_m": breakdown_torque, "breakdown_slip": breakdown_slip,
            "synchronous_speed_rad_s": synchronous_speed,
        }),
        MotorLaw::Table { speeds, torques } => {
            json!({ "law": "table", "speeds_rad_s": speeds, "torques_N_m": torques })
        }
    };
    json!({
        "torque": law, "ratio": motor.ratio, "efficiency": motor.efficiency,
        "inertia_on_crank_kg_m2": motor.inertia_on_crank(),
    })
}

/// The value of a load over the motion: a number if it is constant.
/// A table is not written. In its place, an object states the table's period in turns, or that its variable is a slide.
fn course(course: &Course) -> Value {
    match course {
        Course::Constant(value) => json!(value),
        Course::Table { turns: Some(turns), .. } => json!({ "table_over_turns": turns }),
        Course::Table { turns: None, .. } => json!({ "table_over": "slide" }),
    }
}

fn load(case: &Case, load: &Load) -> Value {
    let (place, on) = match load.nature().on {
        On::Link(link) => ("link", json!(name(case, link))),
        On::Joint(joint, _) => ("joint", json!(case.mechanism.joints()[joint].name)),
        On::Links(links) => ("links", json!(links.map(|link| name(case, link)))),
        On::Point(at) => ("at", side(case, at)),
        On::Points(ends) => ("ends", json!(ends.map(|end| side(case, end)))),
    };
    let mut all = Map::from_iter([("type".into(), json!(load.sort())), (place.into(), on)]);
    for part in load.clone().parts() {
        let (name, value) = match part {
            LoadPart::Link(_) | LoadPart::Point(_) => continue,
            LoadPart::Number { role: _, name, value } => (name, json!(value)),
            LoadPart::Courses { name, values: [one] } => (name, course(one)),
            LoadPart::Courses { name, values } => (name, values.iter().map(course).collect()),
            LoadPart::Acts(Acts::Always) => ("acts", json!("always")),
            LoadPart::Acts(Acts::CounterClockwise) => ("acts", json!("counter_clockwise")),
            LoadPart::Acts(Acts::Clockwise) => ("acts", json!("clockwise")),
            LoadPart::Follows(follows) => ("follows", json!(follows)),
        };
        all.insert(name.into(), value);
    }
    Value::Object(all)
}
