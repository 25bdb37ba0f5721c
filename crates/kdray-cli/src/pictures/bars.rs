//! Bar charts, one for each figure, of everyone who is compared.

use super::canvas::{Anchor, Canvas, Point, Stroke, line, rectangle, text_width};
use super::legend::{self, Entry};
use super::palette;
use crate::wording::three_digits;

/// One chart: for every contender one bar of each series.
pub(crate) struct Bars {
    /// What is measured, and in which unit.
    pub(crate) title: String,
    /// Whether more or less is better.
    pub(crate) note: &'static str,
    /// The series; one alone needs no name.
    pub(crate) series: Vec<Series>,
}

/// A bar for every contender.
pub(crate) struct Series {
    /// What it is called in the legend.
    pub(crate) name: &'static str,
    /// A value for each contender; `None` if there is none.
    pub(crate) values: Vec<Option<f64>>,
}

const WIDTH: f64 = 560.0;
const LABELS: f64 = 110.0;
const VALUES: f64 = 78.0;
const BAR: f64 = 16.0;
const GAP: f64 = 10.0;
const HEAD: f64 = 52.0;
const COLORS: [&str; 3] = [palette::BLUE, palette::SKY, palette::ORANGE];

/// Draws charts two in a row below a headline.
pub(crate) fn draw_bars(title: &str, subtitle: &str, names: &[&str], charts: &[Bars]) -> Canvas {
    let width = 2.0 * WIDTH + 48.0;
    let row_heights: Vec<f64> = charts
        .chunks(2)
        .map(|row| row.iter().map(|chart| chart.height(names.len())).fold(0.0, f64::max))
        .collect();
    let legend = legend(charts);
    let top = 72.0;
    let bottom = top + row_heights.iter().sum::<f64>();
    let height = bottom + legend::height(&legend, width - 48.0) + 12.0;
    let mut canvas = Canvas::new(width, height, title);
    canvas.text([24.0, 32.0], Anchor::Start, 18.0, title);
    canvas.text([24.0, 54.0], Anchor::Start, 13.0, subtitle);
    let mut y = top;
    for (row, row_height) in charts.chunks(2).zip(row_heights) {
        for (column, chart) in row.iter().enumerate() {
            chart.draw(&mut canvas, [24.0 + column as f64 * (WIDTH + 8.0), y], names);
        }
        y += row_height;
    }
    legend::draw(&mut canvas, [24.0, bottom], width - 48.0, &legend);
    canvas
}

impl Bars {
    fn height(&self, contenders: usize) -> f64 {
        HEAD + contenders as f64 * (self.series.len() as f64 * BAR + GAP) + 24.0
    }

    fn draw(&self, canvas: &mut Canvas, [x, y]: Point, names: &[&str]) {
        canvas.text([x, y + 18.0], Anchor::Start, 14.0, &self.title);
        canvas.text([x, y + 36.0], Anchor::Start, 12.0, self.note);
        let all = self.series.iter().flat_map(|series| series.values.iter().flatten());
        let largest = all.fold(0.0_f64, |m, &value| m.max(value));
        let scale = if largest > 0.0 { (WIDTH - LABELS - VALUES - 16.0) / largest } else { 0.0 };
        let left = x + LABELS;
        let mut top = y + HEAD;
        let bottom = y + self.height(names.len()) - 24.0;
        for (i, name) in names.iter().enumerate() {
            let middle = top + self.series.len() as f64 * BAR / 2.0;
            canvas.text([left - 8.0, middle + 4.5], Anchor::End, 13.0, name);
            for (series, color) in self.series.iter().zip(COLORS) {
                draw_bar(
                    canvas,
                    [left, top],
                    series.values.get(i).copied().flatten(),
                    scale,
                    color,
                );
                top += BAR;
            }
            top += GAP;
        }
        let axis = Stroke::new(palette::GREY, 1.0);
        canvas.add(line([left, y + HEAD - 4.0], [left, bottom], axis));
    }
}

fn draw_bar(canvas: &mut Canvas, [x, y]: Point, value: Option<f64>, scale: f64, color: &str) {
    let length = value.unwrap_or(0.0) * scale;
    let bar = rectangle([x, y + 1.0], [length, BAR - 2.0]);
    canvas.add(bar.set("class", "bar").set("fill", color));
    let text = value.map_or("–".into(), three_digits);
    canvas.text([x + length + 6.0, y + BAR - 4.0], Anchor::Start, 11.5, &text);
    debug_assert!(text_width(11.5, &text) < VALUES);
}

fn legend(charts: &[Bars]) -> Vec<Vec<Entry>> {
    let Some(chart) = charts.iter().find(|chart| chart.series.len() > 1) else { return Vec::new() };
    let entries = chart.series.iter().zip(COLORS);
    vec![entries.map(|(series, color)| Entry::area(color, series.name)).collect()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bars_are_as_long_as_their_values() {
        let values = vec![Some(2.0), None, Some(4.0)];
        let chart = Bars { title: "x".into(), note: "", series: vec![Series { name: "", values }] };
        let svg = draw_bars("t", "s", &["a", "b", "c"], &[chart]).into_svg();
        let widths: Vec<f64> = svg
            .lines()
            .filter(|line| line.contains("class=\"bar\""))
            .map(|line| {
                let after = line.split(" width=\"").nth(1).unwrap();
                after.split('"').next().unwrap().parse().unwrap()
            })
            .collect();
        assert_eq!(widths.len(), 3);
        assert!(widths[2] > 100.0 && widths[0] * 2.0 == widths[2] && widths[1] == 0.0);
    }
}
