//! The pictures of the pages in `docs/`, all made by one command from the shipped cases.
//!
//! `cargo run --release -p fem-tools -- pictures docs/images [NAME...]`
//!
//! Each picture is what a command of the program writes, in a temporary folder: figures as SVG, and pages as PNG by a
//! headless Chromium. `CHROMIUM` names the browser if it is not `chromium` on the path. Without a browser, or without the
//! browser page that `crates/fem-page/build.sh` builds, these pictures stay as they are. With names, only the pictures
//! whose file names contain one of them are made.

mod list;

use std::io::{BufRead, BufReader, Write};
use std::net::TcpListener;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Duration;
use std::{env, fs, thread};

use crate::Error;
use list::{OWN_CASES, PICTURES, Picture, Source};

/// The page that `crates/fem-page/build.sh` builds.
const PAGE: &str = "target/page/index.html";
/// Time in which the browser page computes its first collision.
const PATIENCE: Duration = Duration::from_secs(8);

/// Makes the pictures in the folder of the first word, those that the other words name.
pub fn run(words: &[String]) -> Result<(), Error> {
    let mut words = words.iter();
    let images = words.next().ok_or("name the folder of the pictures, such as docs/images")?;
    let (names, root) = (words.collect::<Vec<_>>(), env::current_dir()?);
    let images = root.join(images);
    let is_chosen = |one: &&Picture| {
        names.is_empty() || names.iter().any(|name| one.name.contains(name.as_str()))
    };
    let place = tempfile::tempdir()?;
    fill(place.path(), &root)?;
    env::set_current_dir(place.path())?;
    let mut ran: Vec<&str> = Vec::new();
    for picture in PICTURES.iter().filter(is_chosen) {
        for line in picture.commands {
            if !ran.contains(line) {
                run_command(line)?;
                ran.push(line);
            }
        }
        println!("{}", picture.name);
        let target = images.join(picture.name);
        match picture.source {
            Source::Figure(path) => fs::write(&target, on_paper(&fs::read_to_string(path)?))?,
            Source::Page(path, size) => {
                let page = place.path().join(path);
                shoot(&format!("file://{}", page.display()), size, &target)?;
            }
            Source::BrowserPage(size) => match fs::read_to_string(root.join(PAGE)) {
                Ok(page) => shoot(&served(page)?, size, &target)?,
                Err(error) => println!("{} is not made: {PAGE}: {error}", picture.name),
            },
        }
    }
    Ok(())
}

/// Fills a folder with the cases, the data and the sweeps that the commands read.
fn fill(place: &Path, root: &Path) -> Result<(), Error> {
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
fn run_command(line: &str) -> Result<(), Error> {
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

/// Serves a page to one browser and returns its address. The page loads an image that comes after [`PATIENCE`], for which
/// the browser waits before it takes a screenshot; a page that computes in a worker is complete by then.
fn served(page: String) -> Result<String, Error> {
    let listener = TcpListener::bind("127.0.0.1:0")?;
    let address = format!("http://{}/", listener.local_addr()?);
    let page = page.replacen("</body>", "<img src=\"late\" alt=\"\" hidden></body>", 1);
    thread::spawn(move || {
        for stream in listener.incoming().filter_map(Result::ok) {
            let page = page.clone();
            thread::spawn(move || answer(stream, &page));
        }
    });
    Ok(address)
}

fn answer(mut stream: std::net::TcpStream, page: &str) -> std::io::Result<()> {
    let mut lines = BufReader::new(&stream).lines();
    let first = lines.next().transpose()?.unwrap_or_default();
    while lines.next().transpose()?.is_some_and(|line| !line.is_empty()) {}
    drop(lines);
    let is_page = first.starts_with("GET / ");
    if !is_page {
        thread::sleep(PATIENCE);
    }
    let (status, body) = if is_page { ("200 OK", page) } else { ("404 Not Found", "") };
    let head = format!(
        "HTTP/1.1 {status}\r\nContent-Type: text/html; charset=utf-8\r\nContent-Length: {}\r\nConnection: \
         close\r\n\r\n",
        body.len()
    );
    stream.write_all(head.as_bytes())?;
    stream.write_all(body.as_bytes())
}

/// Writes a screenshot of a page; says so if there is no browser.
fn shoot(page: &str, [width, height]: [u32; 2], target: &Path) -> Result<(), Error> {
    let browser = env::var_os("CHROMIUM").map_or("chromium".into(), PathBuf::from);
    let mut command = Command::new(&browser);
    command.stdout(Stdio::null()).stderr(Stdio::null());
    command.args(["--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars"]);
    command.arg(format!("--window-size={width},{height}"));
    command.arg(format!("--screenshot={}", target.display())).arg(page);
    match command.status() {
        Err(error) => {
            println!("{} is not made: {}: {error}", target.display(), browser.display());
            Ok(())
        }
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(format!("{page}: no screenshot: {status}").into()),
    }
}
