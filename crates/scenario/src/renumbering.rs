//! Points, masses and moments of inertia of links as functions of varied numbers of the file.
//!
//! The results are equal, bit by bit, to the results for a scenario that is read with these numbers.
//! If a varied number has further effects, or is not allowed, the file must be read instead.

use std::collections::{BTreeMap, BTreeSet};

use toml::de::{DeTable, DeValue};

use super::family::ScenarioFamily;
use super::keys::key::{Sign, ValueKind};
use super::numbers::{self, is_path, plain_number};
use super::parameters::{Conversion, Parameter, Parameters, arithmetic};
use super::reader::SMALLEST;
use super::unit::{self, ANGLE, INERTIA, LENGTH, MASS, NamedUnit, UnitFamily};
use super::{keys, masses};
use formula::{FormulaGraph, FormulaTree, Program, Rounded};
use linkage::case::Case;
use linkage::math::{Vec2, unit as direction};
use linkage::mechanism::{Joint, Link, Mechanism, check_masses};

/// Expressions of parameters, for keys with units. The expressions are evaluated together, and common parts only once.
struct Expressions {
    /// For each input of the program: the index of the parameter, and the conversion to the unit of the key.
    names: Vec<(usize, Conversion)>,
    inputs: Vec<Rounded>,
    program: Program,
}

impl Expressions {
    /// Reads texts, each with its key.
    fn read(texts: &[(String, String)], parameters: &Parameters) -> Option<Expressions> {
        let trees: Vec<_> = texts.iter().map(|(_, text)| FormulaTree::parse(text).ok()).collect::<Option<_>>()?;
        let mut names = Vec::new();
        let mut meanings = Vec::new();
        for ((key, _), tree) in texts.iter().zip(&trees) {
            let wanted = unit::ending(key).map(|(_, unit)| unit);
            let mut meaning = |name| {
                let place = parameters.place(name)?;
                let input = (place, parameters.list()[place].conversion(name, wanted));
                let at = names.iter().position(|own| *own == input).unwrap_or(names.len());
                if at == names.len() {
                    names.push(input);
                }
                Some((name, at))
            };
            let words = tree.names().into_iter().map(|(name, _)| name).filter(|name| *name != "pi");
            meanings.push(words.map(&mut meaning).collect::<Option<Vec<_>>>()?);
        }
        let mut graph = FormulaGraph::new(&[], names.len());
        let mut nodes = Vec::new();
        for (tree, meanings) in trees.iter().zip(meanings) {
            meanings.into_iter().for_each(|(name, input)| graph.name(name, graph.input(input)));
            nodes.push(graph.add(tree).ok()?);
        }
        let inputs = vec![Rounded::exact(0.0); names.len()];
        Some(Expressions { names, inputs, program: Program::of(&graph, &nodes) })
    }

    /// The values; `None` if a rounding error is not finite. The reader refuses such a value.
    fn values(&mut self, parameters: &[Parameter]) -> Option<&[Rounded]> {
        for (input, (place, conversion)) in self.inputs.iter_mut().zip(&self.names) {
            *input = Rounded::exact(conversion.of(parameters[*place].given));
        }
        let found = self.program.run(&self.inputs);
        found.iter().all(|own| own.error.is_finite()).then_some(found)
    }
}

/// Where a number comes from, in the unit of its key.
enum Origin {
    /// The varied number with this index.
    Varied(usize),
    /// The expression with this index.
    Expression(usize),
}

/// The numbers of a case.
#[derive(Clone, Copy)]
struct CaseNumbers<'a> {
    varied: &'a [f64],
    expressions: &'a [Rounded],
}

/// A number of a link.
enum LinkNumber {
    /// The same number in all cases (SI).
    Fixed(f64),
    Changing(Origin, LinkQuantity),
}

/// Unit and limits of a link's number.
struct LinkQuantity {
    unit: &'static NamedUnit,
    family: &'static UnitFamily,
    sign: Sign,
}

impl LinkQuantity {
    /// The number in SI; `None` if it is not allowed.
    fn checked(&self, number: f64) -> Option<f64> {
        let si = self.unit.to_si(number);
        let is_allowed =
            self.sign.broken_by(number).is_none() && (si == 0.0 || (SMALLEST..=self.family.most).contains(&si.abs()));
        is_allowed.then_some(si)
    }
}

/// A position: coordinates, or the distance and the direction from an earlier point.
enum PlaceNumbers {
    Fixed(Vec2),
    Coordinates([LinkNumber; 2]),
    /// The same distance and direction from the point with this index in all cases.
    FixedFrom(usize, Vec2),
    From(usize, [LinkNumber; 2]),
}

/// The numbers of a link that depend on varied numbers.
struct LinkNumbers {
    link: usize,
    points: Vec<PlaceNumbers>,
    centre: Option<PlaceNumbers>,
    mass: Option<LinkNumber>,
    inertia: Option<LinkNumber>,
    /// Joints on the link: index of the joint, whether this link is the joint's second link, and index of the link's
    /// point.
    joints: Vec<(usize, bool, usize)>,
    /// Positions of the points as last computed.
    places: Vec<Vec2>,
}

/// Recomputes links from the varied numbers of the file: their points, masses and moments of inertia, and the positions
/// of joints on the links.
/// Links that do not depend on these numbers stay unchanged.
pub struct Renumbering {
    /// Parameters, with the numbers that were last computed.
    parameters: Vec<Parameter>,
    /// The varied parameters: index of the parameter, and index of the varied number.
    set: Vec<(usize, usize)>,
    /// Parameters whose expressions depend on varied parameters, with these expressions, in the order of the file.
    derived: Vec<(usize, Expressions)>,
    /// The expressions of the links.
    expressions: Expressions,
    links: Vec<LinkNumbers>,
}

/// Reads the tables of a family.
struct Reading<'a> {
    parameters: Parameters,
    /// Names of parameters that depend on varied numbers.
    moved: BTreeSet<String>,
    /// The varied numbers that are not parameters, by their paths.
    paths: BTreeMap<&'a str, usize>,
    /// Number of paths that were found.
    found: usize,
    /// Keys whose texts are not expressions.
    texts: BTreeSet<&'static str>,
    /// The expressions of the links, each with its key.
    expressions: Vec<(String, String)>,
}

/// Keys whose texts may contain names of parameters.
const FORMULAS: [&str; 3] = ["channel", "expression", "formula"];

/// Keys whose texts are not expressions, but names, words or sentences.
pub(super) fn texts() -> BTreeSet<&'static str> {
    let of = |is_meant: fn(ValueKind) -> bool| -> BTreeSet<&'static str> {
        let rows = keys::sections().flat_map(|section| section.keys);
        rows.filter(|row| is_meant(row.kind)).map(|row| row.name).collect()
    };
    let texts = of(|kind| matches!(kind, ValueKind::Text | ValueKind::Texts | ValueKind::Choice(_)));
    let numbers = of(|kind| !kind.families().is_empty() || matches!(kind, ValueKind::Number | ValueKind::Numbers));
    texts.into_iter().filter(|key| !FORMULAS.contains(key) && !numbers.contains(key)).collect()
}

impl Renumbering {
    /// Prepares a family for the varied numbers `keys`; `member` is one of its scenarios.
    /// `None` if a varied number affects more than points, masses and moments of inertia of links, or if approximate
    /// positions choose the assembly modes.
    #[must_use]
    pub fn of(family: &ScenarioFamily, keys: &[String], member: &super::Scenario) -> Option<Renumbering> {
        if member.starts.iter().any(|start| start.mode.is_none() || !start.near.is_empty()) {
            return None;
        }
        let (mut tree, case) = (family.tree().clone(), &member.case);
        numbers::replace(&mut tree, family.set()).ok()?;
        let mut parameters = Parameters::default();
        member.formulas.parameters.iter().for_each(|own| parameters.push(own.clone()));
        let paths =
            keys.iter().enumerate().filter(|(_, key)| is_path(key)).map(|(at, key)| (key.as_str(), at)).collect();
        let mut reading =
            Reading { parameters, moved: BTreeSet::new(), paths, found: 0, texts: texts(), expressions: Vec::new() };
        let mut set = Vec::new();
        for (at, key) in keys.iter().enumerate().filter(|(_, key)| !is_path(key)) {
            set.push((reading.parameters.list().iter().position(|own| own.key == *key)?, at));
        }
        let derived = reading.derived(&tree, &set, family.set())?;
        let mut links = Vec::new();
        let tables = [("ground", tree.get("ground")?.get_ref().as_table()?)];
        let moving = tree.get("links")?.get_ref().as_table()?;
        let all = tables.into_iter().chain(in_order(moving));
        for (index, (name, table)) in all.enumerate() {
            let path = if index == 0 { name.to_string() } else { format!("links.{name}") };
            links.extend(reading.link(index, table, &path, case)?);
        }
        let read = ["parameters", "ground", "links", "formula"];
        let mut rest = tree.iter().filter(|(key, _)| !read.contains(&&**key.get_ref()));
        let is_used = rest.any(|(key, value)| reading.is_moved_below(key.get_ref(), value.get_ref()));
        if is_used || reading.found < reading.paths.len() {
            return None;
        }
        let expressions = Expressions::read(&reading.expressions, &reading.parameters)?;
        Some(Renumbering { parameters: reading.parameters.list().to_vec(), set, derived, expressions, links })
    }

    /// Writes the numbers of links and joints for the varied numbers `values`.
    /// `false` if a number is not allowed or has no value. In this case some numbers may already be written. The file
    /// must then be read to get the message.
    #[must_use]
    pub fn write(&mut self, values: &[f64], links: &mut [Link], joints: &mut [Joint]) -> bool {
        self.written(values, links, joints).is_some()
    }

    /// Whether the crank of a case moves other links, and masses, moments of inertia and speeds are allowed.
    #[must_use]
    pub fn is_sound(case: &Case) -> bool {
        let mechanism: &Mechanism = &case.mechanism;
        let crank = &mechanism.links()[case.crank().link];
        let pivot = mechanism.joints()[case.crank().joint].on(case.crank().link).unwrap_or_default();
        // A crank moves no other link if all its joints lie on its axis of rotation.
        let reaches = mechanism.joints().iter().filter_map(|joint| joint.on(case.crank().link));
        let is_crank = reaches.map(|place| (place - pivot).norm()).any(|length| length > 1e-9 * mechanism.size());
        is_crank
            && crank.points.iter().all(|point| point.local.iter().all(|part| part.is_finite()))
            && mechanism.links().iter().all(|link| check_masses(link).is_ok())
            && masses::check(mechanism, &case.drives).is_ok()
            && masses::check_speeds(mechanism, &case.drives).is_ok()
    }

    fn written(&mut self, values: &[f64], links: &mut [Link], joints: &mut [Joint]) -> Option<()> {
        for (parameter, at) in &self.set {
            self.parameters[*parameter].given = values[*at];
        }
        for (parameter, expression) in &mut self.derived {
            self.parameters[*parameter].given = expression.values(&self.parameters)?[0].value;
        }
        let of = CaseNumbers { varied: values, expressions: self.expressions.values(&self.parameters)? };
        for own in &mut self.links {
            let link = &mut links[own.link];
            own.places.clear();
            for (point, place) in link.points.iter_mut().zip(&own.points) {
                point.local = place.value(&own.places, of)?;
                own.places.push(point.local);
            }
            if let Some(centre) = &own.centre {
                link.mass_centre = centre.value(&own.places, of)?;
            }
            if let Some(mass) = &own.mass {
                link.mass = mass.value(of)?;
            }
            if let Some(inertia) = &own.inertia {
                link.inertia = inertia.value(of)?;
            }
            for &(joint, is_second, point) in &own.joints {
                let joint = &mut joints[joint];
                let side = if is_second { &mut joint.second } else { &mut joint.first };
                side.local = own.places[point];
            }
        }
        Some(())
    }
}

impl LinkNumber {
    fn value(&self, of: CaseNumbers) -> Option<f64> {
        match self {
            LinkNumber::Fixed(si) => Some(*si),
            LinkNumber::Changing(Origin::Varied(at), quantity) => quantity.checked(of.varied[*at]),
            LinkNumber::Changing(Origin::Expression(at), quantity) => quantity.checked(of.expressions[*at].value),
        }
    }
}

impl PlaceNumbers {
    fn value(&self, before: &[Vec2], of: CaseNumbers) -> Option<Vec2> {
        Some(match self {
            PlaceNumbers::Fixed(place) => *place,
            PlaceNumbers::Coordinates([x, y]) => Vec2::new(x.value(of)?, y.value(of)?),
            PlaceNumbers::FixedFrom(origin, offset) => before[*origin] + offset,
            PlaceNumbers::From(origin, [length, angle]) => {
                let (length, angle) = (length.value(of)?, angle.value(of)?);
                before[*origin] + direction(angle) * length
            }
        })
    }
}

/// The tables below a table, in the order of the file.
fn in_order<'t, 'a>(table: &'t DeTable<'a>) -> Vec<(&'t str, &'t DeTable<'a>)> {
    let mut entries: Vec<_> = table.iter().collect();
    entries.sort_by_key(|(key, _)| key.span().start);
    let tables = entries.into_iter().filter_map(|(key, value)| Some((&**key.get_ref(), value.get_ref().as_table()?)));
    tables.collect()
}

impl Reading<'_> {
    /// The parameters whose expressions depend on varied parameters, with these expressions. `fixed` are parameters
    /// that are set for all cases.
    fn derived(
        &mut self,
        tree: &DeTable,
        set: &[(usize, usize)],
        fixed: &[(String, f64)],
    ) -> Option<Vec<(usize, Expressions)>> {
        let table = tree.get("parameters").and_then(|table| table.get_ref().as_table());
        let mut derived = Vec::new();
        for place in 0..self.parameters.list().len() {
            let own = self.parameters.list()[place].clone();
            let is_set = set.iter().any(|(varied, _)| *varied == place);
            let text = table.and_then(|table| table.get(own.key.as_str())).and_then(|value| value.get_ref().as_str());
            let text =
                text.filter(|text| !is_set && self.is_moved(text) && fixed.iter().all(|(key, _)| *key != own.key));
            if let Some(text) = text {
                derived.push((place, Expressions::read(&[(own.key.clone(), text.into())], &self.parameters)?));
            }
            if is_set || text.is_some() {
                self.moved.extend(own.names().map(|(name, _)| name.to_string()));
            }
        }
        Some(derived)
    }

    /// Whether a text names a parameter that depends on varied numbers.
    fn is_moved(&self, text: &str) -> bool {
        let words = text.split(|sign: char| !(sign.is_ascii_alphanumeric() || sign == '_'));
        words.into_iter().any(|word| self.moved.contains(word))
    }

    /// Whether the value of a key, or a table below the key, contains an expression that depends on varied numbers.
    #[expect(clippy::wildcard_enum_match_arm, reason = "an enum of the TOML parser")]
    fn is_moved_below(&self, key: &str, value: &DeValue) -> bool {
        match value {
            DeValue::String(text) => !self.texts.contains(key) && self.is_moved(text),
            DeValue::Array(array) => array.iter().any(|value| self.is_moved_below(key, value.get_ref())),
            DeValue::Table(table) => {
                table.iter().any(|(key, value)| self.is_moved_below(key.get_ref(), value.get_ref()))
            }
            _ => false,
        }
    }

    /// The number of a table under one of the spellings of `base`. `Some(None)` if the key is missing; `None` if the
    /// value cannot be read.
    fn number(
        &mut self,
        table: &DeTable,
        path: &str,
        (base, family, sign): (&str, &'static UnitFamily, Sign),
    ) -> Option<Option<LinkNumber>> {
        let found = table.iter().find_map(|(key, value)| Some((key, value, family.unit_of(base, key.get_ref())?)));
        let Some((key, value, unit)) = found else { return Some(None) };
        let quantity = LinkQuantity { unit, family, sign };
        let number = match (self.paths.get(format!("{path}.{}", key.get_ref()).as_str()), value.get_ref()) {
            (Some(at), _) => {
                self.found += 1;
                LinkNumber::Changing(Origin::Varied(*at), quantity)
            }
            (None, DeValue::String(text)) => {
                let key = key.get_ref();
                if self.is_moved(text) {
                    self.expressions.push((key.to_string(), text.to_string()));
                    LinkNumber::Changing(Origin::Expression(self.expressions.len() - 1), quantity)
                } else {
                    LinkNumber::Fixed(quantity.checked(arithmetic(text, key, &self.parameters).ok()?)?)
                }
            }
            (None, value) => LinkNumber::Fixed(quantity.checked(plain_number(value)?)?),
        };
        Some(Some(number))
    }

    fn place(&mut self, table: &DeTable, path: &str, before: &[&str]) -> Option<PlaceNumbers> {
        if let Some(from) = table.get("from") {
            let origin = before.iter().position(|name| Some(*name) == from.get_ref().as_str())?;
            let length = self.number(table, path, ("length", &LENGTH, Sign::NotNegative))??;
            let angle = self.number(table, path, ("angle", &ANGLE, Sign::Any))??;
            return Some(match (length, angle) {
                (LinkNumber::Fixed(length), LinkNumber::Fixed(angle)) => {
                    PlaceNumbers::FixedFrom(origin, direction(angle) * length)
                }
                (length, angle) => PlaceNumbers::From(origin, [length, angle]),
            });
        }
        let x = self.number(table, path, ("x", &LENGTH, Sign::Any))??;
        let y = self.number(table, path, ("y", &LENGTH, Sign::Any))??;
        Some(match (x, y) {
            (LinkNumber::Fixed(x), LinkNumber::Fixed(y)) => PlaceNumbers::Fixed(Vec2::new(x, y)),
            (x, y) => PlaceNumbers::Coordinates([x, y]),
        })
    }

    /// The numbers of a link. `Some(None)` if the numbers of the link do not depend on varied numbers; `None` if the
    /// link cannot be recomputed.
    fn link(&mut self, index: usize, table: &DeTable, path: &str, case: &Case) -> Option<Option<LinkNumbers>> {
        let below = format!("{path}.");
        let has_varied = self.paths.keys().any(|own| own.starts_with(&below));
        let is_moved = table.iter().any(|(key, value)| self.is_moved_below(key.get_ref(), value.get_ref()));
        if !has_varied && !is_moved {
            return Some(None);
        }
        let tables = in_order(table.get("points")?.get_ref().as_table()?);
        let names: Vec<&str> = tables.iter().map(|(name, _)| *name).collect();
        let mut points = Vec::new();
        for (at, (name, own)) in tables.iter().enumerate() {
            points.push(self.place(own, &format!("{path}.points.{name}"), &names[..at])?);
        }
        let link = &case.mechanism.links().to_vec()[index];
        // The points of the case are in the order of the file.
        if link.points.iter().map(|point| point.name.as_str()).ne(names.iter().copied()) {
            return None;
        }
        let centre = match table.get("mass_centre") {
            Some(own) => Some(self.place(own.get_ref().as_table()?, &format!("{path}.mass_centre"), &names)?),
            None => None,
        };
        let mass = self.number(table, path, ("mass", &MASS, Sign::NotNegative))?;
        let inertia = self.number(table, path, ("inertia", &INERTIA, Sign::NotNegative))?;
        let mut joints = Vec::new();
        for (joint, own) in case.mechanism.joints().entries() {
            for (is_second, side) in [(false, own.first), (true, own.second)] {
                if side.link.index() == index {
                    // The joint's point is found by its position. Points that coincide here may lie apart for other
                    // numbers. Of such points, only the one with the joint's name is certainly the joint's point.
                    let mut at = link.points.iter().enumerate().filter(|(_, point)| point.local == side.local);
                    let named = link.points.iter().position(|point| own.is_pin() && point.name == own.name);
                    let found = named.filter(|at| link.points[*at].local == side.local);
                    let point = match (found, at.next(), at.next()) {
                        (Some(point), ..) => point,
                        (None, Some((point, _)), None) => point,
                        (None, ..) => return None,
                    };
                    joints.push((joint.index(), is_second, point));
                }
            }
        }
        Some(Some(LinkNumbers { link: index, points, centre, mass, inertia, joints, places: Vec::new() }))
    }
}
