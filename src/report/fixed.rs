//! A structure without a drive: its groups and all its configurations.

use serde_json::{Value, json};

use super::pretty::{list, pretty};
use crate::sentences;
use drawing::lay::{Laid, all_modes};
use linkage::error::{Error, ErrorKind, Result};
use linkage::mechanism::{AssemblyMode, Structure};
use prover::numbers::fixed;
use scenario::Draft;

/// Largest number of configurations in a list.
const MOST: usize = 1000;

/// A file without a drive whose links cannot move.
#[derive(Debug)]
pub(crate) struct FixedStructure<'a> {
    draft: &'a Draft,
    structure: &'a Structure,
    /// All configurations that can be assembled.
    configurations: Vec<Laid>,
}

impl<'a> FixedStructure<'a> {
    /// The structure of a draft, with its configurations.
    ///
    /// # Errors
    /// The reason why the links form no structure, or [`ErrorKind::Geometry`] if no configuration closes.
    pub(crate) fn of(draft: &'a Draft) -> Result<Self> {
        let structure = draft.structure.as_ref().map_err(Error::clone)?;
        let all = all_modes(&draft.mechanism, structure, &[], &draft.starts, MOST);
        let open = all.iter().find_map(|laid| laid.faults.first().cloned());
        let configurations: Vec<Laid> = all.into_iter().filter(Laid::is_whole).collect();
        if configurations.is_empty() {
            return Err(open.unwrap_or_else(|| Error::new(ErrorKind::Geometry, sentences::NO_CONFIGURATION_CLOSES)));
        }
        Ok(FixedStructure { draft, structure, configurations })
    }

    /// The structure as text; with all configurations if `lists` is set.
    pub(crate) fn text(&self, lists: bool) -> String {
        let FixedStructure { draft, structure, configurations } = self;
        let (links, joints) = (draft.mechanism.links(), draft.mechanism.joints());
        let mut text = format!("{}: {}\n", draft.name, draft.title);
        say!(
            text,
            sentences::a_fixed_structure(&(links.len() - 1), &joints.len(), &structure.formula(&draft.mechanism))
        );
        for group in &structure.groups {
            let (names, pairs) = (group.names(&draft.mechanism), group.pairs());
            say!(text, sentences::class_and_order(&names, &group.class, &group.order(), &pairs));
        }
        let cut = if configurations.len() < MOST { "" } else { sentences::OR_MORE };
        say!(text, sentences::configurations_of_the_structure(&configurations.len(), &cut));
        for (number, laid) in configurations.iter().enumerate().filter(|_| lists) {
            say!(text, "  {}{}", number + 1, modes(laid).iter().map(|mode| format!(", {mode}")).collect::<String>());
            for (link, place) in links.iter().zip(&laid.places).skip(1) {
                let Some(pose) = place.pose() else { continue };
                let points = link.points.iter().map(|point| {
                    let at = pose.point(point.local);
                    format!("{} ({}, {})", point.name, fixed(at.x, 6), fixed(at.y, 6))
                });
                let (angle, points) = (fixed(pose.angle.to_degrees(), 5), points.collect::<Vec<_>>().join(", "));
                say!(text, "    {:14} {angle:>11} deg   {points} m", link.name);
            }
        }
        text
    }

    /// The structure and all configurations as JSON, schema 1.
    pub(crate) fn json(&self) -> String {
        let FixedStructure { draft, structure, configurations } = self;
        let name = |link: &linkage::mechanism::Link| Value::from(link.name.as_str());
        let links = draft.mechanism.links();
        let groups = list(&structure.groups, |group| {
            let own = list(&group.links, |&link| name(&links[link]));
            json!({"links": own, "class": group.class, "order": group.order(), "kind": group.pairs()})
        });
        let configurations = list(configurations, |laid| {
            let links = list(links.iter().zip(&laid.places).skip(1), |(link, place)| {
                let pose = place.pose();
                let points = list(&link.points, |point| {
                    let at = pose.map(|pose| pose.point(point.local));
                    json!({"name": point.name, "x_m": at.map(|at| at.x), "y_m": at.map(|at| at.y)})
                });
                json!({"name": link.name, "angle_rad": pose.map(|pose| pose.angle), "points": points})
            });
            json!({"modes": modes(laid), "links": links})
        });
        pretty(&json!({
            "schema": 1, "scenario": draft.name, "title": draft.title, "mobility": structure.mobility,
            "formula": structure.formula(&draft.mechanism), "groups": groups, "configurations": configurations,
        }))
    }
}

/// The modes of a configuration that have names.
fn modes(laid: &Laid) -> Vec<&'static str> {
    let named = laid.modes.iter().map(|own| own.mode);
    named.filter(|mode| !matches!(mode, AssemblyMode::Only | AssemblyMode::Followed)).map(AssemblyMode::name).collect()
}
