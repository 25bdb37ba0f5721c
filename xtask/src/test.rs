//! `cargo xtask test`.

use crate::python;
use crate::steps::Steps;

/// Runs every test. Examples are run by a test of the crate `kdray-tests`.
pub(crate) fn run() -> Result<(), String> {
    let mut steps = Steps::new();
    steps.cargo("tests and examples", "test --workspace --test * --examples", &[])?;
    let others = "test --workspace --exclude kdray --lib --bins";
    steps.cargo("tests of parts, other crates", others, &[])?;
    steps.cargo("tests of the documentation", "test --workspace --doc", &[])?;
    // Without optimisation, for these tests take longer to compile than to run.
    let library = "test -p kdray --lib --config profile.dev.opt-level=0";
    steps.cargo("tests of parts, library", library, &[])?;
    let bare = format!("{library} --no-default-features");
    steps.cargo("tests of parts, library without default features", &bare, &[])?;
    python::run(&mut steps)?;
    steps.finish("test");
    Ok(())
}
