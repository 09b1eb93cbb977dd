//! Checks that files, source items and links on the pages exist.

use std::collections::HashSet;
use std::fs;

use crate::pages::{Page, root};

/// Folders at the top that a path may begin with; any other path begins in `crates/`.
const TOP: [&str; 9] = [
    "crates/",
    ".ci/",
    "cases/",
    "docs/",
    "fuzz/",
    "meshes/",
    "tools/",
    "validation/",
    "clippy.toml",
];
/// Crates outside `crates/`, and their folders.
pub const APART: [(&str, &str); 3] =
    [("fem-fuzz", "fuzz"), ("fem-tools", "tools"), ("fem-validate", "validation")];
/// Placeholders in paths.
const PLACEHOLDERS: [&str; 5] = ["NAME", "CASE", "<", "*", "…"];
/// Lists of the pages of docs/: the index, and the summary from which mdBook makes a site.
const LISTS: [&str; 2] = ["README.md", "SUMMARY.md"];
/// Keywords that define an item.
const DEFINERS: [&str; 9] =
    ["const", "enum", "fn", "macro_rules!", "mod", "static", "struct", "trait", "type"];

/// A place in the source such as `fem-material/src/prony.rs:PronySeries`, relative to `crates/`.
struct Pointer<'a> {
    path: &'a str,
    item: Option<&'a str>,
}

impl<'a> Pointer<'a> {
    fn parse(code: &'a str) -> Option<Self> {
        if code.contains(' ') || PLACEHOLDERS.iter().any(|mark| code.contains(mark)) {
            return None;
        }
        let (path, item) = match code.split_once(".rs:") {
            Some((stem, item)) => (&code[..stem.len() + ".rs".len()], Some(item)),
            None => (code, None),
        };
        let in_crate = path.starts_with("fem-") || path.starts_with("fem/");
        let is_source = path.ends_with(".rs") || in_crate && path.contains('/');
        let is_top = TOP.iter().any(|folder| path.starts_with(folder));
        (is_source || is_top || is_crate(path)).then_some(Self { path, item })
    }

    fn fault(&self) -> Option<String> {
        let is_top = TOP.iter().any(|folder| self.path.starts_with(folder));
        let apart = APART.iter().find(|(name, _)| *name == self.path);
        let place = match apart {
            Some((_, folder)) => root().join(folder),
            None if is_top => root().join(self.path),
            None => root().join("crates").join(self.path),
        };
        if !place.exists() {
            return Some(format!("there is no {}", self.path));
        }
        let item = self.item?;
        let source = fs::read_to_string(place).unwrap();
        let is_defined = defined(&source).contains(item);
        (!is_defined).then(|| format!("{} defines no {item}", self.path))
    }
}

/// Whether the text has the form of a crate's name.
fn is_crate(code: &str) -> bool {
    code.strip_prefix("fem-").is_some_and(|name| name.chars().all(|c| c.is_ascii_lowercase()))
}

/// Returns the names of the items that a source file defines, methods included.
fn defined(source: &str) -> HashSet<&str> {
    let lines = source.lines().filter(|line| !line.trim_start().starts_with("//"));
    let words = lines.flat_map(|line| line.split(|c: char| " (){}<>:;=".contains(c)));
    let words: Vec<&str> = words.filter(|word| !word.is_empty()).collect();
    words.windows(2).filter(|pair| DEFINERS.contains(&pair[0])).map(|pair| pair[1]).collect()
}

#[test]
fn source_pointers_in_docs_exist() {
    let mut faults = Vec::new();
    let mut n_items = 0;
    for page in Page::all() {
        for code in page.code() {
            let Some(pointer) = Pointer::parse(&code.text) else { continue };
            n_items += usize::from(pointer.item.is_some());
            let is_bare = pointer.path.ends_with(".rs") && pointer.item.is_none();
            let wanting = (is_bare && page.path == "docs/theory.md")
                .then(|| format!("{} wants an item, as in file.rs:item", pointer.path));
            if let Some(fault) = pointer.fault().or(wanting) {
                faults.push(format!("{}:{}: `{}`: {fault}", page.path, code.line, code.text));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    assert!(n_items > 20, "{n_items}");
}

#[test]
fn links_in_docs_have_targets() {
    let mut faults = Vec::new();
    for page in Page::all() {
        let folder = page.path.rsplit_once('/').map_or("", |(folder, _)| folder);
        for link in page.links().iter().filter(|link| !link.text.contains("://")) {
            let (path, anchor) = match link.text.split_once('#') {
                Some((path, anchor)) => (path, Some(anchor)),
                None => (link.text.as_str(), None),
            };
            let target =
                if path.is_empty() { page.path.clone() } else { format!("{folder}/{path}") };
            let target = target.trim_start_matches('/');
            let is_there = root().join(target).exists()
                && anchor.is_none_or(|name| Page::load(target).anchors().iter().any(|a| a == name));
            if !is_there {
                faults.push(format!("{}:{}: ({})", page.path, link.line, link.text));
            }
        }
    }
    assert!(faults.is_empty(), "links that lead nowhere:\n{}", faults.join("\n"));
}

/// The index and the summary of the site link to every page once and to no other page of docs/.
#[test]
fn every_page_is_in_the_index_and_on_the_site() {
    let pages = Page::all();
    let of_docs = pages.iter().filter_map(|page| page.path.strip_prefix("docs/"));
    let names: Vec<&str> = of_docs.filter(|name| !LISTS.contains(name)).collect();
    assert!(names.len() > 20);
    for list in LISTS {
        let links = Page::load(&format!("docs/{list}")).links();
        let mut linked: Vec<&str> = links.iter().map(|link| link.text.as_str()).collect();
        linked.retain(|link| !link.starts_with("../") && !LISTS.contains(link));
        linked.sort_unstable();
        assert_eq!(linked, names, "pages of docs/{list}, and those in docs/");
    }
}

#[test]
fn pointer_check_finds_the_items_defined_in_a_file() {
    let source = "pub(crate) fn one<T>(x: T) {}\n// fn two\nmod three;\npub const FOUR: u8 = 4;\n\
                  use five::six;\npub struct Seven(u8);\n";
    let mut names: Vec<_> = defined(source).into_iter().collect();
    names.sort_unstable();
    assert_eq!(names, ["FOUR", "Seven", "one", "three"]);
}
