//! Position and direction of a joint's constraint rows.

use linkage::math::Vec2;

/// Where a joint's constraint rows were at the start of a step.
/// The direction is that of the first joint frame's x axis.
/// The arms go from the mass centres of both bodies to the rows.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Frame {
    pub(super) axis: Vec2,
    pub(super) arms: [Vec2; 2],
}

impl Frame {
    pub(super) fn towards(self, end: Frame, share: f64) -> Frame {
        let mix = |from: Vec2, to: Vec2| from + (to - from) * share;
        Frame { axis: mix(self.axis, end.axis).normalize(), arms: [0, 1].map(|k| mix(self.arms[k], end.arms[k])) }
    }
}
