//! Reads the numbers of a file with their derivatives.

use std::collections::BTreeMap;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::found::{CaseKey, CaseSlopes, KeySort};
use super::slope::Slope;
use crate::asked::StartRequest;
use crate::numbers::{path_of_entry, plain_number};
use crate::parameters::{Parameter, ParameterGraph, Parameters, arithmetic};
use crate::unit::{self, ACCELERATION, ANGLE, INERTIA, LENGTH, MASS, TIME, UnitFamily};
use formula::{FormulaTree, Program, Rounded};
use linkage::case::{Case, CaseNumber};
use linkage::mechanism::{GROUND, LinkId};

/// A table of the file, with its path.
#[derive(Clone)]
pub(super) struct Part<'a> {
    pub(super) table: &'a DeTable<'a>,
    pub(super) path: String,
}

impl<'a> Part<'a> {
    fn path_of(&self, key: &str) -> String {
        if self.path.is_empty() { key.into() } else { format!("{}.{key}", self.path) }
    }

    /// The value under a key.
    pub(super) fn value(&self, key: &str) -> Option<&'a Spanned<DeValue<'a>>> {
        self.table.get(key)
    }

    pub(super) fn text(&self, key: &str) -> Option<&'a str> {
        self.value(key)?.get_ref().as_str()
    }

    /// The texts of a list.
    pub(super) fn texts(&self, key: &str) -> Vec<&'a str> {
        let list = self.value(key).and_then(|value| value.get_ref().as_array());
        list.into_iter().flatten().filter_map(|value| value.get_ref().as_str()).collect()
    }

    /// The table under a key.
    pub(super) fn inner(&self, key: &str) -> Option<Part<'a>> {
        Some(Part { table: self.value(key)?.get_ref().as_table()?, path: self.path_of(key) })
    }

    /// The tables of a list, or the only table, with the paths that messages use.
    pub(super) fn list(&self, key: &str) -> Vec<Part<'a>> {
        let Some(value) = self.value(key) else { return Vec::new() };
        if let Some(part) = self.inner(key) {
            return vec![part];
        }
        let list = value.get_ref().as_array().into_iter().flatten().enumerate();
        let part = |(index, value): (usize, &'a Spanned<DeValue<'a>>)| {
            let table = value.get_ref().as_table()?;
            let path = path_of_entry(&self.path_of(key), index, value.get_ref());
            Some(Part { table, path })
        };
        list.filter_map(part).collect()
    }

    /// All tables by their keys, in the order of the file.
    fn all(&self) -> Vec<(&'a str, Part<'a>)> {
        let mut entries: Vec<_> = self.table.iter().collect();
        entries.sort_by_key(|(key, _)| key.span().start);
        let part = |(key, _): (&'a Spanned<std::borrow::Cow<'a, str>>, _)| {
            let key: &str = key.get_ref();
            Some((key, self.inner(key)?))
        };
        entries.into_iter().filter_map(part).collect()
    }
}

/// Coordinates of a point.
pub(super) type Place = [Slope; 2];

/// The state of reading a file.
pub(super) struct SlopeFile<'a> {
    pub(super) case: &'a Case,
    pub(super) found: CaseSlopes,
    parameters: Parameters,
    /// Values of the parameters, in the units of their keys.
    given: Vec<Slope>,
    /// Points by the names of link and point.
    points: BTreeMap<(String, String), Place>,
}

impl<'a> SlopeFile<'a> {
    /// Reads all sections of the file from which `case` and `parameters` were read.
    pub(super) fn read(
        case: &'a Case,
        tree: &'a DeTable<'a>,
        asked: &StartRequest,
        parameters: &[Parameter],
    ) -> SlopeFile<'a> {
        let found = CaseSlopes {
            keys: Vec::new(),
            numbers: BTreeMap::new(),
            tables: BTreeMap::new(),
            untold: Vec::new(),
            by_input: true,
        };
        let mut file =
            SlopeFile { case, found, parameters: Parameters::default(), given: Vec::new(), points: BTreeMap::new() };
        let root = Part { table: tree, path: String::new() };
        file.read_parameters(root.inner("parameters"), asked, parameters);
        file.read_links(&root);
        file.read_joints(&root);
        if let Some(gravity) = root.inner("gravity") {
            for (axis, key) in ["x", "y"].into_iter().enumerate() {
                let own = file.quantity(&gravity, key, &[&ACCELERATION], KeySort::Other);
                file.put(CaseNumber::Gravity { axis }, own);
            }
        }
        file.read_drives(&root, asked);
        file.read_loads(&root);
        if let Some(grid) = root.inner("grid") {
            let keys = ["from", "to", "times"].into_iter().flat_map(|key| TIME.all_keys(key));
            file.found.by_input = !keys.into_iter().any(|key| grid.value(&key).is_some());
        }
        file
    }

    pub(super) fn finish(self) -> CaseSlopes {
        self.found
    }

    /// Stores the slope of a number of the case, if the file states the number.
    pub(super) fn put(&mut self, number: CaseNumber, slope: Option<Slope>) {
        if let Some(slope) = slope {
            self.found.numbers.insert(number, slope);
        }
    }

    /// Records all keys on which `slope` depends as keys without a known derivative. `path` is the part of the file
    /// that uses them.
    pub(super) fn put_untold(&mut self, slope: &Slope, path: &str) {
        self.found.untold.extend(slope.by.keys().map(|key| (*key, path.to_string())));
    }

    fn add_key(&mut self, name: String, sort: KeySort, value: f64, unit: &'static str) -> usize {
        if let Some(known) = self.found.key(&name) {
            return known;
        }
        self.found.keys.push(CaseKey { name, sort, value, unit });
        self.found.keys.len() - 1
    }

    /// Every parameter is a key. A parameter that is an expression of other parameters also depends on their keys.
    fn read_parameters(&mut self, table: Option<Part<'a>>, asked: &StartRequest, all: &[Parameter]) {
        for parameter in all {
            let key = parameter.key.clone();
            let is_set = asked.set.iter().any(|(own, _)| *own == key);
            let mut slope = match table.as_ref().and_then(|table| table.text(&key)).filter(|_| !is_set) {
                Some(text) => self.expression(text, &key, &key).unwrap_or_default(),
                None => Slope::default(),
            };
            slope.value = parameter.given;
            let index = self.add_key(key, KeySort::Parameter, parameter.given, parameter.unit().unwrap_or_default());
            slope.by.insert(index, 1.0);
            self.given.push(slope);
            self.parameters.push(parameter.clone());
        }
    }

    /// The value of an expression of parameters for a key, in the unit of the key.
    /// If the expression has no derivative by one of its parameters, for example at a kink, the keys of this parameter
    /// are recorded as keys without a derivative.
    pub(super) fn expression(&mut self, text: &str, key: &str, path: &str) -> Option<Slope> {
        let value = arithmetic(text, key, &self.parameters).ok()?;
        let tree = FormulaTree::parse(text).ok()?;
        let wanted = unit::ending(key).map(|(_, unit)| unit);
        let ParameterGraph { names, mut graph, node } = ParameterGraph::of(&tree, &self.parameters)?;
        let slopes: Vec<_> = (0..names.len()).map(|input| graph.derivative(node, input)).collect();
        let mut program = Program::of(&graph, &slopes);
        let called = |(place, name): &(usize, &str), given: Option<f64>| {
            let own = &self.parameters.list()[*place];
            own.conversion(name, wanted).of(given.unwrap_or(own.given))
        };
        let inputs: Vec<Rounded> = names.iter().map(|own| Rounded::exact(called(own, None))).collect();
        let factors: Vec<f64> = names.iter().map(|own| called(own, Some(1.0))).collect();
        let found: Vec<f64> = program.run(&inputs).iter().map(|own| own.value).collect();
        let mut slope = Slope::constant(value);
        for (((place, _), factor), partial) in names.into_iter().zip(factors).zip(found) {
            let given = self.given[place].clone();
            if partial.is_finite() {
                slope.include(&given, partial * factor);
            } else {
                self.put_untold(&given, path);
            }
        }
        Some(slope)
    }

    /// A number of the file, in the unit of its key.
    pub(super) fn number(&mut self, value: &Spanned<DeValue>, key: &str, path: &str, sort: KeySort) -> Option<Slope> {
        if let DeValue::String(text) = value.get_ref() {
            return self.expression(text, key, path);
        }
        let value = plain_number(value.get_ref())?;
        let unit = unit::ending(key).map_or("", |(_, unit)| unit.suffix);
        let index = self.add_key(path.into(), sort, value, unit);
        Some(Slope { value, by: BTreeMap::from([(index, 1.0)]) })
    }

    /// A number without a unit.
    pub(super) fn plain(&mut self, part: &Part, key: &str, sort: KeySort) -> Option<Slope> {
        self.number(part.value(key)?, key, &part.path_of(key), sort)
    }

    /// A quantity in SI, whose key is `base` with a unit of one of the families; `None` if it is missing.
    pub(super) fn quantity(
        &mut self,
        part: &Part,
        base: &str,
        families: &[&'static UnitFamily],
        sort: KeySort,
    ) -> Option<Slope> {
        let spelled = |family: &&'static UnitFamily| {
            let key = family.all_keys(base).into_iter().find(|key| part.value(key).is_some())?;
            Some((family.unit_of(base, &key)?, key))
        };
        let (unit, key) = families.iter().find_map(spelled)?;
        let own = self.number(part.value(&key)?, &key, &part.path_of(&key), sort)?;
        Some(own.chained(unit.to_si(own.value), unit.to_si(1.0)))
    }

    /// A position: coordinates, or distance and direction from a point of the same link.
    fn place(&mut self, part: &Part, link: &str) -> Option<Place> {
        let Some(from) = part.text("from") else {
            let [x, y] = ["x", "y"].map(|key| self.quantity(part, key, &[&LENGTH], KeySort::Dimension));
            return Some([x?, y?]);
        };
        let origin = self.points.get(&(link.to_string(), from.to_string()))?.clone();
        let length = self.quantity(part, "length", &[&LENGTH], KeySort::Dimension)?;
        let [sin, cos] = self.quantity(part, "angle", &[&ANGLE], KeySort::Dimension)?.sin_cos();
        Some([&origin[0] + &(&cos * &length), &origin[1] + &(&sin * &length)])
    }

    /// The point of a link.
    pub(super) fn point(&self, link: &str, point: &str) -> Option<&Place> {
        self.points.get(&(link.to_string(), point.to_string()))
    }

    /// Stores both coordinates of a position.
    pub(super) fn put_place(&mut self, place: Option<&Place>, number: impl Fn(usize) -> CaseNumber) {
        for (axis, own) in place.into_iter().flatten().cloned().enumerate().collect::<Vec<_>>() {
            self.put(number(axis), Some(own));
        }
    }

    fn read_links(&mut self, root: &Part<'a>) {
        let ground = root.inner("ground").map(|ground| ("ground", ground));
        let links = root.inner("links").map(|links| links.all()).unwrap_or_default();
        let case = self.case;
        for (name, part) in ground.into_iter().chain(links) {
            let found = case
                .mechanism
                .links()
                .entries()
                .find(|(id, own)| own.name == name || name == "ground" && *id == GROUND);
            let Some((link, body)) = found else { continue };
            for (point, own) in part.inner("points").map(|points| points.all()).unwrap_or_default() {
                let Some(place) = self.place(&own, name) else { continue };
                if let Some(index) = body.points.iter().position(|own| own.name == point) {
                    self.put_place(Some(&place), |axis| CaseNumber::Point { link, point: index, axis });
                }
                self.points.insert((name.into(), point.into()), place);
            }
            if link != GROUND {
                self.read_mass(&part, name, link);
            }
        }
    }

    fn read_mass(&mut self, part: &Part, name: &str, link: LinkId) {
        let mass = self.quantity(part, "mass", &[&MASS], KeySort::Mass);
        self.put(CaseNumber::Mass(link), mass);
        let inertia = self.quantity(part, "inertia", &[&INERTIA], KeySort::Mass);
        self.put(CaseNumber::Inertia(link), inertia);
        let centre = part.inner("mass_centre").and_then(|centre| self.place(&centre, name));
        self.put_place(centre.as_ref(), |axis| CaseNumber::Centre { link, axis });
    }

    fn read_joints(&mut self, root: &Part<'a>) {
        for part in root.list("joints") {
            let Some(name) = part.text("name") else { continue };
            let Some(joint) = self.case.mechanism.joint_named(name) else { continue };
            let own = &self.case.mechanism.joints()[joint];
            let links = part.texts("links");
            let points = match part.texts("points") {
                points if points.len() == 2 => points,
                _ => vec![part.text("point").unwrap_or(name); 2],
            };
            for (side, (link, point)) in links.into_iter().zip(points).enumerate() {
                let place = self.point(link, point).cloned();
                self.put_place(place.as_ref(), |axis| CaseNumber::Place { joint, side, axis });
            }
            for (side, (guide, key)) in own.kind.axes().into_iter().flatten().zip(["axis", "second_axis"]).enumerate() {
                let angle = self.quantity(&part, key, &[&ANGLE], KeySort::Dimension).unwrap_or_default();
                // The case stores exact directions for guides along the axes of the frame. For such a guide, sine and
                // cosine computed from the angle would have rounding errors.
                let axis = [angle.chained(guide.x, -guide.y), angle.chained(guide.y, guide.x)];
                self.put_place(Some(&axis), |axis| CaseNumber::Guide { joint, side, axis });
            }
        }
    }
}

impl SlopeFile<'_> {
    /// Records the parameters in a formula as keys without a known derivative.
    pub(super) fn put_named(&mut self, text: &str, path: &str) {
        let Ok(tree) = FormulaTree::parse(text) else { return };
        for (name, _) in tree.names() {
            let Some(own) = self.parameters.called(name) else { continue };
            let place = self.parameters.list().iter().position(|other| other.key == own.key);
            if let Some(given) = place.map(|place| self.given[place].clone()) {
                self.put_untold(&given, path);
            }
        }
    }
}
