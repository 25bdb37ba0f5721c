//! The vertices that triangles use.

use super::parts::Part;
use std::collections::HashMap;
use std::rc::Rc;

/// Stands for "not used" or "not numbered yet".
const NONE: u32 = u32::MAX;

/// Numbers the vertices that parts use. Many meshes may share one long list of vertices, of which
/// each uses a few: the others take no place in the model.
#[derive(Default)]
pub(super) struct UsedVertices {
    /// The number of each vertex of a list, `NONE` for all between calls. Kept, so that a call
    /// takes as long as there are triangles, however long the list is.
    numbers: Vec<u32>,
}

impl UsedVertices {
    /// Lets the triangles of a mesh's parts count only the vertices in use. Parts that share their
    /// vertices count them together.
    pub(super) fn number(&mut self, parts: &mut [Part]) {
        let mut groups: HashMap<_, Vec<&mut Part>> = HashMap::new();
        for part in parts {
            groups.entry(part.sources).or_default().push(part);
        }
        for mut group in groups.into_values() {
            self.number_group(&mut group);
        }
    }

    fn number_group(&mut self, group: &mut [&mut Part]) {
        let used = Rc::new(self.used(group));
        for (number, &vertex) in used.iter().enumerate() {
            self.numbers[vertex as usize] = number as u32;
        }
        for part in group {
            for triangle in good_triangles(part) {
                *triangle = triangle.map(|vertex| self.numbers[vertex as usize]);
            }
            part.vertices = Rc::clone(&used);
        }
        for &vertex in used.iter() {
            self.numbers[vertex as usize] = NONE;
        }
    }

    /// The vertices in use, in the file's order.
    fn used(&mut self, group: &mut [&mut Part]) -> Vec<u32> {
        let mut used = Vec::new();
        for part in group {
            let count = part.positions.len().max(self.numbers.len());
            self.numbers.resize(count, NONE);
            for &mut vertex in good_triangles(part).flatten() {
                let number = &mut self.numbers[vertex as usize];
                if *number == NONE {
                    *number = 0;
                    used.push(vertex);
                }
            }
        }
        used.sort_unstable();
        used
    }
}

/// The triangles whose vertices are there. The others keep the file's numbers, for messages.
fn good_triangles(part: &mut Part) -> impl Iterator<Item = &mut [u32; 3]> {
    let count = part.positions.len();
    let is_there = move |vertex: &u32| (*vertex as usize) < count;
    part.triangles.iter_mut().filter(move |triangle| triangle.iter().all(is_there))
}
