//! What the commands print and draw, read back.

use super::Folder;
use resvg::usvg::roxmltree::{Document, Node};
use serde_json::Value;
use std::{fs, path::Path};

pub(crate) fn json(folder: &Folder, arguments: &[&str]) -> Value {
    let ran = folder.kdray(&[arguments, &["--json"]].concat()).succeeds();
    serde_json::from_str(&ran.stdout).expect("JSON")
}

pub(crate) fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

/// How many elements of a well-formed SVG have this class.
pub(crate) fn count_class(path: &Path, class: &str) -> usize {
    let text = fs::read_to_string(path).expect("the picture");
    let document = Document::parse(&text).expect("well-formed XML");
    assert_eq!(document.root_element().tag_name().name(), "svg");
    document
        .descendants()
        .filter(|node: &Node<'_, '_>| node.attribute("class") == Some(class))
        .count()
}

pub(crate) fn png_size(path: &Path) -> (u32, u32) {
    image::ImageReader::open(path).expect("the picture").into_dimensions().expect("a PNG")
}
