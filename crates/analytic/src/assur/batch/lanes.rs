//! One number or plane vector for several poses at once, on the widest registers of the machine.
//!
//! Every operation is an IEEE 754 operation on each lane separately, without fused multiply-add.
//! A lane's value therefore does not depend on its neighbours or on the number of lanes.

use std::ops::{Add, Div, Mul, Neg, Sub};

use pulp::Simd;

use linkage::math::Vec2;

/// Number of poses in a tile, which are adjacent in memory.
pub(super) const TILE: usize = 8;

/// One column of a tile.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(super) struct Eight(pub(super) [f64; TILE]);

/// One number per pose.
#[derive(Clone, Copy)]
pub(super) struct Lanes<S: Simd> {
    pub(super) simd: S,
    value: S::f64s,
}

macro_rules! lane_by_lane {
    ($($operation:ident $name:ident $on_lanes:ident)*) => { $(
        impl<S: Simd> $operation for Lanes<S> {
            type Output = Self;
            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                Lanes { value: self.simd.$on_lanes(self.value, other.value), ..self }
            }
        }
        impl<S: Simd> $operation<f64> for Lanes<S> {
            type Output = Self;
            #[inline(always)]
            fn $name(self, other: f64) -> Self {
                self.$name(Lanes { value: self.simd.splat_f64s(other), ..self })
            }
        }
    )* };
}

lane_by_lane! { Add add add_f64s  Sub sub sub_f64s  Mul mul mul_f64s  Div div div_f64s }

impl<S: Simd> Neg for Lanes<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Lanes { value: self.simd.neg_f64s(self.value), ..self }
    }
}

impl<S: Simd> Lanes<S> {
    #[inline(always)]
    pub(super) fn splat(simd: S, value: f64) -> Self {
        Lanes { simd, value: simd.splat_f64s(value) }
    }

    #[inline(always)]
    pub(super) fn sqrt(self) -> Self {
        Lanes { value: self.simd.sqrt_f64s(self.value), ..self }
    }

    #[inline(always)]
    pub(super) fn abs(self) -> Self {
        Lanes { value: self.simd.abs_f64s(self.value), ..self }
    }

    /// The lanes in which this number is greater than `other`; `false` if either number is NaN.
    #[inline(always)]
    pub(super) fn exceeds(self, other: Self) -> Choice<S> {
        Choice { simd: self.simd, mask: self.simd.greater_than_f64s(self.value, other.value) }
    }

    /// The lanes as the first numbers of a column.
    #[inline(always)]
    pub(super) fn to_column(self) -> [f64; TILE] {
        let mut column = Eight([0.0; TILE]);
        S::as_mut_simd_f64s(&mut column.0).0[0] = self.value;
        column.0
    }

    /// The first numbers of a column as lanes.
    #[inline(always)]
    pub(super) fn of_column(simd: S, column: &[f64; TILE]) -> Self {
        Lanes { simd, value: S::as_simd_f64s(column).0[0] }
    }

    /// 1 / self.
    #[inline(always)]
    pub(super) fn inverse(self) -> Self {
        Self::splat(self.simd, 1.0) / self
    }
}

/// A choice per pose.
#[derive(Clone, Copy)]
pub(super) struct Choice<S: Simd> {
    simd: S,
    mask: S::m64s,
}

impl<S: Simd> Choice<S> {
    /// Returns the first number in the lanes where the choice is true, elsewhere the second.
    #[inline(always)]
    pub(super) fn of(self, chosen: Lanes<S>, other: Lanes<S>) -> Lanes<S> {
        Lanes { simd: self.simd, value: self.simd.select_f64s(self.mask, chosen.value, other.value) }
    }

    /// Returns both numbers, exchanged in the lanes where the choice is true.
    #[inline(always)]
    pub(super) fn exchanged(self, a: Lanes<S>, b: Lanes<S>) -> (Lanes<S>, Lanes<S>) {
        (self.of(b, a), self.of(a, b))
    }
}

/// One plane vector per pose.
#[derive(Clone, Copy)]
pub(super) struct Plane<S: Simd> {
    pub(super) x: Lanes<S>,
    pub(super) y: Lanes<S>,
}

impl<S: Simd> Add for Plane<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Plane { x: self.x + other.x, y: self.y + other.y }
    }
}

impl<S: Simd> Add<Vec2> for Plane<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Vec2) -> Self {
        Plane { x: self.x + other.x, y: self.y + other.y }
    }
}

impl<S: Simd> Sub for Plane<S> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Plane { x: self.x - other.x, y: self.y - other.y }
    }
}

impl<S: Simd> Neg for Plane<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Plane { x: -self.x, y: -self.y }
    }
}

impl<S: Simd, T: Copy> Mul<T> for Plane<S>
where
    Lanes<S>: Mul<T, Output = Lanes<S>>,
{
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: T) -> Self {
        Plane { x: self.x * factor, y: self.y * factor }
    }
}

impl<S: Simd> Plane<S> {
    #[inline(always)]
    pub(super) fn splat(simd: S, v: Vec2) -> Self {
        Plane { x: Lanes::splat(simd, v.x), y: Lanes::splat(simd, v.y) }
    }

    #[inline(always)]
    pub(super) fn dot(self, other: Self) -> Lanes<S> {
        self.x * other.x + self.y * other.y
    }

    #[inline(always)]
    pub(super) fn cross(self, other: Self) -> Lanes<S> {
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

/// View of as many poses of one tile as fit into a register.
#[derive(Debug)]
pub(super) struct Window<'a, S: Simd> {
    pub(super) simd: S,
    pub(super) columns: &'a mut [Eight],
    /// Index of this part of the tile.
    pub(super) part: usize,
}

impl<S: Simd> Window<'_, S> {
    /// Number of parts in a tile.
    pub(super) const PARTS: usize = TILE / S::F64_LANES;

    #[inline(always)]
    pub(super) fn get(&self, column: usize) -> Lanes<S> {
        self.of(&self.columns[column])
    }

    #[inline(always)]
    pub(super) fn put(&mut self, column: usize, lanes: Lanes<S>) {
        S::as_mut_simd_f64s(&mut self.columns[column].0).0[self.part] = lanes.value;
    }

    /// The same part of a column that is not in the tile.
    #[inline(always)]
    pub(super) fn of(&self, column: &Eight) -> Lanes<S> {
        self.in_array(&column.0)
    }

    #[inline(always)]
    pub(super) fn in_array(&self, column: &[f64; TILE]) -> Lanes<S> {
        Lanes { simd: self.simd, value: S::as_simd_f64s(column).0[self.part] }
    }

    #[inline(always)]
    pub(super) fn put_in(&self, column: &mut [f64; TILE], lanes: Lanes<S>) {
        S::as_mut_simd_f64s(column).0[self.part] = lanes.value;
    }

    #[inline(always)]
    pub(super) fn add_to(&self, column: &mut [f64; TILE], lanes: Lanes<S>) {
        let sum = self.in_array(column) + lanes;
        self.put_in(column, sum);
    }

    /// Returns the vector with its components at `column` and the next column.
    #[inline(always)]
    pub(super) fn vector(&self, column: usize) -> Plane<S> {
        Plane { x: self.get(column), y: self.get(column + 1) }
    }

    #[inline(always)]
    pub(super) fn put_vector(&mut self, column: usize, v: Plane<S>) {
        self.put(column, v.x);
        self.put(column + 1, v.y);
    }
}
