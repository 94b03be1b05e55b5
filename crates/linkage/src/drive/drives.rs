//! All driving links of a mechanism in one list.

use crate::math::KeepNan;
use crate::mechanism::{DrivenJoint, JointId};
use std::ops::Deref;

use super::Drive;

/// The driving links of a mechanism, at least one.
/// The first driving link is the crank. The crank's angle identifies an instant.
/// The order is that of [`Structure::drivers`](crate::mechanism::Structure::drivers).
#[derive(Clone, Debug, PartialEq)]
pub struct Drives(Vec<Drive>);

impl Drives {
    /// Returns the list of the crank and the further drives.
    #[must_use]
    pub fn new(crank: Drive, further: Vec<Drive>) -> Self {
        let mut all = further;
        all.insert(0, crank);
        Drives(all)
    }

    /// The crank.
    #[inline]
    pub fn crank(&self) -> &Drive {
        &self.0[0]
    }

    /// The crank, mutable.
    pub fn crank_mut(&mut self) -> &mut Drive {
        &mut self.0[0]
    }

    /// All drives except the crank.
    #[inline]
    pub fn further(&self) -> &[Drive] {
        &self.0[1..]
    }

    /// The drives of free links, with their numbers.
    pub fn free(&self) -> impl Iterator<Item = (usize, &Drive)> {
        self.0.iter().enumerate().filter(|(_, drive)| drive.is_free())
    }

    /// Drives that exert a moment, with their numbers: all except those of free links without a motor.
    pub fn with_moment(&self) -> impl Iterator<Item = (usize, &Drive)> {
        self.0.iter().enumerate().filter(|(_, drive)| drive.has_moment())
    }

    /// Numbers of the driven joints, in the order of the drives.
    #[must_use]
    pub fn joint_ids(&self) -> Vec<JointId> {
        self.0.iter().map(|drive| drive.joint).collect()
    }

    /// Driven joints with the kinds of their inputs, in the order of the drives.
    #[must_use]
    pub fn joints(&self) -> Vec<DrivenJoint> {
        self.0.iter().map(|drive| DrivenJoint { joint: drive.joint, input: drive.input }).collect()
    }

    /// Returns the list with each drive changed by `change`.
    #[must_use]
    pub fn map(&self, change: impl FnMut(&Drive) -> Drive) -> Drives {
        Drives(self.0.iter().map(change).collect())
    }

    /// Coordinates of the driven joints (rad or m) at the instant at which the first drive has the input `crank`.
    /// The input is measured in the scenario's convention.
    #[must_use]
    pub fn coordinates(&self, crank: f64) -> Vec<f64> {
        let t = self.crank().time_of(crank);
        let further = self.further().iter().map(|drive| drive.coordinate(drive.at(t).value));
        std::iter::once(self.crank().coordinate(crank)).chain(further).collect()
    }

    /// Ratios of the driving links' angular velocities to the crank's angular velocity, at time `t` (s).
    /// The crank's ratio is 1.
    pub fn ratios(&self, t: f64) -> impl Iterator<Item = f64> {
        let omega = self.crank().at(t).rate;
        self.0.iter().enumerate().map(move |(index, drive)| if index == 0 { 1.0 } else { drive.at(t).rate / omega })
    }

    /// Largest absolute speed of a driving link (rad/s) in a mechanism of the size `size` (m).
    /// The speed of a slide (m/s) is divided by the size.
    #[must_use]
    pub fn top_speed(&self, size: f64) -> f64 {
        let speed = |drive: &Drive| drive.top_speed().abs() / drive.input.span(size);
        self.0.iter().fold(0.0, |most: f64, drive| most.larger(speed(drive)))
    }
}

impl From<Drive> for Drives {
    fn from(crank: Drive) -> Self {
        Drives(vec![crank])
    }
}

impl Deref for Drives {
    type Target = [Drive];

    #[inline]
    fn deref(&self) -> &[Drive] {
        &self.0
    }
}

impl<'a> IntoIterator for &'a Drives {
    type Item = &'a Drive;
    type IntoIter = std::slice::Iter<'a, Drive>;

    #[inline]
    fn into_iter(self) -> Self::IntoIter {
        self.0.iter()
    }
}
