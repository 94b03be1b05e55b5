//! A structure without a drive: its groups and all its configurations.

use serde_json::json;

use super::modes::{points_json, points_text};
use super::pretty::{list, pretty};
use crate::sentences;
use drawing::lay::{Laid, all_modes};
use linkage::error::{Error, ErrorKind, Result};
use linkage::mechanism::{AssemblyMode, LinkPose, Structure};
use prover::numbers::fixed;
use scenario::Draft;

/// Largest number of configurations in a list.
const MOST: usize = 1000;

/// A file that has no drive and whose links cannot move.
pub(crate) struct FixedStructure<'a> {
    draft: &'a Draft,
    structure: &'a Structure,
    /// All configurations that can be assembled.
    configurations: Vec<Configuration>,
}

/// A configuration of the whole structure.
struct Configuration {
    /// The assembly modes of its groups, without the modes `Only` and `Followed`.
    modes: Vec<&'static str>,
    /// Pose of every link, the ground included.
    poses: Vec<LinkPose>,
}

impl Configuration {
    fn of(laid: &Laid) -> Self {
        let named = |mode: &AssemblyMode| !matches!(mode, AssemblyMode::Only | AssemblyMode::Followed);
        let modes = laid.modes.iter().map(|own| own.mode).filter(named).map(AssemblyMode::name).collect();
        Configuration { modes, poses: laid.places.iter().filter_map(|place| place.pose().copied()).collect() }
    }
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
        let configurations: Vec<Configuration> =
            all.iter().filter(|laid| laid.is_whole()).map(Configuration::of).collect();
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
        for (number, Configuration { modes, poses }) in configurations.iter().enumerate().filter(|_| lists) {
            say!(text, "  {}{}", number + 1, modes.iter().map(|mode| format!(", {mode}")).collect::<String>());
            for (link, pose) in links.iter().zip(poses).skip(1) {
                let angle = fixed(pose.angle.to_degrees(), 5);
                say!(text, "    {:14} {angle:>11} deg   {} m", link.name, points_text(link, pose));
            }
        }
        text
    }

    /// The structure and all configurations as JSON, schema 1.
    pub(crate) fn json(&self) -> String {
        let FixedStructure { draft, structure, configurations } = self;
        let links = draft.mechanism.links();
        let groups = list(&structure.groups, |group| {
            let names = list(&group.links, |&link| links[link].name.as_str().into());
            json!({"links": names, "class": group.class, "order": group.order(), "kind": group.pairs()})
        });
        let configurations = list(configurations, |Configuration { modes, poses }| {
            let links = list(
                links.iter().zip(poses).skip(1),
                |(link, pose)| json!({"name": link.name, "angle_rad": pose.angle, "points": points_json(link, pose)}),
            );
            json!({"modes": modes, "links": links})
        });
        pretty(&json!({
            "schema": 1, "scenario": draft.name, "title": draft.title, "mobility": structure.mobility,
            "formula": structure.formula(&draft.mechanism), "groups": groups, "configurations": configurations,
        }))
    }
}
