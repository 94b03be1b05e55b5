//! Elements of an XML document, and numbers in it.

use quick_xml::Writer;
use quick_xml::events::{BytesEnd, BytesStart, BytesText, Event};

use linkage::math::Vec2;

/// Shortest text that is parsed as the same number.
pub(super) fn number(value: f64) -> String {
    match value.abs() {
        0.0 => "0".into(),
        size if (1e-4..1e7).contains(&size) => format!("{value}"),
        _ => format!("{value:e}"),
    }
}

pub(super) fn numbers(values: impl IntoIterator<Item = f64>) -> String {
    values.into_iter().map(number).collect::<Vec<_>>().join(" ")
}

/// A position in the plane.
pub(super) fn flat(place: Vec2) -> String {
    numbers([place.x, place.y, 0.0])
}

/// A rotation about z.
pub(super) fn about_z(angle: f64) -> String {
    numbers([0.0, 0.0, 1.0, angle])
}

pub(super) type Attributes<'a> = &'a [(&'a str, &'a str)];

/// An XML document in memory; writing to it cannot fail.
pub(super) struct Xml(pub(super) Writer<Vec<u8>>);

impl Xml {
    pub(super) fn put(&mut self, event: Event) {
        self.0.write_event(event).expect("memory takes everything");
    }

    fn start<'a>(name: &'a str, attributes: Attributes<'a>) -> BytesStart<'a> {
        BytesStart::new(name).with_attributes(attributes.iter().copied())
    }

    pub(super) fn leaf(&mut self, name: &str, attributes: Attributes) {
        self.put(Event::Empty(Self::start(name, attributes)));
    }

    pub(super) fn nest(&mut self, name: &str, attributes: Attributes, inside: impl FnOnce(&mut Self)) {
        self.put(Event::Start(Self::start(name, attributes)));
        inside(self);
        self.put(Event::End(BytesEnd::new(name)));
    }

    pub(super) fn comment(&mut self, text: &str) {
        self.put(Event::Comment(BytesText::from_escaped(format!(" {text} "))));
    }
}
