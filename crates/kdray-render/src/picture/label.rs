//! What an OpenEXR file says of a picture in words, in the attribute `kdray`:
//!
//! `picture=shaded samples=16 range=0..8 seed=0 exposure=1 heat-max=none complete=yes scene=81f2a7c05d3e9b64`
//!
//! One attribute, as the library that writes files keeps several in no fixed order, and the same
//! picture shall give the same bytes.

use super::Picture;
use crate::options::PictureKind;
use std::ops::Range;
use std::str::FromStr;

/// The attribute's name.
pub(super) const NAME: &str = "kdray";

/// All that is said.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Label {
    pub(super) kind: PictureKind,
    pub(super) samples: u32,
    pub(super) range: Range<u32>,
    pub(super) seed: u64,
    pub(super) exposure: f32,
    pub(super) heat_max: Option<f32>,
    pub(super) complete: bool,
    pub(super) scene: u64,
}

impl Label {
    pub(super) fn of(picture: &Picture) -> Self {
        Self {
            kind: picture.kind,
            samples: picture.part.samples,
            range: picture.part.sample_range.clone(),
            seed: picture.part.seed,
            exposure: picture.exposure,
            heat_max: picture.heat_max,
            complete: picture.complete,
            scene: picture.part.scene,
        }
    }

    pub(super) fn text(&self) -> String {
        let Self { kind, samples, range: Range { start, end }, seed, exposure, scene, .. } = self;
        let heat_max = self.heat_max.map_or("none".to_owned(), |max| max.to_string());
        let complete = if self.complete { "yes" } else { "no" };
        format!(
            "picture={} samples={samples} range={start}..{end} seed={seed} exposure={exposure} \
             heat-max={heat_max} complete={complete} scene={scene:016x}",
            kind.name()
        )
    }

    /// What `text` says; `None` if that is not all, or contradicts itself.
    pub(super) fn read(text: &str) -> Option<Self> {
        let value = |name: &str| {
            let mut words = text.split(' ').filter_map(|word| word.split_once('='));
            words.find(|(key, _)| *key == name).map(|(_, value)| value)
        };
        let kind = value("picture")?;
        let (start, end) = value("range")?.split_once("..")?;
        let label = Self {
            kind: PictureKind::ALL.into_iter().find(|it| it.name() == kind)?,
            samples: number(value("samples")?)?,
            range: number(start)?..number(end)?,
            seed: number(value("seed")?)?,
            exposure: number(value("exposure")?)?,
            heat_max: match value("heat-max")? {
                "none" => None,
                max => Some(number(max)?),
            },
            complete: match value("complete")? {
                "yes" => true,
                "no" => false,
                _ => return None,
            },
            scene: u64::from_str_radix(value("scene")?, 16).ok()?,
        };
        let numbers = [Some(label.exposure), label.heat_max];
        let finite = numbers.into_iter().flatten().all(f32::is_finite);
        (finite && is_range_of(&label.range, label.samples)).then_some(label)
    }
}

/// Whether a range of samples is one that a pixel with so many can have.
pub(crate) fn is_range_of(range: &Range<u32>, samples: u32) -> bool {
    !range.is_empty() && range.end <= samples && samples <= crate::options::MAX_SAMPLES
}

fn number<T: FromStr>(text: &str) -> Option<T> {
    text.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read_again() {
        for kind in PictureKind::ALL {
            let label = Label {
                kind,
                samples: 65_536,
                range: 7..65_536,
                seed: u64::MAX,
                exposure: 0.1,
                heat_max: (kind == PictureKind::Cost).then_some(1e30),
                complete: kind == PictureKind::Depth,
                scene: 0x0123_4567_89ab_cdef,
            };
            assert_eq!(Label::read(&label.text()), Some(label));
        }
    }

    #[test]
    fn what_is_missing_or_wrong_is_found() {
        let good = "picture=shaded samples=16 range=0..8 seed=0 exposure=1 heat-max=none \
                    complete=yes scene=00000000000000ff";
        assert!(Label::read(good).is_some());
        for word in good.split(' ') {
            assert_eq!(Label::read(&good.replace(word, "")), None, "without {word}");
        }
        for (right, wrong) in [
            ("picture=shaded", "picture=shade"),
            ("range=0..8", "range=8..8"),
            ("range=0..8", "range=0..17"),
            ("range=0..8", "range=0-8"),
            ("samples=16", "samples=99999"),
            ("seed=0", "seed=-1"),
            ("exposure=1", "exposure=inf"),
            ("heat-max=none", "heat-max=NaN"),
            ("complete=yes", "complete=maybe"),
            ("scene=00000000000000ff", "scene=0x"),
        ] {
            assert_eq!(Label::read(&good.replace(right, wrong)), None, "{wrong}");
        }
    }
}
