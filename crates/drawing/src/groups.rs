//! Driving links and Assur groups, each drawn separately at its pose, in the order of solution.
//! In this module, "group" also means a driving link outside Assur groups.
//! Links that are solved before a group are drawn as ground in the drawing of the group: joints with these links have
//! a hatched pivot or hatched rails.

use super::mark::{Mark, MarkRole};
use super::paper::figure::sub;
use super::picture::{AROUND, LinkPlacement, Picture};
use super::sheet::{SheetCell, fit};
use super::sketch::{Lettering, Sketch};
use super::travel::Travels;
use super::{body, pins, sign, transmission};
use crate::sentences;
use linkage::drive::Drive;
use linkage::math::{Vec2, corners};
use linkage::mechanism::{
    GROUND, GroupKind, Joint, JointId, JointKind, JointSide, Link, LinkId, Mechanism, Point, Structure, TransmissionId,
    roman,
};

/// Largest enlargement of a small group, relative to the scale of the largest group.
const ENLARGED: f64 = 2.5;
/// If a point is nearer to a joint than this (mm on paper), only the joint's name is shown.
const SAME: f64 = 1e-6;

/// An Assur group, or a driving link outside Assur groups.
struct Part {
    heading: Vec<String>,
    links: Vec<LinkId>,
    /// Joints between links of the group.
    inner: Vec<JointId>,
    /// Joints to the ground or to links that are solved before the group.
    outer: Vec<JointId>,
    trains: Vec<TransmissionId>,
}

/// The drawings of all groups of a structure, each as a cell. Each group has a scale at which its drawing fits into
/// the size `room` (mm).
/// `places` are the placements of the links. `drives` gives the senses of the arrows at driven joints.
pub fn group_cells(
    mechanism: &Mechanism,
    structure: &Structure,
    drives: &[Drive],
    places: &[LinkPlacement],
    room: Vec2,
) -> Vec<SheetCell> {
    let whole = Whole { mechanism, structure, drives, places, travels: travels(mechanism, places) };
    let sized = |part: Part| {
        let [low, high] = corners(whole.extent(&part, &whole.wheels(&part)));
        (part, high - low)
    };
    let parts: Vec<(Part, Vec2)> = parts(mechanism, structure).into_iter().map(sized).collect();
    let largest = parts.iter().fold(Vec2::zeros(), |most, (_, size)| most.sup(size));
    parts.into_iter().map(|(part, size)| whole.cell(part, size.sup(&(largest / ENLARGED)), room)).collect()
}

fn travels(mechanism: &Mechanism, places: &[LinkPlacement]) -> Travels {
    let mut travels = Travels::none(mechanism);
    travels.take_in(mechanism, |link, local| places[link].pose().map(|pose| pose.point(local)));
    travels
}

fn parts(mechanism: &Mechanism, structure: &Structure) -> Vec<Part> {
    let link = |link: LinkId| mechanism.links()[link].name.as_str();
    let leading = structure.leading().map(|(_, driver)| Part {
        heading: vec![sentences::driving_link(&link(driver.link))],
        links: vec![driver.link],
        inner: Vec::new(),
        outer: vec![driver.joint],
        trains: Vec::new(),
    });
    let groups = structure.groups.iter().map(|group| {
        let bodies = group.bodies(mechanism);
        let told = match group.kind {
            GroupKind::Driven => sentences::driving_link(&bodies),
            GroupKind::Rrr | GroupKind::Rrp | GroupKind::Rpr | GroupKind::Rpp | GroupKind::Prp | GroupKind::Higher => {
                let letters = group.kind.letters().map_or_else(String::new, |letters| format!(", {letters}"));
                sentences::group_of_class(&roman(group.class), &group.order(), &letters, &bodies)
            }
        };
        Part {
            heading: vec![told],
            links: group.links.clone(),
            inner: group.inner.clone(),
            outer: group.outer.clone(),
            trains: group.trains.clone(),
        }
    });
    let mut parts: Vec<Part> = leading.chain(groups).collect();
    for (number, (part, formula)) in (1..).zip(parts.iter_mut().zip(structure.numbered_parts(mechanism))) {
        let name = |&joint: &JointId| mechanism.joints()[joint].name.as_str();
        let hangs = part.outer.iter().map(|joint| {
            let solved = solved_side(&mechanism.joints()[*joint], &part.links);
            sentences::joint_on_link(&name(joint), &link(solved.link))
        });
        let outer = sentences::hangs_by(&hangs.collect::<Vec<_>>().join(", "));
        let inner: Vec<&str> = part.inner.iter().map(name).collect();
        let inner = if inner.is_empty() { String::new() } else { sentences::inner_joints(&inner.join(", ")) };
        part.heading.insert(0, format!("{number}. {formula}"));
        part.heading.push(outer + &inner);
        let trains = part.trains.iter().map(|&id| mechanism.transmissions()[id].name());
        part.heading.extend(trains.map(|name| sentences::coupled_by(&name)));
    }
    parts
}

/// The point of an outer joint on the link that is solved before the drawn group. `own` are the links of the group.
fn solved_side(joint: &Joint, own: &[LinkId]) -> JointSide {
    if own.contains(&joint.first.link) { joint.second } else { joint.first }
}

struct Whole<'a> {
    mechanism: &'a Mechanism,
    structure: &'a Structure,
    drives: &'a [Drive],
    places: &'a [LinkPlacement],
    travels: Travels,
}

impl Whole<'_> {
    /// The cell of a group, at the scale at which an area of the size `size` (m) fits into the size `room` (mm).
    fn cell(&self, part: Part, size: Vec2, room: Vec2) -> SheetCell {
        let wheels = self.wheels(&part);
        let scale = fit(size, room - Vec2::repeat(2.0 * AROUND));
        let apart = self.apart(&part);
        let mut sketch = Sketch::of(&apart, &travels(&apart, self.places), scale);
        sketch.labels.retain(|label| part.links.contains(&label.at.link));
        sketch = sketch.without(&[MarkRole::MassCentre, MarkRole::MassQuarter, MarkRole::Axis]);
        self.add_signs(&part, &mut sketch);
        for (link, mark) in wheels {
            sketch.bodies[link].marks.push(mark);
        }
        let mut picture = Picture::of(&sketch, self.places, scale);
        picture.draw_marks();
        picture.open_wheels();
        picture.number_links();
        let mut names: Vec<(Vec2, String)> =
            self.joint_names(&part).into_iter().map(|(at, name)| (at / scale, name)).collect();
        let points = picture.names(|what| what == Lettering::Point);
        let is_free = |at: &Vec2| names.iter().all(|(own, _)| (at - own).norm() > SAME);
        let free: Vec<(Vec2, String)> = points.into_iter().filter(|(at, _)| is_free(at)).collect();
        names.extend(free);
        picture.name(names);
        let figure = picture.finish(1);
        let is_placed = part.links.iter().all(|&link| self.places[link].pose().is_some());
        let faults = if is_placed { Vec::new() } else { vec![sentences::NO_DEFINITE_POSITION.into()] };
        SheetCell { heading: part.heading, bounds: figure.bounds(), figure, scale, faults, ..SheetCell::default() }
    }

    /// A point of a link in the world (m).
    fn at(&self, side: JointSide) -> Option<Vec2> {
        self.places[side.link].pose().map(|pose| pose.point(side.local))
    }

    /// A mechanism with the points, masses and joints of one group. All links keep their numbers. In the outer joints
    /// of the group, the ground replaces the links that are solved before the group.
    /// An exception is an outer prismatic joint whose block is on a link that is solved before: the link stays, to show
    /// the block.
    fn apart(&self, part: &Part) -> Mechanism {
        let mechanism = self.mechanism;
        let outer = part.outer.iter().filter_map(|&id| {
            let joint = &mechanism.joints()[id];
            let solved = solved_side(joint, &part.links);
            let is_guide = mechanism.guide_and_block(joint).is_none_or(|[guide, _]| guide.link == solved.link);
            if is_guide { self.grounded(joint, solved.link) } else { Some(joint.clone()) }
        });
        let inner = part.inner.iter().map(|&id| mechanism.joints()[id].clone());
        let joints: Vec<Joint> = inner.chain(outer).collect();
        let strip = |(id, link): (LinkId, &Link)| {
            let mut link = link.clone();
            if !part.links.contains(&id) {
                return Link { points: Vec::new(), mass: 0.0, inertia: 0.0, ..link };
            }
            // Joints to later groups remain as points, so that the link keeps its shape.
            for joint in mechanism.joints() {
                if let Some(local) = joint.on(id).filter(|at| link.points.iter().all(|point| point.local != *at)) {
                    link.points.push(Point { name: joint.name.clone(), local });
                }
            }
            link
        };
        Mechanism::unchecked(mechanism.links().entries().map(strip).collect(), joints)
    }

    /// A copy of the joint in which the ground replaces the link `solved`.
    /// The pose of this link gives the joint's position on the ground.
    /// `None` if the link has no pose.
    fn grounded(&self, joint: &Joint, solved: LinkId) -> Option<Joint> {
        let pose = self.places[solved].pose()?;
        let is_first = joint.first.link == solved;
        let moved = |side: JointSide| match side.link == solved {
            true => JointSide { link: GROUND, local: pose.point(side.local) },
            false => side,
        };
        let kind = match joint.kind {
            JointKind::Revolute => JointKind::Revolute,
            JointKind::Prismatic { mut axes } => {
                let axis = &mut axes[usize::from(!is_first)];
                *axis = pose.point(*axis) - pose.origin;
                JointKind::Prismatic { axes }
            }
        };
        Some(Joint { kind, first: moved(joint.first), second: moved(joint.second), ..joint.clone() })
    }

    /// Adds arrows at driven joints.
    /// Adds a pivot at each block and each wheel of links that are solved before the group.
    fn add_signs(&self, part: &Part, sketch: &mut Sketch) {
        let unit = sketch.unit;
        let joints = || part.inner.iter().chain(&part.outer);
        for driver in self.structure.drivers.iter().filter(|driver| joints().any(|&joint| joint == driver.joint)) {
            let sense = self.drives.iter().find(|own| own.joint == driver.joint).map_or(1.0, Drive::sense);
            let marks = sign::of_driven(self.mechanism, driver.joint, driver.link, sense, unit);
            sketch.bodies[driver.link].marks.extend(marks);
        }
        let blocks = part.outer.iter().filter_map(|&id| {
            let joint = &self.mechanism.joints()[id];
            let [_, block] = self.mechanism.guide_and_block(joint)?;
            (!part.links.contains(&block.link)).then(|| self.at(block))?
        });
        let members = part.trains.iter().flat_map(|&id| &self.mechanism.transmissions()[id].members);
        let solved = members.filter(|member| member.link != GROUND && member.radius > 0.0);
        let wheels = solved.filter(|member| !part.links.contains(&member.link));
        let wheels = wheels.filter_map(|own| self.at(JointSide { link: own.link, local: own.local }));
        let fixed: Vec<Vec2> = blocks.chain(wheels).collect();
        let ground = &mut sketch.bodies[GROUND].marks;
        for at in fixed {
            ground.extend(pins::pivot(at, unit));
            ground.push(Mark::circle(MarkRole::Pin, at, pins::PIN * unit));
        }
    }

    /// Marks of wheels, racks, cams and strands of belts, each with its link.
    /// A transmission that the group contains is shown completely, including its marks on links that are solved
    /// before.
    /// For other transmissions, only the marks on the group's links are shown, without strands.
    fn wheels(&self, part: &Part) -> Vec<(LinkId, Mark)> {
        let of = |id: TransmissionId| {
            let is_own = part.trains.contains(&id);
            let marks = transmission::of(self.mechanism, &self.travels, id);
            let is_wheel = |mark: &Mark| mark.role != MarkRole::Strand;
            marks.into_iter().filter(move |(link, mark)| is_own || part.links.contains(link) && is_wheel(mark))
        };
        self.mechanism.transmissions().ids().flat_map(of).collect()
    }

    /// The positions of a group's joints in the world (m), with the joints' names.
    /// The subscript of an outer joint is the number of the link that is solved before.
    fn joint_names(&self, part: &Part) -> Vec<(Vec2, String)> {
        let place = |joint: &Joint| {
            self.mechanism.guide_and_block(joint).map_or_else(|| self.at(joint.first), |[_, block]| self.at(block))
        };
        let outer = part.outer.iter().map(|&id| &self.mechanism.joints()[id]);
        let outer = outer.map(|own| (own, sub(&solved_side(own, &part.links).link.to_string())));
        let inner = part.inner.iter().map(|&id| (&self.mechanism.joints()[id], String::new()));
        inner.chain(outer).filter_map(|(own, number)| Some((place(own)?, own.name.clone() + &number))).collect()
    }

    /// All points that the cell of a group must contain (m).
    fn extent(&self, part: &Part, wheels: &[(LinkId, Mark)]) -> Vec<Vec2> {
        let places = part.links.iter().flat_map(|&link| {
            body::places(self.mechanism, link).into_iter().map(move |local| JointSide { link, local })
        });
        let wheels = wheels
            .iter()
            .flat_map(|(link, mark)| mark.shape.points().into_iter().map(|local| JointSide { link: *link, local }));
        places.chain(wheels).filter_map(|side| self.at(side)).collect()
    }
}
