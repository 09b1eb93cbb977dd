//! Pages with tables that a program writes.

use std::io;
use std::path::Path;

use crate::Error;

/// Replaces the text between the marks `<!-- NAME -->` and `<!-- end of NAME -->`, each on a line of its
/// own, by a table.
fn put(page: &Path, name: &str, table: &str) -> io::Result<()> {
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

/// Puts a table into a page, or prints it if no page is named.
pub fn put_or_print(page: Option<&String>, name: &str, table: &str) -> Result<(), Error> {
    match page {
        Some(page) => put(Path::new(page), name, table)?,
        None => println!("{table}"),
    }
    Ok(())
}
