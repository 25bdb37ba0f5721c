//! Material libraries (Advanced Visualizer manual, MTL).

use crate::number;

/// A material as the library states it. What it does not state is none.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Statements {
    pub(super) name: String,
    pub(super) diffuse: Option<[f32; 3]>,
    pub(super) specular: Option<[f32; 3]>,
    pub(super) emission: Option<[f32; 3]>,
    pub(super) filter: Option<[f32; 3]>,
    pub(super) shininess: Option<f32>,
    pub(super) ior: Option<f32>,
    pub(super) dissolve: Option<f32>,
    pub(super) transparency: Option<f32>,
    pub(super) illumination: Option<f32>,
    pub(super) roughness: Option<f32>,
    pub(super) metallic: Option<f32>,
    pub(super) diffuse_map: Option<Map>,
    pub(super) emission_map: Option<Map>,
    /// Maps that are passed over.
    pub(super) other_maps: Vec<String>,
}

/// A texture statement.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Map {
    pub(super) file: String,
    pub(super) scale: [f32; 2],
    pub(super) offset: [f32; 2],
    pub(super) clamp: bool,
}

/// Adds one line of a library to the materials so far.
pub(super) fn add_line(line: &str, materials: &mut Vec<Statements>) {
    let line = line.trim();
    let (keyword, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
    let rest = rest.trim();
    if keyword == "newmtl" {
        materials.push(Statements { name: rest.to_owned(), ..Statements::default() });
        return;
    }
    let Some(material) = materials.last_mut() else { return };
    match keyword {
        "Kd" => material.diffuse = color(rest),
        "Ks" => material.specular = color(rest),
        "Ke" => material.emission = color(rest),
        "Tf" => material.filter = color(rest),
        "Ns" => material.shininess = single(rest),
        "Ni" => material.ior = single(rest),
        "d" => material.dissolve = single(rest.strip_prefix("-halo").unwrap_or(rest)),
        "Tr" => material.transparency = single(rest),
        "illum" => material.illumination = single(rest),
        "Pr" => material.roughness = single(rest),
        "Pm" => material.metallic = single(rest),
        "map_Kd" => material.diffuse_map = map(rest),
        "map_Ke" => material.emission_map = map(rest),
        _ if keyword.starts_with("map_")
            || matches!(keyword, "bump" | "disp" | "decal" | "refl") =>
        {
            material.other_maps.push(keyword.to_owned());
        }
        _ => {}
    }
}

fn single(text: &str) -> Option<f32> {
    let value = number::parse(text.split_whitespace().next()?.as_bytes())? as f32;
    value.is_finite().then_some(value)
}

/// Red, green and blue, or one number for all; CIE XYZ and spectra are not read.
fn color(text: &str) -> Option<[f32; 3]> {
    let mut words = text.split_whitespace();
    let red = single(words.next()?)?;
    let mut other = || words.next().and_then(single).unwrap_or(red);
    Some([red, other(), other()])
}

/// Options, then a file name, which may have spaces.
fn map(text: &str) -> Option<Map> {
    let mut map = Map { file: String::new(), scale: [1.0; 2], offset: [0.0; 2], clamp: false };
    let mut rest = text;
    while let Some((option, after)) = rest.split_once(char::is_whitespace) {
        let words = match option {
            "-s" | "-o" | "-t" => 3,
            "-mm" => 2,
            "-blendu" | "-blendv" | "-cc" | "-clamp" | "-bm" | "-boost" | "-texres" | "-type"
            | "-imfchan" => 1,
            _ => break,
        };
        rest = after.trim_start();
        let mut numbers = [None; 3];
        for slot in numbers.iter_mut().take(words) {
            let Some((word, after)) = rest.split_once(char::is_whitespace) else { break };
            *slot = single(word);
            // Of three numbers only the first is required.
            if words == 3 && slot.is_none() {
                break;
            }
            map.clamp |= option == "-clamp" && word == "on";
            rest = after.trim_start();
        }
        let pair = |missing: f32| [0, 1].map(|i| numbers[i].unwrap_or(missing));
        match option {
            "-s" => map.scale = pair(1.0),
            "-o" => map.offset = pair(0.0),
            _ => {}
        }
    }
    map.file = rest.trim_matches('"').to_owned();
    (!map.file.is_empty()).then_some(map)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn maps_have_options_and_names_with_spaces() {
        let plain = map("my file.png").unwrap();
        assert_eq!((plain.file.as_str(), plain.clamp), ("my file.png", false));
        let full = map("-s 2 3 1 -o 0.5 -clamp on -bm 1 dir\\a b.png").unwrap();
        assert_eq!((full.file.as_str(), full.clamp), ("dir\\a b.png", true));
        assert_eq!((full.scale, full.offset), ([2.0, 3.0], [0.5, 0.0]));
        assert_eq!(map(""), None);
    }

    #[test]
    fn lines_describe_the_material_before_them() {
        let mut materials = Vec::new();
        for line in ["Kd 1 1 1", "newmtl a b ", "\tKd .5", "Ks 0.1 0.2 0.3 # red", "Ns nan"] {
            add_line(line, &mut materials);
        }
        let expected = Statements {
            name: "a b".to_owned(),
            diffuse: Some([0.5; 3]),
            specular: Some([0.1, 0.2, 0.3]),
            ..Statements::default()
        };
        assert_eq!(materials, [expected]);
    }
}
