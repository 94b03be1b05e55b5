//! Messages between the live server and a viewer: Foxglove's WebSocket protocol, as JSON and as bytes.
//!
//! Foxglove has renamed its protocol, but has not changed the messages that this server uses.
//! Only viewers that offer the new name support playback control.
//! Numbers are little-endian; a binary message begins with its opcode.

use crate::sentences;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};

use super::layout::{TURN, speed};
use linkage::math::KeepNan;
use prover::numbers::significant;
use recording::{MessageKind, Reel, ReelMessage};

linkage::words! {
    /// Name of the protocol of live views. A viewer offers the protocol names that it supports.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub(crate) enum Dialect: name {
        /// Current Foxglove.
        Sdk = "foxglove.sdk.v1",
        /// The former name, for Lichtblick and the open-source Foxglove Studio.
        WebSocket = "foxglove.websocket.v1",
    }
}

impl Dialect {
    /// The preferred protocol name among the names that a viewer offers in `offered`, separated by commas.
    pub(crate) fn of(offered: &str) -> Option<Dialect> {
        let is_offered = |own: &Dialect| offered.split(',').any(|name| name.trim() == own.name());
        [Dialect::Sdk, Dialect::WebSocket].into_iter().find(is_offered)
    }
}

/// A request of a viewer.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Request {
    /// Subscribes to channels, each under a number that the viewer chooses.
    Subscribe(Vec<(u32, u64)>),
    /// Ends the subscriptions with these numbers.
    Unsubscribe(Vec<u32>),
    /// Changes playback.
    Control(Control),
}

/// Playback as requested by a viewer.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Control {
    /// Whether playback runs.
    pub plays: bool,
    /// Playback speed: log time that passes per second of the clock.
    pub speed: f32,
    /// Log time (ns) to go to.
    pub seek: Option<u64>,
    /// Identifier of the request, chosen by the viewer.
    pub id: String,
}

/// Playback state of a viewer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct State {
    /// Whether playback runs.
    pub plays: bool,
    /// Log time (ns).
    pub time: u64,
    /// Playback speed: log time that passes per second of the clock.
    pub speed: f32,
    /// Whether playback jumped to `time`.
    pub jumped: bool,
}

/// Playback speed: log time that passes per second of the clock.
/// The value is the playback speed of the layout, reduced if a revolution would be too fast to follow.
pub(crate) fn pace(reel: &Reel) -> f64 {
    let usual = speed(reel.slow, reel.turn);
    if reel.slow == 1.0 && reel.turn > 0.0 { usual.smaller(reel.turn / TURN) } else { usual }
}

/// The speed of playback in words, for people.
pub(crate) fn pace_told(reel: &Reel) -> String {
    let [slow, lasts] = [reel.slow, reel.lasts() as f64 * 1e-9].map(|own| significant(own / pace(reel), 3));
    match reel.lasts() {
        0 => sentences::ONE_INSTANT_AT_REST.into(),
        _ if slow == "1" => sentences::as_fast_as_the_mechanism(&lasts),
        _ => sentences::times_slower_than_the_mechanism(&slow, &lasts),
    }
}

/// Name of the server, and what the viewer may do.
/// A new `session` makes viewers discard what they have shown.
pub(crate) fn server_info(name: &str, session: &str, dialect: Dialect, reel: Option<&Reel>) -> String {
    let mut info = json!({ "op": "serverInfo", "name": name, "capabilities": ["time"], "sessionId": session });
    if let (Dialect::Sdk, Some(reel)) = (dialect, reel) {
        info["capabilities"] = json!(["time", "playbackControl"]);
        info["dataStartTime"] = stamp(0);
        info["dataEndTime"] = stamp(reel.lasts());
    }
    info.to_string()
}

fn stamp(nanoseconds: u64) -> Value {
    json!({ "sec": nanoseconds / 1_000_000_000, "nsec": nanoseconds % 1_000_000_000 })
}

/// Announces the channels of topics; the first channel has the number `first`.
pub(crate) fn advertised(topics: &[(String, MessageKind)], first: u64) -> String {
    let channels = topics.iter().zip(first..).map(|((topic, kind), id)| {
        // Binary schemas are written as base64, text schemas unchanged.
        let schema = match kind.encoding.as_str() {
            "protobuf" => STANDARD.encode(&kind.data),
            _ => String::from_utf8_lossy(&kind.data).into_owned(),
        };
        json!({
            "id": id,
            "topic": topic,
            "encoding": kind.message,
            "schemaName": kind.schema,
            "schemaEncoding": kind.encoding,
            "schema": schema,
        })
    });
    json!({ "op": "advertise", "channels": channels.collect::<Vec<Value>>() }).to_string()
}

/// Announces that `count` channels, from the number `first`, no longer exist.
pub(crate) fn unadvertised(first: u64, count: usize) -> String {
    let ids: Vec<u64> = (first..).take(count).collect();
    json!({ "op": "unadvertise", "channelIds": ids }).to_string()
}

/// A message of a channel for the subscription with this number.
pub(crate) fn message(subscription: u32, told: &ReelMessage) -> Vec<u8> {
    [&[1][..], &subscription.to_le_bytes(), &told.time.to_le_bytes(), told.data].concat()
}

/// The server's log time (ns).
pub(crate) fn time(time: u64) -> Vec<u8> {
    [&[2][..], &time.to_le_bytes()].concat()
}

/// The playback state; `id` is the identifier of the request that this message answers, or empty.
pub(crate) fn state(state: &State, id: &str) -> Vec<u8> {
    let (head, jumped, length) = ([5, u8::from(!state.plays)], [u8::from(state.jumped)], id.len() as u32);
    let (time, speed) = (state.time.to_le_bytes(), state.speed.to_le_bytes());
    [&head[..], &time, &speed, &jumped, &length.to_le_bytes(), id.as_bytes()].concat()
}

/// Reads a request from a viewer's text message; `None` if the request is not supported.
pub(crate) fn asked(text: &str) -> Option<Request> {
    let value: Value = serde_json::from_str(text).ok()?;
    let list = |key: &str| value.get(key)?.as_array();
    let number = |of: &Value| u32::try_from(of.as_u64()?).ok();
    match value.get("op")?.as_str()? {
        "subscribe" => {
            let pair = |own: &Value| Some((number(own.get("id")?)?, own.get("channelId")?.as_u64()?));
            Some(Request::Subscribe(list("subscriptions")?.iter().filter_map(pair).collect()))
        }
        "unsubscribe" => Some(Request::Unsubscribe(list("subscriptionIds")?.iter().filter_map(number).collect())),
        _ => None,
    }
}

/// Reads a request from a viewer's binary message; `None` if the request is not supported.
pub(crate) fn asked_in_bytes(bytes: &[u8]) -> Option<Request> {
    let (&[kind, command], rest) = bytes.split_first_chunk()?;
    let (&speed, rest) = rest.split_first_chunk()?;
    let (&[seeks], rest) = rest.split_first_chunk()?;
    let (&seek, rest) = rest.split_first_chunk()?;
    let (&length, rest) = rest.split_first_chunk()?;
    let id = rest.get(..u32::from_le_bytes(length) as usize)?;
    let speed = f32::from_le_bytes(speed);
    let is_control = kind == 3 && command <= 1 && speed.is_finite() && speed >= 0.0;
    is_control.then(|| {
        Request::Control(Control {
            plays: command == 0,
            speed,
            seek: (seeks != 0).then_some(u64::from_le_bytes(seek)),
            id: String::from_utf8_lossy(id).into_owned(),
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_newer_protocol_is_preferred_and_unknown_ones_refused() {
        for (offered, dialect) in [
            ("foxglove.websocket.v1", Some(Dialect::WebSocket)),
            ("foxglove.websocket.v1, foxglove.sdk.v1", Some(Dialect::Sdk)),
            ("foxglove.sdk.v1.1,foxglove.sdk.v1", Some(Dialect::Sdk)),
            ("foxglove.sdk.v1.1", None),
            ("", None),
        ] {
            assert_eq!(Dialect::of(offered), dialect, "{offered}");
        }
    }

    #[test]
    fn messages_have_the_bytes_of_the_protocol() {
        let told = ReelMessage { time: 0x0102, topic: 7, data: b"ab" };
        assert_eq!(message(3, &told), [1, 3, 0, 0, 0, 2, 1, 0, 0, 0, 0, 0, 0, b'a', b'b']);
        assert_eq!(time(5), [2, 5, 0, 0, 0, 0, 0, 0, 0]);
        let state_of = State { plays: false, time: 1, speed: 1.0, jumped: true };
        assert_eq!(state(&state_of, "x"), [5, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 128, 63, 1, 1, 0, 0, 0, b'x']);
    }

    #[test]
    fn valid_requests_are_parsed_and_others_ignored() {
        let subscribe = r#"{"op":"subscribe","subscriptions":[{"id":0,"channelId":9},{"id":-1,"channelId":1},{}]}"#;
        assert_eq!(asked(subscribe), Some(Request::Subscribe(vec![(0, 9)])));
        let unsubscribe = r#"{"op":"unsubscribe","subscriptionIds":[0,"a",4294967296,2]}"#;
        assert_eq!(asked(unsubscribe), Some(Request::Unsubscribe(vec![0, 2])));
        for text in ["", "[]", "{}", r#"{"op":1}"#, r#"{"op":"subscribe"}"#, r#"{"op":"getParameters"}"#] {
            assert_eq!(asked(text), None, "{text}");
        }
        let control: Vec<u8> =
            [&[3, 1][..], &0.5f32.to_le_bytes(), &[1], &8u64.to_le_bytes(), &[2, 0, 0, 0], b"id"].concat();
        let read = Control { plays: false, speed: 0.5, seek: Some(8), id: "id".into() };
        assert_eq!(asked_in_bytes(&control), Some(Request::Control(read)));
        for length in 0..control.len() {
            assert_eq!(asked_in_bytes(&control[..length]), None, "{length} bytes");
        }
        for (place, byte) in [(0, 1), (1, 2), (5, 0x7f), (5, 0xbf)] {
            let mut wrong = control.clone();
            (wrong[4], wrong[place]) = (0x80, byte);
            assert_eq!(asked_in_bytes(&wrong), None, "byte {place}");
        }
    }
}
