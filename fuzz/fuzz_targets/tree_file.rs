#![no_main]

use kdray_tests::fuzz;

libfuzzer_sys::fuzz_target!(
    init: fuzz::write_seeds("tree_file"),
    |data: &[u8]| fuzz::run("tree_file", data)
);
