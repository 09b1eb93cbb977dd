//! `fem-run validate` starts the program `fem-validate` beside it.

use std::env::consts::EXE_SUFFIX;
use std::fs;
use std::process::Command;

use crate::PROGRAM;
use crate::common::{Place, Ran};

#[test]
fn the_program_of_the_claims_is_that_beside_the_command() {
    let place = Place::new();
    let own = place.path(format!("fem-run{EXE_SUFFIX}"));
    // A link would lead to the program beside the first one.
    fs::copy(PROGRAM, &own).unwrap();
    let run =
        || Ran::from(Command::new(&own).args(["validate", "a b", "--list"]).output().unwrap());
    let missing = run();
    missing.tells("`cargo build --release -p fem-validate`, or put it there");
    assert_eq!((missing.code, missing.stderr.lines().count()), (Some(2), 1));
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        place.write("fem-validate", "#!/bin/sh\necho \"$#: $*\"; echo said >&2; exit 77\n");
        let script = place.path("fem-validate");
        fs::set_permissions(script, fs::Permissions::from_mode(0o755)).unwrap();
        let ran = run();
        assert_eq!((ran.stdout.as_str(), ran.stderr.as_str()), ("2: a b --list\n", "said\n"));
        assert_eq!(ran.code, Some(77));
    }
}
