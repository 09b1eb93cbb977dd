//! Pages with tables that a program writes.

use std::io;
use std::path::Path;

/// Replaces the text between the marks `<!-- NAME -->` and `<!-- end of NAME -->`, each on a line of its
/// own, by a table.
pub fn put(page: &Path, name: &str, table: &str) -> io::Result<()> {
    let text = std::fs::read_to_string(page)?;
    let [begin, end] = [format!("<!-- {name} -->\n"), format!("<!-- end of {name} -->\n")];
    let parts = text.split_once(&begin).and_then(|(before, rest)| {
        let (_, after) = rest.split_once(&end)?;
        Some([before, after])
    });
    let [before, after] =
        parts.ok_or_else(|| io::Error::other(format!("the page has no place for {name}")))?;
    std::fs::write(page, format!("{before}{begin}\n{}\n\n{end}{after}", table.trim()))
}
