//! Faults in loads, springs and dampers.

use std::f64::consts::TAU;

use super::kind::kinds;
use linkage::case::Case;
use linkage::drive::load::Acts;
use linkage::drive::{Course, Drive, Load};
use linkage::mechanism::{Joint, LinkId, TransmissionDesign};
use prover::diagnosis::{recoupled, remade};

kinds! { Load, Case:
    "load-missing": "the first load is missing", |case, _| times(case, 0, 0.0);
    "last-load-missing": "the last load is missing", |case, _| times(case, case.loads.len().checked_sub(1)?, 0.0);
    "load-size" (1e-2): "the first load is too large by a relative amount", |case, size| times(case, 0, 1.0 + size);
    // Springs are excluded, because a spring of the wrong sign drives a free motion to infinity.
    // No scenario file can describe such a spring.
    "load-sign": "the first reversible load that is not a spring acts in the opposite direction", |case, _| {
        let others = (0..case.loads.len()).filter(|&index| !is_spring(&case.loads[index]));
        others.filter_map(|index| times(case, index, -1.0)).next()
    };
    "load-twice": "the first load is twice as large", |case, _| times(case, 0, 2.0);
    "load-by-ratio": "the first load is divided by the reducer's ratio", |case, _| {
        let ratio = case.drives.iter().find_map(Drive::motor)?.ratio;
        (ratio != 1.0).then(|| times(case, 0, 1.0 / ratio))?
    };
    "load-other-link": "the first moment acts on the preceding link", |case, _| changed(case, &|load| {
        if let Load::Resistance { link: link @ LinkId(2..), moment } = load {
            return Some(Load::Resistance { link: LinkId(link.index() - 1), moment: *moment });
        }
        let Load::Moment { link: link @ LinkId(2..), moment, acts } = load else { return None };
        Some(Load::Moment { link: LinkId(link.index() - 1), moment: moment.clone(), acts: *acts })
    });
    "load-place": "the first force acts at the mass centre", |case, _| changed(case, &|load| {
        let Load::Force { at, force, follows } = load else { return None };
        let centre = case.mechanism.links()[at.link].mass_centre;
        let at = linkage::mechanism::JointSide { link: at.link, local: centre };
        Some(Load::Force { at, force: force.clone(), follows: *follows })
    });
    "load-components": "x and y of the first force are exchanged", |case, _| changed(case, &|load| {
        let Load::Force { at, force: [x, y], follows } = load else { return None };
        Some(Load::Force { at: *at, force: [y.clone(), x.clone()], follows: *follows })
    });
    "load-frame": "a force in world axes is taken in link axes, or vice versa",
        |case, _| changed(case, &|load| {
            let Load::Force { at, force, follows } = load else { return None };
            Some(Load::Force { at: *at, force: force.clone(), follows: !follows })
        });
    "load-one-sense": "a resistance acts in the same direction whatever the motion", |case, _| changed(case, &|load| {
        let Load::Resistance { link, moment } = load else { return None };
        Some(Load::Moment { link: *link, moment: Course::Constant(-moment), acts: Acts::Always })
    });
    "load-always": "a moment for one sense of rotation always acts", |case, _| changed(case, &|load| {
        let Load::Moment { link, moment, acts: Acts::Clockwise | Acts::CounterClockwise } = load else {
            return None;
        };
        Some(Load::Moment { link: *link, moment: moment.clone(), acts: Acts::Always })
    });
    "load-mean": "a load that depends on the crank angle keeps its value at angle zero", |case, _| {
        let at_zero = |course: &Course| Course::Constant(course.at(0.0));
        changed(case, &|load| {
            load.nature().courses.iter().any(|course| course.knots().is_some()).then_some(())?;
            if let Load::Moment { link, moment, acts } = load {
                return Some(Load::Moment { link: *link, moment: at_zero(moment), acts: *acts });
            }
            let Load::Force { at, force, follows } = load else { return None };
            Some(Load::Force { at: *at, force: force.each_ref().map(at_zero), follows: *follows })
        })
    };
    "spring-missing": "the first spring is missing", |case, _| times(case, sprung(case)?, 0.0);
    "spring-twice": "the first spring is twice as strong", |case, _| times(case, sprung(case)?, 2.0);
    "spring-stiffness" (1e-2): "the first spring is too stiff by a relative amount",
        |case, size| times(case, sprung(case)?, 1.0 + size);
    "spring-free-length": "the free length of the first spring is zero", |case, _| changed(case, &|load| {
        let Load::Spring { ends, stiffness, free_length } = load else { return None };
        (*free_length != 0.0).then_some(Load::Spring { ends: *ends, stiffness: *stiffness, free_length: 0.0 })
    });
    "spring-free-angle": "the free angle of a torsion spring is one turn too large", |case, _| changed(case, &|load| {
        let &Load::TorsionSpring { links, stiffness, free_angle, acts } = load else { return None };
        Some(Load::TorsionSpring { links, stiffness, free_angle: free_angle + TAU, acts })
    });
    "friction-missing": "the first friction is missing", |case, _| times(case, rubbed(case, |_| true)?, 0.0);
    "friction-sign": "the first friction acts with the sliding", |case, _| times(case, rubbed(case, |_| true)?, -1.0);
    "friction" (1e-2): "the first friction is too strong by a relative amount",
        |case, size| times(case, rubbed(case, |_| true)?, 1.0 + size);
    "friction-diameter": "the radius of the first journal is taken as its diameter", |case, _| {
        times(case, rubbed(case, |joint| !joint.slides())?, 0.5)
    };
    "friction-of-moment": "the moment of the first guide causes no friction", |case, _| changed(case, &|load| {
        let &Load::Friction { joint, links, coefficient, length } = load else { return None };
        let has_moment = case.mechanism.joints()[joint].slides() && length > 0.0;
        has_moment.then_some(Load::Friction { joint, links, coefficient, length: 0.0 })
    });
    "efficiency" (1e-2): "the efficiency of the first transmission is too small by a relative amount",
        |case, size| lossy(case, |[forward, back]| [forward * (1.0 - size), back - size * back.abs()]);
    "efficiency-missing": "the first transmission loses no power", |case, _| lossy(case, |_| [1.0; 2]);
    "efficiency-side": "the efficiencies of the first transmission are exchanged",
        |case, _| lossy(case, |[forward, back]| if back > 0.0 { [back, forward] } else { [forward, forward] });
    "damper-missing": "the first damper is missing", |case, _| times(case, damped(case)?, 0.0);
    "damper-sign": "the first damper has the wrong sign", |case, _| times(case, damped(case)?, -1.0);
    "damper" (1e-2): "the first damper is too strong by a relative amount", |case, size| times(case, damped(case)?, 1.0 + size);
    "damper-degrees": "a torsion damper's speed is in degrees per second", |case, _| {
        let index = case.loads.iter().position(|load| matches!(load, Load::TorsionDamper { .. }))?;
        times(case, index, 1f64.to_degrees())
    };
}

/// The case with one load multiplied by a factor.
fn times(case: &Case, index: usize, factor: f64) -> Option<Case> {
    remade(case, |parts| {
        let own = parts.loads.get(index)?.times(factor)?;
        parts.loads.splice(index..=index, own);
        Some(())
    })
}

/// The case with a change to the first load that `change` accepts.
fn changed(case: &Case, change: &dyn Fn(&Load) -> Option<Load>) -> Option<Case> {
    let (index, wrong) = case.loads.iter().enumerate().find_map(|(index, load)| Some((index, change(load)?)))?;
    remade(case, |parts| {
        parts.loads[index] = wrong;
        Some(())
    })
}

fn is_spring(load: &Load) -> bool {
    matches!(load, Load::Spring { .. } | Load::TorsionSpring { .. })
}

fn sprung(case: &Case) -> Option<usize> {
    case.loads.iter().position(is_spring)
}

/// Index of the first friction load whose joint `is_meant` accepts. Friction in meshes is skipped.
fn rubbed(case: &Case, is_meant: impl Fn(&Joint) -> bool) -> Option<usize> {
    case.frictions().find(|own| !own.is_mesh() && is_meant(&case.mechanism.joints()[own.joint])).map(|own| own.index)
}

/// Changes the efficiencies of the first transmission with losses.
fn lossy(case: &Case, change: impl Fn([f64; 2]) -> [f64; 2]) -> Option<Case> {
    let (id, own) = case.mechanism.transmissions().entries().find(|(_, own)| own.losses.is_some())?;
    let other = TransmissionDesign { efficiency: change(own.design.efficiency), ..own.design.clone() };
    (other != own.design).then_some(())?;
    remade(case, |parts| recoupled(parts, id, Some(other)))
}

fn damped(case: &Case) -> Option<usize> {
    case.loads.iter().position(|load| matches!(load, Load::Damper { .. } | Load::TorsionDamper { .. }))
}
