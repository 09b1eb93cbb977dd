//! The pictures of the pages in `docs/`, all made by one command from the shipped cases.
//!
//! `cargo run --release -p fem-run --example pictures -- docs/images [NAME...]`
//!
//! Each picture is what a command of the program writes, in a temporary folder: figures as SVG, and pages as PNG by a
//! headless Chromium. `CHROMIUM` names the browser if it is not `chromium` on the path. Without a browser, or without the
//! browser page that `crates/fem-page/build.sh` builds, these pictures stay as they are. With names, only the pictures
//! whose file names contain one of them are made.

#![allow(
    clippy::disallowed_macros,
    clippy::disallowed_methods,
    reason = "an example that writes files and prints what it wrote"
)]

#[path = "pictures/list.rs"]
mod list;

use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::{env, fs};

use list::{OWN_CASES, PICTURES, Picture, Source};

/// The page that `crates/fem-page/build.sh` builds.
const PAGE: &str = "target/page/index.html";
/// Time in which a page must be complete, ms.
const PATIENCE: u32 = 30_000;

fn main() -> Result<(), Box<dyn Error>> {
    let mut words = env::args().skip(1);
    let images = words.next().ok_or("name the folder of the pictures, such as docs/images")?;
    let (names, root) = (words.collect::<Vec<_>>(), env::current_dir()?);
    let images = root.join(images);
    let is_chosen =
        |one: &&Picture| names.is_empty() || names.iter().any(|name| one.name.contains(&**name));
    let place = tempfile::tempdir()?;
    fill(place.path(), &root)?;
    env::set_current_dir(place.path())?;
    let mut ran: Vec<&str> = Vec::new();
    for picture in PICTURES.iter().filter(is_chosen) {
        for line in picture.commands {
            if !ran.contains(line) {
                run(line)?;
                ran.push(line);
            }
        }
        let target = images.join(picture.name);
        match picture.source {
            Source::Figure(path) => fs::write(&target, on_paper(&fs::read_to_string(path)?))?,
            Source::Page(path, size) => shoot(&place.path().join(path), size, &target)?,
            Source::BrowserPage(size) => shoot(&root.join(PAGE), size, &target)?,
        }
        println!("{}", picture.name);
    }
    Ok(())
}

/// Fills a folder with the cases, the data and the sweeps that the commands read.
fn fill(place: &Path, root: &Path) -> Result<(), Box<dyn Error>> {
    for folder in ["cases", "validation/data"] {
        fs::create_dir_all(place.join(folder))?;
        for entry in fs::read_dir(root.join(folder))? {
            let name = entry?.file_name();
            fs::copy(root.join(folder).join(&name), place.join(folder).join(&name))?;
        }
    }
    for (name, text) in OWN_CASES {
        fs::write(place.join("cases").join(name), text)?;
    }
    Ok(())
}

/// Runs a command of the program; its result is the picture, and what it prints is not shown twice.
fn run(line: &str) -> Result<(), Box<dyn Error>> {
    let words = ["fem-run"].into_iter().chain(line.split_whitespace()).chain(["--quiet"]);
    match fem_command::run(words.map(Into::into)) {
        0 => Ok(()),
        status => Err(format!("fem-run {line}: exit status {status}").into()),
    }
}

/// Returns a figure on a white ground, so that it is legible on a dark page.
fn on_paper(svg: &str) -> String {
    const GROUND: &str = "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>";
    let marked = svg.replace("<!-- fem-run plot -->", "");
    let is_there = marked.contains(GROUND) || marked.contains("fill=\"white\"");
    match is_there {
        true => marked,
        false => marked.replacen('>', &format!(">\n{GROUND}"), 1),
    }
}

/// Writes a screenshot of a page; says so if there is no page or no browser.
fn shoot(page: &Path, [width, height]: [u32; 2], target: &Path) -> Result<(), Box<dyn Error>> {
    let browser = env::var_os("CHROMIUM").map_or("chromium".into(), PathBuf::from);
    let silent = || {
        let mut command = Command::new(&browser);
        command.stdout(Stdio::null()).stderr(Stdio::null());
        command
    };
    if !page.exists() || !silent().arg("--version").status().is_ok_and(|status| status.success()) {
        let lacking = if page.exists() { &browser } else { page };
        println!("not made: {} is missing, which {} needs", lacking.display(), target.display());
        return Ok(());
    }
    let mut command = silent();
    command.args(["--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars"]);
    command.arg(format!("--window-size={width},{height}"));
    command.arg(format!("--virtual-time-budget={PATIENCE}"));
    command.arg(format!("--screenshot={}", target.display()));
    let status = command.arg(format!("file://{}", page.display())).status()?;
    if status.success() { Ok(()) } else { Err(format!("{}: no screenshot", page.display()).into()) }
}
