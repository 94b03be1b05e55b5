//! The page of `linkproof watch`: the text of the file beside the page of its proof.

use super::html::{escaped, filled};

const TEMPLATE: &str = include_str!("watch/watch.html");
const STYLE: &str = include_str!("watch/watch.css");
/// The script of the page.
pub(crate) const SCRIPT: &str = include_str!("watch/watch.js");

/// The page around the frames. It has no data; its script asks for them.
pub(crate) fn shell(file: &str) -> String {
    filled(TEMPLATE, &[("file", &escaped(file)), ("style", STYLE), ("version", env!("CARGO_PKG_VERSION"))])
}

/// A page with a still picture, for a mechanism with mistakes.
pub(crate) fn picture_page(svg: &str) -> String {
    let svg = svg.find("<svg").map_or(svg, |start| &svg[start..]);
    format!(
        "<!doctype html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\"><title>draft</title>\n\
         <style>body {{ margin: 0; background: #fff; }} svg {{ width: 100%; height: auto; }}</style></head>\n\
         <body>\n{svg}\n</body>\n</html>\n"
    )
}
