//! Tests which text is printed on stdout and which on stderr.

use std::path::Path;
use std::process::Stdio;

use crate::common::Place;

#[test]
fn stdout_has_the_report_and_stderr_the_messages() {
    let place = Place::new();
    let ran = place.succeed("case.toml --verbose");
    ran.prints(
        "A pair|restitution|contact time|µs|Hertz|ratio|momentum|viscoelasticity|off  gravity|warning:\
         |Result: runs/case",
    );
    assert!(ran.stderr.starts_with("case.toml: "), "{}", ran.stderr);
    assert!(!ran.stdout.contains('\u{1b}') && !ran.stderr.contains('\u{1b}'));
    // A run warns at its start as `check` does, about the expected contact, and at its end about the computed one.
    let warning = "the contact radius spans only 2.5 elements";
    let checked = place.succeed("check case.toml").stdout;
    assert!(checked.starts_with(&format!("warning:  {warning}")), "{checked}");
    assert_eq!(ran.stderr.matches(warning).count(), 1, "{}", ran.stderr);
    let warnings = place.json("runs/case/summary.json")["warnings"].to_string();
    assert!(warnings.contains("because of the mesh"), "{warnings}");
}

/// Where a run lacks what decides its results, the terminal and the report show the number as a bound, and the warning of what is
/// missing is the first one below the table.
#[test]
fn bounds_have_their_sign_on_terminal_and_report() {
    let place = Place::new();
    let pair = |material: &str, diameter: &str, speed: &str| {
        format!(
            "body = [{{ name = 'a', sphere.diameter = '{diameter}', material = '{material}', approach_speed = '{speed}' }},
                     {{ name = 'b', sphere.diameter = '{diameter}', material = '{material}' }}]\n"
        )
    };
    place.write("steel.toml", &pair("lib:steel", "10 mm", "5 m/s"));
    place.write("dust.toml", &pair("lib:fused-silica", "1 um", "1 cm/s"));
    place.write("fast.toml", &pair("lib:fused-silica", "1 um", "100 m/s"));
    for (command, restitution, warning) in [
        ("steel.toml", "≤ 1.0000", " yields from "),
        ("dust.toml", "≤ 1.0000", " would stick"),
        ("dust.toml --set contact.work_of_adhesion=0.1", "0.0000", " stay together"),
    ] {
        let text = place.succeed((command, "--set model=hertz --force --out out")).stdout;
        let row = text.lines().find(|line| line.starts_with("restitution")).unwrap();
        let is_bound = restitution.contains('≤');
        let cells: Vec<&str> = row.split_whitespace().skip(1).collect();
        assert!(cells.join(" ").starts_with(restitution), "{text}");
        let first = text.lines().find(|line| line.starts_with("warning:")).unwrap();
        assert!(first.contains(warning), "{text}");
        assert_eq!(text.contains("; ≤: upper bound"), is_bound, "{text}");
        assert!(!is_bound || !text.contains("1 - restitution"), "{text}");
        assert!(
            text.lines().all(|line| line.chars().count() <= 80 || line.contains(": ")),
            "{text}"
        );
        // The report's tiles say the same.
        let tile = if is_bound { "<b>≤ 1.000 <span></span></b>" } else { "<b>0.0" };
        assert!(place.text("out/report.html").contains(tile), "{command}");
    }
    // The numbers of a run that lacks nothing are the answer.
    place.succeed("fast.toml --set model=hertz").prints("this run");
}

/// Returns the lines that a text takes on a terminal of 80 columns.
fn lines(text: &str) -> usize {
    text.lines().map(|line| line.chars().count().max(1).div_ceil(80)).sum()
}

/// A run takes at most 20 lines of a terminal of 80 columns, and two more per warning. A terminal shows the warnings of
/// stderr once.
#[test]
fn report_of_a_run_fits_on_a_screen() {
    let place = Place::new();
    let steel = "body = [{ name = 'a', sphere.diameter = '10 mm', material = 'lib:steel', approach_speed = '5 m/s' },
                         { name = 'b', sphere.diameter = '10 mm', material = 'lib:steel' }]\n";
    place.write("steel.toml", steel);
    let cases = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases");
    for name in
        ["glass_0.5ms", "glass_0.5ms_elastic", "ball_on_block", "dust_grain", "three_bounces"]
    {
        let file = format!("{name}.toml");
        std::fs::copy(cases.join(&file), place.path(&file)).unwrap();
    }
    for (command, said) in [
        (
            "glass_0.5ms.toml",
            "on:  viscoelasticity (striker and target relax: |9 effects off, none above the tolerance of 1 %; -v lists them\n|No warnings.\nResult: ",
        ),
        (
            "ball_on_block.toml --set model=hertz",
            "effects off; above the tolerance of 1 %: partner waves; -v lists them",
        ),
        ("dust_grain.toml", "restitution                1.0000           0"),
        ("glass_0.5ms_elastic.toml --set model.condensed={}", "1 - restitution: less than "),
        ("three_bounces.toml --set model=ting", "bounces:  3, with restitution 0.|gravity"),
        (
            "three_bounces.toml --set model=condensed --set stop.bounces=500",
            ", …; -v lists them|at rest:",
        ),
        (
            "steel.toml --set model=auto",
            "model:   fem = {}, the cheapest within the tolerance|became plastic work",
        ),
    ] {
        // An earlier result would be announced.
        let _ = std::fs::remove_dir_all(place.path("out"));
        let ran = place.succeed((command, "--force --out out"));
        ran.prints(said);
        // A terminal has a bar in place of the lines of progress.
        let is_passing = |line: &str| line.starts_with("warning: ") || line.contains(" %  t = ");
        let announced: Vec<&str> = ran.stderr.lines().filter(|line| !is_passing(line)).collect();
        let n_lines = lines(&announced.join("\n")) + lines(&ran.stdout);
        let n_warnings = ran.stdout.matches("warning: ").count();
        assert!(n_lines <= 20 + 2 * n_warnings, "{n_lines} lines:\n{}{}", ran.stderr, ran.stdout);
        let all = place.succeed((command, "--force --out out -v")).stdout;
        assert!(all.contains("\nEffects\n") && lines(&all) > 20, "{all}");
    }
    // Neglected effects may change more than the numerical error of closed forms.
    let dust = place.succeed("dust_grain.toml --force --out out").stdout;
    assert!(!dust.contains("1 - restitution"), "{dust}");
    let uncertain =
        "glass_0.5ms.toml --set model=ting --set 'material.glass.youngs_modulus=\"63 ± 2 GPa\"'";
    place
        .succeed((uncertain, "--force --out out"))
        .prints("± input|; ± input: by uncertain inputs\n");
    place.fails(2, "glass_0.5ms.toml -v -q").tells("cannot be used with");
}

#[test]
fn quiet_prints_only_errors_and_warnings() {
    let place = Place::new();
    let ran = place.succeed("case.toml --quiet");
    assert_eq!(ran.stdout, "");
    ran.tells(" because of the mesh");
    assert!(ran.stderr.lines().all(|line| line.starts_with("warning: ")), "{}", ran.stderr);
    // A sphere that is really so large is not rejected, but reported.
    for command in
        [&["case.toml", "--set", "model=hertz", "--out", "odd"][..], &["check", "case.toml"]]
    {
        let odd = ["--quiet", "--set", "body.0.sphere.diameter=22.2 m"];
        let ran = place.succeed((command, odd));
        assert_eq!(ran.stdout, "");
        ran.tells("warning: the diameter of striker is 22.20 m");
    }
    let warnings = place.json("odd/summary.json")["warnings"].to_string();
    assert!(warnings.contains("a bare number is in metres"), "{warnings}");
    let ran = place.run("missing.toml --quiet");
    assert_eq!((ran.code, ran.stdout.as_str()), (Some(2), ""));
    ran.tells("missing.toml");
}

#[test]
fn control_characters_in_a_title_do_not_reach_the_terminal() {
    let place = Place::with(&crate::common::CASE.replace("A pair", "\\u001b[2J\\n# x = 1"));
    let ran = place.succeed("case.toml");
    assert!(!ran.stdout.contains('\u{1b}'), "{:?}", ran.stdout);
    let checked = place.succeed("check case.toml --resolved").stdout;
    assert!(checked.parse::<toml::Table>().is_ok(), "{checked}");
}

#[test]
fn closed_output_pipe_is_not_an_error() {
    let place = Place::new();
    for arguments in [&["check", "case.toml"][..], &["case.toml"], &["completions", "bash"]] {
        let mut command = place.command(arguments);
        let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        drop(child.stdout.take());
        let ran: crate::common::Ran = child.wait_with_output().unwrap().into();
        assert_eq!(ran.code, Some(0), "{arguments:?}: {}", ran.stderr);
    }
    // A closed stderr is no error either.
    let mut command = place.command("case.toml");
    let mut child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
    drop(child.stderr.take());
    assert_eq!(child.wait().unwrap().code(), Some(0));
}

#[test]
fn help_version_and_completions_are_there() {
    let place = Place::new();
    let help = place.succeed("--help").stdout;
    for expected in ["check", "mesh", "completions", "--set", "--threads", "130"] {
        assert!(help.contains(expected), "{expected}: {help}");
    }
    let version = place.succeed("--version").stdout;
    place.succeed("case.toml --set model=hertz");
    let summary = place.json("runs/case/summary.json");
    let expected = [&summary["version"], &summary["numerics"]].map(|it| it.as_str().unwrap());
    assert_eq!(version, format!("fem-run {} (numerics {})\n", expected[0], expected[1]));
    for command in ["check", "mesh", "completions"] {
        place.succeed([command, "--help"]);
    }
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let script = place.succeed(["completions", shell]).stdout;
        assert!(script.contains("fem-run"), "{shell}");
    }
}

/// A case may have the name of a command; a file name with a blank is quoted for a shell.
#[test]
fn a_case_named_like_a_command_runs_with_its_folder() {
    let place = Place::new();
    place.write("check", crate::common::CASE);
    place.succeed("./check --set model=ting");
    assert!(place.path("runs/check/summary.json").exists());
    place.succeed("new 'wei rd2'").prints("fem-run check 'wei rd2.toml'");
    place.succeed("new plain").prints("fem-run check plain.toml");
}
