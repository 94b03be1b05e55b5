//! HTML for notebooks. All text in the HTML is escaped.

use linkproof::Verdict;

/// The text, escaped for HTML.
pub(crate) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// A number with four decimals, or with four digits and an exponent.
pub(crate) fn number(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 || (1e-3..1e5).contains(&size) { format!("{value:.4}") } else { format!("{value:.3e}") }
}

/// A paragraph.
pub(crate) fn paragraph(text: &str) -> String {
    format!("<p>{}</p>", escaped(text))
}

/// A preformatted text.
pub(crate) fn report(text: &str) -> String {
    format!("<pre style=\"line-height:1.25\">{}</pre>", escaped(text))
}

/// A table with a header.
pub(crate) fn table(names: &[&str], rows: impl Iterator<Item = Vec<String>>) -> String {
    let line = |cells: Vec<String>| format!("<tr>{}</tr>", cells.concat());
    let head = line(names.iter().map(|name| format!("<th>{}</th>", escaped(name))).collect());
    let cell = |text: &String| format!("<td>{}</td>", escaped(text));
    let body: String = rows.map(|row| line(row.iter().map(cell).collect())).collect();
    format!("<table><thead>{head}</thead><tbody>{body}</tbody></table>")
}

/// A verdict on a coloured background, followed by its subject.
pub(crate) fn verdict(verdict: &Verdict, of: &str) -> String {
    let colour = match verdict {
        Verdict::Agree { .. } | Verdict::Expected { .. } => "#1a7f37",
        Verdict::Disagree { .. } => "#cf222e",
        Verdict::Inconclusive { .. } => "#9a6700",
    };
    let word = verdict.word().to_uppercase();
    let style = format!("background:{colour};color:#fff;padding:2px 8px;border-radius:4px;font-weight:bold");
    format!("<p><span style=\"{style}\">{word}</span> {}</p>", escaped(of))
}
