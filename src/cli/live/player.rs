//! Position of a viewer in a reel.

use std::ops::Range;

use crate::report::live::State;
use linkage::math::KeepNan;
use recording::Reel;

/// Position of a viewer in a reel, and how playback continues.
pub(super) struct Player {
    /// Log time (ns).
    position: f64,
    /// Number of messages already sent.
    pub told: usize,
    /// Whether playback runs.
    pub plays: bool,
    /// Playback speed: log time that passes per second of the clock.
    pub speed: f64,
}

/// Messages to send now.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Due {
    /// Whether the reel starts again.
    pub again: bool,
    /// Numbers of the messages.
    pub messages: Range<usize>,
}

impl Player {
    /// A player at the start of a reel.
    pub(super) fn new(speed: f64) -> Player {
        Player { position: 0.0, told: 0, plays: true, speed }
    }

    /// Log time (ns).
    pub(super) fn time(&self) -> u64 {
        self.position as u64
    }

    /// Advances the position by `seconds` of the clock.
    /// The messages up to the end of the reel are sent before the reel starts again.
    /// A reel of one instant does not repeat.
    pub(super) fn pass(&mut self, seconds: f64, reel: &Reel) -> Due {
        let again = self.plays && self.told == reel.len() && reel.lasts() > 0;
        if again {
            (self.position, self.told) = (0.0, 0);
        } else if self.plays {
            self.position = (self.position + seconds * 1e9 * self.speed).smaller(reel.lasts() as f64);
        }
        let until = reel.until(self.time()).max(self.told);
        let messages = self.told..until;
        self.told = until;
        Due { again, messages }
    }

    /// Moves to a log time (ns), at most to the end.
    pub(super) fn seek(&mut self, time: u64, reel: &Reel) {
        let time = time.min(reel.lasts());
        (self.position, self.told) = (time as f64, reel.until(time));
    }

    /// The playback state that viewers receive.
    pub(super) fn state(&self, jumped: bool) -> State {
        State { plays: self.plays, time: self.time(), speed: self.speed as f32, jumped }
    }
}
