#![no_main]

use kdray_tests::fuzz;

libfuzzer_sys::fuzz_target!(
    init: fuzz::write_seeds("build_and_query_f64"),
    |data: &[u8]| fuzz::run("build_and_query_f64", data)
);
