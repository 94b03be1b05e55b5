//! Outcomes as JUnit: a suite for each scenario, a case for each channel and check. No times, so that equal runs give
//! equal bytes.

use std::io;

use quick_xml::Writer;
use quick_xml::events::{BytesDecl, BytesText, Event};

use super::outcomes::{Case, Entry, Outcome, Outcomes};

/// What stands in the way of a case.
struct Flaw<'a> {
    element: &'static str,
    word: &'static str,
    reason: &'a str,
}

/// A case of a suite.
struct Row<'a> {
    name: &'a str,
    class: String,
    flaw: Option<Flaw<'a>>,
    told: Option<&'a str>,
}

impl<'a> Row<'a> {
    fn of(suite: &str, case: &'a Case) -> Self {
        let flaw = |element, word, reason| Some(Flaw { element, word, reason });
        let (flaw, told) = match &case.outcome {
            Outcome::Agrees => (None, None),
            Outcome::Expected(finding) => (None, Some(finding.as_str())),
            Outcome::Disagrees(reason) => (flaw("failure", "disagree", reason), None),
            // It stands in the way of a verdict, though nothing is wrong.
            Outcome::Open(reason) => (flaw("error", "inconclusive", reason), None),
        };
        Row { name: &case.name, class: format!("{suite}.{}", case.by), flaw, told }
    }
}

/// The outcomes as XML.
#[must_use]
pub fn xml(outcomes: &Outcomes) -> String {
    let suites: Vec<(String, Vec<Row>)> =
        outcomes.entries.iter().map(|entry| (entry.name.clone(), rows(entry))).collect();
    let mut writer = Writer::new_with_indent(Vec::new(), b' ', 4);
    write(&mut writer, &suites).expect("a text takes whatever is written to it");
    String::from_utf8(writer.into_inner()).expect("all that is written is text") + "\n"
}

fn rows(entry: &Entry) -> Vec<Row<'_>> {
    let error = entry.error.as_deref().map(|reason| Row {
        name: "proof",
        class: entry.name.clone(),
        flaw: Some(Flaw { element: "error", word: "error", reason }),
        told: None,
    });
    entry.cases.iter().map(|case| Row::of(&entry.name, case)).chain(error).collect()
}

fn write(writer: &mut Writer<Vec<u8>>, suites: &[(String, Vec<Row>)]) -> io::Result<()> {
    writer.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
    let all = suites.iter().flat_map(|(_, cases)| cases);
    let [tests, failures, errors] = counts(all);
    let head =
        [("name", "linkproof"), ("tests", &tests), ("skipped", "0"), ("failures", &failures), ("errors", &errors)];
    writer.create_element("testsuites").with_attributes(head).write_inner_content(|writer| {
        suites.iter().try_for_each(|(name, cases)| {
            let [tests, failures, errors] = counts(cases.iter());
            let name = allowed(name);
            let head =
                [("name", &*name), ("tests", &tests), ("skipped", "0"), ("errors", &errors), ("failures", &failures)];
            let suite = writer.create_element("testsuite").with_attributes(head);
            if cases.is_empty() {
                return suite.write_empty().map(drop);
            }
            suite.write_inner_content(|writer| cases.iter().try_for_each(|case| write_case(writer, case))).map(drop)
        })
    })?;
    Ok(())
}

fn write_case(writer: &mut Writer<Vec<u8>>, row: &Row) -> io::Result<()> {
    let (name, class) = (allowed(row.name), allowed(&row.class));
    let element = writer.create_element("testcase").with_attributes([("name", &*name), ("classname", &*class)]);
    let written = match (&row.flaw, row.told) {
        (None, None) => element.write_empty(),
        (Some(flaw), _) => element.write_inner_content(|writer| {
            let reason = allowed(flaw.reason);
            let why = [("message", &*reason), ("type", flaw.word)];
            writer.create_element(flaw.element).with_attributes(why).write_empty().map(drop)
        }),
        (None, Some(told)) => element.write_inner_content(|writer| {
            writer.create_element("system-out").write_text_content(BytesText::new(&allowed(told))).map(drop)
        }),
    };
    written.map(drop)
}

/// How many cases there are, how many fail, and how many are open, as text.
fn counts<'a>(rows: impl Iterator<Item = &'a Row<'a>> + Clone) -> [String; 3] {
    let flawed =
        |element| rows.clone().filter(|row| row.flaw.as_ref().is_some_and(|flaw| flaw.element == element)).count();
    [rows.clone().count(), flawed("failure"), flawed("error")].map(|count| count.to_string())
}

/// A text without the letters that XML has no place for.
fn allowed(text: &str) -> String {
    text.chars().filter(|&letter| !letter.is_control() || letter == '\n' || letter == '\t').collect()
}
