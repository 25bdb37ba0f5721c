#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| kdray_tests::fuzz::run("instances", data));
