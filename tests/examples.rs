//! The examples of the library run, and print what they promise.

use std::path::PathBuf;
use std::process::Command;
use std::sync::LazyLock;

/// Where the examples are, once they are built: with all of the workspace, whose libraries are there already. For
/// one package alone cargo would compile the library anew.
static EXAMPLES: LazyLock<PathBuf> = LazyLock::new(|| {
    let manifest = concat!(env!("CARGO_MANIFEST_DIR"), "/../Cargo.toml");
    let arguments = ["build", "--quiet", "--workspace", "--examples", "--manifest-path", manifest];
    let built = Command::new(env!("CARGO")).args(arguments).output().expect("cargo can be started");
    assert!(built.status.success(), "{}", String::from_utf8_lossy(&built.stderr));
    let own = std::env::current_exe().expect("a test knows its own path");
    own.ancestors().nth(2).expect("it is in target/PROFILE/deps").join("examples")
});

/// What an example prints.
fn output_of(example: &str) -> String {
    let output = Command::new(EXAMPLES.join(example)).output().expect("the example can be started");
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{example} failed: {errors}");
    String::from_utf8(output.stdout).expect("examples print text")
}

#[track_caller]
fn assert_prints(example: &str, lines: &[&str]) {
    let output = output_of(example);
    for line in lines {
        assert!(output.contains(line), "{example} does not print {line:?}:\n{output}");
    }
}

#[test]
fn lecture_prints_the_numbers_of_the_lecture() {
    assert_prints(
        "lecture",
        &[
            "is met at t_x = 2\n",
            "is met at t_y = 1.5\n",
            "t_x > t_y is true",
            "x: l = -5, h = 5, so m = -5, M = 5",
            "y: l = -20, h = 20, so m = -20, M = 20",
            "z: l = 4, h = 9, so m = 4, M = 9",
            "t_min = 4 < t_max = 5: HIT",
            "t_split > t_far: the near child, the far one is dropped",
            "t_near < t_split < t_far: the near child first, the far one onto the stack",
            "t_split < t_near: only the far child",
        ],
    );
}

#[test]
fn own_shape_draws_its_columns_and_passes_two_of_them() {
    assert_prints(
        "own_shape",
        &["16 columns", "####", "t =  5.3675  column  4  from its Front", "blocked? false"],
    );
}

#[test]
fn plan_2d_sees_through_doors_and_not_through_walls() {
    assert_prints("plan_2d", &["E", "east       wall  1 at t = 9.000, (16.00, 2.25); 1 walls"]);
}
