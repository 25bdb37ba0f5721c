//! Rays that come together: kdray's packets beside the best that Embree does with the same rays.

use crate::measure::{Traced, median};
use crate::rays::SetKind;
use crate::report::{PacketRow, RayRow};

/// The contender that is the best of several others, set by set.
const BEST: &str = "embree best packet";

/// Those others. The best of them may be single rays: a packet of eight need not pay.
const AMONG: [&str; 6] = [
    "embree medium single",
    "embree medium 8",
    "embree medium 8 coherent",
    "embree high single",
    "embree high 8",
    "embree high 8 coherent",
];

/// What is compared with it, and with what else.
const PACKETS: &str = "kdray packets";
const SINGLE: &str = "kdray single";

/// The sets whose rays share something.
const SETS: [SetKind; 3] = [SetKind::Primary, SetKind::Shadow, SetKind::AoShared];

/// Whether a kernel has to run because the best of Embree was asked for, by a part of its name.
pub(crate) fn is_needed(name: &str, names: &[String]) -> bool {
    is_asked(names) && AMONG.contains(&name)
}

fn is_asked(names: &[String]) -> bool {
    names.is_empty() || names.iter().any(|part| BEST.contains(part.as_str()))
}

/// The row of the best of Embree, if it was asked for and there is one.
pub(crate) fn best_row(traced: &[Traced], kind: SetKind, names: &[String]) -> Option<RayRow> {
    let row = &best(traced, kind, names)?.row;
    Some(RayRow { contender: BEST.to_owned(), best: Some(row.contender.clone()), ..row.clone() })
}

/// How kdray's packets compare; none if they were not traced.
pub(crate) fn packet_row(traced: &[Traced], kind: SetKind, names: &[String]) -> Option<PacketRow> {
    let packets = find(traced, PACKETS).filter(|_| SETS.contains(&kind))?;
    let best = best(traced, kind, names);
    Some(PacketRow {
        scene: packets.row.scene.clone(),
        set: packets.row.set.clone(),
        best: best.map(|best| best.row.contender.clone()),
        to_best: best.map(|best| ratio(packets, best)),
        to_single: find(traced, SINGLE).map(|single| ratio(packets, single)),
    })
}

fn best<'a>(traced: &'a [Traced], kind: SetKind, names: &[String]) -> Option<&'a Traced> {
    let among = traced.iter().filter(|it| AMONG.contains(&it.row.contender.as_str()));
    let best = among.max_by(|a, b| a.row.mrays.total_cmp(&b.row.mrays));
    best.filter(|_| SETS.contains(&kind) && is_asked(names))
}

fn find<'a>(traced: &'a [Traced], name: &str) -> Option<&'a Traced> {
    traced.iter().find(|it| it.row.contender == name)
}

/// The median of the rounds' ratios.
fn ratio(above: &Traced, below: &Traced) -> f64 {
    median(above.rates.iter().zip(&below.rates).map(|(above, below)| above / below).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::Wrong;

    /// Contenders that traced so many million rays a second in each round.
    fn traced(rates: &[(&str, [f64; 3])]) -> Vec<Traced> {
        let one = |&(name, rates): &(&str, [f64; 3])| Traced {
            row: RayRow {
                scene: "bunny".to_owned(),
                set: "primary".to_owned(),
                contender: name.to_owned(),
                best: None,
                rays: 100,
                mrays: median(rates.to_vec()),
                mrays_wall: 1.0,
                ratio: Some(1.0),
                wrong: Wrong::default(),
            },
            rates: rates.to_vec(),
        };
        rates.iter().map(one).collect()
    }

    const RATES: [(&str, [f64; 3]); 6] = [
        ("embree medium single", [2.0, 2.0, 2.0]),
        ("embree high 8 coherent", [4.0, 5.0, 2.0]),
        ("embree high 8", [3.0, 3.5, 3.0]),
        ("embree robust 8", [9.0, 9.0, 9.0]),
        ("kdray packets", [8.0, 5.0, 6.0]),
        ("kdray single", [2.0, 1.0, 1.0]),
    ];

    #[test]
    fn the_best_of_embree_is_told_by_name() {
        let traced = traced(&RATES);
        let row = best_row(&traced, SetKind::Primary, &[]).unwrap();
        assert_eq!((row.contender.as_str(), row.mrays), (BEST, 4.0));
        assert_eq!(row.best.as_deref(), Some("embree high 8 coherent"));
        assert!(best_row(&traced, SetKind::Diffuse, &[]).is_none());
        assert!(best_row(&traced, SetKind::Primary, &["kdray".to_owned()]).is_none());
        assert!(best_row(&traced[4..], SetKind::Primary, &[]).is_none());
    }

    #[test]
    fn packets_are_compared_round_by_round() {
        let row = packet_row(&traced(&RATES), SetKind::Shadow, &[]).unwrap();
        assert_eq!((row.to_best, row.to_single), (Some(2.0), Some(5.0)));
        let row = packet_row(&traced(&RATES[4..]), SetKind::Shadow, &[]).unwrap();
        assert_eq!((row.to_best, row.to_single, row.best), (None, Some(5.0), None));
        assert!(packet_row(&traced(&RATES[..4]), SetKind::Shadow, &[]).is_none());
        assert!(packet_row(&traced(&RATES), SetKind::Ao, &[]).is_none());
    }

    #[test]
    fn whoever_asks_for_the_best_runs_all_of_them() {
        let names = |names: &[&str]| names.iter().map(|&it| it.to_owned()).collect::<Vec<_>>();
        assert!(is_needed("embree high 8", &names(&["kdray packets", "embree best packet"])));
        assert!(!is_needed("embree robust 8", &names(&["embree best packet"])));
        assert!(!is_needed("embree high 8", &names(&["kdray packets"])));
    }
}
