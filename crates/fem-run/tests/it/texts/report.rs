//! The report page, the comparison of results, and single figures.

use std::fs;

use crate::common::Place;

const TING: [&str; 4] = ["case.toml", "--set", "model.ting={}", "--quiet"];

/// Checks that a page loads nothing from elsewhere.
fn stands_alone(page: &str) {
    for address in ["src=", "href=", "url(", "@import", "<link", "fetch("] {
        assert!(!page.contains(address), "{address}");
    }
    assert!(page.len() < 1_000_000, "{}", page.len());
    assert!(page.contains("prefers-color-scheme: dark") && page.contains("@media print"));
}

/// A report of a material without relaxation says that its loss matters, and not that nothing does.
#[test]
fn effects_that_matter_and_are_not_computed_are_shown() {
    let place = Place::new();
    place.succeed("new steel --material steel --quiet");
    place.succeed("steel.toml --set model=hertz --set body.1.approach_speed=5 --out steel --quiet");
    let page = place.text("steel/report.html");
    assert!(page.contains("These effects matter here and are not computed"));
    assert!(page.contains("<dt>plastic flow</dt>") && !page.contains("No effects beyond"));
}

/// A report of ice on ice draws the measured restitutions beside the result; the summary has the one at its speed.
#[test]
fn measured_restitutions_stand_beside_the_result() {
    let place = Place::new();
    let ice = ["body.0.material='lib:ice'", "body.1.material='lib:ice'"];
    let slow = "body.0.approach_speed='1 cm/s'";
    let set = ["--set", ice[0], "--set", ice[1], "--set", slow, "--set", "model=hertz"];
    place.succeed(("case.toml --out ice --quiet", set));
    let measured = &place.json("ice/summary.json")["measured_restitution"];
    assert_eq!(
        (&measured[0]["name"], &measured[0]["restitution"]),
        (&"bridges-1984".into(), &0.32.into())
    );
    assert!(measured[2]["restitution"].is_null() && measured[2]["scatter"] == 0.23);
    let page = place.text("ice/report.html");
    stands_alone(&page);
    for expected in
        ["Measured restitution", ">this result<", ">hatzes-1988<", "e = 0.32 at 10.00 mm/s"]
    {
        assert!(page.contains(expected), "{expected}");
    }
    // Glass of the paper has one at its speed.
    place.succeed("case.toml --set model=hertz --out glass --quiet");
    assert_eq!(place.json("glass/summary.json")["measured_restitution"][0]["restitution"], 0.925);
    // Two other numbers make it a material of the user's.
    let own = "--set material.glass.density=2400 --set material.glass.poissons_ratio=0.2";
    place.succeed(("case.toml --set model=hertz --out own --quiet", own));
    assert!(place.json("own/summary.json")["measured_restitution"].is_null());
    assert!(!place.text("own/report.html").contains("Measured restitution"));
}

/// A contact that shrinks at once has a kink; one like Hertz' has none.
#[test]
fn a_kink_of_the_contact_radius_is_explained() {
    let place = Place::new();
    let of = |seconds: &str| {
        let terms = format!("[{{ weight = 0.99, relaxation_time = {seconds} }}]");
        let relaxation =
            format!("material.glass.relaxation={{ acts_on = \"all\", terms = {terms} }}");
        place.succeed((TING, ["--set", &relaxation, "--out", seconds]));
        place.text(format!("{seconds}/report.html")).contains("has a kink at its maximum")
    };
    assert!(of("2e-6") && !of("1.0"));
}

/// Numbers with errors, curves next to Hertz, fields, effects, the case, how to cite.
#[test]
fn report_of_a_run_with_fields_has_all_sections() {
    let place = Place::new();
    place.succeed(["case.toml", "--set", "model.condensed={}", "--quiet"]);
    let page = place.text("runs/case/report.html");
    stands_alone(&page);
    let summary = place.json("runs/case/summary.json");
    let restitution = format!("{:.3}", summary["restitution"].as_f64().unwrap());
    for expected in [
        "<h1>A pair</h1>",
        &restitution,
        "Contact force F [N]",
        "Energy E [",
        ">Hertz<",
        "Hertz under the same force",
        "mid-compression, ",
        "last contact, ",
        "The material relaxes while it is compressed",
        "body.0.approach_speed",
        "How to cite",
        "aria-label=\"The bodies before the collision, to scale\"",
        ">22.20 mm, 500.0 mm/s</text>",
        ">15.90 mm, at rest</text>",
        "stress \u{b1} ",
    ] {
        assert!(page.contains(expected), "{expected}");
    }
    assert_eq!(page.matches("<figure>").count(), 4);
    // Each frame has its mesh, hidden until it is asked for; effects that are off say what they would change.
    assert_eq!(page.matches("class=\"mesh\" visibility=\"hidden\"").count(), 4);
    let (_, off) = page.split_once("It would change e by").unwrap();
    let row = off.split("<tr>").find(|row| row.contains("<td>surface slip<br>")).unwrap();
    assert_eq!(row.matches("<td class=\"number\">0</td>").count(), 3, "{row}");
    assert!(summary["files"].as_array().unwrap().iter().any(|file| file == "report.html"));
    // An older result gets the same page as a new one.
    fs::remove_file(place.path("runs/case/report.html")).unwrap();
    place.succeed("report runs/case");
    assert_eq!(place.text("runs/case/report.html"), page);
    // Each figure is also written by itself, as XML.
    for what in ["contours", "force", "approach", "radius", "pressure", "energy", "profile", "loop"]
    {
        place.succeed(["plot", "runs/case", "--what", what]);
        let svg = place.text(format!("case-{what}.svg"));
        assert!(svg.starts_with("<svg xmlns=") && svg.ends_with("</svg>\n"), "{what}");
    }
}

#[test]
fn a_result_without_fields_has_a_page_with_its_title_escaped_and_no_picture() {
    let place = Place::new();
    place.succeed((TING, ["--set", "title='<script>alert(1)</script>'"]));
    let page = place.text("runs/case/report.html");
    stands_alone(&page);
    assert!(page.contains("Contact radius a [µm]") && !page.contains("<figure>"));
    assert!(!page.contains("<script>alert"));
    assert_eq!(page.matches("<script>").count(), 1);
    place.fails(2, "plot runs/case --what contours").tells("nothing to draw");
    place.fails(2, "plot runs/case").tells("contours, dent, force, approach");
    let converted = "write --out a.svg and convert it: inkscape a.svg -o a.png";
    place.fails(2, "plot runs/case --what force --out a.png").tells(converted);
    place.succeed((TING, "--set output.report=false --out spared"));
    assert_eq!(place.list("spared"), ["history.csv", "summary.json"]);
}

/// A comparison has names as they are, numbers with error bars, and the differing key before what follows
/// from it; each result once.
#[test]
fn comparison_shows_the_differing_keys_first() {
    let place = Place::new();
    let condensed = ["case.toml", "--set", "model.condensed={}", "--quiet"];
    place.succeed((condensed, "--out glass_on_glass"));
    let fast = ["--set", "body.0.approach_speed='4 m/s'", "--out", "glass_fast_0.5"];
    place.succeed((condensed, fast));
    place.succeed("report glass_on_glass glass_fast_0.5 --out both.html");
    let page = place.text("both.html");
    stands_alone(&page);
    // The time of contact falls by 8^(1/5); the difference is printed as a share.
    let time = |name: &str| place.json(&format!("{name}/summary.json"))["contact_time_s"].as_f64();
    let change = 100.0 * (time("glass_fast_0.5").unwrap() / time("glass_on_glass").unwrap() - 1.0);
    assert!(page.contains(&format!("{:.2} %", -change)), "{change}");
    assert!(page.contains("<td class=\"path\">body.0.approach_speed</td><td>0.5</td><td>4.0</td>"));
    assert!(!page.contains("<td class=\"path\">title</td>"));
    assert_eq!(page.matches(">glass_fast_0.5</text>").count(), 6, "in the legend of each chart");
    assert!(
        page.contains("Force over Hertz' peak force")
            || page.contains("Force over Hertz&#39; peak")
    );
    assert_eq!(
        page.matches("<figure class=\"film scale").count(),
        2,
        "stresses next to each other"
    );
    let (before, rest) = page.split_once("<details>").unwrap();
    let (folded, _) = rest.split_once("</details>").unwrap();
    assert!(before.contains("body.0.approach_speed") && folded.contains("mesh.refined_radius"));
    assert!(!before.contains("mesh.") && before.contains(" ± "));
    // No number has twenty digits.
    let longest = page.split(|c: char| !(c.is_ascii_digit() || c == '.')).map(str::len).max();
    assert!(longest.is_some_and(|n| n <= 12), "{longest:?}");
    for folders in [["glass_on_glass", "glass_on_glass"], ["glass_on_glass", "./glass_on_glass/"]] {
        place.fails(2, ["report", folders[0], folders[1]]).tells("named twice");
    }
}

/// Two pairs on one mesh, which differ in their relaxing share. The difference of their peak forces is smaller than both
/// error bars together, and is shown as a difference all the same, because most of the errors is common.
#[test]
fn shared_errors_do_not_hide_a_difference() {
    let place = Place::new();
    let mesh = "mesh.contact_element_size='45 um'";
    let condensed = ["case.toml", "--set", "model.condensed={}", "--set", mesh, "--quiet"];
    place.succeed((condensed, "--out one"));
    let weight = ["--set", "material.glass.relaxation.terms.0.weight=0.6", "--out", "two"];
    place.succeed((condensed, weight));
    let [one, two] = ["one", "two"].map(|name| place.json(&format!("{name}/summary.json")));
    let force = |of: &serde_json::Value| of["peak_force_n"].as_f64().unwrap();
    let bar = |of: &serde_json::Value| {
        ["discretisation", "model"].map(|part| of["uncertainty"]["peak_force_n"][part].as_f64())
    };
    let difference = (force(&one) - force(&two)).abs();
    let bars: f64 = [bar(&one), bar(&two)].into_iter().flatten().flatten().sum();
    assert!(bars > difference, "{bars} {difference}");
    place.succeed("report one two --out both.html");
    let page = place.text("both.html");
    assert!(page.contains("All results have the same mesh and settings as the first."));
    let row = page.split("<tr>").find(|row| row.contains("<td>peak force</td>")).unwrap();
    assert!(row.contains(" %") && !row.contains("within"), "{bars} {difference} {row}");
}

/// Only the requested arrays are written, and the film is there if it has its fields.
#[test]
fn snapshots_have_the_fields_that_are_asked_for() {
    let place = Place::new();
    let run = |fields: &str, out: &str| {
        let set = format!("output.fields={fields}");
        let condensed = ["case.toml", "--set", "model.condensed={}", "--quiet", "--out", out];
        place.succeed((condensed, ["--set", &set]));
        let snapshot = place.list(out).into_iter().find(|name| name.ends_with("maximum.vtu"));
        let file = fem_vtk::VtuFile::open(place.path(out).join(snapshot.unwrap())).unwrap();
        let has = |name: &str| [file.point_data(name).is_ok(), file.cell_data(name).is_ok()];
        let page = place.text(format!("{out}/report.html"));
        (["displacement", "velocity", "sigma_yy", "von_mises", "body"].map(has), page)
    };
    let (arrays, page) = run("['displacement', 'sigma_yy']", "some");
    let expected = [[true, false], [false; 2], [true; 2], [false; 2], [true; 2]];
    assert_eq!(arrays, expected);
    assert_eq!(page.matches("<figure>").count(), 4);
    let (arrays, page) = run("[]", "none");
    assert_eq!(arrays, [[false; 2], [false; 2], [false; 2], [false; 2], [true; 2]]);
    assert!(!page.contains("<figure>") && page.contains("Contact pressure p ["));
    place.fails(2, ["case.toml", "--set", "output.fields=['sigma_zz']"]).tells("sigma_yy");
}

/// A ball on a wall fills its picture: the wall is a strip, with the body above it.
#[test]
fn picture_of_a_ball_on_a_wall_fills_its_frame() {
    let place = Place::new();
    let wall = ["--set", "body.0={ name = 'floor', wall = {} }", "--set", "model.condensed={}"];
    let moves = ["--set", "body.1.approach_speed='0.5 m/s'", "--quiet"];
    place.succeed(("case.toml --out runs/case", wall, moves));
    let page = place.text("runs/case/report.html");
    assert_eq!(page.matches("class=\"rigid ink stroke\"").count(), 4);
    // The height of a frame over its width: 0.625; it was 0.85 when as much of the wall as of the
    // ball was shown.
    let frame = page.split_once("<figure>").unwrap().1;
    let height = frame.split_once("width=\"400\" height=\"").unwrap().1;
    let height: f64 = height.split_once('"').unwrap().0.parse().unwrap();
    assert!((height / 400.0 - 0.625).abs() < 1e-3, "{height}");
}

/// Commands that write a single file overwrite no file of others.
#[test]
fn single_file_commands_overwrite_no_foreign_file() {
    let place = Place::new();
    place.succeed(TING);
    for folder in [".", "nowhere"] {
        place.fails(2, ["report", folder]).tells("summary.json cannot be read");
    }
    place.succeed((TING, "--out runs/other"));
    let summary = place.text("runs/case/summary.json");
    fn own(name: &str) -> Vec<&str> {
        vec!["plot", "runs/case", "--what", "force", "--out", name]
    }
    let mine = "mine: not to be lost";
    for (command, name) in [
        (own("mine.svg"), "mine.svg"),
        (own("runs/case/summary.json"), "runs/case/summary.json"),
        (own("mine.png"), "mine.png"),
        (vec!["plot", "runs/case", "--what", "force"], "case-force.svg"),
        (vec!["report", "runs/case", "--out", "mine.html"], "mine.html"),
        (vec!["report", "runs/case", "--out", "case.toml"], "case.toml"),
        (vec!["report", "runs/case", "runs/other"], "case-other-comparison.html"),
    ] {
        let old = match name {
            "runs/case/summary.json" => summary.clone(),
            _ => mine.to_string(),
        };
        place.write(name, &old);
        let ran = place.fails(2, &command);
        assert!(ran.stderr.contains(name) && ran.stderr.contains("--out"), "{}", ran.stderr);
        assert_eq!(place.text(name), old, "{command:?}");
    }
    // They overwrite their own files, and `-` is no file.
    for _ in 0..2 {
        place.succeed(own("own.svg"));
    }
    let printed = place.run(own("-"));
    assert_eq!((printed.code, printed.stdout), (Some(0), place.text("own.svg")));
    assert!(!place.path("-").exists());
}

/// Returns the points (x, y) of the first curve of the first chart of a page, in its pixels.
fn first_curve(page: &str) -> Vec<[f64; 2]> {
    let path = page.split("<path class=\"c0 stroke\"").nth(2).unwrap();
    let data = path.split("d=\"").nth(1).unwrap().split('"').next().unwrap();
    let places = data.split(['M', 'L']).filter(|place| !place.is_empty());
    let numbers = |place: &str| place.split(' ').map(|n| n.parse().unwrap()).collect::<Vec<f64>>();
    places.map(numbers).map(|place| [place[0], place[1]]).collect()
}

/// Returns the width and the height of the first curve over those of the plot area.
fn share(page: &str) -> [f64; 2] {
    let curve = first_curve(page);
    let extent = |k: usize| {
        let of_axis = || curve.iter().map(|place| place[k]);
        of_axis().fold(0.0, f64::max) - of_axis().fold(f64::INFINITY, f64::min)
    };
    [extent(0) / 370.0, extent(1) / 190.0]
}

/// Hertz' curve does not set the scale of a much stiffer or softer law.
#[test]
fn hertz_curve_does_not_set_the_scale_of_the_axes() {
    for stiffness in ["1e3 N/m", "1e10 N/m"] {
        let place = Place::new();
        let law = format!("model.law={{linear={{k=\"{stiffness}\"}}}}");
        place.succeed(["case.toml", "--set", &law, "--quiet"]);
        let page = place.text("runs/case/report.html");
        assert!(page.contains(">Hertz, up to "), "{stiffness}");
        let [width, height] = share(&page);
        assert!(width > 0.6 && height > 0.7, "{stiffness}: {width} × {height}");
    }
}

/// Balls that stay together have no last contact; the curves of others are not squeezed.
#[test]
fn contact_without_an_end_does_not_set_the_time_axis() {
    let place = Place::new();
    place.succeed((TING, "--out leaves"));
    let stays =
        "material.glass.relaxation={acts_on='all',terms=[{weight=1.0,relaxation_time='0.1 us'}]}";
    place.succeed((TING, ["--set", stays, "--out", "stays"]));
    assert!(place.json("stays/summary.json")["contact_time_s"].is_null());
    place.succeed("report leaves stays --out both.html");
    let [width, height] = share(&place.text("both.html"));
    assert!(width > 0.8 && height > 0.8, "{width} × {height}");
    // The error by neglected effects of bodies that stay together is printed beside the number.
    let page = place.text("stays/report.html");
    let value = page.split("<small>restitution</small><b>").nth(1).unwrap();
    assert!(value.starts_with("0.000 ± 0.0"), "{}", &value[..40]);
    assert!(page.contains("neglected effects 0.0"));
}

/// There are seven colours, so the eighth curve has other dashes. The numbers of many results are in rows.
#[test]
fn ten_compared_results_have_distinct_curves() {
    let place = Place::new();
    let names: Vec<String> = (0..10).map(|k| format!("run{k}")).collect();
    for (k, name) in names.iter().enumerate() {
        let speed = format!("body.0.approach_speed={}", 0.1 * (k + 1) as f64);
        place.succeed((TING, ["--set", &speed, "--out", name]));
    }
    let folders: Vec<&str> = names.iter().map(String::as_str).collect();
    place.succeed(("report", &folders, "--out all.html"));
    let page = place.text("all.html");
    let strokes =
        page.split("<path class=\"c").skip(1).map(|path| path.split(" d=").next().unwrap());
    let strokes: std::collections::BTreeSet<&str> =
        strokes.filter(|path| path.contains("stroke=")).collect();
    assert_eq!(strokes.len(), 2 * 10, "a line and its mark in the legend, {strokes:?}");
    assert!(page.contains("<tr><td>run9</td><td class=\"number\">"));
}

/// The frames of the film are chosen by events.
#[test]
fn frames_of_the_film_are_chosen_by_events() {
    let place = Place::new();
    let film = "case.toml --set model.condensed={} --set output.snapshots=40 --quiet";
    place.succeed((film, "--out film"));
    let page = place.text("film/report.html");
    // At least three profiles are visible: half the approach, the peak force, half again.
    let profile = page.split("Contact pressure p [").nth(1).unwrap();
    assert!(profile.matches("snapshot, ").count() >= 4, "{}", profile.len());
    assert!(page.contains("details::details-content") && page.contains("beforeprint"));
}
