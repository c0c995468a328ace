//! Bytes of a fuzzer go in; the promises about `plan` are checked on them.

#![no_main]

#[path = "../promises.rs"]
mod promises;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| promises::keep("plan", bytes));
