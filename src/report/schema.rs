//! The format of scenario files as a JSON Schema, for text editors that support TOML.

use crate::sentences;
use serde_json::{Map, Value, json};

use super::pretty::pretty;
use scenario::keys::{FileKey, ValueKind, section};

/// The schema (draft 7), with a line feed at its end.
#[must_use]
pub fn scenario() -> String {
    let mut schema = object("");
    let head = schema.as_object_mut().expect("a section is an object");
    head.insert("$schema".into(), json!("http://json-schema.org/draft-07/schema#"));
    head.insert("title".into(), json!(sentences::SCENARIO_OF_LINKPROOF));
    pretty(&schema)
}

/// The JSON object for a section; `path` names the section in the table of sections.
fn object(path: &str) -> Value {
    let keys = section(path).map_or(&[][..], |section| section.keys);
    let mut properties = Map::new();
    let (mut required, mut choices) = (Vec::new(), Vec::new());
    for key in keys {
        let spellings = key.all_spellings();
        for spelling in &spellings {
            properties.insert(spelling.clone(), of_key(key, path));
        }
        match (key.is_needed, spellings.as_slice()) {
            (false, _) => {}
            (true, [only]) => required.push(json!(only)),
            (true, several) => {
                let one = |spelling: &String| json!({ "required": [spelling] });
                choices.push(json!({ "oneOf": several.iter().map(one).collect::<Vec<_>>() }));
            }
        }
    }
    let mut object = json!({ "type": "object", "additionalProperties": false, "properties": properties });
    for (name, list) in [("required", required), ("allOf", choices)] {
        if !list.is_empty() {
            object[name] = json!(list);
        }
    }
    object
}

fn of_key(key: &FileKey, path: &str) -> Value {
    let child = if path.is_empty() { key.name.to_string() } else { format!("{path}.{}", key.name) };
    // Any number may be an arithmetic expression of parameters, so a string is allowed as well.
    let number = || json!({ "type": ["number", "string"] });
    let list = |items: Value| json!({ "type": "array", "items": items });
    let mut value = match key.kind {
        ValueKind::Text => json!({ "type": "string" }),
        ValueKind::Choice(words) => json!({ "enum": words() }),
        ValueKind::Texts => list(json!({ "type": "string" })),
        ValueKind::Number | ValueKind::Quantity(..) => number(),
        ValueKind::Numbers | ValueKind::Quantities(_) => list(number()),
        ValueKind::Integer => json!({ "type": "integer" }),
        ValueKind::IntegerOrBoolean => json!({ "type": ["integer", "boolean"] }),
        ValueKind::Table => table(&child),
        ValueKind::Tables => list(table(&child)),
        ValueKind::TableOrTables => json!({ "anyOf": [table(&child), list(table(&child))] }),
    };
    value["description"] = json!(key.meaning);
    value
}

/// The schema of a section. There are three kinds of sections: with fixed keys, with user-chosen names of subsections,
/// and with user-chosen names of numbers.
fn table(path: &str) -> Value {
    let named = format!("{path}.*");
    match (section(path), section(&named)) {
        (Some(_), _) => object(path),
        (None, Some(_)) => json!({ "type": "object", "additionalProperties": object(&named) }),
        (None, None) => json!({ "type": "object", "additionalProperties": { "type": ["number", "string"] } }),
    }
}
