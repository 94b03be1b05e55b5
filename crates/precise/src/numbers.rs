//! The numbers of a case, in any scalar.

use linkage::case::{Case, CaseNumber};
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::Vec2;
use linkage::mechanism::{JointId, LinkId};

use super::law::DriveNumbers;
use super::load_numbers::LoadNumbers;
use super::scalar::{Lift, LiftTable, Scalar};
use super::vector::Vector;
use crate::sentences;

/// A link.
#[derive(Clone, Debug)]
pub(crate) struct LinkNumbers<S> {
    pub(crate) points: Vec<Vector<S>>,
    pub(crate) mass: S,
    pub(crate) centre: Vector<S>,
    pub(crate) inertia: S,
}

/// A joint: its point and its axis on each of the two links.
#[derive(Clone, Debug)]
pub(crate) struct JointNumbers<S> {
    pub(crate) places: [Vector<S>; 2],
    pub(crate) guides: Option<[Vector<S>; 2]>,
}

/// All numbers of a case that determine its motion and its forces.
#[derive(Clone, Debug)]
pub struct CaseNumbers<S> {
    pub(crate) links: Vec<LinkNumbers<S>>,
    pub(crate) joints: Vec<JointNumbers<S>>,
    pub(crate) gravity: Vector<S>,
    pub(crate) drives: Vec<DriveNumbers<S>>,
    pub(crate) loads: Vec<LoadNumbers<S>>,
}

impl<S: Scalar> CaseNumbers<S> {
    /// The numbers of a case, without derivatives.
    ///
    /// # Errors
    /// The errors of [`CaseNumbers::lifted`].
    pub fn of(case: &Case) -> Result<Self> {
        CaseNumbers::lifted(case, &|_, value| S::of(value), &|_, _| Vec::new())
    }

    /// The numbers of a case, converted to scalars by `lift`; `table` gives the derivatives of tables.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] for a case with friction, transmissions or free motions, or for a drive that may pass
    /// change points.
    pub fn lifted(case: &Case, lift: Lift<S>, table: LiftTable<S>) -> Result<Self> {
        let refused = |what: &str| Err(Error::new(ErrorKind::Unsupported, what));
        if case.drives.iter().any(|drive| drive.passes() && !drive.is_free()) {
            return refused(sentences::CHANGE_POINTS_MAY_BE_PASSED);
        }
        if !case.mechanism.transmissions().is_empty() {
            return refused(sentences::THERE_ARE_TRANSMISSIONS);
        }
        if case.has_friction() {
            return refused(sentences::THERE_IS_FRICTION);
        }
        let plane = |of: &dyn Fn(usize) -> CaseNumber, v: Vec2| Vector { x: lift(of(0), v.x), y: lift(of(1), v.y) };
        let link = |(link, own): (LinkId, &linkage::mechanism::Link)| {
            let point = |(point, own): (usize, &linkage::mechanism::Point)| {
                plane(&|axis| CaseNumber::Point { link, point, axis }, own.local)
            };
            LinkNumbers {
                points: own.points.iter().enumerate().map(point).collect(),
                mass: lift(CaseNumber::Mass(link), own.mass),
                centre: plane(&|axis| CaseNumber::Centre { link, axis }, own.mass_centre),
                inertia: lift(CaseNumber::Inertia(link), own.inertia),
            }
        };
        let joint = |(joint, own): (JointId, &linkage::mechanism::Joint)| {
            let side = |side: usize, v: Vec2| plane(&|axis| CaseNumber::Place { joint, side, axis }, v);
            let guide = |side: usize, v: Vec2| plane(&|axis| CaseNumber::Guide { joint, side, axis }, v);
            JointNumbers {
                places: [side(0, own.first.local), side(1, own.second.local)],
                guides: own.kind.axes().map(|[first, second]| [guide(0, first), guide(1, second)]),
            }
        };
        let load = |(number, own)| LoadNumbers::of(own, number, lift, table);
        Ok(CaseNumbers {
            links: case.mechanism.links().entries().map(link).collect(),
            joints: case.mechanism.joints().entries().map(joint).collect(),
            gravity: plane(&|axis| CaseNumber::Gravity { axis }, case.gravity),
            drives: (0..case.drives.len()).map(|own| DriveNumbers::of(case, own, lift)).collect::<Result<_>>()?,
            loads: case.loads.iter().enumerate().map(load).collect(),
        })
    }
}
