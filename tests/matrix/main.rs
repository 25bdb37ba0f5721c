//! Every strategy, kind of primitive and query, against the answer of testing every primitive and
//! against rational arithmetic. A test's name says which: `sah::triangles::closest_hit`, of vertices in f64
//! `sah::triangles_f64::closest_hit`; those of the kernels name their instruction set:
//! `sah::kernels::avx2::closest_hit` and `sah::kernels_f64::avx2::closest_hit`, those of their packets
//! too: `sah::kernels::avx2::packets_closest_hit`; and those of the packets that can be watched, on the
//! canonical tree, their kind: `sah::packets::frustum::triangles`.

mod cases;
mod checks;
mod float;
mod packets;
mod ray_packets;

use cases::{BALLS_2D, BALLS_3D, SEGMENTS, TRIANGLES, TRIANGLES_F64};
use checks::{all_hits, all_touched, any_hit, closest_hit, count};
use checks::{kernel_all_hits, kernel_any_hit, kernel_any_hit_near, kernel_closest_hit};
use kdray::build::SahBuilder;
use kdray::traverse::PacketKind;
use kdray::{BuildOptions, InstructionSet, Preset, Strategy};

macro_rules! queries {
    ($kind:ident, $cases:expr, $($query:ident)*) => {
        mod $kind {
            use super::*;

            #[test]
            fn trees_are_valid() {
                checks::trees_are_valid(&options(), &$cases);
            }

            $(
                #[test]
                fn $query() {
                    checks::on_each(&options(), &$cases, super::$query);
                }
            )*
        }
    };
}

macro_rules! kernels {
    ($kind:ident, $cases:ident, $packets:ident, $($instructions:ident)*) => {
        mod $kind {
            use super::*;
            use crate::ray_packets::$packets;

            $(
                mod $instructions {
                    use super::*;

                    #[test]
                    fn closest_hit() {
                        let set = stringify!($instructions);
                        checks::on_each_mesh(&options(), &$cases, set, kernel_closest_hit);
                    }

                    #[test]
                    fn all_hits() {
                        let set = stringify!($instructions);
                        checks::on_each_mesh(&options(), &$cases, set, kernel_all_hits);
                    }

                    #[test]
                    fn any_hit() {
                        let set = stringify!($instructions);
                        checks::on_each_mesh(&options(), &$cases, set, kernel_any_hit);
                    }

                    #[test]
                    fn any_hit_near() {
                        let set = stringify!($instructions);
                        checks::on_each_mesh(&options(), &$cases, set, kernel_any_hit_near);
                    }

                    #[test]
                    fn packets_closest_hit() {
                        let set = stringify!($instructions);
                        ray_packets::closest_hits(&options(), (&$cases, &$packets), set);
                    }

                    #[test]
                    fn packets_any_hit() {
                        let set = stringify!($instructions);
                        ray_packets::any_hits(&options(), (&$cases, &$packets), set);
                    }

                    #[test]
                    fn packets_in_float() {
                        let set = stringify!($instructions);
                        ray_packets::in_float(&options(), (&$cases, &$packets), set);
                    }

                    #[test]
                    fn in_float() {
                        let set = stringify!($instructions);
                        float::is_close_to_exact(&options(), &$cases, set);
                    }
                }
            )*
        }
    };
}

/// Appends to what a macro is given the instruction sets for which the kernels are compiled: there are no tests of
/// those that no processor of this architecture has. Tests of one that only this processor lacks say so.
#[cfg(target_arch = "x86_64")]
macro_rules! for_each_set {
    ($then:ident!($($given:tt)*)) => { $then!($($given)* portable avx2 avx512); };
}
#[cfg(target_arch = "aarch64")]
macro_rules! for_each_set {
    ($then:ident!($($given:tt)*)) => { $then!($($given)* portable neon); };
}
#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
macro_rules! for_each_set {
    ($then:ident!($($given:tt)*)) => { $then!($($given)* portable); };
}

macro_rules! names {
    ($($instructions:ident)*) => {
        /// The sets that kernels are tested by.
        const SETS: &[&str] = &[$(stringify!($instructions)),*];
    };
}

for_each_set!(names!());

#[test]
fn every_set_of_this_processor_is_tested() {
    for set in InstructionSet::available() {
        assert!(SETS.contains(&set.name()), "{set}");
    }
}

macro_rules! packets {
    ($($kind:ident = $packet:ident)*) => {
        mod packets {
            use super::*;

            $(
                mod $kind {
                    use super::*;

                    #[test]
                    fn triangles() {
                        crate::packets::on_each(&options(), &TRIANGLES, PacketKind::$packet);
                    }

                    #[test]
                    fn balls() {
                        crate::packets::on_each(&options(), &BALLS_3D, PacketKind::$packet);
                    }
                }
            )*
        }
    };
}

macro_rules! builder {
    ($name:ident, $options:expr $(, $kernels_f64:ident)?) => {
        mod $name {
            use super::*;

            fn options() -> BuildOptions {
                $options
            }

            queries!(triangles, TRIANGLES, closest_hit any_hit all_hits all_touched count);
            queries!(segments, SEGMENTS, closest_hit any_hit all_hits all_touched count);
            queries!(balls_2d, BALLS_2D, closest_hit any_hit all_hits all_touched count);
            queries!(balls_3d, BALLS_3D, closest_hit any_hit all_hits all_touched count);
            queries!(triangles_f64, TRIANGLES_F64, closest_hit any_hit all_hits all_touched count);
            for_each_set!(kernels!(kernels, TRIANGLES, PACKETS,));
            $(for_each_set!(kernels!($kernels_f64, TRIANGLES_F64, PACKETS_F64,));)?
            packets!(masked = Masked interval = Interval frustum = Frustum);
        }
    };
}

/// Leaves of one primitive where the strategy can: the deepest trees, with the most cells to lose
/// a hit between.
fn deep(strategy: Strategy) -> BuildOptions {
    BuildOptions { leaf_size: 1, ..BuildOptions::for_strategy(strategy) }
}

// For f64 the kernels have other bounds, and corners from elsewhere, but ask the same of a tree: three builders, of
// the deepest leaves, of blocks, and of none, stand for all.
builder!(middle, deep(Strategy::Middle));
builder!(median, deep(Strategy::Median));
builder!(round_robin, deep(Strategy::RoundRobin));
builder!(sah, deep(Strategy::Sah), kernels_f64);
builder!(sah_naive, BuildOptions { sah_builder: SahBuilder::Naive, ..deep(Strategy::Sah) });
builder!(
    binned,
    BuildOptions { sah_builder: SahBuilder::Binned { sweep_below: 0 }, ..deep(Strategy::Sah) }
);
builder!(fast, BuildOptions::preset(Preset::Fast));
builder!(balanced, BuildOptions::preset(Preset::Balanced), kernels_f64);
builder!(best, BuildOptions::preset(Preset::Best));
builder!(one_leaf, BuildOptions { leaf_size: usize::MAX, ..deep(Strategy::Sah) }, kernels_f64);
