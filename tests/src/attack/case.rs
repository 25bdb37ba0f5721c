//! A failing case, made as small as possible, and told as a test.

use super::answers::Answers;
use super::settings;
use super::verdict::Judge;
use super::{Attacked, Tally, Target, Volley};
use crate::OwnedPacket;
use crate::flat::Flat;
use crate::meshes::{Soup, mesh};
use kdray::geometry::Common;
use kdray::{Ray, Scene};
use std::fmt::{self, Display, Write};
use std::time::{Duration, Instant};

/// Spoils answers, so that it can be tested that errors are found.
pub type Tamper<'a> = &'a (dyn Fn(&mut Answers) + Sync);

/// Triangles, the name of [`settings`], and rays.
#[derive(Clone, Debug)]
pub struct Case<T = f32> {
    /// The triangles.
    pub soup: Soup<T>,
    /// How the tree is built.
    pub settings: String,
    /// The rays.
    pub volley: Volley,
}

impl<T: Attacked> Case<T> {
    /// What is wrong of the answers; nothing if the tree cannot be built.
    pub fn tally(&self, tamper: Option<Tamper<'_>>) -> Tally {
        let target = Target::new("case", mesh(self.soup.clone()));
        let options = settings::named(&self.settings);
        let Ok(scene) = Scene::build(target.mesh.clone(), &options) else {
            return Tally::default();
        };
        let flat = Flat::new(&target.mesh);
        shoot(&scene, Judge::of(&target, &flat), &self.volley, tamper)
    }

    /// The smallest case that is wrong in the same way, as far as one is found in that time: as long as it
    /// stays wrong, rays are left out, then triangles (ddmin; Zeller and Hildebrandt 2002).
    #[must_use]
    pub fn smallest(self, tamper: Option<Tamper<'_>>, longest: Duration) -> Self {
        let kind = kind_of(&self.tally(tamper));
        let deadline = Instant::now() + longest;
        let fails = |case: &Self| {
            kind.is_some() && Instant::now() < deadline && kind_of(&case.tally(tamper)) == kind
        };
        let rays = reduced((0..self.volley.rays.len()).collect(), |rays| {
            fails(&Self { volley: self.volley.only(rays), ..self.clone() })
        });
        let few = Self { volley: self.volley.only(&rays), ..self };
        // Fewer triangles need not be closed, nor hold what was inside.
        let open =
            Self { volley: Volley { from_inside: false, ..few.volley.clone() }, ..few.clone() };
        let few = if fails(&open) { open } else { few };
        let triangles = reduced((0..few.soup.len()).collect(), |triangles| {
            fails(&Self { soup: triangles.iter().map(|&i| few.soup[i]).collect(), ..few.clone() })
        });
        Self { soup: triangles.iter().map(|&i| few.soup[i]).collect(), ..few }
    }
}

/// Asks about a volley and judges the answers.
pub fn shoot<T: Attacked>(
    scene: &Scene<T>,
    judge: Judge<'_, T>,
    volley: &Volley,
    tamper: Option<Tamper<'_>>,
) -> Tally {
    let mut answers = Answers::of(scene, judge.flat, volley);
    if let Some(tamper) = tamper {
        tamper(&mut answers);
    }
    judge.tally(volley, &answers)
}

/// The number of the first kind of error that there is.
fn kind_of(tally: &Tally) -> Option<usize> {
    tally.by_kind().iter().position(|&count| count > 0)
}

/// The smallest list found for which `fails` holds, as it does for all of `items`.
fn reduced(mut items: Vec<usize>, fails: impl Fn(&[usize]) -> bool) -> Vec<usize> {
    let mut parts = 2;
    while items.len() > 1 {
        let size = items.len().div_ceil(parts);
        let without = |part: usize| -> Vec<usize> {
            let cut = part * size..((part + 1) * size).min(items.len());
            items.iter().enumerate().filter(|(i, _)| !cut.contains(i)).map(|(_, &it)| it).collect()
        };
        match (0..items.len().div_ceil(size)).map(without).find(|fewer| fails(fewer)) {
            Some(fewer) => (items, parts) = (fewer, 2.max(parts - 1)),
            None if size == 1 => break,
            None => parts = (2 * parts).min(items.len()),
        }
    }
    items
}

/// Asserts that all answers about rays at some triangles are right: what a printed case calls.
///
/// # Panics
/// If one is not.
pub fn assert_right<T: Attacked>(settings: &str, soup: Soup<T>, volley: Volley) {
    let tally = Case { soup, settings: settings.to_owned(), volley }.tally(None);
    assert_eq!(tally.errors(), 0, "{tally:?}");
}

/// A file for `tests/repro`.
impl<T: Attacked> Display for Case<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let vector = |v: &[f64]| {
            format!("[{}]", v.iter().map(|&x| number(x)).collect::<Vec<_>>().join(", "))
        };
        let mut rays = String::new();
        let uses = match &self.volley.packet {
            Some(packet) => {
                write_packet(&mut rays, packet, vector)?;
                "use kdray::Interval;\nuse kdray::geometry::Common;\nuse kdray_tests::OwnedPacket;\n"
            }
            None => {
                writeln!(rays, "    let volley = Volley::of_rays(vec![")?;
                for Ray { origin, direction, interval } in &self.volley.rays {
                    let (t_min, t_max) = (number(interval.t_min), number(interval.t_max));
                    let (origin, direction) = (vector(origin), vector(direction));
                    writeln!(
                        rays,
                        "        Ray::new({origin}, {direction}).with_interval({t_min}, {t_max}),"
                    )?;
                }
                writeln!(rays, "    ]);")?;
                "use kdray::Ray;\n"
            }
        };
        let (settings, inside) = (&self.settings, self.volley.from_inside);
        writeln!(f, "//! (Say here what was wrong.)\n")?;
        writeln!(f, "{uses}use kdray_tests::attack::{{Volley, assert_right}};")?;
        writeln!(f, "use kdray_tests::meshes::Soup;\n")?;
        let vertices = std::any::type_name::<T>();
        writeln!(f, "#[test]\nfn the_answers_are_right() {{")?;
        writeln!(f, "    let triangles: Soup<{vertices}> = vec![")?;
        for triangle in &self.soup {
            writeln!(f, "        {triangle:?},")?;
        }
        writeln!(
            f,
            "    ];\n{rays}    let volley = Volley {{ from_inside: {inside}, ..volley }};"
        )?;
        writeln!(f, "    assert_right({settings:?}, triangles, volley);\n}}")
    }
}

fn write_packet(
    out: &mut String,
    packet: &OwnedPacket,
    vector: impl Fn(&[f64]) -> String,
) -> fmt::Result {
    let packet = packet.packet();
    let common = match packet.common() {
        Common::Origin(point) => format!("Common::Origin({})", vector(&point)),
        Common::Direction(direction) => format!("Common::Direction({})", vector(&direction)),
        Common::Target(point) => format!("Common::Target({})", vector(&point)),
    };
    let [x, y, z] = packet.each();
    let each =
        (0..packet.len()).map(|i| vector(&[x[i], y[i], z[i]])).collect::<Vec<_>>().join(", ");
    writeln!(out, "    let packet = OwnedPacket::new({common}, &[{each}]);")?;
    writeln!(out, "    let packet = packet.with_intervals(&[")?;
    for index in 0..packet.len() {
        let interval = packet.interval(index);
        let (t_min, t_max) = (number(interval.t_min), number(interval.t_max));
        writeln!(out, "        Interval {{ t_min: {t_min}, t_max: {t_max} }},")?;
    }
    writeln!(out, "    ]);\n    let volley = Volley::of_packet(packet);")
}

/// A number as Rust reads it.
fn number(x: f64) -> String {
    match x {
        _ if x.is_nan() => "f64::NAN".to_owned(),
        f64::INFINITY => "f64::INFINITY".to_owned(),
        f64::NEG_INFINITY => "f64::NEG_INFINITY".to_owned(),
        _ => format!("{x:?}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_become_as_small_as_they_can() {
        let needs = |needed: &'static [usize]| {
            move |items: &[usize]| needed.iter().all(|it| items.contains(it))
        };
        assert_eq!(reduced((0..100).collect(), needs(&[3, 77])), [3, 77]);
        assert_eq!(reduced((0..7).collect(), needs(&[6])), [6]);
        assert_eq!(reduced(vec![5], needs(&[5])), [5]);
    }

    #[test]
    fn cases_are_told_as_tests() {
        let soup = vec![[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1e-40, 0.0]]];
        let ray = Ray::new([0.5; 3], [-0.0, 1e-300, 1.0]).with_interval(0.0, f64::INFINITY);
        let each = [[0.1, 0.2, 0.3]];
        let packet = OwnedPacket::new(Common::Origin([f64::NAN; 3]), &each);
        for (volley, part) in [
            (Volley::of_rays(vec![ray]), "Ray::new([0.5, 0.5, 0.5], [-0.0, 1e-300, 1.0])"),
            (Volley::of_packet(packet), "Common::Origin([f64::NAN, f64::NAN, f64::NAN])"),
        ] {
            let text = Case { soup: soup.clone(), settings: "sah".to_owned(), volley }.to_string();
            assert!(
                text.contains(part) && text.contains("1e-40") && text.contains("f64::INFINITY")
            );
        }
    }
}
