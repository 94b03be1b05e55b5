//! One number or plane vector for several poses at once, in a register of the machine, and the columns of many poses.
//!
//! Every operation is an IEEE 754 operation on each lane separately, without fused multiply-add.
//! A lane's value therefore does not depend on its neighbours or on the number of lanes.

use std::cell::Cell;
use std::ops::{Add, Deref, DerefMut, Div, Mul, Neg, Range, Sub};

use linkage::math::Vec2;
use linkage::math::tally::LANES;
use pulp::Simd;

/// Number of poses in a tile, whose values of a column are adjacent in memory.
/// All columns of a tile stay in the fastest cache.
pub(super) const TILE: usize = 64;

/// One column of a tile.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(super) struct TileColumn(pub(super) [f64; TILE]);

/// One number per pose.
#[derive(Clone, Copy)]
pub(super) struct Lanes<S: Simd> {
    pub(super) on: S,
    values: S::f64s,
}

macro_rules! lane_by_lane {
    ($($operation:ident $name:ident $on_register:ident;)*) => { $(
        impl<S: Simd> $operation for Lanes<S> {
            type Output = Self;
            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                Lanes { values: self.on.$on_register(self.values, other.values), ..self }
            }
        }
        impl<S: Simd> $operation<f64> for Lanes<S> {
            type Output = Self;
            #[inline(always)]
            fn $name(self, other: f64) -> Self {
                self.$name(Self::splat(self.on, other))
            }
        }
    )* };
}

lane_by_lane! {
    Add add add_f64s;
    Sub sub sub_f64s;
    Mul mul mul_f64s;
    Div div div_f64s;
}

impl<S: Simd> Neg for Lanes<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        // `pulp` does not inline its negation into large functions.
        Lanes { values: self.on.xor_f64s(self.values, self.on.splat_f64s(-0.0)), ..self }
    }
}

impl<S: Simd> Lanes<S> {
    #[inline(always)]
    pub(super) fn splat(on: S, value: f64) -> Self {
        Lanes { on, values: on.splat_f64s(value) }
    }

    #[inline(always)]
    pub(super) fn sqrt(self) -> Self {
        Lanes { values: self.on.sqrt_f64s(self.values), ..self }
    }

    #[inline(always)]
    pub(super) fn abs(self) -> Self {
        let but_the_sign = self.on.splat_f64s(f64::from_bits(!(1 << 63)));
        Lanes { values: self.on.and_f64s(self.values, but_the_sign), ..self }
    }

    /// The lanes in which this number is greater than `other`; `false` if either number is NaN.
    #[inline(always)]
    pub(super) fn exceeds(self, other: Self) -> Choice<S> {
        Choice { on: self.on, choices: self.on.greater_than_f64s(self.values, other.values) }
    }

    /// The part `part` of some adjacent numbers.
    #[inline(always)]
    pub(super) fn of(on: S, numbers: &[f64], part: usize) -> Self {
        Lanes { on, values: S::as_simd_f64s(numbers).0[part] }
    }

    /// The number in one lane.
    pub(super) fn number(self, lane: usize) -> f64 {
        pulp::bytemuck::cast_slice(std::slice::from_ref(&self.values))[lane]
    }

    /// 1 / self.
    #[inline(always)]
    pub(super) fn inverse(self) -> Self {
        Self::splat(self.on, 1.0) / self
    }
}

/// A choice per pose.
#[derive(Clone, Copy)]
pub(super) struct Choice<S: Simd> {
    on: S,
    choices: S::m64s,
}

impl<S: Simd> Choice<S> {
    /// Returns the first number in the lanes where the choice is true, elsewhere the second.
    #[inline(always)]
    pub(super) fn of(self, chosen: Lanes<S>, other: Lanes<S>) -> Lanes<S> {
        Lanes { on: self.on, values: self.on.select_f64s(self.choices, chosen.values, other.values) }
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
    pub(super) fn splat(on: S, v: Vec2) -> Self {
        Plane { x: Lanes::splat(on, v.x), y: Lanes::splat(on, v.y) }
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

    /// This vector, or its opposite if `sign` is -0. The only other value of `sign` is +0.
    #[inline(always)]
    pub(super) fn signed(self, sign: f64) -> Self {
        let flip = self.x.on.splat_f64s(sign);
        let signed = |lanes: Lanes<S>| Lanes { values: lanes.on.xor_f64s(lanes.values, flip), ..lanes };
        Plane { x: signed(self.x), y: signed(self.y) }
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

/// Adjacent columns of a tile, or other numbers that are adjacent in memory, register by register.
/// They are cells, because a step of the solution reads some columns and writes others.
#[derive(Clone, Copy, Debug)]
pub(super) struct Columns<'a, S: Simd> {
    pub(super) on: S,
    cells: &'a [Cell<S::f64s>],
}

impl<'a, S: Simd> Columns<'a, S> {
    /// Number of registers that a column fills.
    pub(super) const PARTS: usize = TILE / S::F64_LANES;

    /// Numbers that fill whole registers.
    #[inline(always)]
    pub(super) fn of(on: S, numbers: &'a mut [f64]) -> Self {
        Columns { on, cells: Cell::from_mut(S::as_mut_simd_f64s(numbers).0).as_slice_of_cells() }
    }

    /// `COUNT` columns, beginning with the column `first`. The limits are checked here, once for all registers.
    #[inline(always)]
    pub(super) fn adjacent<const COUNT: usize>(self, first: usize) -> Self {
        Columns { cells: &self.cells[first * Self::PARTS..][..COUNT * Self::PARTS], ..self }
    }

    /// One column.
    #[inline(always)]
    pub(super) fn column(self, column: usize) -> Self {
        self.adjacent::<1>(column)
    }

    /// The column `column` in the poses `part`.
    #[inline(always)]
    pub(super) fn get(self, column: usize, part: usize) -> Lanes<S> {
        Lanes { on: self.on, values: self.cells[column * Self::PARTS + part].get() }
    }

    #[inline(always)]
    pub(super) fn put(self, column: usize, part: usize, lanes: Lanes<S>) {
        self.cells[column * Self::PARTS + part].set(lanes.values);
    }

    /// The vector with its components in `column` and the next column.
    #[inline(always)]
    pub(super) fn vector(self, column: usize, part: usize) -> Plane<S> {
        Plane { x: self.get(column, part), y: self.get(column + 1, part) }
    }

    #[inline(always)]
    pub(super) fn put_vector(self, column: usize, part: usize, v: Plane<S>) {
        self.put(column, part, v.x);
        self.put(column + 1, part, v.y);
    }
}

/// The columns of a tile.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tile<'a, S: Simd> {
    pub(super) columns: Columns<'a, S>,
    /// Number of parts that are solved, at most [`Columns::PARTS`].
    parts: usize,
}

impl<'a, S: Simd> Tile<'a, S> {
    /// A tile in which the first `rows` poses are wanted. The number of poses that are solved is a multiple of
    /// [`LANES`], for the statistics.
    #[inline(always)]
    pub(super) fn of(on: S, columns: &'a mut [f64], rows: usize) -> Self {
        Tile { columns: Columns::of(on, columns), parts: rows.next_multiple_of(LANES) / S::F64_LANES }
    }

    /// The parts of the tile. Each part fills a register.
    #[inline(always)]
    pub(super) fn parts(self) -> Range<usize> {
        // With this limit, the compiler removes the checks of indices.
        0..self.parts.min(Columns::<S>::PARTS)
    }

    /// The poses of a part.
    #[inline(always)]
    pub(super) fn window(self, part: usize) -> Window<'a, S> {
        Window { on: self.columns.on, columns: self.columns, part }
    }
}

/// View of the poses of one tile that are solved at once.
#[derive(Clone, Copy, Debug)]
pub(super) struct Window<'a, S: Simd> {
    pub(super) on: S,
    pub(super) columns: Columns<'a, S>,
    pub(super) part: usize,
}

impl<S: Simd> Window<'_, S> {
    #[inline(always)]
    pub(super) fn get(self, column: usize) -> Lanes<S> {
        self.columns.get(column, self.part)
    }

    #[inline(always)]
    pub(super) fn put(self, column: usize, lanes: Lanes<S>) {
        self.columns.put(column, self.part, lanes);
    }

    /// Returns the vector with its components at `column` and the next column.
    #[inline(always)]
    pub(super) fn vector(self, column: usize) -> Plane<S> {
        self.columns.vector(column, self.part)
    }

    #[inline(always)]
    pub(super) fn put_vector(self, column: usize, v: Plane<S>) {
        self.columns.put_vector(column, self.part, v);
    }
}

/// Numbers that begin at a cache line.
#[derive(Debug, Default)]
pub(super) struct AlignedNumbers {
    numbers: Vec<f64>,
    /// Index of the first number at a cache line.
    first: usize,
    /// Number of numbers.
    count: usize,
}

impl AlignedNumbers {
    /// `count` zeros.
    pub(super) fn zeros(count: usize) -> Self {
        let numbers = vec![0.0; count + 8];
        let first = numbers.as_ptr().align_offset(64).min(8);
        AlignedNumbers { numbers, first, count }
    }

    /// Changes the number of numbers. Their values have no meaning afterwards.
    pub(super) fn resize(&mut self, count: usize) {
        match count + 8 <= self.numbers.len() {
            true => self.count = count,
            false => *self = Self::zeros(count),
        }
    }
}

impl Clone for AlignedNumbers {
    fn clone(&self) -> Self {
        let mut copy = Self::zeros(self.count);
        copy.copy_from_slice(self);
        copy
    }
}

impl Deref for AlignedNumbers {
    type Target = [f64];
    fn deref(&self) -> &[f64] {
        &self.numbers[self.first..][..self.count]
    }
}

impl DerefMut for AlignedNumbers {
    fn deref_mut(&mut self) -> &mut [f64] {
        &mut self.numbers[self.first..][..self.count]
    }
}
