//! What WebAssembly exports: numbers and bytes.
//!
//! ```text
//! page_reserve(n)  →  address of n bytes, for a text
//! page_begin(rows, frames), page_advance(pieces), page_finish(seconds)
//! page_picture(index, half_width), page_chart(), page_materials()
//! page_answer(), page_answer_length()  →  what one of these has answered, as JSON
//! ```
//!
//! Memory may grow in any call, so addresses are asked for after it. A failure ends the module
//! with a trap, also that no memory is left; [`page_answer`] then still leads to what it said, if anything.

use std::cell::RefCell;
use std::panic;
use std::sync::{Mutex, Once, PoisonError};

use serde::Serialize;

use crate::charts::ChartSpec;
use crate::fault::Fault;
use crate::library_entry::LibraryEntry;
use crate::session::{Ask, Session};

thread_local! {
    static PAGE: RefCell<Page> = RefCell::default();
}

/// Apart from the rest, which a trap leaves borrowed.
static ANSWER: Mutex<Vec<u8>> = Mutex::new(Vec::new());
static HOOK: Once = Once::new();

#[derive(Default)]
struct Page {
    text: Vec<u8>,
    session: Session,
}

/// What was answered before is gone, so that a trap without a word leaves none.
fn with<T>(act: impl FnOnce(&mut Page) -> T) -> T {
    answer(Vec::new());
    PAGE.with(|page| act(&mut page.borrow_mut()))
}

fn answer(bytes: Vec<u8>) {
    *ANSWER.lock().unwrap_or_else(PoisonError::into_inner) = bytes;
}

fn answer_json<T: Serialize>(value: &T) {
    // Structs of texts and numbers: the one way to fail is no memory.
    answer(serde_json::to_vec(value).unwrap_or_default());
}

/// Room for a text of so many bytes: where to write it.
#[unsafe(no_mangle)]
pub extern "C" fn page_reserve(length: usize) -> *mut u8 {
    HOOK.call_once(|| panic::set_hook(Box::new(|what| answer(what.to_string().into_bytes()))));
    with(|page| {
        page.text.resize(length, 0);
        page.text.as_mut_ptr()
    })
}

/// Begins the collision of the case whose text was written: 0, or 1 where something is wrong with it.
/// The answer is a [`Begun`](crate::Begun) or a [`Fault`].
#[unsafe(no_mangle)]
pub extern "C" fn page_begin(rows: usize, frames: usize) -> u32 {
    with(|page| {
        let text = String::from_utf8_lossy(&page.text).into_owned();
        match page.session.begin(&text, Ask { rows, frames }) {
            Ok(begun) => {
                answer_json(&begun);
                0
            }
            Err(error) => {
                answer_json(&Fault::from(error));
                1
            }
        }
    })
}

/// Goes on by so many pieces: how much of the run is done, 1 when it is over.
#[unsafe(no_mangle)]
pub extern "C" fn page_advance(pieces: u32) -> f64 {
    with(|page| page.session.advance(pieces))
}

/// Ends the run, over or not, after so long, s. The answer is an [`Outcome`](crate::Outcome), or null.
#[unsafe(no_mangle)]
pub extern "C" fn page_finish(seconds: f64) {
    with(|page| answer_json(&page.session.finish(seconds)));
}

/// Draws the bodies at an instant, in a window of so many contact radii to each side of the contact.
/// The answer is a [`StressPicture`](crate::StressPicture), or null.
#[unsafe(no_mangle)]
pub extern "C" fn page_picture(index: usize, half_width: f64) {
    with(|page| answer_json(&page.session.picture(index, half_width)));
}

/// The answer is the library: each material's name and title, what its numbers are from and where they
/// hold, and its table in a case.
#[unsafe(no_mangle)]
pub extern "C" fn page_materials() {
    answer_json(&LibraryEntry::all());
}

/// Draws the chart whose [`ChartSpec`] was written. The answer is a text of SVG, or null.
#[unsafe(no_mangle)]
pub extern "C" fn page_chart() {
    with(|page| {
        let spec = serde_json::from_slice::<ChartSpec>(&page.text).ok();
        answer_json(&spec.and_then(|spec| spec.svg()));
    });
}

/// Where the answer begins.
#[unsafe(no_mangle)]
pub extern "C" fn page_answer() -> *const u8 {
    ANSWER.lock().unwrap_or_else(PoisonError::into_inner).as_ptr()
}

/// Its length in bytes.
#[unsafe(no_mangle)]
pub extern "C" fn page_answer_length() -> usize {
    ANSWER.lock().unwrap_or_else(PoisonError::into_inner).len()
}
