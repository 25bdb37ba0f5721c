//! The key to a heat map: a bar of its colours with numbers, in the lower left corner.

use super::false_color::HeatScale;
use super::png::Canvas;
use font8x8::legacy::BASIC_LEGACY;

/// The side of a character in pixels, before enlargement.
const CHARACTER: usize = 8;

const WHITE: [u16; 4] = [65535; 4];

/// A rectangle of the canvas that is drawn on; what lies outside of the canvas is left out.
struct Pen<'a> {
    canvas: &'a mut Canvas,
    left: usize,
    top: usize,
    /// How many pixels make a dot.
    size: usize,
}

/// Draws the key. A picture of less than 64 x 32 has no room for it.
pub(crate) fn draw(canvas: &mut Canvas, title: &str, scale: &HeatScale) {
    if canvas.width < 64 || canvas.height < 32 {
        return;
    }
    let size = (canvas.width.min(canvas.height) / 360).max(1);
    let dots = canvas.width / size;
    let (columns, rows) = (dots.min(208), 32);
    let top = canvas.height - (rows * size).min(canvas.height);
    let mut pen = Pen { canvas, left: 0, top, size };
    pen.darken(columns, rows);
    pen.text(title, 4, 3);
    let bar = columns - 8;
    for x in 0..bar {
        let color = scale.color(scale.max * (x as f32 + 0.5) / bar as f32);
        let [r, g, b] = color.map(|c| (c * 65535.0) as u16);
        for y in 13..20 {
            pen.dot(4 + x, y, [r, g, b, 65535]);
        }
    }
    pen.text("0", 4, 22);
    let last = number(scale.max) + if scale.exceeded { "+" } else { "" };
    let end = columns - 4 - (last.len() * CHARACTER).min(columns - 4);
    pen.text(&last, end, 22);
    let middle = number(scale.max / 2.0);
    let width = middle.len() * CHARACTER;
    if 4 + CHARACTER + width / 2 < columns / 2 && columns / 2 + width / 2 + CHARACTER < end {
        pen.text(&middle, columns / 2 - width / 2, 22);
    }
}

fn number(value: f32) -> String {
    if value.fract() == 0.0 || value >= 100.0 {
        format!("{value:.0}")
    } else {
        format!("{value:.1}")
    }
}

impl Pen<'_> {
    fn dot(&mut self, x: usize, y: usize, color: [u16; 4]) {
        self.each_pixel(x, y, |pixel| *pixel = color);
    }

    fn darken(&mut self, columns: usize, rows: usize) {
        for (x, y) in (0..rows).flat_map(|y| (0..columns).map(move |x| (x, y))) {
            self.each_pixel(x, y, |pixel| {
                let [r, g, b, _] = *pixel;
                *pixel = [r / 5, g / 5, b / 5, u16::MAX];
            });
        }
    }

    fn each_pixel(&mut self, x: usize, y: usize, change: impl Fn(&mut [u16; 4])) {
        for (dx, dy) in (0..self.size).flat_map(|dy| (0..self.size).map(move |dx| (dx, dy))) {
            let (x, y) = (self.left + x * self.size + dx, self.top + y * self.size + dy);
            if x < self.canvas.width && y < self.canvas.height {
                change(&mut self.canvas.pixels[y * self.canvas.width + x]);
            }
        }
    }

    /// Writes ASCII text with its upper left corner at (x, y).
    fn text(&mut self, text: &str, x: usize, y: usize) {
        for (i, byte) in text.bytes().enumerate() {
            let rows = BASIC_LEGACY.get(usize::from(byte)).copied().unwrap_or_default();
            for (dy, row) in rows.into_iter().enumerate() {
                for dx in (0..CHARACTER).filter(|dx| row >> dx & 1 == 1) {
                    self.dot(x + i * CHARACTER + dx, y + dy, WHITE);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_key_shows_its_colors_and_fits_any_picture() {
        let scale = HeatScale { max: 123.0, exceeded: true };
        for (width, height) in [(1, 1), (64, 32), (65, 40), (1920, 1080)] {
            let pixels = vec![[0; 4]; width * height];
            let mut canvas = Canvas { width, height, pixels };
            draw(&mut canvas, "nodes visited", &scale);
            let drawn = canvas.pixels.contains(&WHITE);
            assert_eq!(drawn, width >= 64);
            let red = canvas.pixels.iter().any(|[r, _, b, _]| *r > 30_000 && *b < 3_000);
            assert_eq!(red, width >= 64);
        }
    }

    #[test]
    fn a_number_without_room_is_left_out_or_cut() {
        for max in [1e9, 1e20, f32::MAX, f32::INFINITY] {
            for width in [64, 100, 208, 400] {
                let mut canvas = Canvas { width, height: 40, pixels: vec![[0; 4]; width * 40] };
                draw(&mut canvas, "nodes visited", &HeatScale { max, exceeded: true });
                assert!(canvas.pixels.contains(&WHITE));
            }
        }
    }

    #[test]
    fn numbers_are_short() {
        assert_eq!([61.5, 123.0, 1234.5].map(number), ["61.5", "123", "1234"]);
    }
}
