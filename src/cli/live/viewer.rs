//! One viewer: its requests and its position.
//! Each viewer has a separate clock.
//! A viewer that pauses, seeks or is slow therefore does not disturb other viewers.
//! A viewer that connects late still sees the content from its start.

use crate::sentences;
use std::collections::BTreeMap;
use std::io::ErrorKind;
use std::net::TcpStream;
use std::time::{Duration, Instant};

use tungstenite::handshake::server::{ErrorResponse, Request as Asking, Response};
use tungstenite::http::{HeaderValue, StatusCode};
use tungstenite::protocol::WebSocketConfig;
use tungstenite::{Error, Message, WebSocket, accept_hdr_with_config};

use super::player::Player;
use super::stage::{Shown, Stage};
use crate::report::live::{self, Control, Dialect, Request};
use recording::Reel;

/// How long a viewer's thread waits for a request before it reads the clock again.
const TICK: Duration = Duration::from_millis(10);
/// Time limit for the handshake with a viewer.
const GREETING: Duration = Duration::from_secs(5);
/// Time limit for sending data to a viewer.
const PATIENCE: Duration = Duration::from_secs(20);
/// Largest time by which playback advances between two readings of the clock.
/// After a pause, a slow viewer therefore does not receive all missed messages at once.
const MOST: Duration = Duration::from_millis(100);
/// Largest request (bytes).
const LARGEST: usize = 1 << 20;
/// Largest number of requests between two readings of the clock.
const REQUESTS: usize = 64;
/// The channel numbers of new content begin at the product of this constant and the number of content changes so far.
/// Each channel number is therefore unique.
const CHANNELS: u64 = 1 << 16;

/// One viewer.
pub(super) struct Viewer<'a> {
    socket: WebSocket<TcpStream>,
    dialect: Dialect,
    stage: &'a Stage,
    shown: Shown,
    player: Player,
    wants: Wants,
}

type Spoken = tungstenite::Result<()>;

impl<'a> Viewer<'a> {
    /// Agrees on a protocol with a viewer; `None` if they share no protocol, or if the connection fails.
    pub(super) fn greeted(stream: TcpStream, stage: &'a Stage) -> Option<Viewer<'a>> {
        stream.set_nodelay(true).ok()?;
        stream.set_read_timeout(Some(GREETING)).ok()?;
        stream.set_write_timeout(Some(PATIENCE)).ok()?;
        let mut dialect = None;
        let config = WebSocketConfig::default().max_message_size(Some(LARGEST)).max_frame_size(Some(LARGEST));
        #[expect(clippy::result_large_err, reason = "a type of the library")]
        let answer = |asking: &Asking, response: Response| agreed(asking, response, &mut dialect);
        let socket = accept_hdr_with_config(stream, answer, Some(config)).ok()?;
        socket.get_ref().set_read_timeout(Some(TICK)).ok()?;
        let player = Player::new(1.0);
        Some(Viewer { socket, dialect: dialect?, stage, shown: Shown::default(), player, wants: Wants::default() })
    }

    /// Serves the viewer until it leaves.
    pub(super) fn attend(mut self) {
        // An abrupt disconnection counts as a normal end.
        let _ = self.converse();
    }

    fn converse(&mut self) -> Spoken {
        self.introduce()?;
        let mut since = Instant::now();
        loop {
            self.listen()?;
            self.look_at_the_stage()?;
            let now = Instant::now();
            let passed = (now - since).min(MOST);
            since = now;
            self.play(passed.as_secs_f64())?;
            self.socket.flush()?;
        }
    }

    /// Sends the name of the server, the channels, and the playback state.
    fn introduce(&mut self) -> Spoken {
        let session = format!("{}-{}", std::process::id(), self.shown.changes);
        let reel = self.shown.reel.clone();
        let topics = reel.as_ref().map_or(&[][..], |reel| &reel.topics);
        self.say(live::server_info(&self.stage.name, &session, self.dialect, reel.as_deref()))?;
        self.say(live::advertised(topics, self.first_channel()))?;
        self.tell_state(reel.is_some(), "")
    }

    /// Switches to new content, if new content exists.
    fn look_at_the_stage(&mut self) -> Spoken {
        let shown = self.stage.shown();
        if shown.changes == self.shown.changes {
            return Ok(());
        }
        if let Some(old) = &self.shown.reel {
            self.say(live::unadvertised(self.first_channel(), old.topics.len()))?;
        }
        self.player = Player::new(shown.reel.as_deref().map_or(1.0, live::pace));
        self.shown = shown;
        self.wants.clear();
        self.introduce()
    }

    /// Sends the messages that are due.
    fn play(&mut self, seconds: f64) -> Spoken {
        let Some(reel) = self.shown.reel.clone() else { return Ok(()) };
        let due = self.player.pass(seconds, &reel);
        if due.again {
            self.tell_state(true, "")?;
        }
        let mut clock = None;
        for told in due.messages.map(|index| reel.message(index)) {
            // Viewers date a message by the last time that the server announced, not by the message's own log time.
            // The server therefore announces each log time before it sends the messages with this log time.
            if clock != Some(told.time) {
                self.send(live::time(told.time))?;
                clock = Some(told.time);
            }
            for number in self.wants.of(told.topic) {
                self.send(live::message(number, &told))?;
            }
        }
        if self.player.plays || due.again {
            self.send(live::time(self.player.time()))?;
        }
        Ok(())
    }

    /// Reads the requests that have arrived.
    fn listen(&mut self) -> Spoken {
        for _ in 0..REQUESTS {
            let heard = match self.socket.read() {
                Ok(heard) => heard,
                Err(Error::Io(nothing)) if matches!(nothing.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut) => {
                    return Ok(());
                }
                Err(gone) => return Err(gone),
            };
            let request = if let Message::Text(text) = &heard {
                live::asked(text)
            } else if let Message::Binary(bytes) = &heard {
                live::asked_in_bytes(bytes)
            } else {
                None
            };
            if let (Some(request), Some(reel)) = (request, self.shown.reel.clone()) {
                self.answer(request, &reel)?;
            }
        }
        Ok(())
    }

    fn answer(&mut self, request: Request, reel: &Reel) -> Spoken {
        match request {
            Request::Subscribe(pairs) => {
                for (number, channel) in pairs {
                    let topic = channel.checked_sub(self.first_channel()).and_then(|own| u16::try_from(own).ok());
                    let topic = topic.filter(|&own| usize::from(own) < reel.topics.len());
                    if let Some(topic) = topic
                        && self.wants.add(number, topic)
                    {
                        self.tell_latest(number, topic, reel)?;
                    }
                }
                Ok(())
            }
            Request::Unsubscribe(numbers) => {
                self.wants.remove(&numbers);
                Ok(())
            }
            Request::Control(control) => self.control(&control, reel),
        }
    }

    fn control(&mut self, control: &Control, reel: &Reel) -> Spoken {
        (self.player.plays, self.player.speed) = (control.plays, f64::from(control.speed));
        if let Some(time) = control.seek {
            self.player.seek(time, reel);
        }
        self.tell_state(control.seek.is_some(), &control.id)?;
        if control.seek.is_some() {
            self.send(live::time(self.player.time()))?;
            for (number, topic) in self.wants.all() {
                self.tell_latest(number, topic, reel)?;
            }
        }
        Ok(())
    }

    /// Sends the latest message of the topic, because a viewer that subscribes late would miss messages that are sent
    /// only once.
    fn tell_latest(&mut self, number: u32, topic: u16, reel: &Reel) -> Spoken {
        match reel.latest(topic, self.player.told) {
            Some(told) => self.send(live::message(number, &told)),
            None => Ok(()),
        }
    }

    /// Sends the playback state to viewers that support it.
    fn tell_state(&mut self, jumped: bool, id: &str) -> Spoken {
        match (self.dialect, &self.shown.reel) {
            (Dialect::Sdk, Some(_)) => self.send(live::state(&self.player.state(jumped), id)),
            (Dialect::Sdk, None) | (Dialect::WebSocket, _) => Ok(()),
        }
    }

    fn first_channel(&self) -> u64 {
        1 + self.shown.changes * CHANNELS
    }

    fn say(&mut self, text: String) -> Spoken {
        self.socket.write(Message::Text(text.into()))
    }

    fn send(&mut self, bytes: Vec<u8>) -> Spoken {
        self.socket.write(Message::Binary(bytes.into()))
    }
}

/// Answers the handshake: with the selected protocol, or with a list of the supported protocols.
#[expect(clippy::result_large_err, reason = "a type of the library")]
fn agreed(
    asking: &Asking,
    mut response: Response,
    dialect: &mut Option<Dialect>,
) -> std::result::Result<Response, ErrorResponse> {
    const HEADER: &str = "sec-websocket-protocol";
    let offered: Vec<&str> = asking.headers().get_all(HEADER).iter().filter_map(|own| own.to_str().ok()).collect();
    let Some(found) = Dialect::of(&offered.join(",")) else {
        let known = [Dialect::Sdk, Dialect::WebSocket].map(Dialect::name).join(" and ");
        let mut refusal = ErrorResponse::new(Some(sentences::linkproof_speaks(&known)));
        *refusal.status_mut() = StatusCode::BAD_REQUEST;
        return Err(refusal);
    };
    response.headers_mut().insert(HEADER, HeaderValue::from_static(found.name()));
    *dialect = Some(found);
    Ok(response)
}

/// Largest number of subscriptions of one viewer to one topic.
/// A viewer needs one subscription; each additional subscription repeats every message.
const EACH: usize = 4;

/// Subscriptions of a viewer, by the numbers that the viewer chose and by the numbers of the topics.
#[derive(Default)]
pub(super) struct Wants {
    topics: BTreeMap<u32, u16>,
    numbers: BTreeMap<u16, Vec<u32>>,
}

impl Wants {
    /// Adds a topic under a number that the viewer chose; returns whether it was added.
    /// A topic is not added if the viewer already has [`EACH`] subscriptions to it, or already uses this number.
    pub(super) fn add(&mut self, number: u32, topic: u16) -> bool {
        let numbers = self.numbers.entry(topic).or_default();
        let is_new = numbers.len() < EACH && !self.topics.contains_key(&number);
        if is_new {
            numbers.push(number);
            self.topics.insert(number, topic);
        }
        is_new
    }

    /// Removes the subscriptions with these numbers.
    pub(super) fn remove(&mut self, numbers: &[u32]) {
        for number in numbers {
            let topic = self.topics.remove(number);
            if let Some(own) = topic.and_then(|topic| self.numbers.get_mut(&topic)) {
                own.retain(|other| other != number);
            }
        }
    }

    /// Removes all subscriptions.
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
