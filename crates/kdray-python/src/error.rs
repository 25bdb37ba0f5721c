//! The package's exceptions, which `kdray/errors.py` defines.

use pyo3::{PyErr, import_exception};
use std::any::Any;

import_exception!(kdray.errors, ArgumentError);
import_exception!(kdray.errors, BuildError);
import_exception!(kdray.errors, FileError);
import_exception!(kdray.errors, InternalError);
import_exception!(kdray.errors, KdrayError);
import_exception!(kdray.errors, MissingFileError);
import_exception!(kdray.errors, SceneError);
import_exception!(kdray.errors, UnsupportedError);

/// What callers say who take rays and points as they come.
pub(crate) const LENIENT: &str = "invalid=\"miss\"";

/// What became of a panic: a mistake of kdray, told as an exception.
pub(crate) fn of_panic(payload: &(dyn Any + Send)) -> PyErr {
    let text = payload.downcast_ref::<&str>().map(|text| (*text).to_owned());
    let text = text.or_else(|| payload.downcast_ref::<String>().cloned());
    let text = text.unwrap_or_else(|| "a panic without a message".to_owned());
    InternalError::new_err(format!("this is a mistake in kdray, please report it: {text}"))
}

/// That an argument cannot be used.
pub(crate) fn argument(name: &str, reason: impl std::fmt::Display) -> PyErr {
    ArgumentError::new_err(format!("{name}: {reason}"))
}
