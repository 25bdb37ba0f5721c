//! The geometric means of the ratios as bars, a panel for each set of rays; those of the rates if
//! there was no Embree to compare with.

use super::Report;
use crate::error::BenchError;
use resvg::{tiny_skia, usvg};
use std::path::Path;
use svg::node::element::{Line, Rectangle, SVG, Text, Title};

const PANEL: f64 = 480.0;
const LABELS: f64 = 190.0;
const BAR: f64 = 18.0;
const HEAD: f64 = 84.0;
const INK: &str = "#1a1a1a";
const GREY: &str = "#767676";

/// kdray's bars, and the others': colours that all eyes tell apart (Okabe and Ito 2008).
const OURS: &str = "#0072b2";
const OTHERS: &str = "#e69f00";

/// Pixels of a PNG for each of the drawing.
const SCALE: f32 = 1.5;

/// Whether a file of that name can be drawn.
pub(super) fn is_drawable(path: &Path) -> bool {
    matches!(ending(path).as_deref(), Some("svg" | "png"))
}

fn ending(path: &Path) -> Option<String> {
    Some(path.extension()?.to_string_lossy().to_ascii_lowercase())
}

/// The drawing as the content of a file of that name.
pub(super) fn picture(report: &Report, path: &Path) -> Result<Vec<u8>, BenchError> {
    let svg = format!("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n{}\n", draw(report));
    match ending(path).as_deref() {
        Some("png") => {
            rasterise(&svg).map_err(|error| BenchError::io(path, std::io::Error::other(error)))
        }
        _ => Ok(svg.into_bytes()),
    }
}

/// The SVG as a PNG, its text in the embedded font whatever the machine has.
fn rasterise(svg: &str) -> Result<Vec<u8>, String> {
    let mut options = usvg::Options { font_family: "DejaVu Sans".into(), ..Default::default() };
    options.fontdb_mut().load_font_data(dejavu::sans::regular().to_vec());
    let tree = usvg::Tree::from_str(svg, &options).map_err(|error| error.to_string())?;
    let [width, height] = [tree.size().width(), tree.size().height()].map(|side| side * SCALE);
    let mut pixels = tiny_skia::Pixmap::new(width.ceil() as u32, height.ceil() as u32)
        .ok_or_else(|| format!("a picture of {width} x {height} pixels cannot be drawn"))?;
    let scale = tiny_skia::Transform::from_scale(SCALE, SCALE);
    resvg::render(&tree, scale, &mut pixels.as_mut());
    pixels.encode_png().map_err(|error| error.to_string())
}

/// A panel's bars: contender and mean.
type Bars<'a> = Vec<(&'a str, f64)>;

fn draw(report: &Report) -> SVG {
    let title = match report.has_ratios() {
        true => "Rays a second, one thread; Embree MEDIUM, single = 1",
        false => "Million rays a second, one thread",
    };
    let sets = report.sets();
    let bars = |set: &str| -> Bars<'_> {
        let means = |name| Some((name, report.mean(set, name)?));
        report.contenders().into_iter().filter_map(means).collect()
    };
    let panels: Vec<(&str, Bars<'_>)> = sets.into_iter().map(|set| (set, bars(set))).collect();
    let tallest = panels.iter().map(|(_, bars)| bars.len()).max().unwrap_or(0);
    let panel_height = tallest as f64 * BAR + 64.0;
    let (width, rows) = (2.0 * PANEL + 24.0, panels.len().div_ceil(2));
    let height = HEAD + rows as f64 * panel_height;
    let mut svg = SVG::new()
        .set("viewBox", (0, 0, width, height))
        .set("width", width)
        .set("height", height)
        .set("font-family", "DejaVu Sans, Verdana, Arial, sans-serif")
        .add(Title::new(title))
        .add(rectangle([0.0, 0.0], [width, height], "#ffffff"));
    let scenes: Vec<&str> = report.scenes.iter().map(|(name, _)| name.as_str()).collect();
    let machine = &report.machine;
    svg = svg
        .add(text([16.0, 26.0], "start", 17.0, title))
        .add(text([16.0, 46.0], "start", 11.0, &format!("{}, {}", machine.cpu, machine.date)))
        .add(text(
            [16.0, 62.0],
            "start",
            11.0,
            &format!("geometric means over {}", scenes.join(", ")),
        ));
    for (index, content) in panels.iter().enumerate() {
        let at = [16.0 + (index % 2) as f64 * PANEL, HEAD + (index / 2) as f64 * panel_height];
        svg = panel(svg, at, content, report.has_ratios());
    }
    svg
}

/// A headline, a bar for each contender, and for ratios a line at one, where Embree is.
fn panel(mut svg: SVG, [x, y]: [f64; 2], (set, bars): &(&str, Bars<'_>), has_ratios: bool) -> SVG {
    let largest = bars.iter().map(|(_, value)| *value).fold(1.0, f64::max);
    let scale = (PANEL - LABELS - 64.0) / largest;
    let (left, top) = (x + LABELS, y + 26.0);
    let (one, bottom) = (left + scale, top + bars.len() as f64 * BAR + 2.0);
    let line = Line::new().set("x1", one).set("x2", one).set("y1", top - 2.0).set("y2", bottom);
    let line = line.set("stroke", GREY).set("stroke-dasharray", "3 2");
    svg = svg.add(text([x, y + 14.0], "start", 14.0, set));
    if has_ratios {
        svg = svg.add(line);
    }
    for (index, (name, value)) in bars.iter().enumerate() {
        let y = top + index as f64 * BAR;
        let color = if name.starts_with("kdray") { OURS } else { OTHERS };
        let bar = rectangle([left, y + 2.0], [value * scale, BAR - 4.0], color);
        svg = svg
            .add(text([left - 6.0, y + 13.0], "end", 11.5, name))
            .add(bar.set("class", "bar"))
            .add(on_line([left + value * scale + 5.0, y + 13.0], &format!("{value:.2}")));
    }
    svg
}

fn rectangle([x, y]: [f64; 2], [width, height]: [f64; 2], color: &str) -> Rectangle {
    let place = Rectangle::new().set("x", x).set("y", y);
    place.set("width", width).set("height", height).set("fill", color)
}

fn text([x, y]: [f64; 2], anchor: &str, size: f64, content: &str) -> Text {
    let place = Text::new(content).set("x", x).set("y", y).set("fill", INK);
    place.set("text-anchor", anchor).set("font-size", size)
}

/// A value that stays readable on the line, by a white seam around its digits.
fn on_line(at: [f64; 2], content: &str) -> Text {
    let seam = text(at, "start", 11.0, content).set("stroke", "#ffffff").set("stroke-width", 3);
    seam.set("paint-order", "stroke")
}

#[cfg(test)]
mod tests {
    use super::super::tests::report;
    use super::*;

    #[test]
    fn every_contender_has_a_bar_in_every_set() {
        let svg = String::from_utf8(picture(&report(), Path::new("x.svg")).unwrap()).unwrap();
        assert_eq!(svg.matches("class=\"bar\"").count(), 2);
        assert!(svg.contains("b &amp; c") && svg.contains("primary"), "{svg}");
    }

    #[test]
    fn a_png_shows_text_without_fonts() {
        let png = picture(&report(), Path::new("x.PNG")).unwrap();
        let pixels = tiny_skia::Pixmap::decode_png(&png).unwrap();
        let dark = pixels.pixels().iter().filter(|pixel| pixel.red() < 128).count();
        assert!(dark > 500, "{dark} dark pixels");
    }
}
