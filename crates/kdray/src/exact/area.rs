//! Whether a triangle has an area.

use super::edge::cross_sign;
use std::cmp::Ordering;

/// Whether three points do not lie on a line.
pub fn has_area([a, b, c]: [[f64; 3]; 3]) -> bool {
    [(0, 1), (1, 2), (2, 0)].into_iter().any(|plane| cross_sign(a, b, c, plane) != Ordering::Equal)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slivers_have_one_and_points_on_a_line_do_not() {
        // (b − a) x (c − a) is computed as zero.
        let a = [-1.030_589_983_033_553_6, -1.025_445_860_993_461, 0.0];
        let c = [0.270_451_279_648_476_6, 0.269_101_339_894_243_9, 0.0];
        assert!(has_area([a, a.map(|x| -x), c]));
        // It is computed as another number than zero.
        let a = [-1.806_684_180_854_961, -2.452_290_924_610_869, 0.0];
        let b = [1.204_456_120_569_974, 1.634_860_616_407_246, 0.0];
        let c = [2.408_912_241_139_948, 3.269_721_232_814_492, 0.0];
        assert!(!has_area([a, b, c]));
        for size in [1e-300, 1.0, 1e300] {
            let corner = |x: f64, y: f64, z: f64| [size * x, size * y, size * z];
            assert!(has_area([
                corner(0.0, 0.0, 0.0),
                corner(1.0, 0.0, 0.0),
                corner(0.0, 0.0, 1.0)
            ]));
            assert!(!has_area([
                corner(0.5, 0.5, 0.0),
                corner(1.0, 1.0, 0.0),
                corner(0.0, 0.0, 0.0)
            ]));
        }
    }
}
