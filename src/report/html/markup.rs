//! Text and numbers in the form used on a page.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};

/// Text for a page or other XML, valid between tags and in attributes.
pub(in crate::report) fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            // HTML does not allow the control characters of this pattern, not even as entities, so they are replaced.
            '\0'..='\u{8}' | '\u{b}' | '\u{c}' | '\u{e}'..='\u{1f}' => out.push('\u{fffd}'),
            _ => out.push(letter),
        }
    }
    out
}

/// JSON for a script element. `<` is escaped, so no text in the JSON can end the element.
pub(super) fn contained(json: &str) -> String {
    json.replace('<', "\\u003c")
}

/// A template with its `{{slots}}` filled.
/// The inserted text is not searched for slots.
pub(in crate::report) fn filled(template: &str, slots: &[(&str, &str)]) -> String {
    let mut parts = template.split("{{");
    let mut out = parts.next().unwrap_or_default().to_string();
    for part in parts {
        let (name, rest) = part.split_once("}}").unwrap_or((part, ""));
        out.push_str(slots.iter().find(|(own, _)| *own == name).expect("the page has all its slots").1);
        out.push_str(rest);
    }
    out
}

/// Numbers as doubles, little-endian, in base64.
pub(super) fn doubles(values: impl Iterator<Item = f64>) -> String {
    STANDARD.encode(values.flat_map(f64::to_le_bytes).collect::<Vec<u8>>())
}

/// Numbers in single precision, little-endian, in base64.
pub(super) fn singles(values: impl Iterator<Item = f64>) -> String {
    STANDARD.encode(values.flat_map(|value| (value as f32).to_le_bytes()).collect::<Vec<u8>>())
}

/// A column of numbers in single precision; a single number if all are equal.
pub(super) fn column(mut values: impl Iterator<Item = f64> + Clone) -> Value {
    let all = values.clone();
    match values.next() {
        Some(first) if values.all(|value| value == first) => json!(first),
        _ => singles(all).into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inserted_text_is_escaped() {
        let name = "</script><b a=\"1\" b='2'>&\u{1}{{x}}";
        assert_eq!(
            filled("<i>{{x}}</i>{{y}}", &[("x", &escaped(name)), ("y", "")]),
            "<i>&lt;/script&gt;&lt;b a=&quot;1&quot; b=&#39;2&#39;&gt;&amp;\u{fffd}{{x}}</i>"
        );
        assert_eq!(contained("\"</script>\""), "\"\\u003c/script>\"");
    }

    #[test]
    fn numbers_are_little_endian() {
        assert_eq!([doubles([1.0].into_iter()), singles([1.0].into_iter())], ["AAAAAAAA8D8=", "AACAPw=="]);
    }
}
