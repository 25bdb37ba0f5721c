//! `cargo xtask test`.

use crate::python;
use crate::steps::Steps;

/// Runs every test. Examples are run by a test of the crate `kdray-tests`.
pub(crate) fn run() -> Result<(), String> {
    let mut steps = Steps::new();
    steps.cargo("tests and examples", "test --workspace --all-targets", &[])?;
    steps.cargo("tests of the documentation", "test --workspace --doc", &[])?;
    // Without optimisation, for these tests take longer to compile than to run.
    let bare = "test -p kdray --no-default-features --lib --config profile.dev.opt-level=0";
    steps.cargo("tests, library without default features", bare, &[])?;
    python::run(&mut steps)?;
    steps.finish("test");
    Ok(())
}
