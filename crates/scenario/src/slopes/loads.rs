//! The numbers of loads.

use std::collections::BTreeSet;
use std::f64::consts::PI;

use super::file::{Part, SlopeFile};
use super::found::KeySort;
use super::slope::Slope;
use crate::unit::ANGLE;
use crate::unit::{
    DAMPING, FORCE, INPUTS, LENGTH, MOMENT, MOMENT_PER_SPEED, PRESSURE, STIFFNESS, TORSIONAL_STIFFNESS, UnitFamily,
};
use linkage::case::{Case, CaseNumber};
use linkage::drive::{Course, Load};

/// A quantity of a load as stated in the file: a constant, or the points of a table.
enum Stated {
    Constant(Slope),
    Table(Vec<(f64, Slope)>),
}

impl<'a> SlopeFile<'a> {
    pub(super) fn read_loads(&mut self, root: &Part<'a>) {
        let case: &'a Case = self.case;
        for (load, (part, own)) in root.list("loads").into_iter().zip(&case.loads).enumerate() {
            self.read_load(&part, load, own);
        }
    }

    fn read_load(&mut self, part: &Part<'a>, load: usize, own: &Load) {
        let numbers: &[(&str, &'static UnitFamily)] = match own {
            Load::Resistance { .. } => &[("moment", &MOMENT)],
            Load::ResistingForce { .. } => &[("force", &FORCE)],
            Load::Spring { .. } => &[("stiffness", &STIFFNESS), ("free_length", &LENGTH)],
            Load::Damper { .. } | Load::SlideDamper { .. } => &[("damping", &DAMPING)],
            Load::TorsionSpring { .. } => &[("stiffness", &TORSIONAL_STIFFNESS), ("free_angle", &ANGLE)],
            Load::TorsionDamper { .. } => &[("damping", &MOMENT_PER_SPEED)],
            Load::SlideSpring { .. } => &[("stiffness", &STIFFNESS), ("free_slide", &LENGTH)],
            Load::Moment { moment, .. } => return self.read_course(part, [load, 0], "moment", &MOMENT, moment),
            Load::Force { force: [x, y], .. } => {
                self.read_course(part, [load, 0], "x", &FORCE, x);
                self.read_course(part, [load, 1], "y", &FORCE, y);
                &[]
            }
            Load::SlideForce { force, .. } => return self.read_thrust(part, load, force),
            Load::Friction { .. } => {
                let coefficient = self.plain(part, "coefficient", KeySort::Load);
                let length = self.quantity(part, "radius", &[&LENGTH], KeySort::Load);
                let length = length.or_else(|| self.quantity(part, "length", &[&LENGTH], KeySort::Load));
                for (index, own) in [coefficient, Some(length.unwrap_or_default())].into_iter().enumerate() {
                    self.put(CaseNumber::Load { load, part: index }, own);
                }
                return;
            }
        };
        for (index, (key, family)) in numbers.iter().enumerate() {
            let own = self.quantity(part, key, &[*family], KeySort::Load);
            self.put(CaseNumber::Load { load, part: index }, own);
        }
        let ends = match (part.text("link"), part.text("point")) {
            (Some(link), Some(point)) => vec![(link, point)],
            _ => part.texts("links").into_iter().zip(part.texts("points")).collect(),
        };
        for (end, (link, point)) in ends.into_iter().enumerate() {
            let place = self.point(link, point).cloned();
            self.put_place(place.as_ref(), |axis| CaseNumber::LoadPlace { load, end, axis });
        }
    }

    /// A force along a slide, given as a force or as a pressure on a piston.
    fn read_thrust(&mut self, part: &Part<'a>, load: usize, course: &Course) {
        let Some(bore) = self.quantity(part, "bore", &[&LENGTH], KeySort::Dimension) else {
            return self.read_course(part, [load, 0], "thrust", &FORCE, course);
        };
        let area = bore.chained(PI * bore.value * bore.value / 4.0, PI * bore.value / 2.0);
        match self.stated(part, "pressure", &PRESSURE) {
            Some(Stated::Constant(pressure)) => {
                self.put(CaseNumber::Load { load, part: 0 }, Some(&area * &pressure));
            }
            Some(Stated::Table(points)) => {
                let points = points.into_iter().map(|(crank, own)| (crank, &own * &area)).collect::<Vec<_>>();
                self.put_table(part, [load, 0], &points, course);
            }
            None => {}
        }
    }

    fn read_course(
        &mut self,
        part: &Part<'a>,
        place: [usize; 2],
        key: &str,
        family: &'static UnitFamily,
        course: &Course,
    ) {
        match self.stated(part, key, family) {
            Some(Stated::Constant(own)) => self.put(CaseNumber::Load { load: place[0], part: place[1] }, Some(own)),
            Some(Stated::Table(points)) => self.put_table(part, place, &points, course),
            None => {}
        }
    }

    fn stated(&mut self, part: &Part<'a>, key: &str, family: &'static UnitFamily) -> Option<Stated> {
        let rows = part.list("table");
        if rows.is_empty() {
            return self.quantity(part, key, &[family], KeySort::Load).map(Stated::Constant);
        }
        let mut points = Vec::with_capacity(rows.len());
        for row in &rows {
            let crank = self.quantity(row, "crank", &INPUTS, KeySort::Other)?;
            // A change of this key shifts the points of the table. The derivative for such a shift is not computed.
            self.put_untold(&crank, &row.path);
            points.push((crank.value, self.quantity(row, key, &[family], KeySort::Load)?));
        }
        Some(Stated::Table(points))
    }

    /// A table is linear in its values, so the derivative of the table is a table of the derivatives of its values.
    fn put_table(&mut self, part: &Part<'a>, [load, index]: [usize; 2], points: &[(f64, Slope)], course: &Course) {
        let keys: BTreeSet<usize> = points.iter().flat_map(|(_, own)| own.by.keys().copied()).collect();
        let smooth = part.text("interpolation") == Some("smooth");
        let table = |key: usize| {
            let slope = |(crank, own): &(f64, Slope)| (*crank, own.by.get(&key).copied().unwrap_or(0.0));
            let slopes: Vec<(f64, f64)> = points.iter().map(slope).collect();
            match course.turns() {
                Some(turns) => Course::table(&slopes, turns, smooth),
                None => Course::over_slide(&slopes),
            }
        };
        self.found.tables.insert((load, index), keys.into_iter().map(|key| (key, table(key))).collect());
    }
}
