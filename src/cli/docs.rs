//! `linkproof docs`: shows the documentation, which is embedded in the program.

use super::output;
use crate::sentences;
use linkage::error::{Error, ErrorKind, Result};
use scenario::words::suggestion;

#[derive(Debug, clap::Args)]
#[command(after_help = include_str!("help/docs.txt").trim_ascii_end())]
pub(super) struct Args {
    /// Page, or one section of a page; without this argument, the pages are listed
    #[arg(value_name = "PAGE[#SECTION]")]
    page: Option<String>,
}

macro_rules! pages {
    ($($name:literal)*) => {
        &[$(($name, include_str!(concat!("../../docs/", $name, ".md")))),*]
    };
}

/// Names and texts of the documentation pages.
static PAGES: &[(&str, &str)] = pages! {
    "authors" "bench" "clearance" "compare" "course" "draw" "engines" "exercise" "extending" "findings" "foreign"
    "formats" "formulas" "gallery" "golden" "graph" "guide" "import" "machines" "mjcf" "mutate" "notation"
    "numerics/bounds" "numerics/change_points" "numerics/diagnosis" "numerics/forces" "numerics/friction"
    "numerics/given" "numerics/laboratory" "numerics/settings" "numerics/twins" "peers" "plans" "python" "rapier"
    "recording" "report" "scale" "scenario" "sensitivity" "skip" "stories" "stress" "sweep" "synthesis" "teaching"
    "testing" "tutorial" "variants60" "verification"
};

pub(super) fn docs(args: &Args) -> Result<()> {
    let Some(asked) = &args.page else { return output::print(&list()) };
    let (name, section) = match asked.split_once('#') {
        Some((name, section)) => (name, Some(section)),
        None => (asked.as_str(), None),
    };
    let name = name.trim_start_matches("docs/").trim_end_matches(".md");
    let Some((_, text)) = PAGES.iter().find(|(own, _)| *own == name) else {
        let help = suggestion(name, PAGES.iter().map(|(own, _)| *own), "\"");
        return Err(Error::new(ErrorKind::Input, sentences::there_is_no_page(&name)).help(help));
    };
    match section {
        None => output::data(text),
        Some(anchor) => output::data(&part(text, anchor).ok_or_else(|| {
            Error::new(ErrorKind::Input, sentences::the_page_has_no_section(&name, &anchor)).help(suggestion(
                anchor,
                headings(text).map(|(_, _, own)| own).collect::<Vec<_>>().iter().map(String::as_str),
                "\"",
            ))
        })?),
    }
}

fn list() -> String {
    let width = PAGES.iter().map(|(name, _)| name.len()).max().unwrap_or_default();
    let title = |text: &str| text.lines().next().unwrap_or_default().trim_start_matches("# ").to_string();
    PAGES.iter().map(|(name, text)| format!("{name:width$}  {}\n", title(text))).collect()
}

/// Headings outside code blocks: position of their line, level, and anchor on web pages.
fn headings(text: &str) -> impl Iterator<Item = (usize, usize, String)> {
    let mut at = 0;
    let mut is_block = false;
    text.split_inclusive('\n').filter_map(move |line| {
        let begins = at;
        at += line.len();
        is_block ^= line.starts_with("```");
        let level = line.bytes().take_while(|byte| *byte == b'#').count();
        let anchor = || {
            let kept = |sign: &char| sign.is_alphanumeric() || matches!(sign, ' ' | '-' | '_');
            line[level..].trim().to_lowercase().chars().filter(kept).collect::<String>().replace(' ', "-")
        };
        (level > 0 && !is_block).then(|| (begins, level, anchor()))
    })
}

/// The section with this anchor, up to the next heading of the same or a higher level.
fn part(text: &str, anchor: &str) -> Option<String> {
    let mut all = headings(text);
    let (begins, level, _) = all.find(|(_, _, own)| own == anchor)?;
    let ends = all.find(|(_, other, _)| *other <= level).map_or(text.len(), |(at, _, _)| at);
    Some(text[begins..ends].into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_docs_page_is_included() {
        let pages = |folder: &str| {
            let files = std::fs::read_dir(std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("docs").join(folder));
            let name = |file: std::io::Result<std::fs::DirEntry>| file.unwrap().file_name().into_string().unwrap();
            let names =
                files.unwrap().map(name).filter_map(|name| Some(format!("{folder}{}", name.strip_suffix(".md")?)));
            names.collect::<Vec<String>>()
        };
        let mut names = [pages(""), pages("numerics/")].concat();
        names.sort();
        assert_eq!(PAGES.iter().map(|(name, _)| *name).collect::<Vec<_>>(), names);
    }

    #[test]
    fn a_section_ends_where_the_next_begins() {
        let page = "# A\n\na\n\n## B, *c*\nb\n```sh\n# no heading\n```\n### D\nd\n## E\ne\n";
        assert_eq!(part(page, "b-c").unwrap(), "## B, *c*\nb\n```sh\n# no heading\n```\n### D\nd\n");
        assert_eq!(part(page, "e").unwrap(), "## E\ne\n");
        assert!(part(page, "no-heading").is_none());
    }
}
