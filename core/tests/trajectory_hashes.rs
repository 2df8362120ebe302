//! The bits of the default study: the same in every build and on every target.
//!
//! `tests/trajectory_hashes.json` holds the hashes. This test is run optimised with debug assertions and, by `cargo xtask test`,
//! again in a release build and with the `unoptimized` profile; the end-to-end tests compare the program and the browser with
//! the same file. A change of
//! any operation in the core changes the hashes: then, and only then, put the new ones in, and say so in the changelog.

use adaptarm_core::scenario::{Scenario, Scheme};
use serde_json::Value;

/// Unoptimised, every intermediate number of a kernel has its own place on the stack: more together than the 2 MiB that a test's thread has.
const STACK_BYTES: usize = 8 << 20;

#[test]
fn default_study_has_its_golden_bits() {
    let thread = std::thread::Builder::new().stack_size(STACK_BYTES).spawn(compare_with_golden_bits).unwrap();
    thread.join().unwrap();
}

fn compare_with_golden_bits() {
    let golden: Value = serde_json::from_str(include_str!("trajectory_hashes.json")).unwrap();
    let mut found = serde_json::Map::new();
    for scheme in Scheme::ALL {
        let report = Scenario::new(scheme.paper()).unwrap().run().report;
        found.insert(scheme.id().to_owned(), report.trajectory_hash.into());
    }
    assert_eq!(golden, Value::Object(found), "the default study gives other bits than before");
}
