//! What a running program tells, and the processor time it takes.

use std::io::{BufRead, BufReader, Read, Write};
use std::process::Child;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::thread;
use std::time::{Duration, Instant};
use sysinfo::{Pid, ProcessRefreshKind, ProcessesToUpdate, System};

/// What a run came to.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Spent {
    /// Inputs that were run.
    pub(super) executions: u64,
    /// Processor time, to a quarter of a second.
    pub(super) cpu: Duration,
    /// Time on the clock.
    pub(super) wall: Duration,
}

/// Waits for a program to end, and ends it itself when `stop` says so. What it tells goes to `log`; `progress` is
/// called every so often.
pub(super) fn watch(
    child: &mut Child,
    log: impl Write + Send,
    stop: &AtomicBool,
    mut progress: impl FnMut(Spent),
) -> Spent {
    const STEP: Duration = Duration::from_millis(250);
    const TOLD_EVERY: Duration = Duration::from_secs(30);
    let (started, mut told) = (Instant::now(), Instant::now());
    let executions = AtomicU64::new(0);
    let mut clock = Clock::new(child.id());
    let source = child.stderr.take();
    thread::scope(|scope| {
        if let Some(source) = source {
            scope.spawn(|| follow(source, log, &executions));
        }
        let mut spent = Spent::default();
        while let Ok(None) = child.try_wait() {
            thread::sleep(STEP);
            let cpu = clock.read().max(spent.cpu);
            let executions = executions.load(Ordering::Relaxed);
            spent = Spent { executions, cpu, wall: started.elapsed() };
            if told.elapsed() > TOLD_EVERY {
                told = Instant::now();
                progress(spent);
            }
            if stop.load(Ordering::SeqCst) {
                end(child);
            }
        }
        spent
    })
    .with_executions(&executions)
}

impl Spent {
    /// The number as it is once all was read.
    fn with_executions(self, executions: &AtomicU64) -> Self {
        Self { executions: executions.load(Ordering::Relaxed), ..self }
    }
}

/// Ends a program. What it found is in files already.
fn end(child: &mut Child) {
    // Time to end by itself: Ctrl-C reaches it, too.
    thread::sleep(Duration::from_secs(1));
    let _ = child.kill();
}

/// Copies what a program tells, and takes note of how many inputs it has run.
fn follow(source: impl Read, mut log: impl Write, executions: &AtomicU64) {
    for line in BufReader::new(source).split(b'\n').map_while(Result::ok) {
        let text = String::from_utf8_lossy(&line);
        if let Some(count) = executed(&text) {
            executions.fetch_max(count, Ordering::Relaxed);
        }
        // A full disk ends the log and not the run.
        let _ = writeln!(log, "{text}");
    }
}

/// The number in a line such as `#1234 NEW cov: …` or `stat::number_of_executed_units: 1234`.
fn executed(line: &str) -> Option<u64> {
    let rest =
        line.strip_prefix('#').or_else(|| line.strip_prefix("stat::number_of_executed_units:"));
    rest?.split_whitespace().next()?.parse().ok()
}

/// The processor time of a process; zero where the system does not tell.
struct Clock {
    system: Option<System>,
    id: Pid,
}

impl Clock {
    fn new(id: u32) -> Self {
        Self { system: System::new().ok(), id: Pid::from_u32(id) }
    }

    fn read(&mut self) -> Duration {
        let only = [self.id];
        let what = ProcessRefreshKind::nothing().with_cpu();
        let Some(system) = &mut self.system else { return Duration::ZERO };
        system.refresh_processes_specifics(ProcessesToUpdate::Some(&only), false, what);
        system
            .process(self.id)
            .map_or(Duration::ZERO, |it| Duration::from_millis(it.accumulated_cpu_time()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_of_the_program_are_read() {
        assert_eq!(executed("#4096\tpulse  cov: 52 ft: 70 corp: 6/6b"), Some(4096));
        assert_eq!(executed("stat::number_of_executed_units: 812"), Some(812));
        assert_eq!(executed("==7== ERROR: libFuzzer: deadly signal"), None);
        assert_eq!(executed("    #3 0x55 in main"), None);
    }
}
