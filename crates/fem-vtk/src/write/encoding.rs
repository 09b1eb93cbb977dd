//! Encodings of an array's compressed bytes in the file.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use crate::blocks::Compressed;

/// Position and encoding of the bytes. VTK 9.2 and 9.7 and meshio 5.3 read all three.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Encoding {
    /// Base64 inside each `DataArray` element.
    InlineBase64,
    /// Base64 in one block at the end, the default of VTK's writer. The file is well-formed XML.
    #[default]
    AppendedBase64,
    /// Bytes in one block at the end: a quarter smaller, but not well-formed XML, and meshio takes three times as long to
    /// read it (200,000 cells).
    AppendedRaw,
}

impl Encoding {
    pub(crate) fn is_appended(self) -> bool {
        self != Self::InlineBase64
    }

    /// Returns the attribute `encoding` of `AppendedData`.
    pub(crate) fn appended_name(self) -> &'static str {
        match self {
            Self::AppendedRaw => "raw",
            Self::InlineBase64 | Self::AppendedBase64 => "base64",
        }
    }

    /// Encodes header and blocks; base64 pads each of them separately.
    pub(crate) fn encode(self, compressed: &Compressed) -> Vec<u8> {
        let Compressed { header, blocks } = compressed;
        match self {
            Self::AppendedRaw => [header.as_slice(), blocks].concat(),
            Self::InlineBase64 | Self::AppendedBase64 => {
                let mut text = STANDARD.encode(header);
                STANDARD.encode_string(blocks, &mut text);
                text.into_bytes()
            }
        }
    }
}
