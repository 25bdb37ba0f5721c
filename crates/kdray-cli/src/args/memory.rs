//! Limits of memory: `8GiB`, `500MB`, `none`; and how much there is.

use super::bytes;
use std::str::FromStr;
use sysinfo::{ProcessRefreshKind, ProcessesToUpdate, System, get_current_pid};

/// How much memory the build of a tree may take.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum MemoryLimit {
    /// As much as is available when it begins.
    #[default]
    Available,
    /// So many bytes.
    Bytes(u64),
    /// Any amount.
    None,
}

impl MemoryLimit {
    /// In bytes, as of now; `None` if there is no limit, or the system does not tell.
    pub(crate) fn bytes(self) -> Option<u64> {
        match self {
            Self::Available => available(),
            Self::Bytes(bytes) => Some(bytes),
            Self::None => None,
        }
    }
}

/// How much memory can be had without swapping, by the machine and by the control group that the
/// process is in; `None` if neither is known.
fn available() -> Option<u64> {
    let mut system = System::new().ok()?;
    system.refresh_memory();
    let group = get_current_pid().ok().and_then(|pid| {
        let only = ProcessesToUpdate::Some(&[pid]);
        system.refresh_processes_specifics(only, false, ProcessRefreshKind::nothing());
        system.process(pid)?.cgroup_limits()
    });
    // What the group only holds to read files faster can be had, too.
    let group = group.map(|group| group.total_memory.saturating_sub(group.rss));
    least(system.available_memory(), group)
}

/// The least of what is known; the machine's is zero where the system does not tell.
fn least(machine: u64, group: Option<u64>) -> Option<u64> {
    Some(machine).filter(|&bytes| bytes > 0).into_iter().chain(group).min()
}

impl FromStr for MemoryLimit {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if text.eq_ignore_ascii_case("none") {
            return Ok(Self::None);
        }
        bytes(text).map(Self::Bytes).map_err(|error| error + ", or none")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_have_units() {
        let read = |text: &str| text.parse::<MemoryLimit>();
        assert_eq!(read("8GiB"), Ok(MemoryLimit::Bytes(8 << 30)));
        assert_eq!(read("1.5 g"), Ok(MemoryLimit::Bytes(3 << 29)));
        assert_eq!(read("500MB"), Ok(MemoryLimit::Bytes(500_000_000)));
        assert_eq!(read("4096"), Ok(MemoryLimit::Bytes(4096)));
        assert_eq!(read("none"), Ok(MemoryLimit::None));
        for bad in ["", "GiB", "-1GB", "1.2.3", "8 giants", "inf"] {
            assert!(read(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn the_machine_and_the_group_both_limit() {
        assert_eq!(least(8, Some(3)), Some(3));
        assert_eq!(least(2, Some(3)), Some(2));
        assert_eq!(least(2, None), Some(2));
        assert_eq!(least(0, Some(3)), Some(3));
        assert_eq!(least(0, None), None);
    }
}
