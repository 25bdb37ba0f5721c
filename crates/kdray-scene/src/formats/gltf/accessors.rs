//! Typed numbers in buffers.

use super::Document;
use super::buffers::Buffers;
use crate::LoadError;
use ::gltf::json::accessor::{ComponentType, Type};
use ::gltf::json::validation::Checked;
use ::gltf::json::{Accessor, Index};
use std::cell::Cell;
use std::ops::RangeInclusive;

/// Reads accessors.
pub(super) struct Accessors<'a> {
    pub(super) document: Document<'a>,
    buffers: &'a Buffers,
    /// How many more numbers may be read.
    budget: Cell<u64>,
}

/// How the elements of an accessor lie in a view.
struct Layout {
    component: ComponentType,
    components: usize,
    normalized: bool,
}

impl Layout {
    fn component_size(&self) -> usize {
        self.component.size()
    }

    fn element_size(&self) -> usize {
        self.components * self.component_size()
    }

    /// One number, as it is or from −1 or 0 to 1 (section 3.6.2.2).
    fn number(&self, bytes: &[u8]) -> f64 {
        let unit = |value: f64, largest: f64| {
            if self.normalized { (value / largest).max(-1.0) } else { value }
        };
        match (self.component, bytes) {
            (ComponentType::I8, &[a]) => unit(f64::from(a as i8), 127.0),
            (ComponentType::U8, &[a]) => unit(f64::from(a), 255.0),
            (ComponentType::I16, &[a, b]) => unit(f64::from(i16::from_le_bytes([a, b])), 32_767.0),
            (ComponentType::U16, &[a, b]) => unit(f64::from(u16::from_le_bytes([a, b])), 65_535.0),
            (ComponentType::U32, &[a, b, c, d]) => f64::from(u32::from_le_bytes([a, b, c, d])),
            (ComponentType::F32, &[a, b, c, d]) => f64::from(f32::from_le_bytes([a, b, c, d])),
            _ => f64::NAN,
        }
    }

    fn element(&self, bytes: &[u8], out: &mut [f64]) {
        for (slot, raw) in out.iter_mut().zip(bytes.chunks_exact(self.component_size())) {
            *slot = self.number(raw);
        }
    }
}

impl<'a> Accessors<'a> {
    pub(super) fn new(document: Document<'a>, buffers: &'a Buffers) -> Self {
        // Many accessors may show the same bytes, but there is no sense in many times as many
        // numbers as bytes: a small file could take all memory.
        let budget = Cell::new((1 << 22) + 16 * buffers.total());
        Self { document, buffers, budget }
    }

    /// Counts numbers that are about to take memory, or refuses them.
    pub(super) fn charge(&self, numbers: u64, path: &str) -> Result<(), LoadError> {
        let left = self.budget.get().checked_sub(numbers).ok_or_else(|| {
            self.document.invalid(path, "there are many more numbers than bytes in buffers")
        })?;
        self.budget.set(left);
        Ok(())
    }

    /// The elements of an accessor, which must be of so many numbers; if they are fewer than N, they
    /// are filled up with 1, as colours without alpha are.
    pub(super) fn vectors<const N: usize>(
        &self,
        index: Index<Accessor>,
        numbers: RangeInclusive<usize>,
    ) -> Result<Vec<[f64; N]>, LoadError> {
        let path = format!("accessors[{}]", index.value());
        let invalid = |reason: &str| self.document.invalid(&path, reason);
        let accessor = self.document.root.get(index).ok_or_else(|| invalid("missing"))?;
        let (Checked::Valid(kind), Checked::Valid(component)) =
            (accessor.type_, accessor.component_type)
        else {
            return Err(invalid("of an unknown type"));
        };
        let components = kind.multiplicity();
        let is_plain = !matches!(kind, Type::Mat2 | Type::Mat3);
        if !numbers.contains(&components) || components > N || !is_plain {
            return Err(invalid(&format!("elements of {components} numbers do not belong here")));
        }
        self.charge(accessor.count.0.saturating_mul(N as u64), &path)?;
        let normalized = accessor.normalized;
        let layout = Layout { component: component.0, components, normalized };
        let mut elements = self.dense(accessor, &layout, &path)?;
        self.apply_sparse(accessor, &layout, &path, &mut elements)?;
        Ok(elements)
    }

    /// The elements, or zeros where there is no view.
    fn dense<const N: usize>(
        &self,
        accessor: &Accessor,
        layout: &Layout,
        path: &str,
    ) -> Result<Vec<[f64; N]>, LoadError> {
        let mut filler = [1.0; N];
        filler[..layout.components].fill(0.0);
        let count = accessor.count.0;
        let Some(view) = accessor.buffer_view else {
            // The budget bounds the count.
            return Ok(vec![filler; count as usize]);
        };
        let offset = accessor.byte_offset.unwrap_or_default().0;
        let bytes = self.buffers.view(self.document, view)?;
        let stride = self.document.root.get(view).and_then(|view| view.byte_stride);
        let stride = stride.map_or(0, |stride| stride.0);
        let raw = self.elements(bytes, offset, count, stride, layout, path)?;
        Ok(raw
            .map(|raw| {
                let mut element = filler;
                layout.element(raw, &mut element);
                element
            })
            .collect())
    }

    /// The bytes of `count` elements; a stride of 0 means that they are tightly packed.
    fn elements<'b>(
        &self,
        bytes: &'b [u8],
        offset: u64,
        count: u64,
        stride: usize,
        layout: &Layout,
        path: &str,
    ) -> Result<impl Iterator<Item = &'b [u8]> + use<'b>, LoadError> {
        let size = layout.element_size();
        let stride = if stride == 0 { size } else { stride };
        if stride < size {
            let reason = "the stride of its view is shorter than its elements";
            return Err(self.document.invalid(path, reason));
        }
        let start = usize::try_from(offset).ok().and_then(|offset| bytes.get(offset..));
        let count = usize::try_from(count).ok();
        let needed = count.and_then(|count| match count.checked_sub(1) {
            Some(before) => before.checked_mul(stride)?.checked_add(size),
            None => Some(0),
        });
        match (start, needed, count) {
            (Some(start), Some(needed), Some(count)) if needed <= start.len() => {
                Ok(start.chunks(stride).take(count).map(move |chunk| &chunk[..size]))
            }
            _ => Err(self.document.invalid(path, "reaches beyond its buffer view")),
        }
    }

    /// Replaces the elements that a sparse accessor names.
    fn apply_sparse<const N: usize>(
        &self,
        accessor: &Accessor,
        layout: &Layout,
        path: &str,
        elements: &mut [[f64; N]],
    ) -> Result<(), LoadError> {
        let Some(sparse) = &accessor.sparse else { return Ok(()) };
        let path = format!("{path}.sparse");
        let Checked::Valid(component) = sparse.indices.component_type else {
            return Err(self.document.invalid(&path, "indices of an unknown type"));
        };
        let index_layout = Layout { component: component.0, components: 1, normalized: false };
        let count = sparse.count.0;
        let view = self.buffers.view(self.document, sparse.indices.buffer_view)?;
        let offset = sparse.indices.byte_offset.0;
        let indices = self.elements(view, offset, count, 0, &index_layout, &path)?;
        let view = self.buffers.view(self.document, sparse.values.buffer_view)?;
        let offset = sparse.values.byte_offset.0;
        let values = self.elements(view, offset, count, 0, layout, &path)?;
        let total = elements.len();
        for (index, value) in indices.zip(values) {
            let index = index_layout.number(index);
            let Some(element) = elements.get_mut(index as usize) else {
                let reason = format!("index {index} is out of range: there are {total} elements");
                return Err(self.document.invalid(&path, reason));
            };
            layout.element(value, element);
        }
        Ok(())
    }
}
