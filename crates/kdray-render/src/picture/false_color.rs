//! Colours for numbers that are not colours.

/// From a cost to a colour: dark blue for none, by green and yellow to dark red.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct HeatScale {
    /// The cost that has the last colour.
    pub(crate) max: f32,
    /// Whether there are costs beyond it.
    pub(crate) exceeded: bool,
}

/// The share of pixels, in thousandths, whose cost the scale covers if it is not given.
const COVERED: usize = 995;

impl HeatScale {
    /// A scale from 0 to `max`, or else to the 99.5th percentile of `costs`.
    pub(crate) fn new(costs: impl Iterator<Item = f32>, max: Option<f32>) -> Self {
        let mut costs: Vec<f32> = costs.collect();
        costs.sort_unstable_by(f32::total_cmp);
        let highest = costs.last().copied().unwrap_or(0.0);
        let covered = costs.get(costs.len() * COVERED / 1000).copied().unwrap_or(0.0);
        // At least 1, so that a picture without any cost has a scale.
        let max = max.unwrap_or_else(|| covered.ceil().max(1.0));
        Self { max, exceeded: highest > max }
    }

    /// The colour of `cost`.
    pub(crate) fn color(&self, cost: f32) -> [f32; 3] {
        turbo((cost / self.max).clamp(0.0, 1.0))
    }
}

/// Mikhailov's "Turbo, an improved rainbow colormap" (Google, 2019) as the polynomial of fifth
/// degree that R. Du fitted to it; display values.
fn turbo(x: f32) -> [f32; 3] {
    const COEFFICIENTS: [[f32; 6]; 3] = [
        [0.135_721_38, 4.615_392_6, -42.660_32, 132.131_08, -152.942_4, 59.286_38],
        [0.091_402_61, 2.194_188_4, 4.842_966_6, -14.185_033, 4.277_298_6, 2.829_566],
        [0.106_673_3, 12.641_946, -60.582_05, 110.362_77, -89.903_11, 27.348_25],
    ];
    COEFFICIENTS.map(|c| c.iter().rev().fold(0.0, |sum, &c| sum * x + c).clamp(0.0, 1.0))
}

/// A colour for an id, black for none (`u32::MAX`): bright, and unlike that of the next ids.
pub(crate) fn of_id(id: u32) -> [f32; 3] {
    if id == u32::MAX {
        return [0.0; 3];
    }
    let mut hash = id.wrapping_add(1).wrapping_mul(0x9e37_79b1);
    hash = (hash ^ (hash >> 15)).wrapping_mul(0x85eb_ca77);
    hash ^= hash >> 13;
    [0, 8, 16].map(|shift| 0.25 + 0.75 * ((hash >> shift) & 255) as f32 / 255.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scale_goes_from_blue_to_red() {
        let scale = HeatScale { max: 10.0, exceeded: false };
        let [r, _, b] = scale.color(1.0);
        assert!(b > r);
        let [r, g, b] = scale.color(5.0);
        assert!(g > r && g > b);
        let [r, _, b] = scale.color(99.0);
        assert!(r > 0.4 && b < 0.1);
    }

    #[test]
    fn outliers_do_not_stretch_the_scale() {
        let costs = (0..1000).map(|i| if i == 500 { 1e6 } else { 7.0 });
        assert_eq!(HeatScale::new(costs.clone(), None), HeatScale { max: 7.0, exceeded: true });
        assert_eq!(HeatScale::new(costs, Some(2e6)), HeatScale { max: 2e6, exceeded: false });
        assert_eq!(HeatScale::new(std::iter::empty(), None).max, 1.0);
    }
}
