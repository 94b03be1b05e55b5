//! Outcomes as JUnit: a suite for each scenario, a case for each channel and check.
//! The file contains no times, so equal runs give equal bytes.

use std::io;

use quick_xml::Writer;
use quick_xml::events::{BytesDecl, BytesText, Event};

use super::outcomes::{Case, Entry, Outcomes};
use crate::plain::judged::grade;

/// The outcomes as XML.
#[must_use]
pub fn xml(outcomes: &Outcomes) -> String {
    let mut writer = Writer::new_with_indent(Vec::new(), b' ', 4);
    write(&mut writer, &outcomes.entries).expect("a text takes whatever is written to it");
    String::from_utf8(writer.into_inner()).expect("all that is written is text") + "\n"
}

fn write(writer: &mut Writer<Vec<u8>>, entries: &[Entry]) -> io::Result<()> {
    writer.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
    let [tests, failures, errors] = counts(entries);
    let head =
        [("name", "linkproof"), ("tests", &tests), ("skipped", "0"), ("failures", &failures), ("errors", &errors)];
    let all = writer.create_element("testsuites").with_attributes(head);
    all.write_inner_content(|writer| entries.iter().try_for_each(|entry| suite(writer, entry))).map(drop)
}

fn suite(writer: &mut Writer<Vec<u8>>, entry: &Entry) -> io::Result<()> {
    let [tests, failures, errors] = counts(std::slice::from_ref(entry));
    let name = allowed(&entry.name);
    let head = [("name", &*name), ("tests", &tests), ("skipped", "0"), ("errors", &errors), ("failures", &failures)];
    let suite = writer.create_element("testsuite").with_attributes(head);
    if tests == "0" {
        return suite.write_empty().map(drop);
    }
    let inside = suite.write_inner_content(|writer| {
        for own in &entry.cases {
            let flaw = flaw(own).map(|element| [element, own.verdict.word()]);
            case(writer, [&own.name, &format!("{}.{}", entry.name, own.by)], flaw, own.reason.as_deref())?;
        }
        let failed = |reason| case(writer, ["proof", &entry.name], Some(["error", "error"]), Some(reason));
        entry.error.as_deref().map_or(Ok(()), failed)
    });
    inside.map(drop)
}

/// The XML element that reports a case without agreement.
/// An open case is an error instead of a failure: nothing is wrong, but the verdict is missing.
fn flaw(case: &Case) -> Option<&'static str> {
    grade(&case.verdict).of([None, Some("error"), Some("failure")])
}

/// Writes a case with its name and class. A case without agreement has an XML element with a type and a reason.
fn case(
    writer: &mut Writer<Vec<u8>>,
    names: [&str; 2],
    flaw: Option<[&str; 2]>,
    reason: Option<&str>,
) -> io::Result<()> {
    let [name, class] = names.map(allowed);
    let reason = reason.map(allowed);
    let element = writer.create_element("testcase").with_attributes([("name", &*name), ("classname", &*class)]);
    let written = match (flaw, &reason) {
        (None, None) => element.write_empty(),
        (Some([of, word]), reason) => element.write_inner_content(|writer| {
            let why = [("message", reason.as_deref().unwrap_or_default()), ("type", word)];
            writer.create_element(of).with_attributes(why).write_empty().map(drop)
        }),
        (None, Some(told)) => element.write_inner_content(|writer| {
            writer.create_element("system-out").write_text_content(BytesText::new(told)).map(drop)
        }),
    };
    written.map(drop)
}

/// Numbers of cases, of failing cases, and of open cases, as text.
fn counts(entries: &[Entry]) -> [String; 3] {
    let cases = || entries.iter().flat_map(|entry| &entry.cases);
    let flawed = |element| cases().filter(|case| flaw(case) == Some(element)).count();
    let unproven = entries.iter().filter(|entry| entry.error.is_some()).count();
    [cases().count() + unproven, flawed("failure"), flawed("error") + unproven].map(|count| count.to_string())
}

/// A text without the characters that XML does not allow.
fn allowed(text: &str) -> String {
    text.chars().filter(|&letter| !letter.is_control() || letter == '\n' || letter == '\t').collect()
}
