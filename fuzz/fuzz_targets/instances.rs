#![no_main]

use kdray_tests::fuzz;

libfuzzer_sys::fuzz_target!(
    init: fuzz::write_seeds("instances"),
    |data: &[u8]| fuzz::run("instances", data)
);
