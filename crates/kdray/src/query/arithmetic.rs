//! How hits are decided.

/// How closest-hit and any-hit queries on a mesh decide what is hit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Arithmetic {
    /// As if in real arithmetic on the given numbers: fast arithmetic with an error bound, and an
    /// exact test where that cannot tell. t is good to 2^-39.
    #[default]
    Exact,
    /// Plain floating point in f32, as in other libraries: somewhat faster, but rays may slip
    /// through edges and vertices, and t, u and v are good to some five digits, the last of which depend on the
    /// [`InstructionSet`](crate::InstructionSet); to fewer where coordinates are much larger than triangles. Scenes of f64 vertices
    /// are exact by this, too, and so are those rays of a packet that it answers as one.
    Float,
}
