//! `kdray merge`: a picture from parts that several machines have rendered.

use crate::{
    args::bits,
    cli::Globals,
    error::CliError,
    interrupt,
    output::Output,
    picture_file::{Format, write},
    progress::Progress,
    wording::counted,
};
use kdray_render::{Merge, MergeError, Picture, PngDepth};
use std::{
    fs::File,
    io::BufReader,
    path::{Path, PathBuf},
};

/// Put a picture together from parts that `render` wrote
///
/// Parts are OpenEXR files of the same picture, each with other pixels (`render --crop`), other
/// samples (`render --sample-range`), or both. They are read one by one, in any order.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example: a picture in two halves
  kdray render bunny.ply -o left.exr --crop 0,0,480x540
  kdray render bunny.ply -o right.exr --crop 480,0,480x540
  kdray merge left.exr right.exr -o bunny.png

Example: what is there so far
  kdray merge tile_*.exr -o preview.png --allow-missing")]
pub(crate) struct Args {
    /// OpenEXR files of `render`, or of `merge`
    #[arg(value_name = "PART.exr", required = true)]
    parts: Vec<PathBuf>,
    /// The picture: a name that ends in .png or .exr; it may be one of the parts
    #[arg(long, short, value_name = "OUT.png|exr")]
    out: PathBuf,
    /// Leave pixels that no part has transparent, and take the samples of the others that there are
    #[arg(long)]
    allow_missing: bool,
    /// Bits a channel, 8 without it; only for .png
    #[arg(long, value_name = "8|16", value_parser = bits)]
    bits: Option<PngDepth>,
}

/// Reads, adds up and writes.
pub(crate) fn run(args: &Args, globals: &Globals) -> Result<(), CliError> {
    let format = Format::of(&args.out)?;
    format.check_bits(args.bits)?;
    let mut output = Output::create(&args.out)?;
    let progress = Progress::start("merging", args.parts.len() as u64, "parts", globals);
    let picture = {
        let _watch = interrupt::watch();
        let picture = merge(args, &progress)?;
        write(&picture, format, args.bits, &mut output, &args.out)?;
        picture
    };
    output.commit()?;
    let took = progress.elapsed();
    progress.finish(&format!(
        "merged {} into {} in {took:.2?}: {}",
        counted(args.parts.len(), "part", "parts"),
        described(&picture),
        args.out.display()
    ));
    Ok(())
}

/// The picture of all parts, of which one at a time is in memory.
fn merge(args: &Args, progress: &Progress) -> Result<Picture, CliError> {
    let mut merge = Merge::default();
    if args.allow_missing {
        merge = merge.allow_missing();
    }
    for path in &args.parts {
        if interrupt::requested() {
            return Err(CliError::Interrupted);
        }
        merge.add(&path.display().to_string(), &read(path)?)?;
        progress.advance(1);
    }
    Ok(merge.finish()?)
}

fn read(path: &Path) -> Result<Picture, CliError> {
    let file = File::open(path).map_err(|error| CliError::input(path, error))?;
    Picture::read_exr(BufReader::new(file)).map_err(|error| CliError::input(path, error))
}

/// `64 x 36 pixels`, or how much of them there is.
fn described(picture: &Picture) -> String {
    let all = format!("{} x {} pixels", picture.width, picture.height);
    let rendered = picture.rendered.iter().filter(|&&rendered| rendered).count();
    let part = &picture.part;
    let there = match picture.ids("samples", "count") {
        Some(counts) => counts.iter().map(|&count| f64::from(count)).sum(),
        None => rendered as f64 * part.sample_range.len() as f64,
    };
    let share = there / (picture.rendered.len() as f64 * f64::from(part.samples));
    if share < 1.0 { format!("{:.1} % of {all}", share * 100.0) } else { all }
}

impl From<MergeError> for CliError {
    fn from(error: MergeError) -> Self {
        match error {
            MergeError::Missing { .. } => Self::Merge(format!("{error} with --allow-missing")),
            error => Self::Merge(error.to_string()),
        }
    }
}
