//! The ways to put an array's compressed bytes into the file.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use crate::blocks::Compressed;

/// Where the bytes go and how they look. VTK 9.2 and 9.7 and meshio 5.3 read all three.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Encoding {
    /// Base64 inside each `DataArray` element.
    InlineBase64,
    /// Base64 in one block at the end: the default of VTK's own writer. The file is well-formed
    /// XML.
    #[default]
    AppendedBase64,
    /// Bytes in one block at the end: a quarter smaller, but no well-formed XML, and meshio needs
    /// three times as long to read it (200,000 cells).
    AppendedRaw,
}

impl Encoding {
    pub(crate) fn is_appended(self) -> bool {
        self != Self::InlineBase64
    }

    /// The attribute `encoding` of `AppendedData`.
    pub(crate) fn appended_name(self) -> &'static str {
        match self {
            Self::AppendedRaw => "raw",
            Self::InlineBase64 | Self::AppendedBase64 => "base64",
        }
    }

    /// Header and blocks as they stand in the file. Base64 pads each of the two.
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
