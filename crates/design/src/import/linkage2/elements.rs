//! Connectors, links and gear ratios as they stand in the file.

use crate::import::parts::{Parts, SourceUnits};
use crate::import::xml::XmlFile;
use crate::sentences;
use linkage::error::Result;
use linkage::math::Vec2;
use roxmltree::Node;

/// Number of the file's units of length in an inch.
const PER_INCH: f64 = 96.0;
/// Lengths in the scenario's unit are rounded to multiples of 1 / `DECIMALS`, because the file has six decimals.
pub(super) const DECIMALS: f64 = 1e6;
/// Bits of the layer number that mark an element as part of the mechanism. Elements on other layers only belong to the
/// drawing.
const MECHANISM: u32 = 0xffff_fff0;

/// A connector: a point of all its links.
#[derive(Debug)]
pub(super) struct Connector {
    pub(super) name: String,
    pub(super) place: Vec2,
    pub(super) is_anchor: bool,
    pub(super) is_input: bool,
    /// Turns per minute, clockwise positive.
    pub(super) speed: f64,
    /// For a slider, the connectors at the ends of its straight or curved path.
    pub(super) path: Option<[usize; 2]>,
    pub(super) is_curved: bool,
    /// Id of the link to which the connector is fastened.
    pub(super) fastened: Option<String>,
}

/// A link.
#[derive(Debug)]
pub(super) struct DrawnLink {
    pub(super) id: String,
    pub(super) name: String,
    pub(super) connectors: Vec<usize>,
    /// Stroke and cycles per minute of an actuator.
    pub(super) actuator: Option<[f64; 2]>,
    pub(super) is_gear: bool,
    /// Id of the link to which this link is fastened.
    pub(super) fastened: Option<String>,
    /// Whether the link is fastened to an anchor.
    pub(super) is_fixed: bool,
}

/// Two gears or chain wheels.
#[derive(Debug)]
pub(super) struct DrawnRatio<'a> {
    pub(super) node: Node<'a, 'a>,
    pub(super) is_chain: bool,
    /// Whether the sizes are radii.
    pub(super) has_radii: bool,
    /// Ids of the links, and their sizes.
    pub(super) wheels: Vec<(String, f64)>,
}

/// The elements of a file.
#[derive(Debug)]
pub(super) struct Elements<'a> {
    pub(super) units: SourceUnits,
    pub(super) connectors: Vec<Connector>,
    pub(super) links: Vec<DrawnLink>,
    pub(super) ratios: Vec<DrawnRatio<'a>>,
    pub(super) told: Vec<String>,
}

/// The elements of a file.
pub(super) fn elements<'a>(file: &'a XmlFile<'a>) -> Result<Elements<'a>> {
    let root = file.tree.root_element();
    let named = |name: &'static str| root.children().filter(move |node| node.has_tag_name(name));
    let program = named("program").next();
    let is_inch =
        program.and_then(|node| node.attribute("units")).is_some_and(|own| own.eq_ignore_ascii_case("inches"));
    let units = match is_inch {
        true => SourceUnits { length: "in", metres: 0.0254, mass: "lb", force: "lbf" },
        false => SourceUnits { length: "mm", metres: 0.001, mass: "kg", force: "N" },
    };
    let scale = if is_inch { 1.0 } else { 25.4 } / PER_INCH;
    let mut told = vec![sentences::LINKAGE_HAS_NO_MASSES.to_string()];
    if let Some(factor) = program.and_then(|node| node.attribute("scalefactor")).filter(|own| own.parse() != Ok(1.0)) {
        told.push(sentences::the_scale_is_left_out(&factor));
    }
    let known = ["program", "connector", "Link", "element", "selected", "ratios"];
    for node in root.children().filter(|node| node.is_element() && !known.contains(&node.tag_name().name())) {
        told.push(sentences::the_element_is_left_out(&node.tag_name().name(), &"", &file.line(node)));
    }
    let nodes: Vec<Node> = named("connector").filter(|node| is_mechanism(*node)).collect();
    let drawn: Vec<Node> = named("Link").chain(named("element")).filter(|node| is_mechanism(*node)).collect();
    Parts::check_count(nodes.len() + drawn.len())?;
    let ids = nodes.iter().map(|node| file.text(*node, "id")).collect::<Result<Vec<_>>>()?;
    let find = |id: Option<&str>| ids.iter().position(|own| Some(*own) == id);
    let mut connectors = nodes.iter().map(|node| connector(file, *node, scale)).collect::<Result<Vec<_>>>()?;
    for (own, node) in connectors.iter_mut().zip(&nodes).filter(|(_, node)| node.attribute("slider") == Some("true")) {
        let ends =
            node.children().filter(|child| child.has_tag_name("slidelimit")).map(|child| find(child.attribute("id")));
        match ends.collect::<Vec<_>>()[..] {
            [Some(first), Some(second)] if first != second => own.path = Some([first, second]),
            _ => told.push(sentences::the_slider_has_no_path(&own.name, &file.line(*node))),
        }
    }
    let mut links = Vec::new();
    for node in drawn {
        if node.attribute("measurementelement") == Some("true") {
            continue;
        }
        let children = node.children().filter(Node::is_element);
        let mut own: Vec<usize> = Vec::new();
        for child in children {
            let Some(at) = find(child.attribute("id")) else {
                return Err(file.wrong(child, sentences::THE_LINK_NAMES_NO_CONNECTOR.into()));
            };
            if !own.contains(&at) {
                own.push(at);
            }
        }
        let is = |name: &str| node.attribute(name) == Some("true");
        let id = file.text(node, "id")?.to_string();
        let [stroke, cycles] =
            [(file.number(node, "throw", 0.0)? * scale * DECIMALS).round() / DECIMALS, file.number(node, "cpm", 0.0)?];
        let fixed_to = find(node.attribute("fastenconnector"));
        links.push(DrawnLink {
            name: name(node, "L", &id),
            id,
            actuator: (is("actuator") && own.len() == 2).then_some([stroke, cycles]),
            is_gear: is("gear"),
            fastened: node.attribute("fastenlink").map(Into::into),
            is_fixed: fixed_to.is_some_and(|at| connectors[at].is_anchor),
            connectors: own,
        });
    }
    let ratios = named("ratios").flat_map(|node| node.children()).filter(|node| node.has_tag_name("ratio"));
    let ratios = ratios.map(|node| ratio(file, node, scale)).collect::<Result<_>>()?;
    Ok(Elements { units, connectors, links, ratios, told })
}

/// Whether an element belongs to the mechanism, and not only to the drawing.
fn is_mechanism(node: Node) -> bool {
    let layer = node.attribute("layer").and_then(|layer| layer.parse::<u32>().ok()).filter(|layer| *layer != 0);
    layer.is_none_or(|layer| layer & MECHANISM != 0)
}

/// The name of an element; for an element without a name, `letter` followed by its id.
fn name(node: Node, letter: &str, id: &str) -> String {
    let own = node.attribute("name").map(str::trim).filter(|name| !name.is_empty());
    own.map_or_else(|| format!("{letter}{id}"), Into::into)
}

fn connector(file: &XmlFile, node: Node, scale: f64) -> Result<Connector> {
    let is = |name: &str| node.attribute(name) == Some("true");
    let id = node.attribute("id").unwrap_or_default();
    let fastened = node.attribute("fastenlink").or_else(|| node.attribute("fasten")).filter(|own| !own.is_empty());
    Ok(Connector {
        name: name(node, "P", id),
        place: Vec2::new(file.number(node, "x", 0.0)?, file.number(node, "y", 0.0)?) * scale,
        is_anchor: is("anchor"),
        is_input: is("input"),
        speed: file.number(node, "rpm", 0.0)?,
        path: None,
        is_curved: file.number(node, "slideradius", 0.0)? != 0.0,
        fastened: fastened.map(Into::into),
    })
}

fn ratio<'a>(file: &XmlFile<'a>, node: Node<'a, 'a>, scale: f64) -> Result<DrawnRatio<'a>> {
    let is_chain = node.attribute("type") != Some("gears");
    let has_radii = is_chain && node.attribute("sizeassize") == Some("true");
    let mut wheels = Vec::new();
    for link in node.children().filter(|child| child.has_tag_name("link")) {
        let size = file.number(link, "size", 0.0)? * if has_radii { scale } else { 1.0 };
        if !(size > 0.0) {
            return Err(file.wrong(link, sentences::THE_WHEEL_HAS_NO_SIZE.into()));
        }
        wheels.push((file.text(link, "id")?.to_string(), size));
    }
    Ok(DrawnRatio { node, is_chain, has_radii, wheels })
}
