//! Lengths that lie cost no memory: the allocator itself counts, for each thread.

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::io::Write;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use fem_vtk::VtuFile;

use crate::hostile_files::{ZLIB, header_bytes, square};

thread_local! {
    /// Bytes in use, less those that another thread has allocated, and their maximum.
    static NOW: Cell<i64> = const { Cell::new(0) };
    static PEAK: Cell<i64> = const { Cell::new(0) };
}

struct Counting;

// SAFETY: passes every call on to the system's allocator.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        NOW.set(NOW.get() + layout.size() as i64);
        PEAK.set(PEAK.get().max(NOW.get()));
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        NOW.set(NOW.get() - layout.size() as i64);
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Peak bytes while the mesh of a file with these points is refused.
fn peak_of_refusal(n_points: usize, header: &[u64], blocks: &[u8]) -> i64 {
    let points = STANDARD.encode(header_bytes(header)) + &STANDARD.encode(blocks);
    let piece = format!("NumberOfPoints=\"{n_points}\" NumberOfCells=\"{n_points}\"");
    let text = square(&piece, &points, "", "", "").replacen("ascii", "binary", 1);
    let text = text.replace("<VTKFile", &format!("<VTKFile {ZLIB}"));
    let before = NOW.get();
    PEAK.set(before);
    let file = VtuFile::from_bytes("lie.vtu", text.into_bytes()).unwrap();
    file.quad_mesh().unwrap_err();
    PEAK.get() - before
}

#[test]
fn hostile_headers_and_zlib_bombs_use_little_memory() {
    // 32 MiB of zeros in 32 KiB.
    let mut encoder = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::best());
    encoder.write_all(&vec![0; 1 << 25]).unwrap();
    let bomb = encoder.finish().unwrap();
    let size = bomb.len() as u64;

    // Two copies of the file's bytes, a zlib decoder (50 kB), and slack.
    let enough = 2 * bomb.len() as i64 + 200_000;
    for (n_points, header) in [
        (4, [1, 32768, 96, size]),
        (usize::MAX, [1, 1 << 62, 1 << 61, size]),
        (1 << 40, [1 << 40, 32768, 0, size]),
        (1 << 40, [1, 1 << 40, 0, 1 << 40]),
    ] {
        let peak = peak_of_refusal(n_points, &header, &bomb);
        assert!(peak < enough, "{peak} bytes for {header:?}");
    }
}
