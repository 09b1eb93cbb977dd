//! Checks the pictures of the pages: each is described, each is shown on a page, and one command makes them.

use std::collections::BTreeSet;
use std::fs;

use crate::pages::{Page, root};

/// Fewest letters of a description, for readers who cannot see the picture.
const MIN_LETTERS: usize = 20;
/// Most bytes of all pictures.
const MAX_BYTES: u64 = 1_500_000;

/// Returns the description and the path from the root of each picture on a page.
fn pictures(page: &Page) -> Vec<(String, String)> {
    let folder = page.path.rsplit_once('/').map_or("", |(folder, _)| folder);
    let marks = page.text.split("![").skip(1);
    let shown = marks.filter_map(|rest| {
        let (description, rest) = rest.split_once("](")?;
        let (path, _) = rest.split_once(')')?;
        Some((description.to_string(), path.to_string()))
    });
    let from_root = |path: String| match path.strip_prefix("../") {
        Some(path) => path.to_string(),
        None if folder.is_empty() => path,
        None => format!("{folder}/{path}"),
    };
    shown.map(|(description, path)| (description, from_root(path))).collect()
}

/// The files of docs/images are the pictures that the example makes, and the pages show all of them.
#[test]
fn every_picture_is_made_shown_and_described() {
    let mut shown = BTreeSet::new();
    for page in Page::all() {
        for (description, path) in pictures(&page) {
            // The reports below validation/ are written by their commands.
            let least = if page.path.starts_with("validation/") { 1 } else { MIN_LETTERS };
            let is_described = description.chars().count() >= least;
            assert!(is_described, "{}: {path}: \"{description}\"", page.path);
            assert!(root().join(&path).exists(), "{} shows {path}, which is missing", page.path);
            shown.insert(path);
        }
    }
    let list = include_str!("../../../../tools/src/pictures/list.rs");
    let mut n_bytes = 0;
    for entry in fs::read_dir(root().join("docs/images")).unwrap() {
        let entry = entry.unwrap();
        let name = entry.file_name().into_string().unwrap();
        n_bytes += entry.metadata().unwrap().len();
        assert!(list.contains(&format!("\"{name}\"")), "no command makes {name}");
        assert!(shown.contains(&format!("docs/images/{name}")), "no page shows {name}");
    }
    assert!(n_bytes < MAX_BYTES, "{n_bytes}");
    let names = list.split('"').filter(|word| word.ends_with(".png") || word.ends_with(".svg"));
    let made = names.filter(|name| shown.contains(&format!("docs/images/{name}"))).count();
    assert!(made > 15, "{made}");
}

#[test]
fn pictures_of_a_page_are_read_with_their_descriptions() {
    let of = |path: &str, text: &str| pictures(&Page { path: path.into(), text: text.into() });
    let expected = |path: &str| vec![("a ball".to_string(), path.to_string())];
    assert_eq!(of("docs/a.md", "x ![a ball](images/b.svg) y"), expected("docs/images/b.svg"));
    assert_eq!(of("docs/a.md", "![a ball](../validation/b.svg)"), expected("validation/b.svg"));
    assert_eq!(of("README.md", "![a ball](docs/images/b.svg)"), expected("docs/images/b.svg"));
}
