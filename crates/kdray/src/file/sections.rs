//! Where the arrays of a file lie.

use super::header::HEADER_BYTES;
use std::ops::Range;

/// Sections begin at multiples of this.
const ALIGNMENT: u64 = 64;

/// How many arrays there are.
pub(super) const COUNT: usize = 7;

/// How many bytes an item of each array takes: of vertices in f32, triangles, nodes, references, lines, homes
/// and numbers of homes.
const ITEM_BYTES: [u64; COUNT] = [12, 12, 8, 4, 64, 32, 4];

/// Where the arrays of a file lie, in order.
pub(super) struct Sections {
    pub(super) ranges: [Range<u64>; COUNT],
}

impl Sections {
    /// The places of arrays of so many items, with coordinates of so many bits; `None` if no file could
    /// be as long.
    pub(super) fn new(coordinate_bits: u32, counts: &[u64; COUNT]) -> Option<Self> {
        let mut item_bytes = ITEM_BYTES;
        item_bytes[0] = 3 * u64::from(coordinate_bits / 8);
        let mut ranges = [const { 0..0 }; COUNT];
        let mut end = HEADER_BYTES as u64;
        for ((range, count), item) in ranges.iter_mut().zip(counts).zip(item_bytes) {
            let start = end.checked_next_multiple_of(ALIGNMENT)?;
            end = start.checked_add(count.checked_mul(item)?)?;
            *range = start..end;
        }
        Some(Self { ranges })
    }

    /// Where the last array ends, and with it the file.
    pub(super) fn file_bytes(&self) -> u64 {
        self.ranges[COUNT - 1].end
    }

    /// What lies between the arrays.
    pub(super) fn gaps(&self) -> impl Iterator<Item = Range<u64>> + '_ {
        let mut end = HEADER_BYTES as u64;
        self.ranges.iter().map(move |range| std::mem::replace(&mut end, range.end)..range.start)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sections_are_aligned_and_close_to_each_other() {
        let sections = Sections::new(32, &[3, 1, 1, 2, 4, 1, 1]).expect("a short file");
        let [vertices, triangles, .., above] = &sections.ranges;
        assert_eq!((vertices.clone(), triangles.clone()), (256..292, 320..332));
        assert!(sections.ranges.iter().all(|range| range.start % ALIGNMENT == 0));
        assert!(sections.gaps().all(|gap| gap.end - gap.start < ALIGNMENT));
        assert_eq!(sections.file_bytes(), above.end);
        let in_f64 = Sections::new(64, &[3, 1, 1, 2, 4, 1, 1]).expect("a short file");
        assert_eq!((in_f64.ranges[0].clone(), in_f64.ranges[1].start), (256..328, 384));
    }

    #[test]
    fn counts_that_no_file_holds_have_no_place() {
        for counts in [[u64::MAX, 0, 0, 0, 0, 0, 0], [1 << 60, 1 << 60, 0, 0, 0, 0, 0]] {
            assert!(Sections::new(32, &counts).is_none() && Sections::new(64, &counts).is_none());
        }
    }
}
