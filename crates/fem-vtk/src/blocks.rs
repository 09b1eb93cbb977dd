//! The block format of an array's bytes, compressed (`vtkZLibDataCompressor`) or not.
//!
//! Compressed: a header of integers `[n_blocks, block_size, last_size, compressed_size...]`, then the consecutive zlib
//! streams. If the last block is full, `last_size` is 0 (VTK) or `block_size` (meshio). Uncompressed: a header `[n_bytes]`,
//! then the bytes. Integers are written as `UInt64` and read as `UInt32` or `UInt64`.

use std::cell::RefCell;
use std::io::{self, Read};

use flate2::read::ZlibDecoder;
use flate2::{Compress, Compression, FlushCompress, Status};

/// Uncompressed bytes per block, as in VTK's writer. It is a multiple of every number size, since meshio converts each
/// block separately.
pub(crate) const BLOCK_SIZE: usize = 32768;

/// Compression level. VTK's default, 5, doubles the time per file and saves a tenth of its size.
const LEVEL: Compression = Compression::new(1);

/// Size in bytes of a sample from the middle of an array, which decides whether it is compressed.
const SAMPLE_SIZE: usize = 4096;

/// Largest compressed fraction of a sample; other arrays are stored. Deflate makes noisy mantissas 5 % larger.
const MAX_SHARE: f64 = 0.9;

/// Size of the output buffer of a stream, bytes.
const ROOM: usize = 32768;

/// Upper bound of the bytes that a stored stream adds to its block.
const MAX_ADDED: usize = 64;

/// Largest compression ratio of zlib (Technical Details, zlib.net).
const MAX_RATIO: usize = 1032;

/// The two parts of a compressed array, which base64 encodes separately.
#[derive(Debug)]
pub(crate) struct Compressed {
    pub(crate) header: Vec<u8>,
    pub(crate) blocks: Vec<u8>,
}

thread_local! {
    /// The state of deflate, one per thread: it has about 300 KB, and creating one per block took longer than the block.
    static DEFLATE: RefCell<Deflate> = RefCell::new(Deflate::new());
}

/// Compresses bytes block by block, or stores them in the same format if compression saves little. The result is
/// deterministic.
pub(crate) fn compress(bytes: &[u8]) -> io::Result<Compressed> {
    DEFLATE.with_borrow_mut(|deflate| deflate.compress(bytes))
}

/// Compressor of successive zlib streams.
struct Deflate {
    shrinking: Compress,
    storing: Compress,
    room: Vec<u8>,
}

impl Deflate {
    fn new() -> Self {
        let with = |level| Compress::new(level, true);
        Self { shrinking: with(LEVEL), storing: with(Compression::none()), room: vec![0; ROOM] }
    }

    fn compress(&mut self, bytes: &[u8]) -> io::Result<Compressed> {
        let n_blocks = bytes.len().div_ceil(BLOCK_SIZE);
        let mut header = Vec::with_capacity(8 * (3 + n_blocks));
        for value in [n_blocks, BLOCK_SIZE, bytes.len() % BLOCK_SIZE] {
            header.extend((value as u64).to_le_bytes());
        }
        let mut blocks = Vec::with_capacity(bytes.len() + MAX_ADDED * (n_blocks + 1));
        let start = bytes.len().saturating_sub(SAMPLE_SIZE) / 2;
        let sample = &bytes[start..bytes.len().min(start + SAMPLE_SIZE)];
        append_stream(&mut self.shrinking, &mut self.room, sample, &mut blocks)?;
        let shrinks = blocks.len() as f64 <= MAX_SHARE * sample.len() as f64;
        if shrinks && sample.len() == bytes.len() {
            header.extend((blocks.len() as u64).to_le_bytes());
            return Ok(Compressed { header, blocks });
        }
        blocks.clear();
        let state = if shrinks { &mut self.shrinking } else { &mut self.storing };
        for block in bytes.chunks(BLOCK_SIZE) {
            let start = blocks.len();
            append_stream(state, &mut self.room, block, &mut blocks)?;
            header.extend(((blocks.len() - start) as u64).to_le_bytes());
        }
        Ok(Compressed { header, blocks })
    }
}

/// Appends the zlib stream of a block. zlib splits stored bytes at the size of `room`,
/// so a constant size gives equal files.
fn append_stream(
    state: &mut Compress,
    room: &mut [u8],
    bytes: &[u8],
    stream: &mut Vec<u8>,
) -> io::Result<()> {
    state.reset();
    let mut rest = bytes;
    loop {
        let before = (state.total_in(), state.total_out());
        let flush = if rest.is_empty() { FlushCompress::Finish } else { FlushCompress::None };
        let status = state.compress(rest, room, flush)?;
        let taken = (state.total_in() - before.0) as usize;
        let made = (state.total_out() - before.1) as usize;
        rest = &rest[taken..];
        stream.extend_from_slice(&room[..made]);
        match status {
            Status::StreamEnd => return Ok(()),
            _ if taken == 0 && made == 0 => return Err(io::Error::other("deflate stands still")),
            _ => {}
        }
    }
}

/// The sizes in a header `[n_blocks, block_size, last_size]`.
pub(crate) struct Layout {
    pub(crate) n_blocks: usize,
    block_size: usize,
    last_size: usize,
}

impl Layout {
    /// Returns `None` if the sizes contradict each other or overflow.
    pub(crate) fn new(n_blocks: usize, block_size: usize, last_size: usize) -> Option<Self> {
        let last_size = if last_size == 0 { block_size } else { last_size };
        let is_valid = n_blocks == 0 || (block_size > 0 && last_size <= block_size);
        let layout = Self { n_blocks, block_size, last_size };
        (is_valid && n_blocks.checked_mul(block_size).is_some()).then_some(layout)
    }

    /// Returns the number of bytes before compression.
    pub(crate) fn n_bytes(&self) -> usize {
        match self.n_blocks {
            0 => 0,
            n_blocks => (n_blocks - 1) * self.block_size + self.last_size,
        }
    }

    /// Decompresses the blocks; `None` if one is not zlib data of the size in the header. Memory grows with the
    /// decompressed bytes, never with the sizes in the header.
    pub(crate) fn decompress(&self, mut blocks: &[u8], sizes: &[usize]) -> Option<Vec<u8>> {
        if self.n_bytes() / MAX_RATIO > blocks.len() {
            return None;
        }
        let mut bytes = Vec::new();
        for (index, &size) in sizes.iter().enumerate() {
            let last = index + 1 == self.n_blocks;
            let expected = if last { self.last_size } else { self.block_size };
            let (block, rest) = blocks.split_at_checked(size)?;
            blocks = rest;
            let before = bytes.len();
            let limit = u64::try_from(expected).ok()?.checked_add(1)?;
            ZlibDecoder::new(block).take(limit).read_to_end(&mut bytes).ok()?;
            if bytes.len() - before != expected {
                return None;
            }
        }
        Some(bytes)
    }
}

#[cfg(test)]
mod tests {
    use std::io::Write;

    use super::*;

    fn header_numbers(header: &[u8]) -> Vec<usize> {
        let (numbers, _) = header.as_chunks::<8>();
        numbers.iter().map(|&bytes| u64::from_le_bytes(bytes) as usize).collect()
    }

    #[test]
    fn lengths_around_the_block_size_come_back() {
        let cases = [
            (1, 1, 1),
            (BLOCK_SIZE - 1, 1, BLOCK_SIZE - 1),
            (BLOCK_SIZE, 1, 0),
            (BLOCK_SIZE + 1, 2, 1),
            (3 * BLOCK_SIZE, 3, 0),
        ];
        for (length, n_blocks, last_size) in cases {
            let bytes: Vec<u8> = (0..length).map(|k| (k * k % 251) as u8).collect();
            let compressed = compress(&bytes).unwrap();
            let header = header_numbers(&compressed.header);
            assert_eq!(header[..3], [n_blocks, BLOCK_SIZE, last_size]);
            assert_eq!(header[3..].iter().sum::<usize>(), compressed.blocks.len());
            let layout = Layout::new(header[0], header[1], header[2]).unwrap();
            assert_eq!(layout.n_bytes(), length);
            assert_eq!(layout.decompress(&compressed.blocks, &header[3..]).unwrap(), bytes);
        }
        // A full last block may carry its size, as meshio writes it.
        assert_eq!(Layout::new(2, BLOCK_SIZE, BLOCK_SIZE).unwrap().n_bytes(), 2 * BLOCK_SIZE);
    }

    /// Bytes without pattern.
    fn noise() -> Vec<u8> {
        let number = |k: u64| k.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ (k << 40);
        (0..9000).flat_map(|k| number(k).to_le_bytes()).collect()
    }

    /// Numbers without pattern are stored, with a header and a check sum per block; zeros are compressed.
    #[test]
    fn incompressible_blocks_are_stored() {
        let noise = noise();
        let stored = compress(&noise).unwrap().blocks.len();
        assert!(stored > noise.len() && stored < noise.len() + 100, "{stored}");
        let zeros: Vec<u8> = noise
            .chunks(24)
            .flat_map(|three| [&three[..16.min(three.len())], &[0; 8]].concat())
            .collect();
        let compressed = compress(&zeros).unwrap().blocks.len();
        assert!((compressed as f64) < 0.8 * zeros.len() as f64, "{compressed}");
    }

    /// Each stream is that of a new encoder: the shared state depends on no earlier stream.
    #[test]
    fn streams_are_those_of_new_encoders() {
        let smooth: Vec<u8> = (0..5 * BLOCK_SIZE + 77).map(|k| (k / 7 % 251) as u8).collect();
        let noise = noise();
        let levels = [(&smooth, LEVEL), (&noise, Compression::none())];
        for (bytes, level) in levels.into_iter().chain(levels) {
            let stream = |block: &[u8]| {
                let mut encoder = flate2::write::ZlibEncoder::new(Vec::new(), level);
                encoder.write_all(block).unwrap();
                encoder.finish().unwrap()
            };
            let alone: Vec<u8> = bytes.chunks(BLOCK_SIZE).flat_map(stream).collect();
            assert!(compress(bytes).unwrap().blocks == alone, "{level:?}");
        }
    }

    #[test]
    fn sizes_that_contradict_are_refused() {
        assert!(Layout::new(1, 0, 0).is_none());
        assert!(Layout::new(1, 8, 9).is_none());
        assert!(Layout::new(usize::MAX, 32768, 1).is_none());
        let compressed = compress(&[7; 100]).unwrap();
        let sizes = [compressed.blocks.len()];
        for wrong in [99, 101] {
            let layout = Layout::new(1, BLOCK_SIZE, wrong).unwrap();
            assert!(layout.decompress(&compressed.blocks, &sizes).is_none());
        }
    }
}
