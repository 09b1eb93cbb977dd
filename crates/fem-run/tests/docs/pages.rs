//! Reads the parts of Markdown pages that the tests need.

use std::fs;
use std::path::{Path, PathBuf};

/// Returns the root of the repository.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// A Markdown page.
pub struct Page {
    /// Path from the root.
    pub path: String,
    /// The text of the page.
    pub text: String,
}

/// A fenced code block.
pub struct Block {
    /// Line number of its first line, from 1.
    pub line: usize,
    /// Language after the opening fence.
    pub language: String,
    /// Text without the fences.
    pub text: String,
}

/// A piece of inline text.
pub struct Piece {
    /// Line number in the page, from 1.
    pub line: usize,
    /// Text without its markup.
    pub text: String,
}

impl Page {
    /// Loads a page by its path from the root.
    pub fn load(path: &str) -> Self {
        let text = fs::read_to_string(root().join(path));
        let text = text.unwrap_or_else(|error| panic!("{path}: {error}"));
        Self { path: path.to_string(), text }
    }

    /// Loads all pages except the change log, which describes the past.
    pub fn all() -> Vec<Self> {
        let mut paths = Vec::new();
        for folder in ["", "docs/", "validation/", "validation/data/", "meshes/"] {
            for entry in fs::read_dir(root().join(folder)).unwrap() {
                let name = entry.unwrap().file_name().into_string().unwrap();
                if name.ends_with(".md") && name != "CHANGELOG.md" {
                    paths.push(format!("{folder}{name}"));
                }
            }
        }
        paths.sort();
        paths.iter().map(|path| Self::load(path)).collect()
    }

    /// Returns the fenced blocks.
    pub fn blocks(&self) -> Vec<Block> {
        let mut blocks = Vec::new();
        let mut open: Option<Block> = None;
        for (k, line) in self.text.lines().enumerate() {
            match (line.strip_prefix("```"), &mut open) {
                (Some(language), None) => {
                    let language = language.to_string();
                    open = Some(Block { line: k + 2, language, text: String::new() });
                }
                (Some(_), Some(_)) => blocks.extend(open.take()),
                (None, Some(block)) => block.text += &format!("{line}\n"),
                (None, None) => {}
            }
        }
        assert!(open.is_none(), "{}: a block without an end", self.path);
        blocks
    }

    /// Returns the text without fenced blocks, with the same line numbers.
    fn prose(&self) -> String {
        let mut in_block = false;
        let mut prose = String::new();
        for line in self.text.lines() {
            let is_fence = line.starts_with("```");
            in_block ^= is_fence;
            prose += if is_fence || in_block { "" } else { line };
            prose += "\n";
        }
        prose
    }

    /// Returns the inline code of the text.
    pub fn code(&self) -> Vec<Piece> {
        let prose = self.prose();
        let mut line = 1;
        let mut code = Vec::new();
        let parts: Vec<&str> = prose.split('`').collect();
        assert!(parts.len() % 2 == 1, "{}: a backtick without another", self.path);
        for (k, part) in parts.into_iter().enumerate() {
            if k % 2 == 1 {
                let text = part.split_whitespace().collect::<Vec<_>>().join(" ");
                code.push(Piece { line, text });
            }
            line += part.matches('\n').count();
        }
        code
    }

    /// Returns the targets of links and pictures.
    pub fn links(&self) -> Vec<Piece> {
        let mut links = Vec::new();
        for (k, line) in self.prose().lines().enumerate() {
            for rest in line.split("](").skip(1) {
                let text = rest.split(')').next().unwrap_or_default().to_string();
                links.push(Piece { line: k + 1, text });
            }
        }
        links
    }

    /// Returns the anchors of the headings.
    pub fn anchors(&self) -> Vec<String> {
        let prose = self.prose();
        let headings = prose.lines().filter(|line| line.starts_with('#'));
        let kept = |c: &char| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_');
        headings
            .map(|line| line.trim_start_matches('#').trim().to_lowercase())
            .map(|heading| heading.chars().filter(kept).collect::<String>().replace(' ', "-"))
            .collect()
    }

    /// Returns, for each table whose first column has this heading, the line of the heading and the code in the first
    /// column.
    pub fn first_columns(&self, heading: &str) -> Vec<(usize, Vec<String>)> {
        let lines: Vec<&str> = self.text.lines().collect();
        let mut columns = Vec::new();
        for (k, line) in lines.iter().enumerate() {
            if line.starts_with(&format!("| {heading} |")) {
                let rows = lines[k + 2..].iter().take_while(|row| row.starts_with('|'));
                let cells = rows.filter_map(|row| row.split('|').nth(1));
                let code = cells.flat_map(|cell| cell.split('`').skip(1).step_by(2));
                columns.push((k + 1, code.map(String::from).collect()));
            }
        }
        columns
    }
}
