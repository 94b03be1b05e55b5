//! Where messages go: a file, or whoever looks on.

use super::schema;
use crate::viewers::Known;
use mcap::McapResult;

/// Takes topics and their messages.
pub trait Sink {
    /// Number of a topic with this name and kind of message.
    fn topic(&mut self, name: &str, kind: &Kind) -> McapResult<u16>;

    /// Takes one message at a time (ns).
    fn put(&mut self, topic: u16, sequence: u32, time: u64, data: &[u8]) -> McapResult<()>;
}

/// What the messages of a topic are.
#[derive(Clone, Debug, PartialEq)]
pub struct Kind {
    /// Name of their schema.
    pub schema: String,
    /// How the schema is written.
    pub encoding: String,
    /// The schema.
    pub data: Vec<u8>,
    /// How messages are written.
    pub message: String,
}

impl Kind {
    /// One of our own messages.
    pub fn own(schema: schema::Schema) -> Kind {
        Kind { schema: schema.name, encoding: "protobuf".into(), data: schema.descriptor, message: "protobuf".into() }
    }

    /// One of the viewers' messages.
    pub fn viewers<M: Known>() -> Kind {
        Kind {
            schema: M::SCHEMA.into(),
            encoding: "protobuf".into(),
            data: M::DESCRIPTOR.into(),
            message: "protobuf".into(),
        }
    }

    /// A text, as robots' programs write it.
    pub fn text() -> Kind {
        let [schema, encoding, data, message] = ["std_msgs/msg/String", "ros2msg", "string data", "cdr"];
        Kind { schema: schema.into(), encoding: encoding.into(), data: data.into(), message: message.into() }
    }
}
