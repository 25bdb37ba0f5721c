//! From what was found to what is kept in the repository.

use super::folders::{Folders, count, make};
use super::programs::{Target, program};
use super::watch::watch;
use crate::steps::say;
use std::fs::{self, File};
use std::io;
use std::path::Path;
use std::process::Stdio;
use std::sync::atomic::{AtomicBool, Ordering};

/// How many inputs a target's corpus may have.
const MOST_INPUTS: usize = 64;

/// How many bytes it may have.
const MOST_BYTES: u64 = 40_000;

/// Makes a target's corpus anew: as few of all inputs as cover what all cover, or as many of these as there is room
/// for. The old one is replaced when the new one is whole.
pub(super) fn keep(folders: &Folders, target: &Target, stop: &AtomicBool) -> Result<(), String> {
    let name = &target.name;
    let (kept, old) = (folders.work("kept").join(name), folders.work("old").join(name));
    let (corpus, found, seeds) = (folders.corpus(name), folders.found(name), folders.seeds(name));
    let told = |error: io::Error| format!("{name}: {error}");
    for folder in [&kept, &old] {
        remove(folder).map_err(told)?;
    }
    for folder in [&kept, &folders.work("old"), &corpus, &found, &folders.work("logs")] {
        make(folder)?;
    }
    let mut command = program(folders, target)?;
    command.arg("-set_cover_merge=1").args([&kept, &corpus, &found, &seeds]);
    let child = command.stderr(Stdio::piped()).spawn();
    let mut child = child.map_err(|error| format!("{name}: cannot be started: {error}"))?;
    let log = File::create(folders.work("logs").join(name).with_extension("keep.log"));
    watch(&mut child, log.map_err(told)?, stop, |spent| {
        say(&format!("    {name}: {} s", spent.wall.as_secs()));
    });
    if stop.load(Ordering::SeqCst) {
        return Ok(());
    }
    let status = child.wait().map_err(told)?;
    if !status.success() || count(&kept) == 0 {
        return Err(format!("{name}: the inputs cannot be merged ({status})"));
    }
    let bytes = cut(&kept).map_err(told)?;
    fs::rename(&corpus, &old).and_then(|()| fs::rename(&kept, &corpus)).map_err(told)?;
    say(&format!("    {name}: {} inputs of {bytes} bytes in all", count(&corpus)));
    Ok(())
}

/// Removes a folder, if it is there.
fn remove(folder: &Path) -> io::Result<()> {
    if folder.exists() { fs::remove_dir_all(folder) } else { Ok(()) }
}

/// Leaves inputs out until few enough are left: one in so many of all sizes. Their bytes are counted.
fn cut(folder: &Path) -> io::Result<u64> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        files.push((entry.metadata()?.len(), entry.path()));
    }
    files.sort();
    let sizes: Vec<_> = files.iter().map(|(bytes, _)| *bytes).collect();
    let chosen = chosen(&sizes);
    for (index, (_, path)) in files.iter().enumerate() {
        if chosen.binary_search(&index).is_err() {
            fs::remove_file(path)?;
        }
    }
    Ok(chosen.iter().map(|&index| sizes[index]).sum())
}

/// Which inputs of rising sizes are kept: the most that there is room for if they are taken evenly, so that large ones
/// are not left out for being large. The largest that fits is among them.
fn chosen(sizes: &[u64]) -> Vec<usize> {
    let count = sizes.partition_point(|&size| size <= MOST_BYTES);
    let evenly = |most: usize| (0..most).map(move |i| (i + 1) * count / most - 1);
    let fits = |&most: &usize| evenly(most).map(|index| sizes[index]).sum::<u64>() <= MOST_BYTES;
    let most = (1..=count.min(MOST_INPUTS)).rev().find(fits);
    most.map_or_else(Vec::new, |most| evenly(most).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_small_inputs_are_all_kept() {
        assert_eq!(chosen(&[]), [0; 0]);
        assert_eq!(chosen(&[1, 2, 3]), [0, 1, 2]);
        assert_eq!(chosen(&[1; 200]).len(), MOST_INPUTS);
    }

    #[test]
    fn of_too_many_bytes_all_sizes_are_kept() {
        let sizes: Vec<u64> = (1..=100).map(|i| 80 * i).collect();
        let chosen = chosen(&sizes);
        let bytes: u64 = chosen.iter().map(|&index| sizes[index]).sum();
        assert!(bytes <= MOST_BYTES && chosen.len() > 7, "{bytes} bytes of {chosen:?}");
        assert!(chosen.is_sorted() && chosen[0] < 20 && chosen.last() == Some(&99), "{chosen:?}");
    }

    #[test]
    fn what_is_too_large_alone_is_not_kept() {
        assert_eq!(chosen(&[MOST_BYTES + 1]), [0; 0]);
        assert_eq!(chosen(&[1, 2, MOST_BYTES + 1]), [0, 1]);
    }
}
