//! A scenario beside another party: solved at its instants.

use std::collections::BTreeSet;

use super::allowed::How;
use super::cause;
use super::contradiction;
use super::crank;
use super::instants;
use super::judge::Both;
use super::pair::{Pair, Side};
use super::scale::Scales;
use crate::proof::memory;
use crate::proof::solved::{Solved, asked};
use crate::tables::{At, Column, Held};
use formula::Rounded;
use linkage::case::Grid;
use linkage::error::{Error, ErrorKind, Result};
use linkage::trajectory::Channel;
use scenario::{Claim, Scenario, within};

/// What a scenario says of its own channels, at its own instants.
pub(super) fn held(scenario: &Scenario) -> Result<Held> {
    let channel = |channel: &Channel| Claim::of_channels(&channel.to_string(), std::slice::from_ref(channel)).ok();
    let claims: Vec<Claim> = scenario.case.channels().iter().filter_map(channel).collect();
    let solved = Solved::of(scenario, scenario.case.grid.clone(), &claims)?;
    let columns = columns(&solved, &claims, &|row| row, scenario.case.grid.len())?;
    Ok(Held::of_columns(Held::of_trajectory(solved.trajectory(), true).at, columns, true))
}

/// What the sides say of claims, `of(row)` being the instant of a row.
fn columns(solved: &Solved, claims: &[Claim], of: &dyn Fn(usize) -> usize, rows: usize) -> Result<Vec<Column>> {
    let column = |claim: &Claim| {
        let values = solved.on_course(|course| course.values(claim))?;
        let values = (0..rows).map(|row| values[of(row)]).collect();
        Ok(Column { claim: claim.clone(), values, scale: None, mapped: None })
    };
    claims.iter().map(column).collect()
}

/// Compares a scenario with a party, which gives the instants; `is_first` if the scenario was named first.
pub(super) fn beside(scenario: &Scenario, (name, held): Side, is_first: bool, how: &How) -> Result<Pair> {
    let at = held.at(how.by_crank)?;
    let (claims, alone) = claims(scenario, &held, how)?;
    let asked = claims.iter().flat_map(|claim| asked(claim, &scenario.case));
    let channels: BTreeSet<String> = asked.map(|channel| channel.to_string()).collect();
    let needed = memory::of_comparison(at.values.len(), claims.len(), channels.len());
    memory::check_input(&format!("comparing {} rows", at.values.len()), needed, how.memory)?;
    let (grid, rows) = grid(scenario, &at)?;
    let scales = Scales::of(scenario, &grid);
    let solved = Solved::of(scenario, grid, &claims)?.known_at_least(&|channel| scales.known(channel));
    let mut columns = columns(&solved, &claims, &|row| rows[row], at.values.len())?;
    columns.iter_mut().for_each(|column| column.scale = scales.of_claim(&column.claim));
    let drift = instants::drift(&solved, &claims, &at, &rows, &columns);
    let own = Held::of_columns(held.at.clone(), columns, true);
    let other = if held.is_analytic { as_well_known(held, &own) } else { held };
    let place = |of: &[f64]| rows.iter().map(|&row| of[row]).collect::<Vec<f64>>();
    let trajectory = solved.trajectory();
    let both = Both {
        parties: if is_first { [&own, &other] } else { [&other, &own] },
        at: &at,
        places: [place(trajectory.times()), place(trajectory.inputs())],
        drift: drift.claims,
        how,
    };
    let channels = both.judged(&claims);
    let contradiction = contradiction::found(&both, usize::from(is_first), &claims);
    let causes = match contradiction {
        None => cause::explained(scenario, &both, &channels, is_first)?,
        Some(_) => Vec::new(),
    };
    let mut checks = solved.checks().to_vec();
    if let (false, Some(theirs)) = (at.is_crank, &other.at.cranks) {
        let ours = solved.on_course(|course| Ok(rows.iter().map(|&row| course.crank(row)).collect::<Vec<_>>()))?;
        let cranks: [&[Rounded]; 2] = if is_first { [&ours, theirs] } else { [theirs, &ours] };
        checks.extend(crank::check(cranks, &both.places, &drift.crank, (usize::from(!is_first), true), how));
    }
    let (names, alone) = match is_first {
        true => ([String::new(), name], [Vec::new(), alone]),
        false => ([name, String::new()], [alone, Vec::new()]),
    };
    let (instants, by_crank, turns_back) = (at.values.len(), at.is_crank, at.turns_back());
    Ok(Pair { names, channels, checks, instants, unshared: 0, alone, turns_back, contradiction, by_crank, causes })
}

/// What a party says of channels that the scenario has, and the names of its other ones.
fn claims(scenario: &Scenario, held: &Held, how: &How) -> Result<(Vec<Claim>, Vec<String>)> {
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
        let message = format!("no channel that both have is called {}", how.only.join(" or "));
        return Err(Error::new(ErrorKind::Input, message).help("name a channel, a subject or a stage of both"));
    }
    if claims.is_empty() {
        let message = format!("the scenario {} has no channel of the other party", scenario.name);
        let error = Error::new(ErrorKind::Input, message);
        return Err(error.help("compare the same mechanism, or map columns to channels of the scenario"));
    }
    Ok((claims, alone))
}

/// The grid of some instants, every one once, and for every row its place in it.
fn grid(scenario: &Scenario, at: &At) -> Result<(Grid, Vec<usize>)> {
    let mut rows = vec![0; at.values.len()];
    let mut all: Vec<f64> = Vec::with_capacity(rows.len());
    for row in at.ascending() {
        let Rounded { value, error } = at.values[row];
        // A rounded instant may lie a little beyond the motion.
        let within = if at.is_crank { value } else { within(scenario.case.crank(), value) };
        let value = if (within - value).abs() <= error { within } else { value };
        if all.last() != Some(&value) {
            all.push(value);
        }
        rows[row] = all.len() - 1;
    }
    let crank = scenario.case.crank();
    let grid = if at.is_crank { Grid::of_inputs(crank, all) } else { Grid::of_times(crank, all) };
    grid.check(crank).map_err(|message| {
        let help = match at.is_crank && crank.is_free() {
            true => "give the table a column of times",
            false => "check the unit of the instants, and where they begin",
        };
        Error::new(ErrorKind::Input, format!("the instants of the other party: {message}")).help(help)
    })?;
    Ok((grid, rows))
}

/// What an analytic side has recorded is as well known as what it finds now.
fn as_well_known(mut held: Held, own: &Held) -> Held {
    for column in &mut held.columns {
        let Some(found) = own.values_of(&column.claim) else { continue };
        column.values.iter_mut().zip(found.iter()).for_each(|(value, found)| value.error += found.error);
    }
    held
}
