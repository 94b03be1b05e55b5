//! A free motion. Motor and loads act as forces, which Simbody requests at every evaluation of the equations of motion.
//! See docs/numerics/twins.md.

use std::cell::RefCell;
use std::rc::Rc;

use linkproof_simbody::{Act, IntegrationSettings, LinkageRun};

use super::model::Linkage;
use linkage::case::Case;
use linkage::drive::Wrench;
use linkage::engine::bodies::check_inertias;
use linkage::error::Result;
use linkage::solver::State;

/// Starts the run of a free motion at t = 0.
///
/// # Errors
/// The errors of [`check_inertias`], and failures of Simbody at the start.
pub(super) fn start(case: &Case, settings: IntegrationSettings) -> Result<(Linkage, LinkageRun)> {
    check_inertias(case, "Simbody")?;
    // A model driven at the initial speeds gives the initial rates of all links that are not driven.
    let driven = Linkage::new(case, 1.0, None)?;
    let told = |failure| driven.stopped(case, &failure);
    let rates: Vec<f64> = {
        let mut run = driven.model.run(settings).map_err(told)?;
        run.read(false).map_err(told)?.bodies.iter().map(|body| body.rate).collect()
    };
    let linkage = Linkage::new(case, 1.0, Some(&rates))?;
    let setting_off = Rc::new(RefCell::new(vec![0.0; case.mechanism.links().len()]));
    let begin = || {
        linkage
            .model
            .run_under(settings, Some(acting(case, &linkage, Rc::clone(&setting_off))))
            .map_err(|failure| linkage.stopped(case, &failure))
    };
    let mut run = begin()?;
    if !case.loads.iter().any(|load| load.sensed_link().is_some()) {
        return Ok((linkage, run));
    }
    // A link at rest starts in the direction of its acceleration.
    // This acceleration is computed without the loads that depend on the link's sense of rotation.
    let mut state = State::at_rest(case);
    let found = run.read(false).map_err(|failure| linkage.stopped(case, &failure))?;
    linkage.motion(&found.bodies, &mut state);
    for (sense, motion) in setting_off.borrow_mut().iter_mut().zip(&state.motions) {
        *sense = motion.alpha;
    }
    drop(run);
    let run = begin()?;
    Ok((linkage, run))
}

/// Function that gives the forces and moments of motor and loads, for positions and velocities from Simbody.
/// For a link at rest, loads that depend on its sense of rotation use the sense in which the link will start.
fn acting(case: &Case, linkage: &Linkage, setting_off: Rc<RefCell<Vec<f64>>>) -> Act {
    let (case, linkage) = (case.clone(), linkage.clone());
    let mut state = State::at_rest(&case);
    let mut wrenches = vec![Wrench::ZERO; case.mechanism.links().len()];
    Box::new(move |bodies, loads| {
        linkage.motion(bodies, &mut state);
        let State { motions, angles, .. } = &state;
        let senses = setting_off.borrow();
        let sensed = |_: usize, load: &linkage::drive::Load, crank: f64| {
            let Some(link) = load.sensed_link() else { return load.moment_in(case.load_rate(load, motions), crank) };
            let omega = motions[link].omega;
            load.moment_in(if omega == 0.0 { senses[link] } else { omega }, crank)
        };
        case.loads_with(motions, angles, sensed, &mut wrenches);
        if let Some(motor) = case.crank().moving_motor() {
            let (sense, crank) = (case.crank().sense(), case.crank().link);
            wrenches[crank].moment += sense * motor.moment_on_crank(sense * motions[crank].omega);
        }
        for (load, found) in loads.iter_mut().zip(linkage.loads(&wrenches)) {
            *load = found;
        }
    })
}
