use super::*;
use crate::fixtures::{link, mechanism};
use approx::assert_relative_eq;

/// Two wheels on a carrier that stands on the ground, 3 m apart.
fn two_wheels(kind: TransmissionKind) -> Result<Transmission> {
    let links = vec![
        link("ground", &[("O", 0.0, 0.0)]),
        link("carrier", &[("O", 0.0, 0.0), ("P", 3.0, 0.0)]),
        link("first", &[("O", 0.0, 0.0)]),
        link("second", &[("P", 0.0, 0.0)]),
    ];
    let pins = [("H", "O", "ground", "carrier"), ("S", "O", "ground", "first"), ("P", "P", "carrier", "second")];
    let mechanism = mechanism(links, &pins).unwrap();
    let [carrier, first, second] = ["carrier", "first", "second"].map(|name| mechanism.link_named(name).unwrap());
    let links = [first, second];
    let design = TransmissionDesign {
        name: "t".into(),
        kind,
        links,
        carrier,
        joint: JointId(2),
        start: 0.0,
        efficiency: [1.0; 2],
    };
    Transmission::of(mechanism.links(), mechanism.joints(), mechanism.size(), design)
}

fn gears(first: f64, second: f64) -> TransmissionKind {
    TransmissionKind::Gears { teeth: [first, second], pressure_angle: 0.3 }
}

fn belt(radii: [f64; 2], crossed: bool) -> TransmissionKind {
    TransmissionKind::Belt { radii, crossed, slack: 0.0 }
}

#[test]
fn ratios_and_radii_follow_from_teeth_and_radii() {
    let cases = [
        (gears(20.0, 40.0), -0.5, [1.0, 2.0]),
        (gears(20.0, -50.0), 0.4, [2.0, 5.0]),
        (gears(-50.0, 20.0), 2.5, [5.0, 2.0]),
        (belt([0.5, 1.0], false), 0.5, [0.5, 1.0]),
        (belt([0.5, 1.0], true), -0.5, [0.5, 1.0]),
    ];
    for (kind, ratio, radii) in cases {
        let own = two_wheels(kind).unwrap();
        assert_relative_eq!(own.ratio().unwrap(), ratio, epsilon = 1e-14);
        assert_relative_eq!(own.members[0].radius, radii[0], epsilon = 1e-14);
        assert_relative_eq!(own.members[1].radius, radii[1], epsilon = 1e-14);
        // The two lines of action have equal lever arms about the second axle and opposite senses.
        let lever = |line: &LineOfAction| cross(line.feet[1] - own.members[1].place, line.direction);
        let lines = own.contact([0.0; 2]).lines;
        assert_relative_eq!(lever(&lines[0]), -lever(&lines[1]), epsilon = 1e-14);
    }
}

/// External teeth push the axles apart. The teeth of a ring gear and the strands of a belt pull the axles together.
#[test]
fn lines_of_action_push_or_pull_the_second_axle() {
    let along = |kind| two_wheels(kind).unwrap().contact([0.0; 2]).lines.map(|line| line.direction.x);
    for (kind, away) in [(gears(20.0, 40.0), 1.0), (gears(20.0, -50.0), -1.0), (gears(-50.0, 20.0), -1.0)] {
        for own in along(kind) {
            assert_relative_eq!(own, away * 0.3f64.sin(), epsilon = 1e-14);
        }
    }
    for own in along(belt([0.5, 1.0], true)) {
        assert_relative_eq!(own, -(1.0 - 0.25f64).sqrt(), epsilon = 1e-14);
    }
    let own = two_wheels(belt([0.5, 1.0], false)).unwrap();
    assert_eq!((own.forces(3.0), own.forces(-3.0)), ([3.0, 0.0], [0.0, 3.0]));
    assert!(own.forces(f64::NAN).iter().any(|force| force.is_nan()));
}

#[test]
fn wheels_that_cannot_touch_are_refused() {
    for kind in [gears(20.0, -20.0), belt([2.0, 1.5], true), belt([4.0, 0.5], false)] {
        let error = two_wheels(kind).unwrap_err();
        assert!(error.to_string().contains("cannot touch"), "{error}");
    }
}
