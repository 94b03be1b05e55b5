//! The machine's vector registers, one by one or in pairs.
//!
//! The result of a division or a square root is available only after many cycles. In a pair, the operations on the two
//! registers are independent, so these waiting times overlap.

use pulp::{Arch, Simd, WithSimd};

/// Number of poses in a tile, which are adjacent in memory. A pair of the widest registers fills a tile.
pub(super) const TILE: usize = 16;

/// The instructions that poses need, on one or several registers.
pub(super) trait Registers: Copy {
    /// One number per pose.
    type Values: Copy;
    /// One choice per pose.
    type Choices: Copy;
    /// One register.
    type One: Registers;
    /// Number of poses that are solved at once.
    const LANES: usize;
    /// Whether each value takes a pair of registers.
    const IS_PAIR: bool;

    fn one(self) -> Self::One;
    fn splat(self, value: f64) -> Self::Values;
    fn add(self, a: Self::Values, b: Self::Values) -> Self::Values;
    fn sub(self, a: Self::Values, b: Self::Values) -> Self::Values;
    fn mul(self, a: Self::Values, b: Self::Values) -> Self::Values;
    fn div(self, a: Self::Values, b: Self::Values) -> Self::Values;
    fn neg(self, a: Self::Values) -> Self::Values;
    fn sqrt(self, a: Self::Values) -> Self::Values;
    fn abs(self, a: Self::Values) -> Self::Values;
    /// Where `a` is greater than `b`.
    fn exceeds(self, a: Self::Values, b: Self::Values) -> Self::Choices;
    /// `a` where the choice is true, elsewhere `b`.
    fn choose(self, choice: Self::Choices, a: Self::Values, b: Self::Values) -> Self::Values;
    /// Reads the part `part` of some adjacent numbers.
    fn read(self, numbers: &[f64], part: usize) -> Self::Values;
    /// Writes the part `part` of some adjacent numbers.
    fn write(self, numbers: &mut [f64], part: usize, values: Self::Values);
}

/// Work that runs on registers of any width.
pub(super) trait OnRegisters {
    /// Whether the work runs on pairs of registers if a pair fits into a tile.
    const IN_PAIRS: bool;
    type Output;

    fn run<R: Registers>(self, on: R) -> Self::Output;
}

struct Dispatched<W>(W);

impl<W: OnRegisters> WithSimd for Dispatched<W> {
    type Output = W::Output;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> W::Output {
        match W::IN_PAIRS && 2 * S::F64_LANES <= TILE {
            true => self.0.run(Pair(simd)),
            false => self.0.run(Single(simd)),
        }
    }
}

/// Runs `work` on the registers of an instruction set.
pub(super) fn dispatch<W: OnRegisters>(arch: Arch, work: W) -> W::Output {
    arch.dispatch(Dispatched(work))
}

/// One register of the instruction set `S`.
#[derive(Clone, Copy)]
struct Single<S: Simd>(S);

/// Two registers of the instruction set `S`.
#[derive(Clone, Copy)]
struct Pair<S: Simd>(S);

// The values of a pair are tuples of two registers, because compiling arrays of registers would take minutes.
macro_rules! on_single {
    ($($name:ident $on_register:ident ($($operand:ident),*);)*) => { $(
        #[inline(always)]
        fn $name(self, $($operand: Self::Values),*) -> Self::Values {
            self.0.$on_register($($operand),*)
        }
    )* };
}

macro_rules! on_pair {
    ($($name:ident $on_register:ident ($($operand:ident),*);)*) => { $(
        #[inline(always)]
        fn $name(self, $($operand: Self::Values),*) -> Self::Values {
            (self.0.$on_register($($operand.0),*), self.0.$on_register($($operand.1),*))
        }
    )* };
}

macro_rules! arithmetic {
    ($on:ident) => {
        $on! {
            add add_f64s (a, b);
            sub sub_f64s (a, b);
            mul mul_f64s (a, b);
            div div_f64s (a, b);
            neg neg_f64s (a);
            sqrt sqrt_f64s (a);
            abs abs_f64s (a);
        }
    };
}

impl<S: Simd> Registers for Single<S> {
    type Values = S::f64s;
    type Choices = S::m64s;
    type One = Self;
    const LANES: usize = S::F64_LANES;
    const IS_PAIR: bool = false;

    arithmetic! { on_single }

    #[inline(always)]
    fn one(self) -> Self::One {
        self
    }

    #[inline(always)]
    fn splat(self, value: f64) -> Self::Values {
        self.0.splat_f64s(value)
    }

    #[inline(always)]
    fn exceeds(self, a: Self::Values, b: Self::Values) -> Self::Choices {
        self.0.greater_than_f64s(a, b)
    }

    #[inline(always)]
    fn choose(self, choice: Self::Choices, a: Self::Values, b: Self::Values) -> Self::Values {
        self.0.select_f64s(choice, a, b)
    }

    #[inline(always)]
    fn read(self, numbers: &[f64], part: usize) -> Self::Values {
        S::as_simd_f64s(numbers).0[part]
    }

    #[inline(always)]
    fn write(self, numbers: &mut [f64], part: usize, values: Self::Values) {
        S::as_mut_simd_f64s(numbers).0[part] = values;
    }
}

impl<S: Simd> Registers for Pair<S> {
    type Values = (S::f64s, S::f64s);
    type Choices = (S::m64s, S::m64s);
    type One = Single<S>;
    const LANES: usize = 2 * S::F64_LANES;
    const IS_PAIR: bool = true;

    arithmetic! { on_pair }

    #[inline(always)]
    fn one(self) -> Self::One {
        Single(self.0)
    }

    #[inline(always)]
    fn splat(self, value: f64) -> Self::Values {
        (self.0.splat_f64s(value), self.0.splat_f64s(value))
    }

    #[inline(always)]
    fn exceeds(self, a: Self::Values, b: Self::Values) -> Self::Choices {
        (self.0.greater_than_f64s(a.0, b.0), self.0.greater_than_f64s(a.1, b.1))
    }

    #[inline(always)]
    fn choose(self, choice: Self::Choices, a: Self::Values, b: Self::Values) -> Self::Values {
        (self.0.select_f64s(choice.0, a.0, b.0), self.0.select_f64s(choice.1, a.1, b.1))
    }

    #[inline(always)]
    fn read(self, numbers: &[f64], part: usize) -> Self::Values {
        let registers = S::as_simd_f64s(numbers).0;
        (registers[2 * part], registers[2 * part + 1])
    }

    #[inline(always)]
    fn write(self, numbers: &mut [f64], part: usize, values: Self::Values) {
        let registers = S::as_mut_simd_f64s(numbers).0;
        (registers[2 * part], registers[2 * part + 1]) = values;
    }
}
