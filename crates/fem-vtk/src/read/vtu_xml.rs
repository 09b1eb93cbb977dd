//! Parses the XML of a `.vtu` into a list of arrays; their data remain in the bytes of the file.
//!
//! Appended data may be any bytes, so the file is split at `<AppendedData ...>`: XML before, data up to the last
//! `</AppendedData>`, then only `</VTKFile>`.

use std::ops::Range;

use quick_xml::XmlVersion;
use quick_xml::events::{BytesStart, Event};
use quick_xml::reader::Reader;

use crate::vtk_types::Section;

/// An error in the format of a file: the place, the value that was found, and the allowed ones.
#[derive(Debug)]
pub(crate) struct FormatError {
    pub(crate) place: String,
    pub(crate) found: String,
    pub(crate) allowed: String,
}

impl FormatError {
    pub(crate) fn new(
        place: impl Into<String>,
        found: impl Into<String>,
        allowed: impl Into<String>,
    ) -> Self {
        Self { place: tame(place.into()), found: tame(found.into()), allowed: allowed.into() }
    }
}

/// Replaces control characters, which a terminal would execute.
pub(crate) fn tame(text: String) -> String {
    match text.contains(char::is_control) {
        true => text.replace(char::is_control, "\u{fffd}"),
        false => text,
    }
}

/// A `DataArray`; its attributes are validated when it is decoded.
#[derive(Debug)]
pub(crate) struct ArrayEntry {
    pub(crate) section: Section,
    pub(crate) name: String,
    pub(crate) scalar_type: String,
    pub(crate) components: String,
    pub(crate) format: String,
    pub(crate) offset: Option<String>,
    /// The text of the element in the file.
    pub(crate) text: Range<usize>,
}

/// The appended data at the end of the file, after their `_`.
#[derive(Debug)]
pub(crate) struct Appended {
    pub(crate) raw: bool,
    pub(crate) data: Range<usize>,
}

/// The parsed file.
#[derive(Debug, Default)]
pub(crate) struct VtuXml {
    pub(crate) wide_headers: bool,
    pub(crate) compressed: bool,
    pub(crate) n_points: usize,
    pub(crate) n_cells: usize,
    pub(crate) appended: Option<Appended>,
    pub(crate) arrays: Vec<ArrayEntry>,
    n_pieces: usize,
}

const WHOLE_FILE: &str = "a whole .vtu file (VTK XML UnstructuredGrid)";

/// The largest depth of an element that is read: a `DataArray` in its section.
const DEEPEST: usize = 4;

impl VtuXml {
    pub(crate) fn parse(bytes: &[u8]) -> Result<Self, FormatError> {
        let (xml_end, data) = find_appended(bytes)?;
        let xml = std::str::from_utf8(&bytes[..xml_end]).map_err(|error| {
            FormatError::new(
                format!("byte {}", error.valid_up_to()),
                "text that is not UTF-8",
                WHOLE_FILE,
            )
        })?;
        let mut xml_file = Self::default();
        let open = xml_file.read_events(xml)?;
        match (data, open.as_slice()) {
            (Some(data), [root, appended]) if root == "VTKFile" && appended == "AppendedData" => {
                if let Some(appended) = &mut xml_file.appended {
                    appended.data = data;
                }
            }
            (None, []) => {}
            _ => {
                return Err(FormatError::new(
                    "end of file",
                    format!("<{}> still open", open.join("><")),
                    WHOLE_FILE,
                ));
            }
        }
        match xml_file.n_pieces {
            1 => Ok(xml_file),
            n_pieces => {
                Err(FormatError::new("UnstructuredGrid", format!("{n_pieces} pieces"), "one Piece"))
            }
        }
    }

    /// Reads the elements and returns the names of those that are not closed.
    fn read_events(&mut self, xml: &str) -> Result<Vec<String>, FormatError> {
        let mut reader = Reader::from_str(xml);
        let mut open: Vec<String> = Vec::new();
        loop {
            let start = position(&reader);
            let event = reader.read_event().map_err(|error| {
                FormatError::new(
                    format!("byte {}", reader.error_position()),
                    format!("broken XML ({error})"),
                    WHOLE_FILE,
                )
            })?;
            match event {
                Event::Start(element) => {
                    self.open_element(&open, &element)?;
                    open.push(element.name().0.to_owned());
                }
                Event::Empty(element) => self.open_element(&open, &element)?,
                Event::End(_) => {
                    open.pop();
                }
                Event::Text(text) if is_array(&open) && !text.trim_ascii().is_empty() => {
                    self.take_text(start..position(&reader))?;
                }
                Event::CData(_) | Event::GeneralRef(_) if is_array(&open) => {
                    return Err(FormatError::new(
                        "DataArray",
                        "XML references or CDATA",
                        "plain text",
                    ));
                }
                Event::Eof => break,
                _ => {}
            }
        }
        if self.n_pieces == 0 && open.is_empty() {
            return Err(FormatError::new("file", "no VTKFile element with a Piece", WHOLE_FILE));
        }
        Ok(open)
    }

    fn open_element(&mut self, open: &[String], element: &BytesStart) -> Result<(), FormatError> {
        if open.len() > DEEPEST {
            return Ok(());
        }
        let path: Vec<&str> = open.iter().map(String::as_str).chain([element.name().0]).collect();
        match path.as_slice() {
            ["VTKFile"] => self.read_root(element),
            [_] => Err(FormatError::new("file", format!("root element {}", path[0]), "VTKFile")),
            ["VTKFile", "UnstructuredGrid", "Piece"] => self.read_piece(element),
            ["VTKFile", "AppendedData"] => self.read_appended(element),
            ["VTKFile", "UnstructuredGrid", section, "DataArray"]
            | ["VTKFile", "UnstructuredGrid", "Piece", section, "DataArray"] => {
                match Section::ALL.into_iter().find(|known| known.name() == *section) {
                    Some(section) => self.read_array(section, element),
                    None => Ok(()),
                }
            }
            _ => Ok(()),
        }
    }

    fn read_root(&mut self, element: &BytesStart) -> Result<(), FormatError> {
        let place = "VTKFile";
        let kind = attribute(element, "type")?.unwrap_or_default();
        if kind != "UnstructuredGrid" {
            return Err(FormatError::new(
                place,
                format!("type {kind:?}"),
                "type \"UnstructuredGrid\" (.vtu)",
            ));
        }
        let order = attribute(element, "byte_order")?.unwrap_or("LittleEndian".into());
        if order != "LittleEndian" {
            return Err(FormatError::new(
                place,
                format!("byte_order {order:?}"),
                "\"LittleEndian\"",
            ));
        }
        self.wide_headers = match attribute(element, "header_type")?.as_deref() {
            None | Some("UInt32") => false,
            Some("UInt64") => true,
            Some(other) => {
                return Err(FormatError::new(
                    place,
                    format!("header_type {other:?}"),
                    "\"UInt32\", \"UInt64\"",
                ));
            }
        };
        self.compressed = match attribute(element, "compressor")?.as_deref() {
            None | Some("") => false,
            Some("vtkZLibDataCompressor") => true,
            Some(other) => {
                let allowed = "\"vtkZLibDataCompressor\" or none (ParaView: choose it when saving)";
                return Err(FormatError::new(place, format!("compressor {other:?}"), allowed));
            }
        };
        Ok(())
    }

    fn read_piece(&mut self, element: &BytesStart) -> Result<(), FormatError> {
        self.n_pieces += 1;
        self.n_points = count(element, "NumberOfPoints")?;
        self.n_cells = count(element, "NumberOfCells")?;
        Ok(())
    }

    fn read_appended(&mut self, element: &BytesStart) -> Result<(), FormatError> {
        let raw = match attribute(element, "encoding")?.as_deref() {
            Some("raw") => true,
            None | Some("base64") => false,
            Some(other) => {
                let found = format!("encoding {other:?}");
                return Err(FormatError::new("AppendedData", found, "\"raw\", \"base64\""));
            }
        };
        self.appended = Some(Appended { raw, data: 0..0 });
        Ok(())
    }

    fn read_array(&mut self, section: Section, element: &BytesStart) -> Result<(), FormatError> {
        self.arrays.push(ArrayEntry {
            section,
            name: attribute(element, "Name")?.unwrap_or_default(),
            scalar_type: attribute(element, "type")?.unwrap_or_default(),
            components: attribute(element, "NumberOfComponents")?.unwrap_or("1".into()),
            format: attribute(element, "format")?.unwrap_or("ascii".into()),
            offset: attribute(element, "offset")?,
            text: 0..0,
        });
        Ok(())
    }

    fn take_text(&mut self, text: Range<usize>) -> Result<(), FormatError> {
        match self.arrays.last_mut() {
            Some(array) if array.text.is_empty() => {
                array.text = text;
                Ok(())
            }
            Some(array) => {
                Err(FormatError::new(&array.name, "data in several pieces", "one piece of text"))
            }
            None => Ok(()),
        }
    }
}

/// Returns whether the innermost open element is a `DataArray` of a known section.
fn is_array(open: &[String]) -> bool {
    let section = open.len().checked_sub(2).map(|index| open[index].as_str());
    open.last().is_some_and(|name| name == "DataArray")
        && Section::ALL.into_iter().any(|known| Some(known.name()) == section)
}

fn position(reader: &Reader<&[u8]>) -> usize {
    reader.buffer_position() as usize
}

fn attribute(element: &BytesStart, name: &str) -> Result<Option<String>, FormatError> {
    let place = element.name().0;
    let broken = |found: String| FormatError::new(place, found, "well-formed attributes");
    for attribute in element.attributes() {
        let attribute = attribute.map_err(|error| broken(error.to_string()))?;
        if attribute.key.0 == name {
            let value = attribute
                .normalized_value(XmlVersion::Implicit1_0)
                .map_err(|error| broken(error.to_string()))?;
            return Ok(Some(value.into_owned()));
        }
    }
    Ok(None)
}

fn count(element: &BytesStart, name: &str) -> Result<usize, FormatError> {
    let text = attribute(element, name)?.unwrap_or_default();
    text.trim().parse().map_err(|_| {
        FormatError::new("Piece", format!("{name} {text:?}"), "a whole number, 0 or greater")
    })
}

/// Returns the end of the XML and the range of the appended data, if there are any.
fn find_appended(bytes: &[u8]) -> Result<(usize, Option<Range<usize>>), FormatError> {
    const OPEN: &[u8] = b"<AppendedData";
    const CLOSE: &[u8] = b"</AppendedData>";
    let Some(open) = bytes.windows(OPEN.len()).position(|window| window == OPEN) else {
        return Ok((bytes.len(), None));
    };
    let cut = |found| {
        FormatError::new("AppendedData", found, "<AppendedData ...>_data</AppendedData></VTKFile>")
    };
    let tag = bytes[open..]
        .iter()
        .position(|&byte| byte == b'>')
        .ok_or_else(|| cut("no end of the tag"))?;
    let xml_end = open + tag + 1;
    let blank = bytes[xml_end..].iter().take_while(|byte| byte.is_ascii_whitespace()).count();
    let start = xml_end + blank + 1;
    if bytes.get(start - 1) != Some(&b'_') {
        return Err(cut("no _ before the data"));
    }
    let length = bytes[start..]
        .windows(CLOSE.len())
        .rposition(|window| window == CLOSE)
        .ok_or_else(|| cut("no closing tag: the file is truncated"))?;
    let tail = bytes[start + length + CLOSE.len()..].trim_ascii();
    if tail != b"</VTKFile>" {
        return Err(cut("something else after the data, or a truncated file"));
    }
    Ok((xml_end, Some(start..start + length)))
}
