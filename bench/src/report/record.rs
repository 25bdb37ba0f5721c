//! Runs that are kept, in `bench/records`.

use super::file::Output;
use super::{Report, plot, say, table, to_json};
use crate::error::BenchError;
use std::fs;
use std::path::Path;

/// Writes `YYYY-MM-DD-<cpu>.json`, `.md` and `.svg` into `folder`.
pub(super) fn write(folder: &Path, report: &Report) -> Result<(), BenchError> {
    fs::create_dir_all(folder).map_err(|error| BenchError::io(folder, error))?;
    let stem = stem(report);
    let path = |ending: &str| folder.join(format!("{stem}.{ending}"));
    Output::create(&path("json"))?.write(&to_json(report))?;
    Output::create(&path("svg"))?.write(&plot::picture(report, &path("svg"))?)?;
    Output::create(&path("md"))?.write(markdown(report, &stem).as_bytes())?;
    say(&format!("kept as {stem} in {}", folder.display()));
    Ok(())
}

/// Date and processor in characters that any file system takes.
fn stem(report: &Report) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { ' ' };
    let cpu = report.machine.cpu.replace("(R)", "").replace("(TM)", "");
    let cpu: String = cpu.chars().map(plain).collect();
    let words: Vec<&str> = cpu.split_whitespace().collect();
    format!("{}-{}", report.machine.date, words.join("-"))
}

fn markdown(report: &Report, stem: &str) -> String {
    let tables = table::text(report);
    format!(
        "# Comparison of {}\n\n![ratios]({stem}.svg)\n\n```\n{tables}```\n",
        report.machine.date
    )
}

#[cfg(test)]
mod tests {
    use super::super::tests::report;
    use super::*;

    #[test]
    fn records_name_date_and_processor() {
        let mut report = report();
        report.machine.cpu = "Intel(R) Xeon(R) Processor @ 2.80GHz".to_owned();
        report.machine.date = "2026-11-22".to_owned();
        assert_eq!(stem(&report), "2026-11-22-intel-xeon-processor-2-80ghz");
        let folder = tempfile::tempdir().unwrap();
        write(folder.path(), &report).unwrap();
        let text = fs::read_to_string(folder.path().join(format!("{}.md", stem(&report)))).unwrap();
        assert!(text.contains("Xeon") && text.contains("dragon"), "{text}");
        assert!(folder.path().join(format!("{}.json", stem(&report))).exists());
    }
}
