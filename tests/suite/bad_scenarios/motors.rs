//! Errors in `[motor]`.

use super::{Bad, GOOD, INPUT, assert_refused};

#[test]
fn laws_and_reducers() {
    let linear = "law = \"linear\"\ntorque_at_rest_N_m = 1\nslope_N_m_s = -1\nratio = 1\n";
    let cases: [(String, &'static str, &'static str, &[&str]); 12] = [
        ("law = \"constant\"\nratio = 1\n".into(), "[motor]", "motor", &["torque_N_m", "missing"]),
        (
            "law = \"kloss\"\nbreakdown_torque_N_m = 1\nsynchronous_speed_rpm = 3000\nratio = 1\n".into(),
            "[motor]",
            "motor",
            &["`breakdown_speed_rad_s` is missing", "breakdown_slip"],
        ),
        (
            "law = \"kloss\"\nbreakdown_torque_N_m = 1\nsynchronous_speed_rpm = 3000\nbreakdown_slip = 0.2\nbreakdown_speed_rpm = 2400\nratio = 1\n"
                .into(),
            "breakdown_slip",
            "motor.breakdown_slip",
            &["both given", "one of the two"],
        ),
        (
            "law = \"kloss\"\nbreakdown_torque_N_m = 1\nsynchronous_speed_rpm = 3000\nbreakdown_slip = 0\nratio = 1\n".into(),
            "breakdown_slip",
            "motor.breakdown_slip",
            &["found 0", "positive"],
        ),
        (
            "law = \"kloss\"\nbreakdown_torque_N_m = 1\nsynchronous_speed_rpm = 3000\nbreakdown_speed_rpm = 3000\nratio = 1\n".into(),
            "[motor]",
            "motor",
            &["is not below the synchronous speed"],
        ),
        (
            "law = \"table\"\npoints = [{ speed_rpm = 0, torque_N_m = 1 }]\nratio = 1\n".into(),
            "points = [{",
            "motor.points",
            &["at least two points, found 1"],
        ),
        (
            "law = \"table\"\npoints = [{ speed_rpm = 9, torque_N_m = 1 }, { speed_rpm = 9, torque_N_m = 0 }]\nratio = 1\n".into(),
            "points = [{",
            "motor.points[2]",
            &["do not ascend", "ascending order"],
        ),
        (format!("{linear}efficiency = 92\n"), "efficiency", "motor.efficiency", &["found 92", "0.92 for 92 %"]),
        (format!("{linear}efficiency = 0\n"), "efficiency", "motor.efficiency", &["found 0"]),
        (
            format!("{linear}rotor_inertia_kg_m2 = -1\n"),
            "rotor_inertia",
            "motor.rotor_inertia_kg_m2",
            &["must not be negative"],
        ),
        (
            format!("{linear}intermediate_inertia_kg_m2 = 1\n"),
            "intermediate_inertia",
            "motor.intermediate_inertia_kg_m2",
            &["speed is not known", "intermediate_ratio"],
        ),
        (
            format!("{linear}intermediate_inertia_kg_m2 = 1\nintermediate_ratio = 0\n"),
            "intermediate_ratio",
            "motor.intermediate_ratio",
            &["found 0", "divided by the speed of the crank"],
        ),
    ];
    for (text, at, key, words) in cases {
        let section: &'static str = Box::leak(format!("[motor]\n{text}[start]").into_boxed_str());
        assert_refused(GOOD, &Bad { edits: &[("[start]", section)], kind: INPUT, at, key, words });
    }
}
