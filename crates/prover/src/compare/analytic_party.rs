//! Compares a scenario with another party: the scenario is solved at the instants of the other party.
//! The scenario can be solved at shifted instants, which gives the uncertainty due to rounded instants.

use crate::sentences;
use std::collections::BTreeSet;

use super::allowed::ComparisonRule;
use super::cause;
use super::judge::{Both, Which};
use super::pair::{Side, SidePair, crank_check};
use super::scale::Scales;
use crate::check::KnownTrajectory;
use crate::run::memory;
use crate::run::shifted::{Along, grow, is_exact, shifted};
use crate::run::solved::{Solved, asked};
use crate::tables::{Held, PartyColumn, RowKey};
use analytic::AssurSolver;
use formula::Rounded;
use linkage::case::{Case, Grid};
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::KeepNan;
use linkage::trajectory::{Channel, Trajectory};
use scenario::{Claim, Scenario, within};

/// Values of all requested channels of a scenario, at the scenario's own instants.
pub(super) fn held(scenario: &Scenario) -> Result<Held> {
    let channel = |channel: &Channel| Claim::of_channels(&channel.to_string(), std::slice::from_ref(channel)).ok();
    let claims: Vec<Claim> = scenario.case.channels().iter().filter_map(channel).collect();
    let solved = Solved::of(scenario, scenario.case.grid.clone(), &claims)?;
    let columns = columns(&solved, &claims, &|row| row, scenario.case.grid.len())?;
    Ok(Held::of_columns(Held::of_trajectory(solved.trajectory()).at, columns).analytic())
}

/// Values of claims as the analytic sides calculate them; `of(row)` is the grid index of a row.
fn columns(solved: &Solved, claims: &[Claim], of: &dyn Fn(usize) -> usize, rows: usize) -> Result<Vec<PartyColumn>> {
    let column = |claim: &Claim| {
        let values = solved.on_course(|course| course.values(claim))?;
        let values = (0..rows).map(|row| values[of(row)]).collect();
        Ok(PartyColumn { claim: claim.clone(), values, scale: None, mapped: None })
    };
    claims.iter().map(column).collect()
}

/// Compares a scenario (the party `which`) with the party `other` at the instants of `other`.
pub(super) fn beside(scenario: &Scenario, which: Which, other: Side, how: &ComparisonRule) -> Result<SidePair> {
    let Side { name, held } = other;
    let at = held.at(how.by)?;
    let (claims, alone) = claims(scenario, &held, how)?;
    let asked = claims.iter().flat_map(|claim| asked(claim, &scenario.case));
    let channels: BTreeSet<String> = asked.map(|channel| channel.to_string()).collect();
    let needed = memory::of_comparison(at.values.len(), claims.len(), channels.len());
    memory::check_input(&sentences::comparing_rows(&at.values.len()), needed, how.memory)?;
    let (grid, rows) = grid(scenario, &at)?;
    let scales = Scales::of(scenario, &grid);
    let solved = Solved::of(scenario, grid, &claims)?.known_at_least(&|channel| scales.known(channel));
    let mut columns = columns(&solved, &claims, &|row| rows[row], at.values.len())?;
    columns.iter_mut().for_each(|column| column.scale = scales.of_claim(&column.claim));
    let drift = drift(&solved, &columns, &at, &rows);
    let own = Held::of_columns(held.at.clone(), columns).analytic();
    let other = if held.is_analytic { as_well_known(held, &own) } else { held };
    let place = |of: &[f64]| rows.iter().map(|&row| of[row]).collect::<Vec<f64>>();
    let trajectory = solved.trajectory();
    let both = Both {
        parties: which.beside(&own, &other),
        at: &at,
        input: scenario.case.crank().input,
        instants: [place(trajectory.times()), place(trajectory.inputs())],
        drift: drift.claims,
        how,
    };
    let mut pair = SidePair {
        names: which.beside(String::new(), name),
        alone: which.beside(Vec::new(), alone),
        checks: solved.checks().to_vec(),
        ..SidePair::of(&both, which.other(), &claims)
    };
    if pair.contradiction.is_none() {
        (pair.causes, pair.is_search_cut) = cause::explained(scenario, which, &both, &pair.channels)?;
    }
    if let (false, Some(theirs)) = (at.is_crank, &other.at.cranks) {
        let ours = solved.on_course(|course| Ok(rows.iter().map(|&row| course.crank(row)).collect::<Vec<_>>()))?;
        pair.checks.extend(crank_check(&both, which.beside(ours.as_slice(), theirs), &drift.crank));
    }
    Ok(pair)
}

/// The requested claims of a party that concern channels of the scenario, and the names of the party's other channels.
fn claims(scenario: &Scenario, held: &Held, how: &ComparisonRule) -> Result<(Vec<Claim>, Vec<String>)> {
    let (mut claims, mut alone) = (Vec::new(), Vec::new());
    let asked = how.asked();
    for column in held.columns.iter().filter(|column| asked(&column.claim)) {
        match (Claim::parse(&column.claim.text, &scenario.case), &column.mapped) {
            (Ok(claim), _) => claims.push(claim),
            (Err(fault), Some(mapped)) => return Err(mapped.wrong(&fault.message, &fault.help)),
            (Err(_), None) => alone.push(column.claim.text.clone()),
        }
    }
    if claims.is_empty() && !how.only.is_empty() {
        let message = sentences::no_channel_that_both_have_is_called(&how.only.join(" or "));
        return Err(Error::new(ErrorKind::Input, message).help(sentences::NAME_A_CHANNEL_A_SUBJECT));
    }
    if claims.is_empty() {
        let message = sentences::the_scenario_has_no_channel(&scenario.name);
        let error = Error::new(ErrorKind::Input, message);
        return Err(error.help(sentences::COMPARE_THE_SAME_MECHANISM_OR_MAP));
    }
    Ok((claims, alone))
}

/// Builds a grid in which each instant of the rows occurs once. Also returns the grid index of every row.
fn grid(scenario: &Scenario, at: &RowKey) -> Result<(Grid, Vec<usize>)> {
    let mut rows = vec![0; at.values.len()];
    let mut all: Vec<f64> = Vec::with_capacity(rows.len());
    for row in at.ascending() {
        let Rounded { value, error } = at.values[row];
        // Rounding may put a time slightly outside the motion. Such a time is moved to the nearer end of the motion.
        let within = if at.is_crank { value } else { within(scenario.case.crank(), value) };
        let value = if (within - value).abs() <= error { within } else { value };
        if all.last() != Some(&value) {
            all.push(value);
        }
        rows[row] = all.len() - 1;
    }
    let crank = scenario.case.crank();
    let grid = if at.is_crank { Grid::of_inputs(crank, all) } else { Grid::of_times(crank, all) };
    grid.check(&scenario.case.drives).map_err(|message| {
        let help = match at.is_crank && crank.is_free() {
            true => sentences::GIVE_THE_TABLE_A_COLUMN_OF_TIMES,
            false => sentences::CHECK_THE_UNIT_OF_THE_INSTANTS,
        };
        Error::new(ErrorKind::Input, sentences::the_instants_of_the_other(&message)).help(help)
    })?;
    Ok((grid, rows))
}

/// Enlarges the error bounds of an analytic side's recorded values. The values stay unchanged.
/// Each bound is enlarged by the bound of the same value in `own`, for which this run solves the channels again.
fn as_well_known(mut held: Held, own: &Held) -> Held {
    for column in &mut held.columns {
        let Some(found) = own.values_of(&column.claim) else { continue };
        column.values.iter_mut().zip(found.iter()).for_each(|(value, found)| value.error += found.error);
    }
    held
}

/// Uncertainty of numbers due to the rounding of their instants, row by row; empty if the instants are exact.
#[derive(Default)]
pub(super) struct Drift {
    /// Uncertainty by claim, in the claim's unit.
    pub claims: Vec<Vec<f64>>,
    /// Uncertainty of the input (rad or m).
    pub crank: Vec<f64>,
}

/// The largest change of every claim within the rounding of the instants: see [`shifted`].
/// If the scenario cannot be solved at the shifted instants, the change is estimated from neighbouring rows.
pub(super) fn drift(solved: &Solved, columns: &[PartyColumn], at: &RowKey, rows: &[usize]) -> Drift {
    let trajectory = solved.trajectory();
    let mut slack = vec![0.0; trajectory.times().len()];
    for (own, &row) in at.values.iter().zip(rows) {
        slack[row] = slack[row].larger(if is_exact(own.value, own.error) { 0.0 } else { own.error });
    }
    if slack.iter().all(|slack| *slack == 0.0) {
        return Drift::default();
    }
    let of_rows = |of: &[f64]| rows.iter().map(|&row| of[row]).collect::<Vec<f64>>();
    if let Ok(Drift { claims, crank }) = by_solving(solved, columns, at, &slack) {
        return Drift { claims: claims.iter().map(|own| of_rows(own)).collect(), crank: of_rows(&crank) };
    }
    let (instants, order) = (at.values.iter().map(|at| at.value).collect::<Vec<f64>>(), at.ascending());
    let slack = of_rows(&slack);
    let along = |values: &[Rounded], turn| columns::drift(values, &instants, &slack, &order, turn);
    let cranks: Vec<Rounded> = of_rows(trajectory.inputs()).into_iter().map(Rounded::exact).collect();
    let claims = columns.iter().map(|own| along(&own.values, own.claim.turn())).collect();
    Drift { claims, crank: along(&cranks, None) }
}

fn by_solving(solved: &Solved, columns: &[PartyColumn], at: &RowKey, slack: &[f64]) -> Result<Drift> {
    let (case, own) = (&solved.case, solved.trajectory());
    let mut drift = Drift { claims: vec![vec![0.0; slack.len()]; columns.len()], crank: vec![0.0; slack.len()] };
    let values = |case: &Case, trajectory: &Trajectory, claim: &Claim| {
        KnownTrajectory::new(case, trajectory, &|_, _| 0.0).values(claim)
    };
    let along = if at.is_crank { Along::Crank } else { Along::Time };
    shifted(case, own, along, slack, &AssurSolver, &mut |shifted, found| {
        let claims = columns.iter().map(|own| &own.claim);
        for (claim, drift) in claims.zip(&mut drift.claims).filter(|(claim, _)| claim.figures.is_empty()) {
            let (before, after) = (values(case, own, claim)?, values(shifted, found, claim)?);
            grow(drift, before.iter().zip(&after).map(|(before, after)| after.value - before.value), claim.turn());
        }
        let turned = own.inputs().iter().zip(found.inputs()).map(|(before, after)| after - before);
        grow(&mut drift.crank, turned, None);
        Ok(())
    })?;
    Ok(drift)
}
