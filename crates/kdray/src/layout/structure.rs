//! What the kernels rely on.

use super::arena::{Arena, BLOCK_LINES, NODE_LINES};
use super::home::Home;
use super::wide::stack_size;
use super::{Link, STACK_SIZE, WideError, WideNode};

/// A pass through a wide tree in the order in which its parts lie, which is depth-first.
struct Pass<'a> {
    arena: &'a Arena,
    homes: &'a [Home],
    /// How many triangles there are.
    triangles: u32,
    /// What comes next: where it lies, and the number of the next node's home.
    line: usize,
    number: u32,
}

/// A node whose children the pass goes through.
struct Visit<'a> {
    node: &'a WideNode,
    line: usize,
    number: u32,
    /// The next of its places.
    place: usize,
    /// How many places of a traversal's stack are taken below it.
    stack: usize,
}

/// Checks that every walk through a wide tree ends, fits its stack and finds what it looks up: what the
/// links lead to tiles the arena, children are ordered in each octant, the way up is the way down, and
/// triangles have ids below `triangles`. Boxes and corners may be anything.
pub(super) fn check(arena: &Arena, homes: &[Home], triangles: usize) -> Result<(), WideError> {
    let mut pass = Pass { arena, homes, triangles: triangles as u32, line: 0, number: 0 };
    if !homes.first().is_some_and(Home::is_everywhere) {
        return Err(WideError::BadHome { line: 0 });
    }
    let mut path = vec![pass.enter(Link::ROOT, 0, 0, 0)?];
    while let Some(visit) = path.last_mut() {
        let Some(&bits) = visit.node.links().get(visit.place) else {
            path.pop();
            continue;
        };
        let (link, place) = (Link::from_bits(bits), visit.place as u32);
        visit.place += 1;
        if link.is_leaf() {
            pass.pass_leaf(link, visit.line)?;
        } else if link != Link::ROOT {
            let child = pass.enter(link, visit.number, place, visit.stack)?;
            path.push(child);
        }
    }
    pass.check_end()
}

impl<'a> Pass<'a> {
    /// Enters the node that comes next, to which `link` should lead, from that place of its parent.
    fn enter(
        &mut self,
        link: Link,
        parent: u32,
        place: u32,
        stack: usize,
    ) -> Result<Visit<'a>, WideError> {
        let (line, number) = (self.line, self.number);
        self.advance(link, line, NODE_LINES)?;
        if link.to_bits() as usize != line {
            return Err(WideError::NotDepthFirst { line });
        }
        let is_right = |home: &Home| home.is_at(link, parent, place);
        if !self.homes.get(number as usize).is_some_and(is_right) {
            return Err(WideError::BadHome { line });
        }
        self.number += 1;
        let node = self.arena.node(link);
        if !node.has_no_box_without_child() {
            return Err(WideError::BoxWithoutChild { line });
        }
        if !node.orders_all() {
            return Err(WideError::BadOrder { line });
        }
        let stack = stack + node.child_count().saturating_sub(1);
        if stack_size(stack) > STACK_SIZE {
            return Err(WideError::TooDeep { line });
        }
        Ok(Visit { node, line, number, place: 0, stack })
    }

    /// Passes the blocks of a leaf, which is a child of the node in line `above`.
    fn pass_leaf(&mut self, link: Link, above: usize) -> Result<(), WideError> {
        let count = link.block_count();
        if count == 0 {
            return Err(WideError::EmptyLeaf { line: above });
        }
        let line = self.line;
        self.advance(link, line, count * BLOCK_LINES)?;
        for index in 0..count {
            if !self.arena.block(link, index).has_ids_below(self.triangles) {
                return Err(WideError::NoSuchTriangle { line: line + index * BLOCK_LINES });
            }
        }
        Ok(())
    }

    /// Goes on behind what should lie at `link`, and does lie in `line`.
    fn advance(&mut self, link: Link, line: usize, size: usize) -> Result<(), WideError> {
        if link.line() != line {
            return Err(WideError::NotDepthFirst { line });
        }
        let lines = self.arena.lines().len();
        if lines - line < size {
            return Err(WideError::PastTheEnd { line, lines });
        }
        self.line += size;
        Ok(())
    }

    fn check_end(&self) -> Result<(), WideError> {
        let (reached, lines) = (self.line, self.arena.lines().len());
        if reached == lines && self.number as usize == self.homes.len() {
            Ok(())
        } else {
            Err(WideError::Unreached { reached, lines })
        }
    }
}
