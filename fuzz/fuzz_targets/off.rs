#![no_main]

use kdray_tests::fuzz;

libfuzzer_sys::fuzz_target!(
    init: fuzz::write_seeds("off"),
    |data: &[u8]| fuzz::run("off", data)
);
