//! One number or plane vector for several poses at once, on the registers of the machine.
//!
//! Every operation is an IEEE 754 operation on each lane separately, without fused multiply-add.
//! A lane's value therefore does not depend on its neighbours or on the number of lanes.

use std::ops::{Add, Div, Mul, Neg, Sub};

use linkage::math::Vec2;

use super::registers::Registers;
pub(super) use super::registers::TILE;

/// One column of a tile.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(super) struct TileColumn(pub(super) [f64; TILE]);

/// One number per pose.
#[derive(Clone, Copy)]
pub(super) struct Lanes<R: Registers> {
    pub(super) on: R,
    values: R::Values,
}

macro_rules! lane_by_lane {
    ($($operation:ident $name:ident)*) => { $(
        impl<R: Registers> $operation for Lanes<R> {
            type Output = Self;
            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                Lanes { values: self.on.$name(self.values, other.values), ..self }
            }
        }
        impl<R: Registers> $operation<f64> for Lanes<R> {
            type Output = Self;
            #[inline(always)]
            fn $name(self, other: f64) -> Self {
                self.$name(Self::splat(self.on, other))
            }
        }
    )* };
}

lane_by_lane! { Add add  Sub sub  Mul mul  Div div }

impl<R: Registers> Neg for Lanes<R> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Lanes { values: self.on.neg(self.values), ..self }
    }
}

impl<R: Registers> Lanes<R> {
    #[inline(always)]
    pub(super) fn splat(on: R, value: f64) -> Self {
        Lanes { on, values: on.splat(value) }
    }

    #[inline(always)]
    pub(super) fn sqrt(self) -> Self {
        Lanes { values: self.on.sqrt(self.values), ..self }
    }

    #[inline(always)]
    pub(super) fn abs(self) -> Self {
        Lanes { values: self.on.abs(self.values), ..self }
    }

    /// The lanes in which this number is greater than `other`; `false` if either number is NaN.
    #[inline(always)]
    pub(super) fn exceeds(self, other: Self) -> Choice<R> {
        Choice { on: self.on, choices: self.on.exceeds(self.values, other.values) }
    }

    /// The part `part` of some adjacent numbers.
    #[inline(always)]
    pub(super) fn of(on: R, numbers: &[f64], part: usize) -> Self {
        Lanes { on, values: on.read(numbers, part) }
    }

    /// Writes the part `part` of some adjacent numbers.
    #[inline(always)]
    pub(super) fn put(self, numbers: &mut [f64], part: usize) {
        self.on.write(numbers, part, self.values);
    }

    /// 1 / self.
    #[inline(always)]
    pub(super) fn inverse(self) -> Self {
        Self::splat(self.on, 1.0) / self
    }
}

/// A choice per pose.
#[derive(Clone, Copy)]
pub(super) struct Choice<R: Registers> {
    on: R,
    choices: R::Choices,
}

impl<R: Registers> Choice<R> {
    /// Returns the first number in the lanes where the choice is true, elsewhere the second.
    #[inline(always)]
    pub(super) fn of(self, chosen: Lanes<R>, other: Lanes<R>) -> Lanes<R> {
        Lanes { on: self.on, values: self.on.choose(self.choices, chosen.values, other.values) }
    }

    /// Returns both numbers, exchanged in the lanes where the choice is true.
    #[inline(always)]
    pub(super) fn exchanged(self, a: Lanes<R>, b: Lanes<R>) -> (Lanes<R>, Lanes<R>) {
        (self.of(b, a), self.of(a, b))
    }
}

/// One plane vector per pose.
#[derive(Clone, Copy)]
pub(super) struct Plane<R: Registers> {
    pub(super) x: Lanes<R>,
    pub(super) y: Lanes<R>,
}

impl<R: Registers> Add for Plane<R> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Plane { x: self.x + other.x, y: self.y + other.y }
    }
}

impl<R: Registers> Add<Vec2> for Plane<R> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Vec2) -> Self {
        Plane { x: self.x + other.x, y: self.y + other.y }
    }
}

impl<R: Registers> Sub for Plane<R> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Plane { x: self.x - other.x, y: self.y - other.y }
    }
}

impl<R: Registers> Neg for Plane<R> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Plane { x: -self.x, y: -self.y }
    }
}

impl<R: Registers, T: Copy> Mul<T> for Plane<R>
where
    Lanes<R>: Mul<T, Output = Lanes<R>>,
{
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: T) -> Self {
        Plane { x: self.x * factor, y: self.y * factor }
    }
}

impl<R: Registers> Plane<R> {
    #[inline(always)]
    pub(super) fn splat(on: R, v: Vec2) -> Self {
        Plane { x: Lanes::splat(on, v.x), y: Lanes::splat(on, v.y) }
    }

    #[inline(always)]
    pub(super) fn dot(self, other: Self) -> Lanes<R> {
        self.x * other.x + self.y * other.y
    }

    #[inline(always)]
    pub(super) fn cross(self, other: Self) -> Lanes<R> {
        self.x * other.y - self.y * other.x
    }

    #[inline(always)]
    pub(super) fn turned(self) -> Self {
        Plane { x: -self.y, y: self.x }
    }

    /// Returns this direction rotated by the direction `by`: the product of both as complex numbers.
    #[inline(always)]
    pub(super) fn onwards(self, by: Self) -> Self {
        Plane { x: self.x * by.x - self.y * by.y, y: self.x * by.y + self.y * by.x }
    }

    /// Returns `v` rotated by this direction.
    #[inline(always)]
    pub(super) fn rotate(self, v: Vec2) -> Self {
        Plane { x: self.x * v.x - self.y * v.y, y: self.x * v.y + self.y * v.x }
    }
}

/// View of the poses of one tile that are solved at once.
#[derive(Debug)]
pub(super) struct Window<'a, R: Registers> {
    pub(super) on: R,
    pub(super) columns: &'a mut [TileColumn],
    /// Index of this part of the tile.
    pub(super) part: usize,
}

impl<R: Registers> Window<'_, R> {
    /// Number of parts in a tile.
    pub(super) const PARTS: usize = TILE / R::LANES;

    /// Adjacent columns. The limits are checked once for all of them.
    #[inline(always)]
    pub(super) fn adjacent<const N: usize>(&self, first: usize) -> &[TileColumn; N] {
        self.columns[first..].first_chunk().expect("the columns exist")
    }

    #[inline(always)]
    pub(super) fn adjacent_mut<const N: usize>(&mut self, first: usize) -> &mut [TileColumn; N] {
        self.columns[first..].first_chunk_mut().expect("the columns exist")
    }

    #[inline(always)]
    pub(super) fn get(&self, column: usize) -> Lanes<R> {
        Lanes::of(self.on, &self.columns[column].0, self.part)
    }

    #[inline(always)]
    pub(super) fn put(&mut self, column: usize, lanes: Lanes<R>) {
        lanes.put(&mut self.columns[column].0, self.part);
    }

    /// Adds `lanes` to the part `self.part` of a column that does not belong to the tile.
    #[inline(always)]
    pub(super) fn add_to(&self, column: &mut [f64; TILE], lanes: Lanes<R>) {
        (Lanes::of(self.on, column, self.part) + lanes).put(column, self.part);
    }

    /// Returns the vector with its components at `column` and the next column.
    #[inline(always)]
    pub(super) fn vector(&self, column: usize) -> Plane<R> {
        let [x, y] = self.adjacent(column);
        Plane { x: Lanes::of(self.on, &x.0, self.part), y: Lanes::of(self.on, &y.0, self.part) }
    }

    #[inline(always)]
    pub(super) fn put_vector(&mut self, column: usize, v: Plane<R>) {
        let part = self.part;
        let [x, y] = self.adjacent_mut(column);
        v.x.put(&mut x.0, part);
        v.y.put(&mut y.0, part);
    }
}
