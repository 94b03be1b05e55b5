//! Destination of messages: a file, or a viewer.

use crate::viewers::ViewerMessage;
use mcap::McapResult;

/// Accepts topics and their messages.
pub trait Sink {
    /// Registers a topic with this name and message type, and returns its number.
    fn topic(&mut self, name: &str, kind: &MessageKind) -> McapResult<u16>;

    /// Accepts a message with its log time `time` (ns).
    fn put(&mut self, topic: u16, sequence: u32, time: u64, data: &[u8]) -> McapResult<()>;
}

/// Message type of a topic.
#[derive(Clone, Debug, PartialEq)]
pub struct MessageKind {
    /// Name of the messages' schema.
    pub schema: String,
    /// Encoding of the schema.
    pub encoding: String,
    /// The schema.
    pub data: Vec<u8>,
    /// Encoding of the messages.
    pub message: String,
}

impl MessageKind {
    /// A protobuf type, from the name and the serialised descriptor set of its schema.
    pub fn protobuf(schema: impl Into<String>, data: impl Into<Vec<u8>>) -> MessageKind {
        MessageKind {
            schema: schema.into(),
            encoding: "protobuf".into(),
            data: data.into(),
            message: "protobuf".into(),
        }
    }

    /// A type that viewers know.
    pub fn viewers<M: ViewerMessage>() -> MessageKind {
        MessageKind::protobuf(M::SCHEMA, M::DESCRIPTOR)
    }

    /// The type of a text message in ROS 2.
    pub fn text() -> MessageKind {
        let [schema, encoding, data, message] = ["std_msgs/msg/String", "ros2msg", "string data", "cdr"];
        MessageKind { schema: schema.into(), encoding: encoding.into(), data: data.into(), message: message.into() }
    }
}
