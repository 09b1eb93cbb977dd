//! Reads the commands in a block of a page.

use crate::pages::{Block, Page};

/// A command and its position.
pub struct Shown {
    /// Page and line.
    pub place: String,
    /// Words of the command.
    pub words: Vec<String>,
}

impl Shown {
    /// Returns the arguments of the command if it is this program's, without shell redirections.
    pub fn arguments(&self) -> Option<&[String]> {
        let own = ["fem-run"];
        let built = ["cargo", "run", "--release", "--"];
        [&own[..], &built].iter().find_map(|name| {
            let (head, rest) = self.words.split_at_checked(name.len())?;
            let is_behind = |word: &String| [">", "|", "<"].contains(&word.as_str());
            let end = rest.iter().position(is_behind).unwrap_or(rest.len());
            (head == *name).then_some(&rest[..end])
        })
    }
}

/// Returns the commands of a shell block.
pub fn commands(page: &Page, block: &Block) -> Vec<Shown> {
    if !matches!(block.language.as_str(), "sh" | "console") {
        return Vec::new();
    }
    let joined = block.text.replace("\\\n", " ");
    let lines = joined.lines().map(|line| line.trim_start_matches("$ "));
    let place = format!("{}:{}", page.path, block.line);
    lines
        .map(|line| Shown { place: place.clone(), words: words(line) })
        .filter(|command| !command.words.is_empty())
        .collect()
}

/// Splits a line into words like a shell; a variable becomes 1.
pub fn words(line: &str) -> Vec<String> {
    let mut words = Vec::new();
    let mut word: Option<String> = None;
    let mut quote = None;
    let mut letters = line.chars().peekable();
    while let Some(c) = letters.next() {
        match (c, quote) {
            ('\'' | '"', None) => {
                quote = Some(c);
                word.get_or_insert_default();
            }
            (c, Some(open)) if c == open => quote = None,
            ('#', None) if word.is_none() => break,
            (c, None) if c.is_whitespace() => words.extend(word.take()),
            ('$', None | Some('"')) => {
                while letters.next_if(|c| c.is_ascii_uppercase() || *c == '_').is_some() {}
                word.get_or_insert_default().push('1');
            }
            (c, _) => word.get_or_insert_default().push(c),
        }
    }
    assert!(quote.is_none(), "a quote without an end: {line}");
    words.extend(word);
    words
}

#[test]
fn command_lines_in_docs_are_split_like_a_shell() {
    let line = r#"fem-run a.toml --set b='"1 m/s"' --shard "$TASK_ID/10" '' # and so on"#;
    let expected = ["fem-run", "a.toml", "--set", r#"b="1 m/s""#, "--shard", "1/10", ""];
    assert_eq!(words(line), expected);
}
