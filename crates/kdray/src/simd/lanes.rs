//! What the kernels need of an instruction set beyond `fearless_simd`'s portable operations.

use fearless_simd::prelude::*;
use fearless_simd::{Fallback, f32x8, mask32x8, u32x8};

/// An instruction set that moves lanes about.
pub(crate) trait Lanes: Simd {
    /// Whether vectors are what the processor has, not arrays of numbers.
    const HAS_VECTORS: bool;

    /// Packs the lanes of `t` and `links` where `chosen` is set, in the order of `places`: eight
    /// lane numbers of four bits, the first lowest. Which of the places were chosen, a bit each;
    /// lanes behind as many hold anything.
    fn pack(self, chosen: mask32x8<Self>, places: u32, lists: Lists<Self>) -> (u32, Lists<Self>);

    /// Does a step of a kernel, `work`, which must be `#[inline(always)]`: in place, or as a function that all
    /// kernels share where vectors are arrays of numbers. There a step is thousands of bytes of code, and the
    /// kernels, with a copy of each step in each, would take most of the time of compiling this crate.
    #[inline(always)]
    fn step<R>(self, work: impl FnOnce() -> R) -> R {
        if Self::HAS_VECTORS { work() } else { as_a_function(work) }
    }
}

#[inline(never)]
fn as_a_function<R>(work: impl FnOnce() -> R) -> R {
    work()
}

/// What is packed.
#[derive(Clone, Copy)]
pub(crate) struct Lists<S: Simd> {
    pub(crate) t: f32x8<S>,
    pub(crate) links: u32x8<S>,
}

/// One lane at a time, where no instruction does it at once.
macro_rules! pack_lane_by_lane {
    ($set:ty, $has_vectors:literal) => {
        impl Lanes for $set {
            const HAS_VECTORS: bool = $has_vectors;

            #[inline(always)]
            fn pack(
                self,
                chosen: mask32x8<Self>,
                places: u32,
                lists: Lists<Self>,
            ) -> (u32, Lists<Self>) {
                let mask = chosen.to_bitmask();
                let mut chosen = 0;
                let (t, links) = (lists.t.to_array(), lists.links.to_array());
                let (mut packed_t, mut packed_links) = ([0.0; 8], [0; 8]);
                let mut count = 0;
                for i in 0..8 {
                    let lane = (places >> (4 * i) & 7) as usize;
                    packed_t[count & 7] = t[lane];
                    packed_links[count & 7] = links[lane];
                    count += (mask >> lane & 1) as usize;
                    chosen |= ((mask >> lane & 1) as u32) << i;
                }
                let t = f32x8::load_array(self, packed_t);
                (chosen, Lists { t, links: u32x8::load_array(self, packed_links) })
            }
        }
    };
}

pack_lane_by_lane!(Fallback, false);

#[cfg(target_arch = "aarch64")]
pack_lane_by_lane!(fearless_simd::aarch64::Neon, true);

/// By `vpermd` of AVX2, which permutes eight lanes at once: two times into the order, and with a
/// table of which lanes to take for each of the 256 masks.
#[cfg(target_arch = "x86_64")]
mod x86 {
    use super::{Lanes, Lists};
    use fearless_simd::mask32x8;
    use fearless_simd::prelude::*;
    use fearless_simd::x86::{Avx2, Avx512};
    use std::arch::x86_64::{
        __m256, __m256i, _mm_cvtsi64_si128, _mm256_castsi256_ps, _mm256_cvtepu8_epi32,
        _mm256_movemask_ps, _mm256_permutevar8x32_epi32, _mm256_permutevar8x32_ps,
        _mm256_set1_epi32, _mm256_setr_epi32, _mm256_srlv_epi32,
    };

    /// For each mask the numbers of its set bits, a byte each, from the lowest.
    static SET_BITS: [u64; 256] = {
        let mut table = [0; 256];
        let mut mask = 0;
        while mask < 256 {
            let (mut bit, mut shift) = (0, 0);
            while bit < 8 {
                if mask >> bit & 1 == 1 {
                    table[mask] |= bit << shift;
                    shift += 8;
                }
                bit += 1;
            }
            mask += 1;
        }
        table
    };

    macro_rules! pack_by_vpermd {
        ($set:ident, $kernel:ident) => {
            fearless_simd::kernel!(
                #[inline(always)]
                fn $kernel(
                    simd: $set,
                    chosen: __m256i,
                    places: u32,
                    t: __m256,
                    links: __m256i,
                ) -> (u32, __m256, __m256i) {
                    let shifts = _mm256_setr_epi32(0, 4, 8, 12, 16, 20, 24, 28);
                    let order = _mm256_srlv_epi32(_mm256_set1_epi32(places as i32), shifts);
                    let chosen = _mm256_permutevar8x32_epi32(chosen, order);
                    let chosen = _mm256_movemask_ps(_mm256_castsi256_ps(chosen)) as usize & 255;
                    let taken = _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(SET_BITS[chosen] as i64));
                    let lanes = _mm256_permutevar8x32_epi32(order, taken);
                    let t = _mm256_permutevar8x32_ps(t, lanes);
                    let links = _mm256_permutevar8x32_epi32(links, lanes);
                    (chosen as u32, t, links)
                }
            );

            impl Lanes for $set {
                const HAS_VECTORS: bool = true;

                #[inline(always)]
                fn pack(
                    self,
                    chosen: mask32x8<Self>,
                    places: u32,
                    lists: Lists<Self>,
                ) -> (u32, Lists<Self>) {
                    let Lists { t, links } = lists;
                    let chosen = chosen.to_vector().into();
                    let (chosen, t, links) = $kernel(self, chosen, places, t.into(), links.into());
                    (chosen, Lists { t: t.simd_into(self), links: links.simd_into(self) })
                }
            }
        };
    }

    pack_by_vpermd!(Avx2, pack_avx2);
    pack_by_vpermd!(Avx512, pack_avx512);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::{InstructionSet, Kernel};

    struct Pack(u64, u32);

    impl Kernel for Pack {
        type Output = (Vec<f32>, Vec<u32>);

        #[inline(always)]
        fn run<S: Lanes>(self, simd: S) -> Self::Output {
            let t = f32x8::load_array(simd, [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]);
            let links = u32x8::load_array(simd, [10, 11, 12, 13, 14, 15, 16, 17]);
            let chosen = mask32x8::from_bitmask(simd, self.0);
            let (chosen, lists) = simd.pack(chosen, self.1, Lists { t, links });
            let count = chosen.count_ones() as usize;
            (lists.t.to_array()[..count].to_vec(), lists.links.to_array()[..count].to_vec())
        }
    }

    #[test]
    fn chosen_lanes_are_packed_in_the_order_of_their_places() {
        for set in InstructionSet::available() {
            for places in [0x7654_3210_u32, 0x0123_4567, 0x2657_1034] {
                for mask in 0..256 {
                    let lanes = (0..8).map(|i| places >> (4 * i) & 7);
                    let chosen: Vec<u32> = lanes.filter(|lane| mask >> lane & 1 == 1).collect();
                    let t: Vec<f32> = chosen.iter().map(|&lane| lane as f32).collect();
                    let links: Vec<u32> = chosen.iter().map(|&lane| 10 + lane).collect();
                    assert_eq!(set.run(Pack(mask, places)), (t, links), "{set} {mask:08b}");
                }
            }
        }
    }
}
