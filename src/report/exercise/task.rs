//! The task sheet of a student.

use super::super::class_words as words;
use super::super::html::escaped;
use super::given::given;
use super::{ClassKey, NamedSheet, page, position, table};
use scenario::Scenario;
use std::fmt::Write;

/// The task sheet as a page: drawing, given numbers, quantities, and a table for the answers.
/// If the scenario's start pose is nearly singular and the sheet uses another pose instead, `start` is the input of the
/// scenario's start pose, in the printed unit.
pub(crate) fn task(own: &NamedSheet, scenario: &Scenario, picture: &str, key: &ClassKey, start: Option<f64>) -> String {
    let (language, sheet) = (key.language(), &own.sheet);
    let title = words::task_of(language, &own.name);
    let file = format!("answers/{}.csv", own.name);
    // The XML declaration of a drawing is not allowed inside a page.
    let picture = picture.find("<svg").map_or("", |start| &picture[start..]);
    let mut body =
        format!("<h1>{}</h1>\n<p>{} ______________________</p>\n", escaped(&title), words::student_and_group(language));
    let _ = writeln!(body, "<p>{}</p>", escaped(&scenario.title));
    let _ = writeln!(
        body,
        "<section>{picture}\n<p class=\"small\">{}</p></section>",
        words::the_mechanism_at(language, &position(sheet, 0))
    );
    let _ = writeln!(body, "<h2>{}</h2>\n{}", words::given(language), given(scenario, sheet, language));
    let unit = sheet.case.crank().input.shown_in().0;
    let asked = words::at_the_positions(language, &words::unit(language, unit));
    let _ = writeln!(body, "<h2>{}</h2>\n<p>{asked}</p>", words::asked(language));
    if let Some(start) = start {
        let _ = writeln!(
            body,
            "<p>{}</p>",
            words::the_given_pose_is_near_singular(language, &((start * 1e6).round() / 1e6))
        );
    }
    let _ =
        writeln!(body, "<h2>{}</h2>\n<p>{}</p>", words::answers(language), escaped(&words::fill_in(language, &file)));
    let _ =
        writeln!(body, "{}<p class=\"small\">{}</p>", table(sheet, language, false), escaped(&key.criterion_text()));
    page(language, &title, &body)
}
