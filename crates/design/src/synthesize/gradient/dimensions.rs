//! The numbers of a candidate, with derivatives by the variables of the task.

use std::collections::BTreeMap;

use linkage::case::{Case, CaseNumber, load_places};
use linkage::error::Result;
use linkage::math::Vec2;
use linkage::mechanism::{GROUND, Link, LinkId};
use precise::{CaseNumbers, Dual, Scalar};

use crate::synthesize::bars::BarMass;
use crate::synthesize::search::of_share;
use crate::synthesize::task::{PointPosition, Task, TaskNumber};

/// Numbers of a candidate that differ from the drawing's numbers, each with `N` derivatives.
pub(super) struct Dimensions<'a, const N: usize> {
    task: &'a Task,
    numbers: BTreeMap<CaseNumber, Dual<f64, N>>,
    /// Values of the variables (SI). Derivatives are with respect to the variables as fractions of their ranges.
    variables: Vec<Dual<f64, N>>,
}

impl<'a, const N: usize> Dimensions<'a, N> {
    /// The numbers of a candidate. `shares` are the candidate's variables, as fractions of their ranges.
    /// The derivatives are with respect to the fractions `first` to `first + N - 1`.
    pub(super) fn of(task: &'a Task, shares: &[f64], first: usize) -> Self {
        let variable = |(index, share): (usize, &f64)| {
            let variable = &task.variables[index];
            let range = variable.bounds[1] - variable.bounds[0];
            let slope = |k: usize| if first + k == index { range } else { 0.0 };
            Dual { value: of_share(*share, variable), slopes: std::array::from_fn(slope) }
        };
        let variables = shares.iter().take(task.variables.len()).enumerate().map(variable).collect();
        let mut found = Dimensions { task, numbers: BTreeMap::new(), variables };
        task.places.iter().for_each(|place| found.put(place));
        found.numbers.insert(CaseNumber::Zero(0), found.number(task.zero));
        found.weigh();
        found
    }

    /// All numbers of the case. The candidate's numbers replace the drawing's numbers.
    ///
    /// # Errors
    /// The errors of [`CaseNumbers::lifted`].
    pub(super) fn lifted(&self, case: &Case) -> Result<CaseNumbers<Dual<f64, N>>> {
        let lift = |number: CaseNumber, value: f64| self.numbers.get(&number).copied().unwrap_or(Dual::of(value));
        CaseNumbers::lifted(case, &lift, &|_, _| Vec::new())
    }

    #[cfg(test)]
    pub(super) fn number_of(&self, number: CaseNumber) -> Dual<f64, N> {
        self.numbers[&number]
    }

    /// Mass of all moving links (kg).
    pub(super) fn mass(&self) -> Dual<f64, N> {
        let mass = |(link, body): (LinkId, &Link)| {
            self.numbers.get(&CaseNumber::Mass(link)).copied().unwrap_or(Dual::of(body.mass))
        };
        let moving = self.task.case.mechanism.links().entries().filter(|(link, _)| *link != GROUND);
        moving.map(mass).fold(Dual::ZERO, |sum, mass| sum + mass)
    }

    fn number(&self, number: TaskNumber) -> Dual<f64, N> {
        match number {
            TaskNumber::Fixed(value) => Dual::of(value),
            TaskNumber::Free(index) => self.variables[index],
        }
    }

    /// Position of a point in the frame of its link (m).
    pub(super) fn local(&self, link: LinkId, point: usize) -> [Dual<f64, N>; 2] {
        let drawn = self.task.case.mechanism.links()[link].points[point].local;
        let number = |axis: usize| self.numbers.get(&CaseNumber::Point { link, point, axis }).copied();
        [0, 1].map(|axis| number(axis).unwrap_or(Dual::of(drawn[axis])))
    }

    /// Moves a point, together with the joints and loads at this point.
    fn put(&mut self, place: &PointPosition) {
        let [a, b] = place.entries.map(|entry| self.number(entry));
        let (link, point) = (place.handle.link, place.handle.point);
        let local = match place.from {
            None => [a, b],
            Some(from) => {
                let ([x, y], (sin, cos)) = (self.local(link, from), b.sin_cos());
                [x + a * cos, y + a * sin]
            }
        };
        let case = &self.task.case;
        let drawn = case.mechanism.links()[link].points[point].local;
        for (axis, value) in local.into_iter().enumerate() {
            self.numbers.insert(CaseNumber::Point { link, point, axis }, value);
            for (joint, side) in case.mechanism.sides(&place.handle) {
                self.numbers.insert(CaseNumber::Place { joint, side, axis }, value);
            }
            for (load, end) in loads_at(case, link, drawn) {
                self.numbers.insert(CaseNumber::LoadPlace { load, end, axis }, value);
            }
        }
    }

    /// Masses of the bars, if the task states their mass per metre.
    fn weigh(&mut self) {
        let Some(density) = self.task.bar else { return };
        let links = self.task.case.mechanism.links();
        for (link, body) in links.entries().filter(|(link, _)| *link != GROUND) {
            let points: Vec<_> = (0..body.points.len()).map(|point| self.local(link, point)).collect();
            let Some(bars) = BarMass::of(&points, density) else { continue };
            self.numbers.insert(CaseNumber::Mass(link), bars.mass);
            self.numbers.insert(CaseNumber::Inertia(link), bars.inertia);
            for (axis, value) in bars.centre.into_iter().enumerate() {
                self.numbers.insert(CaseNumber::Centre { link, axis }, value);
            }
        }
    }
}

/// Loads that act on a point of a link: index of the load, and index of the load's end at this point.
fn loads_at(case: &Case, link: LinkId, local: Vec2) -> impl Iterator<Item = (usize, usize)> {
    let ends = |(load, own)| load_places(own).into_iter().flatten().enumerate().map(move |(end, at)| (load, end, at));
    let all = case.loads.iter().enumerate().flat_map(ends);
    all.filter(move |(.., at)| at.link == link && at.local == local).map(|(load, end, _)| (load, end))
}
