//! Random mechanisms with friction in their joints and losses in their transmissions.

use linkage::case::Case;
use linkage::drive::Load;
use linkage::mechanism::TransmissionKind;

use super::sketch::RandomSource;

/// Largest coefficient of friction. Friction with a larger coefficient locks many mechanisms.
const COEFFICIENT: f64 = 0.15;
/// Largest radius of a journal, divided by the mechanism's size.
const RADIUS: f64 = 0.03;
/// Range of the length of a guide, divided by the mechanism's size.
const GUIDE: [f64; 2] = [0.2, 0.6];
/// Smallest efficiency of a transmission.
const LEAST_EFFICIENCY: f64 = 0.6;

/// The mechanism of `case` with friction in about half of its joints, and losses in its transmissions except cams.
/// `None` if the case does not allow friction.
pub fn frictional(random: &mut RandomSource, case: &Case) -> Option<Case> {
    let size = case.mechanism.size();
    let mut loads = case.loads.clone();
    for (joint, own) in case.mechanism.joints().entries() {
        if random.yes() {
            continue;
        }
        let length = match own.slides() {
            false => size * random.number(0.0, RADIUS),
            true if random.yes() => 0.0,
            true => size * random.number(GUIDE[0], GUIDE[1]),
        };
        let coefficient = random.number(0.01, COEFFICIENT);
        loads.push(Load::Friction { joint, links: [own.first.link, own.second.link], coefficient, length });
    }
    let mut designs = case.mechanism.transmission_designs();
    for own in designs.iter_mut().filter(|own| !matches!(own.kind, TransmissionKind::Cam { .. })) {
        own.efficiency = [random.number(LEAST_EFFICIENCY, 1.0), random.number(LEAST_EFFICIENCY, 1.0)];
    }
    let mechanism = case.mechanism.clone().with_transmissions(designs).ok()?;
    case.with(|parts| (parts.loads, parts.mechanism) = (loads, mechanism)).ok()
}
