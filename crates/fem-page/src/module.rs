//! The WebAssembly interface: numbers and bytes.
//!
//! ```text
//! page_reserve(n)  →  address of n bytes for a text
//! page_begin(rows, frames), page_advance(pieces), page_finish(seconds)
//! page_picture(index, half_width), page_chart(), page_materials()
//! page_answer(), page_answer_length()  →  the answer to one of these, as JSON
//! ```
//!
//! Memory may grow in any call, so addresses must be requested after it. A failure, also for lack of memory, ends the
//! module with a trap; [`page_answer`] then still points to its message, if there is one.

use std::cell::RefCell;
use std::panic;
use std::sync::{Mutex, Once, PoisonError};

use serde::Serialize;

use crate::charts::ChartSpec;
use crate::outcome::{CaseFault, LibraryEntry};
use crate::session::{RecordedAmount, Session};

thread_local! {
    static PAGE: RefCell<Page> = RefCell::default();
}

/// Separate from the page's state, which a trap leaves borrowed.
static ANSWER: Mutex<Vec<u8>> = Mutex::new(Vec::new());
static HOOK: Once = Once::new();

#[derive(Default)]
struct Page {
    text: Vec<u8>,
    session: Session,
}

/// Clears the previous answer, so that a trap without a message leaves none.
fn with<T>(act: impl FnOnce(&mut Page) -> T) -> T {
    answer(Vec::new());
    PAGE.with(|page| act(&mut page.borrow_mut()))
}

fn answer(bytes: Vec<u8>) {
    *ANSWER.lock().unwrap_or_else(PoisonError::into_inner) = bytes;
}

fn answer_json<T: Serialize>(value: &T) {
    // Serialisation fails only if there is no memory.
    answer(serde_json::to_vec(value).unwrap_or_default());
}

/// Reserves `length` bytes for a text and returns their address.
#[unsafe(no_mangle)]
pub extern "C" fn page_reserve(length: usize) -> *mut u8 {
    HOOK.call_once(|| panic::set_hook(Box::new(|what| answer(what.to_string().into_bytes()))));
    with(|page| {
        page.text.resize(length, 0);
        page.text.as_mut_ptr()
    })
}

/// Begins the collision of the case whose text was written and returns 0, or 1 if the case has an error.
/// The answer is a [`RunStart`](crate::RunStart) or a [`CaseFault`].
#[unsafe(no_mangle)]
pub extern "C" fn page_begin(rows: usize, frames: usize) -> u32 {
    with(|page| {
        let text = String::from_utf8_lossy(&page.text).into_owned();
        match page.session.begin(&text, RecordedAmount { rows, frames }) {
            Ok(begun) => {
                answer_json(&begun);
                0
            }
            Err(error) => {
                answer_json(&CaseFault::from(error));
                1
            }
        }
    })
}

/// Computes the next pieces of the run and returns the completed share, 1 when it is over.
#[unsafe(no_mangle)]
pub extern "C" fn page_advance(pieces: u32) -> f64 {
    with(|page| page.session.advance(pieces))
}

/// Ends the run, complete or not, after this time in seconds. The answer is a
/// [`RunOutcome`](crate::RunOutcome), or null.
#[unsafe(no_mangle)]
pub extern "C" fn page_finish(seconds: f64) {
    with(|page| answer_json(&page.session.finish(seconds)));
}

/// Draws the bodies at an instant, in a window of `half_width` contact radii to each side of the contact.
/// The answer is a [`StressPicture`](crate::StressPicture), or null.
#[unsafe(no_mangle)]
pub extern "C" fn page_picture(index: usize, half_width: f64) {
    with(|page| answer_json(&page.session.picture(index, half_width)));
}

/// Answers with the library: each material's name, title, source, range of validity and table in a case.
#[unsafe(no_mangle)]
pub extern "C" fn page_materials() {
    answer_json(&LibraryEntry::all());
}

/// Draws the chart whose [`ChartSpec`] was written. The answer is SVG text, or null.
#[unsafe(no_mangle)]
pub extern "C" fn page_chart() {
    with(|page| {
        let spec = serde_json::from_slice::<ChartSpec>(&page.text).ok();
        answer_json(&spec.and_then(|spec| spec.svg()));
    });
}

/// Returns the address of the answer.
#[unsafe(no_mangle)]
pub extern "C" fn page_answer() -> *const u8 {
    ANSWER.lock().unwrap_or_else(PoisonError::into_inner).as_ptr()
}

/// Returns the length of the answer in bytes.
#[unsafe(no_mangle)]
pub extern "C" fn page_answer_length() -> usize {
    ANSWER.lock().unwrap_or_else(PoisonError::into_inner).len()
}
