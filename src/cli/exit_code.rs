//! Exit codes.

/// Exit code when everything agrees.
pub const AGREE: u8 = 0;

/// Exit code when something disagrees.
pub const DISAGREE: u8 = 1;

/// Exit code for bad input or usage.
pub const BAD_INPUT: u8 = 2;

/// Exit code when nothing is proven either way.
pub const INCONCLUSIVE: u8 = 3;
