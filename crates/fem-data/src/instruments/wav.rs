//! Reads the samples of a WAV file: RIFF chunks with integers of 8 to 32 bits or floating-point numbers.

use crate::table::DataError;

use super::sound::Signal;

const INTEGER: u16 = 1;
const FLOAT: u16 = 3;
/// The format stands in the first two bytes of the subformat.
const EXTENSIBLE: u16 = 0xfffe;

/// Whether bytes are a RIFF file.
pub(super) fn is_wav(bytes: &[u8]) -> bool {
    bytes.starts_with(b"RIFF")
}

/// The format of samples.
#[derive(Clone, Copy, Debug)]
struct Format {
    kind: u16,
    n_channels: usize,
    rate: u32,
    /// Bytes of one sample of one channel.
    size: usize,
}

/// Returns the loudest channel of a WAV file; an incomplete file has the samples that are there.
///
/// # Errors
/// The file is no WAV file of numbers.
pub(super) fn read_wav(name: &str, bytes: &[u8]) -> Result<Signal, DataError> {
    let fault = |message: &str| {
        let help = "save the sound as a WAV file of 16 bits (PCM)";
        DataError::new(name, message).with_help(help)
    };
    if bytes.get(8..12) != Some(b"WAVE") {
        return Err(fault("this is a RIFF file and no WAV file"));
    }
    let (mut rest, mut format, mut data) = (&bytes[12..], None, None);
    while let (Some(id), Some(size)) = (rest.get(..4), rest.get(4..8)) {
        let size = u32::from_le_bytes([size[0], size[1], size[2], size[3]]) as usize;
        let body = &rest[8..];
        let content = &body[..size.min(body.len())];
        match id {
            b"fmt " => format = format_of(content),
            b"data" => data = Some(content),
            _ => {}
        }
        // Chunks begin at even places.
        rest = body.get(size.saturating_add(size % 2)..).unwrap_or_default();
    }
    let format = format.ok_or_else(|| fault("the format of the samples is not one of numbers"))?;
    let data = data.ok_or_else(|| fault("the file has no samples"))?;
    let Format { n_channels, rate, size, .. } = format;
    let frames = data.chunks_exact(n_channels * size);
    let channel = |channel: usize| -> Vec<f64> {
        let sample = |frame: &[u8]| number(&frame[channel * size..][..size], format.kind);
        frames.clone().map(sample).collect()
    };
    let loudness = |values: &Vec<f64>| {
        let mean = values.iter().sum::<f64>() / values.len().max(1) as f64;
        values.iter().map(|x| (x - mean).powi(2)).sum::<f64>()
    };
    let loudest = (0..n_channels).map(channel).max_by(|a, b| loudness(a).total_cmp(&loudness(b)));
    let values = loudest.unwrap_or_default();
    if values.len() < 2 || values.iter().any(|value| !value.is_finite()) {
        return Err(fault("the file has no samples, or some are no numbers"));
    }
    Ok(Signal { name: name.to_string(), start: 0.0, rate: f64::from(rate), values })
}

fn format_of(content: &[u8]) -> Option<Format> {
    let word = |at: usize| Some(u16::from_le_bytes([*content.get(at)?, *content.get(at + 1)?]));
    let kind = match word(0)? {
        EXTENSIBLE => word(24)?,
        kind => kind,
    };
    let (n_channels, bits) = (usize::from(word(2)?), word(14)?);
    let rate = u32::from(word(4)?) | u32::from(word(6)?) << 16;
    let is_known = match kind {
        INTEGER => [8, 16, 24, 32].contains(&bits),
        FLOAT => [32, 64].contains(&bits),
        _ => false,
    };
    let size = usize::from(bits / 8);
    (is_known && n_channels > 0 && rate > 0).then_some(Format { kind, n_channels, rate, size })
}

/// Returns a sample; integers are from −1 to 1.
fn number(bytes: &[u8], kind: u16) -> f64 {
    match (kind, bytes) {
        (INTEGER, [byte]) => (f64::from(*byte) - 128.0) / 128.0,
        (FLOAT, [a, b, c, d]) => f64::from(f32::from_le_bytes([*a, *b, *c, *d])),
        (FLOAT, [a, b, c, d, e, f, g, h]) => f64::from_le_bytes([*a, *b, *c, *d, *e, *f, *g, *h]),
        (_, bytes) => {
            let mut whole = [0; 4];
            whole[4 - bytes.len().min(4)..].copy_from_slice(&bytes[..bytes.len().min(4)]);
            f64::from(i32::from_le_bytes(whole)) / 2f64.powi(31)
        }
    }
}
