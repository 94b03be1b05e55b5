//! Requests of a viewer.

use std::collections::BTreeMap;

/// Largest number of subscriptions of one viewer to one topic.
/// A viewer needs one subscription; each additional subscription repeats every message.
const EACH: usize = 4;

/// Subscriptions of a viewer, indexed by the viewer's number and by the topic's number.
#[derive(Default)]
pub(super) struct Wants {
    topics: BTreeMap<u32, u16>,
    numbers: BTreeMap<u16, Vec<u32>>,
}

impl Wants {
    /// Adds a topic under a number that the viewer chose; returns whether it was added.
    /// A subscription is refused if the viewer already has [`EACH`] subscriptions to the topic.
    pub(super) fn add(&mut self, number: u32, topic: u16) -> bool {
        let numbers = self.numbers.entry(topic).or_default();
        let is_new = numbers.len() < EACH && !self.topics.contains_key(&number);
        if is_new {
            numbers.push(number);
            self.topics.insert(number, topic);
        }
        is_new
    }

    /// Forgets these numbers.
    pub(super) fn remove(&mut self, numbers: &[u32]) {
        for number in numbers {
            let topic = self.topics.remove(number);
            if let Some(own) = topic.and_then(|topic| self.numbers.get_mut(&topic)) {
                own.retain(|other| other != number);
            }
        }
    }

    /// Forgets everything.
    pub(super) fn clear(&mut self) {
        *self = Wants::default();
    }

    /// The numbers under which the viewer subscribes to a topic.
    pub(super) fn of(&self, topic: u16) -> Vec<u32> {
        self.numbers.get(&topic).cloned().unwrap_or_default()
    }

    /// All subscription numbers with their topics.
    pub(super) fn all(&self) -> Vec<(u32, u16)> {
        self.topics.iter().map(|(&number, &topic)| (number, topic)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_viewer_has_at_most_four_subscriptions_per_topic() {
        let mut wants = Wants::default();
        let added = (0..100_000).filter(|&number| wants.add(number, (number % 3) as u16)).count();
        assert_eq!((added, wants.all().len()), (3 * EACH, 3 * EACH));
        assert_eq!(wants.of(1), [1, 4, 7, 10]);
        assert!(!wants.add(1, 2), "a number is taken once");
        wants.remove(&[4, 4, 99_999]);
        assert_eq!(wants.of(1), [1, 7, 10]);
        assert!(wants.add(4, 1) && wants.of(1) == [1, 7, 10, 4]);
        wants.clear();
        assert!(wants.all().is_empty() && wants.of(1).is_empty());
    }
}
