//! One number, one status and one error bar wherever a result goes: terminal, summary, sweep, report, fit and export. A restitution
//! that is a bound reaches no contact law unless it is asked for.

use fem_case::library::{Material, materials};
use fem_case::parse_quantity;
use serde_json::Value;

use crate::common::{Place, number};
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
    for text in [ran.stdout, ran.stderr, sweep.stdout, sweep.stderr, refused.stderr] {
        assert_eq!(odd_number(&text), None, "{of}: {text}");
    }
    summary
}

const BLOCK: &str = "half_space = {}";
const BLOCK_OF_STEEL: [&str; 2] = [BLOCK, "steel"];

/// The input of LAMMPS, whose restitution is one of a few numbers after the modulus.
const LAMMPS: &str = "lammps_coeff_restitution.in";

fn has_strength(entry: &Material) -> bool {
    entry.material.yield_strength.is_some() || entry.material.flow.is_some()
}

/// Returns the file of an export with a name.
fn snippet<'a>(export: &'a Value, file: &str) -> &'a Value {
    let snippets = export["snippets"].as_array().unwrap();
    snippets.iter().find(|snippet| snippet["file"] == file).unwrap()
}

/// Compares the law that falls with speed with a run on a half-space, since the codes have no plate.
fn compare_on_a_block(of: &str, place: &Place, export: &Value) {
    let a = number(&export["dissipation_time_s"]);
    let law = format!("model={{ law = {{ kuwabara_kono = {{ a = {a} }} }} }}");
    let text = place.text("case.toml");
    if !text.contains("plate.thickness") {
        return;
    }
    let plate = text.lines().find(|line| line.starts_with("plate.")).unwrap();
    place.write("block.toml", &text.replace(plate, "half_space = {}"));
    place.succeed(["block.toml", "--set", &law, "--out", "block", "--force"]);
    let ran = number(&place.json("block/summary.json")["restitution"]);
    let made = number(&snippet(export, "lammps_viscoelastic.in")["restitutions_at_data"][6]);
    assert!((made - ran).abs() < 1e-6, "{of}: {made} {ran}");
}

/// Compares what `export` writes with the run of the same case, without and with `--as-elastic`.
fn compare_export(of: &str, text: &str, summary: &Value, is_exported: bool) {
    let place = Place::with(text);
    let plain = place.run("export case.toml --out plain");
    assert_eq!(plain.code == Some(0), is_exported, "{of}: {}", plain.stderr);
    assert_eq!(place.path("plain").exists(), is_exported, "{of}");
    let accepted = place.run("export case.toml --as-elastic --out accepted");
    if summary["adhesion"]["sticks"] == true && summary["status"]["restitution"] == "computed" {
        for refused in [plain, accepted] {
            refused.tells("the bodies stick below |no dashpot states that");
        }
        // The way out that the help names.
        let parting = "contact.work_of_adhesion=0 --as-elastic --out parting";
        place.succeed(format!("export case.toml --set {parting}").as_str());
        return;
    }
    assert_eq!(accepted.code, Some(0), "{of}: {}", accepted.stderr);
    let folders: &[&str] = if is_exported { &["plain", "accepted"] } else { &["accepted"] };
    let exports = folders.iter().map(|folder| place.json(&format!("{folder}/export.json")));
    let exports: Vec<Value> = exports.collect();
    for (folder, export) in folders.iter().zip(&exports) {
        let bounds = export["bounds"].as_array().unwrap();
        assert!(*folder == "accepted" || bounds.is_empty(), "{of}: {bounds:?}");
        let written = snippet(export, LAMMPS);
        let (e, worst) = (number(&written["restitution"]), number(&written["worst_error"]));
        for snippet in export["snippets"].as_array().unwrap() {
            let file = place.text(format!("{folder}/{}", snippet["file"].as_str().unwrap()));
            assert_eq!(file.contains("WARNING: "), !bounds.is_empty(), "{of}: {file}");
            let is_meant = file.contains("(elastic = true)");
            assert!(e < 0.999 || is_meant || !bounds.is_empty(), "{of}: {file}");
        }
        let file = place.text(format!("{folder}/{LAMMPS}"));
        let numbers = file.lines().filter(|line| line.contains(" hertz/material "));
        for line in numbers {
            let entry = line.split(" hertz/material ").nth(1).unwrap().split(' ').nth(1).unwrap();
            assert!((entry.parse::<f64>().unwrap() - e).abs() < 1e-8, "{of}: {line}");
        }
        compare_on_a_block(of, &place, export);
        // The file's e is that of the run within the errors that both state.
        let ran = number(&summary["restitution"]);
        let stated = &summary["uncertainty"]["restitution"];
        let own = ["discretisation", "model"].map(|part| stated[part].as_f64().unwrap_or(0.0));
        let error = own[0] + own[1] + number(&export["tolerance"]);
        let at_own = export["data"].as_array().unwrap().iter().find(|point| {
            let speed = number(&summary["bodies"][1]["velocity_before_m_s"]).abs();
            (number(&point["speed_m_s"]) / speed - 1.0).abs() < 1e-9
        });
        let computed = number(&at_own.unwrap_or_else(|| panic!("{of}: no point"))["restitution"]);
        assert!((computed - e).abs() <= worst * (1.0 + 1e-9), "{of}: {computed} {e} {worst}");
        let is_bound = summary["status"]["restitution"] == "bound";
        match is_bound && bounds.is_empty() {
            true => assert!(computed < ran, "{of}: {computed} {ran}"),
            false => assert!((computed - ran).abs() < error, "{of}: {computed} {ran} ± {error}"),
        }
    }
    // What is computed stays as it is if bounds are accepted.
    if let [plain, accepted] = &exports[..] {
        for point in plain["data"].as_array().unwrap() {
            assert!(accepted["data"].as_array().unwrap().contains(point), "{of}: {point}");
        }
    }
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

/// Scenes of a ball on a floor, with the statuses of restitution and peak force, and whether a DEM file is written.
#[test]
fn scenes_say_the_same_everywhere() {
    const TYPED: &str =
        "[material.mine]\ndensity = 7850\nyoungs_modulus = '210 GPa'\npoissons_ratio = 0.3\n";
    const MEANT: &str = "elastic = true\n";
    const STICKY: &str = "[contact]\nwork_of_adhesion = '0.1 J/m^2'\n";
    const NO_FLOW: &str = "[effects]\nplastic_flow = 'off'\n";
    const COMPUTED: [&str; 2] = ["computed"; 2];
    const BOUND: [&str; 2] = ["bound"; 2];
    const OF_LOSS: [&str; 2] = ["bound", "computed"];
    let named = |material: &str| match material {
        "mine" => material.to_string(),
        _ => format!("lib:{material}"),
    };
    // Name; floor and its material, a wall without one; ball: diameter, speed and material; more tables.
    for (name, [shape, below], [diameter, speed, material], more, statuses, is_exported) in [
        ("steel flows", BLOCK_OF_STEEL, ["10 mm", "1 m/s", "steel"], "", COMPUTED, true),
        ("slow steel", BLOCK_OF_STEEL, ["10 mm", "1 mm/s", "steel"], "", OF_LOSS, false),
        ("hard on soft", BLOCK_OF_STEEL, ["10 mm", "1 m/s", "bearing-steel"], "", COMPUTED, true),
        ("ting", BLOCK_OF_STEEL, ["10 mm", "1 m/s", "steel"], "[model.ting]\n", BOUND, true),
        ("flow off", BLOCK_OF_STEEL, ["10 mm", "1 m/s", "steel"], NO_FLOW, BOUND, false),
        ("typed steel", BLOCK_OF_STEEL, ["10 mm", "1 m/s", "mine"], "", BOUND, false),
        ("ice", [BLOCK, "ice"], ["5 cm", "1 cm/s", "ice"], "", OF_LOSS, false),
        ("PMMA", BLOCK_OF_STEEL, ["10 mm", "0.1 m/s", "pmma"], "", OF_LOSS, false),
        ("dust", [BLOCK, "fused-silica"], ["1 um", "0.1 m/s", "fused-silica"], "", BOUND, false),
        (
            "dust that sticks",
            [BLOCK, "fused-silica"],
            ["1 um", "0.02 m/s", "fused-silica"],
            STICKY,
            COMPUTED,
            false,
        ),
        ("Hertz", ["wall = {}", ""], ["10 mm", "1 m/s", "steel"], "[model.hertz]\n", BOUND, true),
        ("elastic by wish", [BLOCK, "mine"], ["10 mm", "1 m/s", "mine"], "", COMPUTED, true),
        (
            "elastic by wish, any model",
            [BLOCK, "mine"],
            ["10 mm", "1 m/s", "mine"],
            "[model.auto]\n",
            COMPUTED,
            true,
        ),
        (
            "elastic by wish, on a plate",
            ["plate.thickness = '5 mm'", "mine"],
            ["10 mm", "1 m/s", "mine"],
            "",
            COMPUTED,
            true,
        ),
        ("polymer", BLOCK_OF_STEEL, ["10 mm", "0.1 m/s", "pvb"], "", COMPUTED, true),
        (
            "plate",
            ["plate.thickness = '5 mm'", "steel"],
            ["10 mm", "0.5 m/s", "steel"],
            "",
            COMPUTED,
            true,
        ),
    ] {
        let below = match below {
            "" => floor(shape),
            below => floor(&format!("{shape}\nmaterial = '{}'", named(below))),
        };
        let material_table = if material == "mine" { TYPED } else { "" };
        let meant = if name.starts_with("elastic") { MEANT } else { "" };
        let ball = ball(diameter, speed, &named(material));
        let coarse = "[accuracy]\ntolerance = '5 %'\n[output]\nsnapshots = []\n";
        let text = [material_table, meant, &below, &ball, coarse, more].concat();
        let summary = compare(name, &text);
        let found = ["restitution", "peak_force_n"].map(|key| summary["status"][key].clone());
        assert_eq!(found, statuses, "{name}");
        compare_export(name, &text, &summary, is_exported);
    }
}

/// A table has the restitution of each pair of equal metals as their run by the law that follows elements has it, whether or not
/// bounds of other pairs are accepted, and each bound has its comment.
#[test]
fn a_table_has_the_restitutions_of_its_metals() {
    // Polymers with a strength have no known damping.
    let is_stiff = |entry: &Material| {
        entry.material.youngs_modulus.as_ref().is_some_and(|modulus| modulus.si().unwrap() > 1e10)
    };
    let is_metal = |entry: &Material| has_strength(entry) && is_stiff(entry);
    let all = materials().iter().filter(|(_, entry)| is_metal(entry));
    let metals: Vec<&str> = all.map(|(name, _)| &**name).collect();
    assert!(metals.len() > 6, "{metals:?}");
    let case = |name: &str, speed: &str| {
        let other = ball("10 mm", "0 m/s", &format!("lib:{name}")).replace("'ball'", "'other'");
        other + &ball("10 mm", speed, &format!("lib:{name}"))
    };
    let table = |others: &[&str], option: &str, name: &str| {
        let place = Place::with(&case("steel", "3 m/s"));
        let all = metals.iter().chain(others).map(|name| format!("lib:{name}"));
        let all = all.collect::<Vec<_>>().join(",");
        let speeds = "--speeds 2.9..3.1 --diameters 1cm";
        place.succeed(
            format!("export case.toml --materials {all} {speeds} {option} --out {name}").as_str(),
        );
        (place.json(&format!("{name}/export.json")), place.text(format!("{name}/lammps_pairs.in")))
    };
    let (plain, _) = table(&[], "", "plain");
    let (accepted, file) = table(&["pmma", "soda-lime-glass"], "--as-elastic", "accepted");
    let rows = accepted["pairs"].as_array().unwrap();
    for row in plain["pairs"].as_array().unwrap() {
        assert!(rows.contains(row), "{row}");
    }
    for (k, row) in rows.iter().enumerate() {
        let is_bound = !row["bounds"].as_array().unwrap().is_empty();
        let e = number(&row["restitution"]);
        assert!(e < 0.999 || is_bound, "{row}");
        let line = file.lines().filter(|line| line.starts_with("pair_coeff")).nth(k).unwrap();
        let types: Vec<&str> = line.split(' ').skip(1).take(2).collect();
        let warned = file.lines().filter(|line| line.starts_with("# WARNING: e of "));
        let pairs = warned.filter_map(|line| line[16..].split(':').next());
        let mut pairs = pairs.flat_map(|list| list.split(", "));
        assert_eq!(pairs.any(|pair| pair == types.join(" ")), is_bound, "{row} {file}");
        if row["first_material"] != row["second_material"] || is_bound {
            continue;
        }
        let name = row["first_material"].as_str().unwrap().trim_start_matches("lib:");
        let law = "[model]\nlaw = { mean_pressure = {} }\n";
        let place = Place::with(&(case(name, "3 m/s") + law));
        place.succeed("case.toml --out run");
        let ran = number(&place.json("run/summary.json")["restitution"]);
        let error = number(&row["worst_error"]) + 1e-6;
        assert!((e - ran).abs() <= error, "{name}: {e} {ran} {error}");
    }
}

/// An export says from which speed on it holds, and why: of bodies that stick, and of bodies whose loss is known from first yield on.
#[test]
fn speeds_that_are_left_out_are_named() {
    let grains = "[material.q]\ndensity = 2200\nyoungs_modulus = '72 GPa'\npoissons_ratio = 0.17\nelastic = true\n\
                  surface_energy = '25 mJ/m^2'\n";
    let first = ball("1 um", "0 m/s", "q").replace("'ball'", "'other'");
    let place = Place::with(&(grains.to_string() + &first + &ball("1 um", "1 cm/s", "q")));
    place.fails(2, "export case.toml").tells("stick below 396.3 mm/s|--speeds LOW..HIGH");
    let ran = place.succeed("export case.toml --speeds 0.1..4 --out sticky");
    ran.tells("from 100.0 mm/s to 342.0 mm/s the bodies stick below 396.3 mm/s");
    ran.tells("the speed of the case, 10.00 mm/s, is outside of the speeds of this export");
    // Data of bodies that stay together are no lossless ones.
    place.write("e.csv", "speed_m_s,restitution\n0.1,0\n0.2,0\n0.5,0.6\n1,0.9\n");
    place.write("zero.csv", "speed_m_s,restitution\n0.1,0\n0.2,0\n");
    place
        .fails(2, "export case.toml --data zero.csv")
        .tells("up to 200.0 mm/s the bodies stay together");
    place
        .succeed("export case.toml --data e.csv --out data")
        .tells("up to 200.0 mm/s the bodies stay");

    // Damping is unknown below first yield, at about 280 mm/s.
    let steel = floor("wall = {}") + &ball("10 mm", "0.8 m/s", "lib:bearing-steel");
    let yields = Place::with(&steel);
    let export = "export case.toml --speeds 0.1..2";
    let ran = yields.succeed(format!("{export} --out above").as_str());
    ran.tells("from 100.0 mm/s to |the restitution is a bound and is left out: the damping");
    assert!(!ran.stderr.contains("the speed of the case"), "{}", ran.stderr);
    let own = "--set body.1.approach_speed=0.15 --out own";
    yields
        .succeed(format!("{export} {own}").as_str())
        .tells("the speed of the case, 150.0 mm/s, is outside");
    yields
        .succeed(format!("{export} --as-elastic --out all").as_str())
        .tells("from 100.0 mm/s to |e is an upper bound, taken as it is");
    for (place, file, begin) in [
        (&place, "sticky", "# from 100.0 mm/s to 342.0 mm/s the bodies stick"),
        (&place, "data", "# speeds are left out: up to 200.0 mm/s the bodies stay together"),
        (&yields, "above", "# from 100.0 mm/s to "),
        (&yields, "all", "# WARNING: from 100.0 mm/s to "),
    ] {
        let text = place.text(format!("{file}/{LAMMPS}"));
        assert!(text.contains(begin), "{text}");
    }
}

/// Bounds of a sweep that are accepted have a comment in each file, of a fit to them too.
#[test]
fn accepted_bounds_of_data_have_a_comment() {
    let typed = "[material.m]\ndensity = 7850\nyoungs_modulus = '210 GPa'\npoissons_ratio = 0.3\n";
    let place =
        Place::with(&(typed.to_string() + &floor("wall = {}") + &ball("1 cm", "1 m/s", "m")));
    place.write(
        "e.csv",
        "speed_m_s,restitution,restitution_status\n1,0.97,bound\n2,0.96,bound\n4,0.95,computed\n",
    );
    place.fails(2, "export case.toml --data e.csv").tells("upper bound");
    place
        .succeed("export case.toml --data e.csv --as-elastic --out data")
        .tells("2 of 3 restitutions are upper");
    place.succeed("fit case.toml --data e.csv --as-elastic --law kuwabara_kono --out fit");
    place.succeed("export case.toml --fit fit --out fitted").tells("2 of 3 restitutions are upper");
    for folder in ["data", "fitted"] {
        let text = place.text(format!("{folder}/{LAMMPS}"));
        assert!(text.contains("WARNING: ") && text.contains("2 of 3 restitutions"), "{text}");
    }
}

/// The law that follows elements is the first of an inversion for bodies that yield, and only what changes a parameter is an
/// uncertain input of it.
#[test]
fn an_inversion_of_metals_begins_with_their_law() {
    for (name, entry) in materials() {
        let text = floor("wall = {}") + &ball("10 mm", "1 m/s", &format!("lib:{name}"));
        let place = Place::with(&text);
        let ran = place.succeed("invert case.toml --restitution 0.5");
        let first = ran.stdout.lines().nth(3).unwrap();
        assert_eq!(first.starts_with("mean_pressure"), has_strength(entry), "{name}: {first}");
        for wrong in ["± 0 ", "0.000000", "0.000 "] {
            assert!(!ran.stdout.contains(wrong), "{name}: {}", ran.stdout);
        }
    }
    let text = floor("wall = {}") + &ball("10 mm", "0.4 m/s", "lib:bearing-steel");
    let place = Place::with(&text);
    place.write("e.csv", "speed_m_s,restitution\n0.4,0.95\n0.6,0.9\n1,0.85\n");
    let ran = place.succeed("fit case.toml --data e.csv --law mean_pressure");
    assert!(!ran.stdout.contains(" by material"), "{}", ran.stdout);
}
