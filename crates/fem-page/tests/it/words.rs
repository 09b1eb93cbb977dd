//! The page has a text of its own for everything that results name.

use fem::Account;
use fem_page::LibraryEntry;

const WORDS: &str = include_str!("../../web/scripts/accounts.js");
const SCENE: &str = include_str!("../../web/scripts/scene.js");

#[test]
fn every_account_has_plain_words() {
    // The work of a wall is supplied during the collision; the others are present from the start.
    for account in Account::all().filter(|account| *account != Account::WallWork) {
        assert!(WORDS.contains(&format!("  {}: '", account.name())), "{}", account.name());
    }
    for part in ["rebound", "ringing"] {
        assert!(WORDS.contains(&format!("  {part}: '")), "{part}");
    }
}

/// The page cuts a relaxation off at its table, and starts with a material of the library.
#[test]
fn library_material_text_ends_with_its_relaxation() {
    let all = LibraryEntry::all();
    assert!(all.len() > 10);
    for material in &all {
        let table = format!("\n[material.{}.relaxation]", material.name);
        let parts: Vec<&str> = material.text.split(&table).collect();
        assert!(parts.len() <= 2 && parts[0].contains("density"), "{}", material.text);
        assert!(!parts[0].contains("terms"), "{}", material.text);
    }
    assert!(SCENE.contains("'striker.material': 'glass'"));
    assert!(
        all.iter().any(|material| material.name == "glass" && material.text.contains("2708 1/s"))
    );
}
