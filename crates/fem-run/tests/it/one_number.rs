//! One number, one status and one error bar wherever a result goes: terminal, summary, sweep, report, fit and export. A restitution
//! that is a bound reaches no contact law unless it is asked for.

use fem_case::library::materials;
use fem_case::parse_quantity;
use serde_json::Value;

use crate::common::Place;
use crate::texts::printed_numbers::odd_number;

const KEYS: [(&str, &str); 6] = [
    ("restitution", "restitution"),
    ("contact_time_s", "contact time"),
    ("peak_force_n", "peak force"),
    ("max_approach_m", "largest approach"),
    ("max_contact_radius_m", "largest contact radius"),
    ("peak_pressure_pa", "peak pressure"),
];

fn ball(diameter: &str, speed: &str, material: &str) -> String {
    format!(
        "[[body]]\nname = 'ball'\nsphere.diameter = '{diameter}'\napproach_speed = '{speed}'\nmaterial = '{material}'\n"
    )
}

fn floor(shape: &str) -> String {
    format!("[[body]]\nname = 'floor'\n{shape}\n")
}

/// A text about a quantity, read: `0.32 (≤ 1.0000)`, `62.46 ± 0.20 µs`, `479.1 ± ? µs`.
#[derive(Debug)]
struct Said {
    /// The measured value before a bound.
    measured: Option<String>,
    mark: &'static str,
    value: f64,
    /// Size of the last digit.
    digit: f64,
    bar: Option<f64>,
}

/// Reads a text; `None` of one without a number.
fn said(text: &str) -> Option<Said> {
    let plain =
        |c: char| "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().position(|it| it == c).map(|k| char::from(b'0' + k as u8));
    let text = text.replace("\u{a0}×\u{a0}10", "e").replace(['⁻', '−'], "-");
    let text: String = text.trim().chars().map(|c| plain(c).unwrap_or(c)).collect();
    let (measured, own) = match text.split_once(" (") {
        Some((measured, own)) => (Some(measured.to_string()), own.trim_end_matches(')')),
        None => (None, &*text),
    };
    let marks = ["≤", "≥", "± ?"];
    let mark = marks.into_iter().find(|mark| own.contains(mark)).unwrap_or("");
    let words: Vec<&str> =
        own.split_whitespace().filter(|word| !["≤", "≥", "±", "?"].contains(word)).collect();
    let has_bar = own.contains('±') && mark.is_empty();
    let (numbers, unit) = words.split_at_checked(if has_bar { 2 } else { 1 })?;
    let si = |number: &str| parse_quantity(&format!("{number} {}", unit.join(" "))).unwrap().0;
    let decimals = numbers[0].split_once('.').map_or(0, |(_, decimals)| decimals.len());
    let value = parse_quantity(&format!("{} {}", numbers[0], unit.join(" "))).ok()?.0;
    let (digit, bar) = (si(&format!("1e-{decimals}")), numbers.get(1).map(|bar| si(bar)));
    Some(Said { measured, mark, value, digit, bar })
}

/// Compares what two texts say of a quantity, one of them with fewer digits; bars have two.
fn compare_said(of: &str, text: &str, other: &str) {
    let (Some(a), Some(b)) = (said(text), said(other)) else {
        assert!(text.len() <= 3 && other.len() <= 3, "{of}: {text} / {other}");
        return;
    };
    assert_eq!((&a.measured, a.mark), (&b.measured, b.mark), "{of}: {text} / {other}");
    let digit = 0.51 * (a.digit + b.digit);
    assert!((a.value - b.value).abs() <= digit, "{of}: {text} / {other}: {a:?} {b:?}");
    if let (Some(a), Some(b)) = (a.bar, b.bar) {
        assert!((a - b).abs() <= 0.06 * a + digit, "{of}: {text} / {other}");
    }
}

/// Returns the text between two others, and what follows it.
fn between<'t>(text: &'t str, from: &str, to: &str) -> Option<(&'t str, &'t str)> {
    text.split_once(from)?.1.split_once(to)
}

/// Compares the line of a quantity on the terminal with its card and its cells in a comparison of the result with itself.
fn compare_pages(
    of: &str,
    line: &str,
    has_input: bool,
    card: &str,
    comparison: &str,
    status: &str,
) {
    let mut cells = line.split("  ").map(str::trim).filter(|cell| !cell.is_empty());
    let name = cells.next().unwrap();
    let [own, mesh, neglected, input] = [0; 4].map(|_| cells.next().unwrap());
    let of = &format!("{of}: {name}");
    let row = comparison.split("<tr>").find(|row| row.starts_with(&format!("<td>{name}"))).unwrap();
    let (first, rest) = between(row, "<td class=\"number\">", "</td>").unwrap();
    let (second, _) = between(rest, "<td class=\"number\">", "</td>").unwrap();
    let (second, difference) = second.split_once("<br>").unwrap_or((second, ""));
    compare_said(of, own, first);
    assert_eq!(first, second, "{of}");
    let expected = match status {
        "computed" => "the same",
        "bound" => ">\u{2013}<",
        _ => "",
    };
    assert!(difference.contains(expected), "{of}: {difference}");
    assert_eq!(neglected == "?", status == "bound", "{of}: {line}");
    let Some((value, notes)) = between(card, "<b>", "</b>") else {
        assert_eq!(status, "unknown", "{of}");
        return;
    };
    let value = value.replace("<span>", "").replace("</span>", "");
    compare_said(of, own, &value);
    assert_eq!(notes.contains("neglected effects ?"), status == "bound", "{of}: {notes}");
    assert!(status == "computed" || !notes.contains("1 − e"), "{of}: {notes}");
    if let Some(Said { bar: Some(bar), digit, .. }) = said(&value) {
        let parts = if has_input { vec![mesh, neglected, input] } else { vec![mesh, neglected] };
        let sum: f64 = parts.into_iter().filter_map(said).map(|it| it.value).sum();
        assert!((sum - bar).abs() < 0.1 * bar + digit, "{of}: {line} / {value}");
    }
}

/// Compares all faces of one case, and returns its summary.
fn compare(of: &str, text: &str) -> Value {
    let place = Place::with(text);
    let ran = place.succeed("case.toml --out result");
    let summary = place.json("result/summary.json");
    let json: Value =
        serde_json::from_str(&place.succeed("case.toml --json --out other").stdout).unwrap();
    let speed = &summary["case"]["body"][1]["approach_speed"];
    let vary = format!("case = 'case.toml'\n[vary]\n'body.1.approach_speed' = [{speed}]\n");
    place.write("sweep.toml", &vary);
    let sweep = place.succeed("sweep sweep.toml --out sweep");
    let bytes = place.read("sweep/sweep.csv");
    let mut reader = csv::Reader::from_reader(bytes.as_slice());
    let header = reader.headers().unwrap().clone();
    let row = reader.records().next().unwrap().unwrap();
    let cell = |name: &str| row[header.iter().position(|it| it == name).unwrap()].to_string();
    let report = place.text("result/report.html");
    place.succeed("report result other --out cmp.html");
    let comparison = place.text("cmp.html");
    for (key, name) in KEYS {
        let (value, status) = (&summary[key], summary["status"][key].as_str().unwrap());
        let parts = &summary["uncertainty"][key];
        let expected = match (value.is_null(), parts["model"].is_null()) {
            (true, _) => "unknown",
            (false, true) => "bound",
            (false, false) => "computed",
        };
        assert_eq!(status, expected, "{of}: {key}");
        for part in [key, "status", "uncertainty"] {
            let of_json = if part == key { &json[key] } else { &json[part][key] };
            let own = if part == key { value } else { &summary[part][key] };
            assert_eq!(own, of_json, "{of}: {key} {part}");
        }
        assert_eq!(cell(&format!("{key}_status")), status, "{of}: {key}");
        assert_eq!(cell(key).parse::<f64>().ok(), value.as_f64(), "{of}: {key}");
        let model = cell(&format!("uncertainty_model_{key}")).parse::<f64>().ok();
        assert_eq!(model, parts["model"].as_f64(), "{of}: {key}");
        // The line of the terminal and the card of the report have the sign of a bound.
        let line = ran.stdout.lines().find(|line| line.starts_with(name)).unwrap();
        let sign = match parts["bound"].as_str() {
            Some("at most") => "≤",
            Some("at least") => "≥",
            _ => "",
        };
        assert_eq!(line.contains(['≤', '≥']), !sign.is_empty(), "{of}: {line}");
        assert!(line.contains(sign), "{of}: {line}");
        let card = report.split("<div class=\"card\">").find(|card| card.contains(name));
        let card = card.filter(|_| !value.is_null()).unwrap_or("");
        assert_eq!(card.contains(['≤', '≥']), !sign.is_empty(), "{of}: {card}");
        compare_pages(of, line, ran.stdout.contains("± input"), card, &comparison, status);
        // An error bar is no rounding noise.
        for part in ["discretisation", "model", "input"] {
            let scale = if key == "restitution" { 1.0 } else { value.as_f64().unwrap_or(1.0) };
            let size = parts[part].as_f64().unwrap_or(0.0);
            assert!(size == 0.0 || size > 1e-13 * scale, "{of}: {key} {part}: {size:e}");
        }
    }
    let is_bound = summary["status"]["restitution"] == "bound";
    assert_eq!(
        sweep.stdout.contains('≤'),
        is_bound && !summary["uncertainty"]["restitution"]["bound"].is_null()
    );
    assert!(!is_bound || !ran.stdout.contains("No warnings."), "{of}");
    assert!(!is_bound || !ran.stdout.contains("none above the tolerance"), "{of}");
    // A fit takes no bound.
    let fit = "fit case.toml --data sweep/sweep.csv --law tsuji --out fit";
    let refused = place.run(fit);
    assert_eq!(refused.stderr.contains("upper bound"), is_bound, "{of}: {}", refused.stderr);
    assert_eq!(odd_number(&refused.stderr), None, "{of}: {}", refused.stderr);
    summary
}

/// Every material of the library, and its numbers typed by hand without a name, struck on a rigid floor.
#[test]
fn every_material_says_the_same_everywhere() {
    for (name, entry) in materials() {
        let text = format!(
            "{}{}[output]\nsnapshots = []\n[model.ting]\n",
            floor("wall = {}"),
            ball("10 mm", "0.1 m/s", &format!("lib:{name}"))
        );
        let summary = compare(name, &text);
        let relaxes = entry.material.relaxation.is_some();
        let expected = if relaxes { "computed" } else { "bound" };
        assert_eq!(summary["status"]["restitution"], expected, "{name}");
    }
    for (modulus, density) in
        [("210 GPa", 7850), ("70 GPa", 2700), ("72 GPa", 2500), ("3 GPa", 1200)]
    {
        let text = format!(
            "[material.mine]\ndensity = {density}\nyoungs_modulus = '{modulus}'\npoissons_ratio = 0.3\n{}{}[model.ting]\n",
            floor("wall = {}"),
            ball("10 mm", "0.1 m/s", "mine"),
        );
        let summary = compare(modulus, &text);
        assert_eq!(summary["status"]["restitution"], "bound", "{modulus}");
        assert_ne!(summary["uncertainty"]["restitution"]["model"], 0.0, "{modulus}");
        let meant = text.replace("poissons_ratio = 0.3", "poissons_ratio = 0.3\nelastic = true");
        assert_eq!(compare(modulus, &meant)["status"]["restitution"], "computed", "{modulus}");
    }
}

/// The bounces on the terminal are those of the page, with the measured restitution of their own speed before a bound.
#[test]
fn bounces_say_the_same_everywhere() {
    for (material, measured) in [("ice", true), ("steel", false), ("pvb", false)] {
        let falls = "[start]\ngap = '50 um'\n[gravity]\nacceleration = '9.81 m/s^2'\n[stop]\nbounces = 3\n[model.ting]\n";
        let place = Place::with(
            &(floor("wall = {}")
                + &ball("5 cm", "0 m/s", &format!("lib:{material}"))
                + "[output]\nsnapshots = []\n"
                + falls),
        );
        let ran = place.succeed("case.toml --out result -v").stdout;
        let page = place.text("result/report.html");
        let rows = page.split("<h2>Bounces</h2>").nth(1).unwrap().split("<tr>").skip(2).take(3);
        let rows: Vec<&str> = rows.map(|row| row.split("<td>").nth(3).unwrap()).collect();
        let lines = ran.lines().skip_while(|line| !line.starts_with("bounce "));
        let lines: Vec<&str> = lines.skip(1).take(3).collect();
        assert_eq!((rows.len(), lines.len()), (3, 3));
        for (row, line) in rows.iter().zip(lines) {
            let cell = line.split("  ").map(str::trim).filter(|cell| !cell.is_empty()).nth(3);
            assert_eq!(row.split_once("</td>").unwrap().0, cell.unwrap(), "{material}: {line}");
        }
        let first = ran.lines().find(|line| line.starts_with("restitution")).unwrap();
        let first = first.split("  ").map(str::trim).filter(|cell| !cell.is_empty()).nth(1);
        compare_said(material, first.unwrap(), rows[0].split_once("</td>").unwrap().0);
        assert_eq!(rows[0].contains(" (≤ "), measured, "{material}: {}", rows[0]);
    }
}

/// What became of the energy is a share of what a collision can lose, which does not depend on who moves.
#[test]
fn shares_of_energy_are_those_of_any_frame() {
    let coarse = "[accuracy]\ntolerance = '5 %'\n[output]\nsnapshots = []\n[model.fem]\n";
    let shares = [["0 m/s", "1 m/s"], ["9 m/s", "-8 m/s"], ["1 m/s", "0 m/s"]].map(|speeds| {
        let wall = floor(&format!("wall = {{}}\napproach_speed = '{}'", speeds[0]));
        let place = Place::with(&(wall + &ball("10 mm", speeds[1], "lib:steel") + coarse));
        let ran = place.succeed("case.toml --out result").stdout;
        let energy = ran.lines().find(|line| line.starts_with("energy:")).unwrap().to_string();
        let page = place.text("result/report.html");
        let (said, _) = between(&page, "Of the energy of relative motion, ", ".</p>").unwrap();
        let words = energy.trim_start_matches("energy:").trim();
        assert_eq!(said.replace(", and ", ", "), words);
        energy
    });
    assert!(shares.iter().all(|one| *one == shares[0]), "{shares:?}");
    let (percent, _) = between(&shares[0], "energy:", " %").unwrap();
    assert!((50.0..100.0).contains(&percent.trim().parse::<f64>().unwrap()), "{shares:?}");
}

/// Scenes with the statuses of restitution and peak force, and whether a DEM file is written.
#[test]
fn scenes_say_the_same_everywhere() {
    let block = |material: &str| floor(&format!("half_space = {{}}\nmaterial = 'lib:{material}'"));
    let plate = |thickness: &str| {
        floor(&format!("plate.thickness = '{thickness}'\nmaterial = 'lib:steel'"))
    };
    let coarse = "[accuracy]\ntolerance = '5 %'\n[output]\nsnapshots = []\n";
    let typed =
        "[material.mine]\ndensity = 7850\nyoungs_modulus = '210 GPa'\npoissons_ratio = 0.3\n";
    let sticky = "[contact]\nwork_of_adhesion = '0.1 J/m^2'\n";
    let scenes = [
        (
            "steel flows",
            block("steel") + &ball("10 mm", "1 m/s", "lib:steel") + coarse,
            ["computed"; 2],
            true,
        ),
        (
            "slow steel",
            block("steel") + &ball("10 mm", "1 mm/s", "lib:steel") + coarse,
            ["bound", "computed"],
            false,
        ),
        (
            "hard on soft",
            block("steel") + &ball("10 mm", "1 m/s", "lib:bearing-steel") + coarse,
            ["computed"; 2],
            true,
        ),
        (
            "ting",
            block("steel") + &ball("10 mm", "1 m/s", "lib:steel") + coarse + "[model.ting]\n",
            ["bound"; 2],
            true,
        ),
        (
            "flow off",
            block("steel")
                + &ball("10 mm", "1 m/s", "lib:steel")
                + coarse
                + "[effects]\nplastic_flow = 'off'\n",
            ["bound"; 2],
            false,
        ),
        (
            "typed steel",
            typed.to_string() + &block("steel") + &ball("10 mm", "1 m/s", "mine") + coarse,
            ["bound"; 2],
            false,
        ),
        (
            "ice",
            block("ice") + &ball("5 cm", "1 cm/s", "lib:ice") + coarse,
            ["bound", "computed"],
            false,
        ),
        (
            "PMMA",
            block("steel") + &ball("10 mm", "0.1 m/s", "lib:pmma") + coarse,
            ["bound", "computed"],
            false,
        ),
        (
            "dust",
            block("fused-silica") + &ball("1 um", "0.1 m/s", "lib:fused-silica") + coarse,
            ["bound"; 2],
            false,
        ),
        (
            "dust that sticks",
            block("fused-silica") + &ball("1 um", "0.02 m/s", "lib:fused-silica") + sticky + coarse,
            ["computed"; 2],
            false,
        ),
        (
            "polymer",
            block("steel") + &ball("10 mm", "0.1 m/s", "lib:pvb") + coarse,
            ["computed"; 2],
            true,
        ),
        (
            "plate",
            plate("5 mm") + &ball("10 mm", "0.5 m/s", "lib:steel") + coarse,
            ["computed"; 2],
            true,
        ),
    ];
    for (name, text, statuses, is_exported) in scenes {
        let summary = compare(name, &text);
        let found = ["restitution", "peak_force_n"].map(|key| summary["status"][key].clone());
        assert_eq!(found, statuses, "{name}");
        let place = Place::with(&text);
        let ran = place.run("export case.toml --out export");
        assert_eq!(ran.code == Some(0), is_exported, "{name}: {}", ran.stderr);
        if is_exported {
            let text = place.text("export/lammps_coeff_restitution.in");
            assert!(!text.contains("no loss of"), "{name}: {text}");
        } else {
            assert!(!place.path("export").exists(), "{name}");
        }
    }
}
