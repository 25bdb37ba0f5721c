//! A sheet to draw on: the few marks that our pictures are made of.

use super::palette;
use svg::node::element::{Element, Group, Line, Path, Rectangle, SVG, Text, Title};

/// A point or a size in pixels; y grows downwards.
pub(crate) type Point = [f64; 2];

/// A sheet of `width` x `height` pixels.
pub(crate) struct Canvas {
    document: SVG,
    width: f64,
    height: f64,
}

/// How a line is drawn.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stroke<'a> {
    /// Its colour.
    pub(crate) color: &'a str,
    /// Its width in pixels.
    pub(crate) width: f64,
    /// Opacity, from 0 to 1.
    pub(crate) opacity: f64,
    /// Dashes and gaps in pixels.
    pub(crate) dash: Option<&'a str>,
}

/// Which end of a text stands at its point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Anchor {
    Start,
    Middle,
    End,
}

impl<'a> Stroke<'a> {
    /// A solid line.
    pub(crate) fn new(color: &'a str, width: f64) -> Self {
        Self { color, width, opacity: 1.0, dash: None }
    }

    /// The same, dashed.
    pub(crate) fn dashed(self, dash: &'a str) -> Self {
        Self { dash: Some(dash), ..self }
    }

    /// The same, translucent.
    pub(crate) fn faint(self, opacity: f64) -> Self {
        Self { opacity, ..self }
    }

    fn apply(self, mut element: Element) -> Element {
        let attributes = element.get_attributes_mut();
        attributes.insert("stroke".into(), self.color.into());
        attributes.insert("stroke-width".into(), self.width.into());
        if self.opacity < 1.0 {
            attributes.insert("stroke-opacity".into(), self.opacity.into());
        }
        if let Some(dash) = self.dash {
            attributes.insert("stroke-dasharray".into(), dash.into());
        }
        element
    }
}

impl Canvas {
    /// A white sheet with a title for screen readers.
    pub(crate) fn new(width: f64, height: f64, title: &str) -> Self {
        let document = SVG::new()
            .set("viewBox", (0, 0, width, height))
            .set("width", width)
            .set("height", height)
            .set("font-family", "DejaVu Sans, Verdana, Arial, sans-serif")
            .add(Title::new(title));
        let mut canvas = Self { document, width, height };
        canvas.add(rectangle([0.0, 0.0], [width, height]).set("fill", palette::WHITE));
        canvas
    }

    /// Its size in pixels.
    pub(crate) fn size(&self) -> Point {
        [self.width, self.height]
    }

    /// Puts something on top of all that is there.
    pub(crate) fn add(&mut self, element: impl Into<Element>) {
        self.document.get_children_mut().push(Box::new(element.into()));
    }

    /// Writes `text` with its baseline at `at`, `size` pixels high.
    pub(crate) fn text(&mut self, at: Point, anchor: Anchor, size: f64, text: &str) {
        self.add(label(at, anchor, size, text));
    }

    /// The whole sheet as an SVG file.
    pub(crate) fn into_svg(self) -> String {
        format!("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n{}\n", self.document)
    }
}

/// A text with its baseline at `at`.
pub(crate) fn label(at: Point, anchor: Anchor, size: f64, text: &str) -> Text {
    let anchor = match anchor {
        Anchor::Start => "start",
        Anchor::Middle => "middle",
        Anchor::End => "end",
    };
    let element = Text::new(text).set("x", short(at[0])).set("y", short(at[1]));
    element.set("font-size", size).set("text-anchor", anchor).set("fill", palette::BLACK)
}

/// A text that stays readable on top of lines, by a white seam around the letters.
pub(crate) fn label_on_lines(at: Point, anchor: Anchor, size: f64, text: &str) -> Text {
    let seam = label(at, anchor, size, text).set("stroke", palette::WHITE);
    seam.set("stroke-width", 3.5).set("stroke-linejoin", "round").set("paint-order", "stroke")
}

/// How wide a text is at most.
pub(crate) fn text_width(size: f64, text: &str) -> f64 {
    // Letters and digits of the embedded font are 0.5 to 0.55 of its size wide on average.
    0.56 * size * text.chars().count() as f64
}

/// A rectangle from its upper left corner.
pub(crate) fn rectangle(at: Point, size: Point) -> Rectangle {
    let corner = Rectangle::new().set("x", short(at[0])).set("y", short(at[1]));
    corner.set("width", short(size[0])).set("height", short(size[1]))
}

/// A straight line.
pub(crate) fn line(from: Point, to: Point, stroke: Stroke<'_>) -> Element {
    let ends = Line::new().set("x1", short(from[0])).set("y1", short(from[1]));
    stroke.apply(ends.set("x2", short(to[0])).set("y2", short(to[1])).into())
}

/// Many straight lines of one kind.
pub(crate) fn lines(ends: impl IntoIterator<Item = [Point; 2]>, stroke: Stroke<'_>) -> Element {
    let mut data = String::new();
    for [[x0, y0], [x1, y1]] in ends {
        data += &format!("M{} {}L{} {}", short(x0), short(y0), short(x1), short(y1));
    }
    stroke.apply(Path::new().set("d", data).set("fill", "none").into())
}

/// A part of the sheet that cuts off what is drawn beyond it. Coordinates remain those of the
/// sheet.
pub(crate) fn window(at: Point, size: Point, content: Group) -> SVG {
    let [x, y] = at;
    let [width, height] = size;
    let place = SVG::new().set("x", x).set("y", y).set("width", width).set("height", height);
    place.set("viewBox", (x, y, width, height)).set("overflow", "hidden").add(content)
}

/// A hundredth of a pixel is enough, and keeps files small.
fn short(x: f64) -> f64 {
    (x * 100.0).round() / 100.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_canvas_is_the_same_file_every_time() {
        let draw = || {
            let mut canvas = Canvas::new(20.0, 10.0, "a < b & c");
            canvas.add(line(
                [0.0, 0.001],
                [1.0 / 3.0, 5.0],
                Stroke::new("#000", 1.0).dashed("2 1"),
            ));
            canvas.text([1.0, 2.0], Anchor::End, 12.0, "t < 4");
            canvas.into_svg()
        };
        let svg = draw();
        assert_eq!(svg, draw());
        assert!(svg.contains("t &lt; 4") && svg.contains("x2=\"0.33\""), "{svg}");
    }
}
