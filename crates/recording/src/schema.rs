//! Linkproof's messages: flat protobuf, one number per field, generated from the table of channels.
//!
//! Every field has presence (proto3 `optional`).
//! A channel that was not computed is not declared, because some viewers show an absent field as zero.

use super::sink::MessageKind;
use linkage::input::Input;
use linkage::trajectory::{CHANNELS, ChannelKind, ChannelSubject, Unit};
use prost::Message;
use prost::encoding::{WireType, decode_key, double, encode_key, float, skip_field};
use prost_types::field_descriptor_proto::{Label, Type};
use prost_types::{
    DescriptorProto, FieldDescriptorProto, FileDescriptorProto, FileDescriptorSet, OneofDescriptorProto,
};
use std::collections::hash_map::Entry;
use std::collections::{BTreeMap, HashMap};

/// Fields of the grid message: time (s), input (in its SI unit), and row number in the solver's order.
pub const fn grid_fields(input: Input) -> [&'static str; 3] {
    ["t_s", input.key(), "row"]
}

/// Content of the messages of a subject.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MessageContent {
    /// Values in SI units.
    Values,
    /// Errors in small units such as um. Single precision is enough for errors, because people read only three of
    /// their digits.
    Errors,
}

/// The grid message.
pub fn grid(input: Input) -> MessageKind {
    message("Grid", (1..).zip(grid_fields(input).map(str::to_string)), Type::Double)
}

/// Number of a channel's field in the message of its subject.
/// All channels of joints have different numbers, including the channels of sliding joints and of friction.
pub fn tag(kind: &ChannelKind) -> u32 {
    let is_beside = |own: &&ChannelKind| own.subject == kind.subject || is_of_joint(own) && is_of_joint(kind);
    let place = CHANNELS.iter().filter(is_beside).position(|own| own.suffix == kind.suffix);
    place.expect("every kind is a row of the table") as u32 + 1
}

fn is_of_joint(kind: &ChannelKind) -> bool {
    kind.subject.word() == ChannelSubject::Joint.word()
}

/// Name of a channel's error with its small unit (such as um), and the number of small units in the SI unit.
pub fn small_unit(kind: &ChannelKind) -> (String, f64) {
    let (prefix, factor) = match kind.unit {
        Unit::Radian | Unit::RadianPerSecond | Unit::RadianPerSecondSquared => ("u", 1e6),
        Unit::Metre | Unit::MetrePerSecond | Unit::MetrePerSecondSquared => ("u", 1e6),
        Unit::Newton | Unit::NewtonMetre => ("m", 1e3),
    };
    let unit = kind.unit.suffix();
    let stem = kind.suffix.strip_suffix(unit).unwrap_or(kind.suffix);
    (format!("{stem}{prefix}{unit}"), factor)
}

/// Appends a field in double precision, even if its value is zero.
pub fn put(buffer: &mut Vec<u8>, tag: u32, value: f64) {
    double::encode(tag, &value, buffer);
}

/// Appends a field in single precision, even if its value is zero.
pub fn put_small(buffer: &mut Vec<u8>, tag: u32, value: f32) {
    encode_key(tag, WireType::ThirtyTwoBit, buffer);
    buffer.extend(value.to_le_bytes());
}

/// The numbers in a message, in double or single precision, in the order of the bytes. Other fields are skipped.
pub fn numbers(mut data: &[u8]) -> Result<Vec<(u32, f64)>, prost::DecodeError> {
    let mut fields = Vec::new();
    while !data.is_empty() {
        let (tag, wire) = decode_key(&mut data)?;
        if wire == WireType::SixtyFourBit {
            let mut value = 0.0;
            double::merge(wire, &mut value, &mut data, Default::default())?;
            fields.push((tag, value));
        } else if wire == WireType::ThirtyTwoBit {
            let mut value = 0.0;
            float::merge(wire, &mut value, &mut data, Default::default())?;
            fields.push((tag, f64::from(value)));
        } else {
            skip_field(wire, tag, &mut data, Default::default())?;
        }
    }
    Ok(fields)
}

/// Upper limit of the length of a message description that is parsed (bytes).
/// The limit is hundreds of times the length of linkproof's descriptions.
/// The limit is needed because the parts of a description in memory take up to a hundred times their size in the file.
const LONGEST: usize = 1 << 20;

/// Names of the numeric fields of schemas. Each schema is parsed once.
#[derive(Default)]
pub struct Names(HashMap<u16, BTreeMap<u32, String>>);

impl Names {
    /// Names of the numeric fields of a schema, by field number.
    pub fn of(&mut self, schema: &mcap::Schema) -> Result<&BTreeMap<u32, String>, prost::DecodeError> {
        match self.0.entry(schema.id) {
            Entry::Occupied(known) => Ok(known.into_mut()),
            Entry::Vacant(new) => {
                let data = if schema.data.len() > LONGEST { &[][..] } else { &schema.data };
                Ok(new.insert(field_names(data, &schema.name)?))
            }
        }
    }
}

/// Names of the numeric fields of the message called `full_name` in a serialised descriptor set, by field number.
pub fn field_names(descriptor: &[u8], full_name: &str) -> Result<BTreeMap<u32, String>, prost::DecodeError> {
    let set = FileDescriptorSet::decode(descriptor)?;
    let full = |package: &str, name: &str| if package.is_empty() { name.into() } else { format!("{package}.{name}") };
    let messages = set.file.iter().flat_map(|file| file.message_type.iter().map(|own| (file.package(), own)));
    let fields =
        messages.filter(|(package, own)| full(package, own.name()) == full_name).flat_map(|(_, own)| &own.field);
    let numbers = fields.filter(|field| matches!(field.r#type(), Type::Double | Type::Float));
    Ok(numbers.map(|field| (field.number() as u32, field.name().to_string())).collect())
}

/// Channels in the message of a subject, except the channels of friction.
/// The message of a sliding joint has the channels of any joint, and additional channels.
fn kinds(subject: ChannelSubject) -> impl Iterator<Item = &'static ChannelKind> {
    let joint = subject == ChannelSubject::Slider;
    CHANNELS.iter().filter(move |kind| kind.subject == subject || joint && kind.subject == ChannelSubject::Joint)
}

/// Message type of a subject with the channels `own`.
/// The name of the type is that of the subject, with the prefix `Rubbing` for a joint with friction.
/// If channels are missing, the name also contains the numbers of the present fields, because viewers confuse types
/// with the same name but different fields.
pub fn of_subject(subject: ChannelSubject, told: MessageContent, own: &[&ChannelKind]) -> MessageKind {
    let word = if subject == ChannelSubject::Slider {
        "slider"
    } else if matches!(subject, ChannelSubject::Thrust | ChannelSubject::FurtherThrust) {
        "driveThrust"
    } else {
        subject.word()
    };
    let (suffix, number) = match told {
        MessageContent::Values => ("", Type::Double),
        MessageContent::Errors => ("Error", Type::Float),
    };
    let field = |kind: &ChannelKind| match told {
        MessageContent::Values => kind.suffix.to_string(),
        MessageContent::Errors => small_unit(kind).0,
    };
    let rubs = own.iter().any(|kind| matches!(kind.subject, ChannelSubject::Journal | ChannelSubject::Guide));
    let mut name = if rubs { String::from("Rubbing") } else { String::new() };
    name += &(word[..1].to_uppercase() + &word[1..] + suffix);
    let fields: BTreeMap<u32, String> = own.iter().map(|kind| (tag(kind), field(kind))).collect();
    if fields.len() < kinds(subject).count() + usize::from(rubs) {
        name.extend(fields.keys().map(|tag| format!("_{tag}")));
    }
    message(&name, fields.into_iter(), number)
}

/// A message type with these fields, each given by number and name.
fn message(name: &str, fields: impl Iterator<Item = (u32, String)>, kind: Type) -> MessageKind {
    let field: Vec<FieldDescriptorProto> = fields
        .enumerate()
        .map(|(index, (tag, field))| FieldDescriptorProto {
            json_name: Some(field.clone()),
            name: Some(field),
            number: Some(tag as i32),
            label: Some(Label::Optional as i32),
            r#type: Some(kind as i32),
            oneof_index: Some(index as i32),
            proto3_optional: Some(true),
            ..Default::default()
        })
        .collect();
    // In proto3, presence is declared as a oneof with a single field, as protoc does.
    let oneof_decl =
        field.iter().map(|f| OneofDescriptorProto { name: Some(format!("_{}", f.name())), options: None }).collect();
    let message = DescriptorProto { name: Some(name.into()), field, oneof_decl, ..Default::default() };
    let file = FileDescriptorProto {
        name: Some(format!("linkproof/{name}.proto")),
        package: Some("linkproof".into()),
        message_type: vec![message],
        syntax: Some("proto3".into()),
        ..Default::default()
    };
    MessageKind::protobuf(format!("linkproof.{name}"), FileDescriptorSet { file: vec![file] }.encode_to_vec())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_channel_has_a_field_with_its_name() {
        for kind in &CHANNELS {
            let all: Vec<&ChannelKind> = kinds(kind.subject).collect();
            let kind_of_all = of_subject(kind.subject, MessageContent::Values, &all);
            let names = field_names(&kind_of_all.data, &kind_of_all.schema).unwrap();
            assert_eq!(names[&tag(kind)], kind.suffix);
        }
    }

    /// Only present channels are declared, and message names are unique.
    /// If absent channels were declared, viewers would show missing values as zero.
    /// If names were not unique, viewers would confuse messages of the same name.
    #[test]
    fn only_recorded_channels_are_declared() {
        let some: Vec<&ChannelKind> = kinds(ChannelSubject::Slider).filter(|kind| kind.unit == Unit::Metre).collect();
        for own in
            [MessageContent::Values, MessageContent::Errors].map(|told| of_subject(ChannelSubject::Slider, told, &some))
        {
            let names = field_names(&own.data, &own.schema).unwrap();
            assert_eq!(
                names.keys().copied().collect::<Vec<_>>(),
                some.iter().map(|kind| tag(kind)).collect::<Vec<_>>()
            );
            assert!(own.schema.contains(&format!("_{}", tag(some[0]))), "{}", own.schema);
        }
    }

    #[test]
    fn zeros_of_both_signs_are_written() {
        let mut buffer = Vec::new();
        put(&mut buffer, 1, 0.0);
        put_small(&mut buffer, 2, 1.0);
        put(&mut buffer, 17, -0.0);
        let read = numbers(&buffer).unwrap();
        assert_eq!(
            read.iter().map(|&(tag, v)| (tag, v.to_bits())).collect::<Vec<_>>(),
            [(1, 0), (2, 1f64.to_bits()), (17, 1 << 63)]
        );
    }

    #[test]
    fn errors_are_named_by_their_small_unit() {
        let name = |suffix: &str| small_unit(CHANNELS.iter().find(|kind| kind.suffix == suffix).unwrap());
        assert_eq!(name("angle_rad"), ("angle_urad".into(), 1e6));
        assert_eq!(name("ax_m_s2"), ("ax_um_s2".into(), 1e6));
        assert_eq!(name("fx_N"), ("fx_mN".into(), 1e3));
        assert_eq!(name("torque_N_m"), ("torque_mN_m".into(), 1e3));
    }
}
