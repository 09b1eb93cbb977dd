//! Decodes an array's text or bytes into numbers.
//!
//! Every length in the file is compared with the bytes that exist before anything of that size is read or allocated.

use std::borrow::Cow;
use std::str::FromStr;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use crate::blocks::Layout;
use crate::read::vtu_xml::{ArrayEntry, FormatError, VtuXml};
use crate::values::Numbers;
use crate::vtk_types::ScalarType;

/// Decodes one array. Returns its components and its numbers, tuple after tuple.
pub(crate) fn decode(
    bytes: &[u8],
    xml_file: &VtuXml,
    entry: &ArrayEntry,
) -> Result<(usize, Numbers), FormatError> {
    let place = place(entry);
    let fault = |(found, allowed): Claim| FormatError::new(&place, found, allowed);
    let scalar_type = ScalarType::from_name(&entry.scalar_type).ok_or_else(|| {
        let allowed = ScalarType::ALL.map(ScalarType::name).join(", ");
        FormatError::new(&place, format!("type {:?}", entry.scalar_type), allowed)
    })?;
    let components =
        entry.components.trim().parse().ok().filter(|&components| components > 0).ok_or_else(
            || {
                FormatError::new(
                    &place,
                    format!("NumberOfComponents {:?}", entry.components),
                    "a whole number, 1 or greater",
                )
            },
        )?;
    let text = bytes.get(entry.text.clone()).unwrap_or_default().trim_ascii();
    let numbers = match entry.format.as_str() {
        "ascii" => parse_ascii(text, scalar_type).map_err(fault)?,
        "binary" | "appended" => {
            let stream = match entry.format.as_str() {
                "binary" => Ok(Stream { data: text, base64: true, wide: xml_file.wide_headers }),
                _ => appended_stream(bytes, xml_file, entry),
            };
            let data = stream.and_then(|stream| read_bytes(stream, xml_file.compressed));
            data.and_then(|data| to_numbers(&data, scalar_type)).map_err(fault)?
        }
        other => {
            let found = format!("format {other:?}");
            return Err(FormatError::new(place, found, "\"ascii\", \"binary\", \"appended\""));
        }
    };
    Ok((components, numbers))
}

/// Returns the name of an array for errors.
pub(crate) fn place(entry: &ArrayEntry) -> String {
    format!("{} array {:?}", entry.section.name(), entry.name)
}

/// The value that was found and the allowed ones.
type Claim = (String, String);

fn truncated() -> Claim {
    ("truncated or damaged data".to_owned(), "as many bytes as its header states".to_owned())
}

fn parse_ascii(text: &[u8], scalar_type: ScalarType) -> Result<Numbers, Claim> {
    fn parse<T: FromStr>(text: &str, scalar_type: ScalarType) -> Result<Vec<T>, Claim> {
        let wrong =
            |word: &str| (format!("{word:?}"), format!("numbers of type {}", scalar_type.name()));
        let words = text.split_ascii_whitespace();
        words.map(|word| word.parse().map_err(|_| wrong(word))).collect()
    }
    let text = String::from_utf8_lossy(text);
    Ok(match scalar_type.is_float() {
        true => Numbers::Float(parse(&text, scalar_type)?),
        false => Numbers::Integer(parse(&text, scalar_type)?),
    })
}

fn appended_stream<'a>(
    bytes: &'a [u8],
    xml_file: &VtuXml,
    entry: &ArrayEntry,
) -> Result<Stream<'a>, Claim> {
    let offset = entry.offset.as_deref().unwrap_or_default();
    let appended = xml_file.appended.as_ref().ok_or_else(|| {
        ("format \"appended\"".to_owned(), "an AppendedData element in the file".to_owned())
    })?;
    let data = bytes.get(appended.data.clone()).unwrap_or_default();
    let from_offset = offset.trim().parse().ok().and_then(|offset: usize| data.get(offset..));
    match from_offset {
        Some(data) => Ok(Stream { data, base64: !appended.raw, wide: xml_file.wide_headers }),
        None => {
            Err((format!("offset {offset:?}"), format!("0 to {} (the appended data)", data.len())))
        }
    }
}

/// Header integers and data bytes, plain or as base64 pieces that each end on a padded group.
struct Stream<'a> {
    data: &'a [u8],
    base64: bool,
    wide: bool,
}

impl<'a> Stream<'a> {
    fn header_size(&self) -> usize {
        if self.wide { 8 } else { 4 }
    }

    /// Returns the next `n_bytes`, a separate piece of base64, without consuming them, and their number of characters.
    fn peek(&self, n_bytes: usize) -> Result<(Cow<'a, [u8]>, usize), Claim> {
        if !self.base64 {
            let bytes = self.data.get(..n_bytes).ok_or_else(truncated)?;
            return Ok((bytes.into(), n_bytes));
        }
        let n_characters = n_bytes.div_ceil(3).checked_mul(4).ok_or_else(truncated)?;
        let text = self.data.get(..n_characters).ok_or_else(truncated)?;
        let mut bytes = STANDARD.decode(text).map_err(|error| {
            (format!("broken base64 ({error})"), "base64 characters without breaks".to_owned())
        })?;
        if bytes.len() < n_bytes {
            return Err(truncated());
        }
        bytes.truncate(n_bytes);
        Ok((bytes.into(), n_characters))
    }

    fn take(&mut self, n_bytes: usize) -> Result<Cow<'a, [u8]>, Claim> {
        let (bytes, used) = self.peek(n_bytes)?;
        self.data = &self.data[used..];
        Ok(bytes)
    }

    /// Returns the header integers in `bytes`; one that does not fit into `usize` is no valid length and an error.
    fn integers(&self, bytes: &[u8]) -> Result<Vec<usize>, Claim> {
        let wide = |&chunk: &[u8; 8]| usize::try_from(u64::from_le_bytes(chunk));
        let narrow = |&chunk: &[u8; 4]| usize::try_from(u32::from_le_bytes(chunk));
        let numbers: Result<_, _> = match self.wide {
            true => bytes.as_chunks().0.iter().map(wide).collect(),
            false => bytes.as_chunks().0.iter().map(narrow).collect(),
        };
        numbers.map_err(|_| truncated())
    }
}

fn read_bytes(stream: Stream, compressed: bool) -> Result<Vec<u8>, Claim> {
    if compressed { read_compressed(stream) } else { read_uncompressed(stream) }
}

fn read_compressed(mut stream: Stream) -> Result<Vec<u8>, Claim> {
    let size = stream.header_size();
    let (first, _) = stream.peek(size)?;
    let n_blocks = stream.integers(&first)?[0];
    let n_header =
        n_blocks.checked_add(3).and_then(|count| count.checked_mul(size)).ok_or_else(truncated)?;
    let header = stream.take(if n_blocks == 0 { size } else { n_header })?;
    let header = stream.integers(&header)?;
    if n_blocks == 0 {
        return Ok(Vec::new());
    }
    let sizes = &header[3..];
    let n_bytes =
        sizes.iter().try_fold(0_usize, |sum, &size| sum.checked_add(size)).ok_or_else(truncated)?;
    let blocks = stream.take(n_bytes)?;
    Layout::new(n_blocks, header[1], header[2])
        .and_then(|layout| layout.decompress(&blocks, sizes))
        .ok_or_else(|| {
            ("damaged zlib blocks".to_owned(), "blocks of the sizes in their header".to_owned())
        })
}

fn read_uncompressed(mut stream: Stream) -> Result<Vec<u8>, Claim> {
    let size = stream.header_size();
    let (header, n_characters) = stream.peek(size)?;
    let n_bytes = stream.integers(&header)?[0];
    // Header and data are one piece of base64 in VTK and meshio, but two pieces in the description of the format, where
    // the header has its own padding (two characters for 4 bytes, one for 8).
    let n_padding = 3 - size % 3;
    let together = stream.base64 && stream.data.get(n_characters - n_padding) != Some(&b'=');
    if together {
        let total = size.checked_add(n_bytes).ok_or_else(truncated)?;
        return Ok(stream.take(total)?[size..].to_vec());
    }
    stream.take(size)?;
    Ok(stream.take(n_bytes)?.into_owned())
}

fn to_numbers(bytes: &[u8], scalar_type: ScalarType) -> Result<Numbers, Claim> {
    if !bytes.len().is_multiple_of(scalar_type.size()) {
        let allowed =
            format!("whole numbers of {} bytes ({})", scalar_type.size(), scalar_type.name());
        return Err((format!("{} bytes", bytes.len()), allowed));
    }
    macro_rules! widen {
        ($kind:ident, $number:ty) => {
            Numbers::$kind(
                bytes
                    .as_chunks()
                    .0
                    .iter()
                    .map(|&chunk| <$number>::from_le_bytes(chunk).into())
                    .collect(),
            )
        };
    }
    Ok(match scalar_type {
        ScalarType::Int8 => widen!(Integer, i8),
        ScalarType::UInt8 => widen!(Integer, u8),
        ScalarType::Int16 => widen!(Integer, i16),
        ScalarType::UInt16 => widen!(Integer, u16),
        ScalarType::Int32 => widen!(Integer, i32),
        ScalarType::UInt32 => widen!(Integer, u32),
        ScalarType::Int64 => widen!(Integer, i64),
        ScalarType::Float32 => widen!(Float, f32),
        ScalarType::Float64 => widen!(Float, f64),
        ScalarType::UInt64 => {
            let values: Result<_, _> = bytes
                .as_chunks()
                .0
                .iter()
                .map(|&chunk| i64::try_from(u64::from_le_bytes(chunk)))
                .collect();
            let too_large =
                |_| ("an integer above 2^63 - 1".to_owned(), format!("at most {}", i64::MAX));
            Numbers::Integer(values.map_err(too_large)?)
        }
    })
}
