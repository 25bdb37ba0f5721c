//! What was spent on each target, over all runs.

use super::folders::{Folders, count, make};
use super::programs::Target;
use super::watch::Spent;
use std::collections::BTreeMap;
use std::fmt::Write;
use std::fs;
use std::time::Duration;

/// Executions, and times in milliseconds, of each target: in all, and in this call.
pub(super) struct Ledger {
    all: BTreeMap<String, Spent>,
    now: BTreeMap<String, Spent>,
}

impl Ledger {
    const FILE: &'static str = "spent.txt";

    /// What earlier calls left; nothing if there were none.
    pub(super) fn read(folders: &Folders) -> Self {
        let text = fs::read_to_string(folders.work(Self::FILE)).unwrap_or_default();
        let entry = |line: &str| {
            let mut words = line.split_whitespace();
            let name = words.next()?.to_owned();
            let mut number = || words.next()?.parse::<u64>().ok();
            let executions = number()?;
            let [cpu, wall] = [number()?, number()?].map(Duration::from_millis);
            Some((name, Spent { executions, cpu, wall }))
        };
        Self { all: text.lines().filter_map(entry).collect(), now: BTreeMap::new() }
    }

    /// Adds a run, and saves the sums: to a file beside, which then takes the place of the old one.
    pub(super) fn add(
        &mut self,
        folders: &Folders,
        name: &str,
        spent: Spent,
    ) -> Result<(), String> {
        for sums in [&mut self.all, &mut self.now] {
            let sum = sums.entry(name.to_owned()).or_default();
            sum.executions += spent.executions;
            sum.cpu += spent.cpu;
            sum.wall += spent.wall;
        }
        let mut text = String::new();
        for (name, Spent { executions, cpu, wall }) in &self.all {
            let _ = writeln!(text, "{name} {executions} {} {}", cpu.as_millis(), wall.as_millis());
        }
        let (file, beside) = (folders.work(Self::FILE), folders.work("spent.new"));
        make(&folders.work(""))?;
        let saved = fs::write(&beside, text).and_then(|()| fs::rename(&beside, &file));
        saved.map_err(|error| format!("{}: {error}", file.display()))
    }

    /// A line a target.
    pub(super) fn table(&self, folders: &Folders, targets: &[Target]) -> String {
        let mut text = format!(
            "\n{:<20} {:>12} {:>8} {:>9} {:>13} {:>9} {:>7} {:>8}\n",
            "target", "executions", "exec/s", "CPU, min", "in all", "CPU, min", "corpus", "crashes"
        );
        for target in targets {
            let name = target.name.as_str();
            let [now, all] =
                [&self.now, &self.all].map(|sums| sums.get(name).copied().unwrap_or_default());
            let rate = now.executions as f64 / now.wall.as_secs_f64().max(1e-3);
            let [cpu, all_cpu] = [now, all].map(|spent| spent.cpu.as_secs_f64() / 60.0);
            let _ = writeln!(
                text,
                "{name:<20} {:>12} {rate:>8.0} {cpu:>9.1} {:>13} {all_cpu:>9.1} {:>7} {:>8}",
                now.executions,
                all.executions,
                count(&folders.corpus(name)) + count(&folders.found(name)),
                folders.failures(name)
            );
        }
        text
    }
}
