//! Feeds some inputs to every target that needs no other program; `fem-fuzz all 1000000` feeds more.

use std::path::Path;
use std::time::Duration;

use fem_fuzz::{TARGETS, bounds, try_inputs};

#[global_allocator]
static ALLOCATOR: bounds::Counting = bounds::Counting;

/// Number of inputs per target, which take one or two seconds.
const INPUTS: [(&str, u64); 6] = [
    ("mesh", 3000),
    ("table", 2000),
    ("sweep", 1000),
    ("checkpoint", 300),
    ("code", 400),
    ("case", 100),
];

#[test]
fn every_reader_accepts_or_rejects_some_inputs() {
    let is_fed = |name: &str| INPUTS.iter().any(|(known, _)| *known == name);
    let others: Vec<_> =
        TARGETS.iter().map(|target| target.name).filter(|name| !is_fed(name)).collect();
    assert_eq!(others, ["command"]);
    for (name, n) in INPUTS {
        let entry = TARGETS.iter().find(|target| target.name == name).expect("a target");
        let target = (entry.make)(Path::new("absent"));
        bounds::limit_memory(1_500_000_000);
        let counts = try_inputs(&*target, 7, 0..n, 2, Duration::from_secs(120));
        assert!(counts.findings.is_empty(), "{name}: {:?}", counts.findings);
        // Useful mutations give both valid and invalid inputs.
        assert!(counts.accepted > n / 100 && counts.rejected > n / 100, "{name}: {counts:?}");
    }
}
