//! The XML of a `.vtu`, parsed to a list of arrays whose data stay where they are in the file.
//!
//! Appended data may be any bytes, so the file is cut at `<AppendedData ...>`: XML before, data
//! up to the last `</AppendedData>`, then only `</VTKFile>`.

use std::ops::Range;

use quick_xml::XmlVersion;
use quick_xml::events::{BytesStart, Event};
use quick_xml::reader::Reader;

use crate::section::Section;

/// The value that was found and the allowed ones, at a place in the file.
#[derive(Debug)]
pub(crate) struct Fault {
    pub(crate) place: String,
    pub(crate) found: String,
    pub(crate) allowed: String,
}

impl Fault {
    pub(crate) fn new(
        place: impl Into<String>,
        found: impl Into<String>,
        allowed: impl Into<String>,
    ) -> Self {
        Self { place: tame(place.into()), found: tame(found.into()), allowed: allowed.into() }
    }
}

/// A file may hold anything; a terminal must not obey it.
pub(crate) fn tame(text: String) -> String {
    match text.contains(char::is_control) {
        true => text.replace(char::is_control, "\u{fffd}"),
        false => text,
    }
}

/// One `DataArray`; attributes are checked when it is decoded.
#[derive(Debug)]
pub(crate) struct ArrayEntry {
    pub(crate) section: Section,
    pub(crate) name: String,
    pub(crate) scalar_type: String,
    pub(crate) components: String,
    pub(crate) format: String,
    pub(crate) offset: Option<String>,
    /// The element's own text in the file.
    pub(crate) text: Range<usize>,
}

/// The block at the end of the file, after its `_`.
#[derive(Debug)]
pub(crate) struct Appended {
    pub(crate) raw: bool,
    pub(crate) data: Range<usize>,
}

/// The parsed file.
#[derive(Debug, Default)]
pub(crate) struct Document {
    pub(crate) wide_headers: bool,
    pub(crate) compressed: bool,
    pub(crate) n_points: usize,
    pub(crate) n_cells: usize,
    pub(crate) appended: Option<Appended>,
    pub(crate) arrays: Vec<ArrayEntry>,
    n_pieces: usize,
}

const WHOLE_FILE: &str = "a whole .vtu file (VTK XML UnstructuredGrid)";

/// The most elements around one that matters: a `DataArray` in its section.
const DEEPEST: usize = 4;

impl Document {
    pub(crate) fn parse(bytes: &[u8]) -> Result<Self, Fault> {
        let (xml_end, data) = find_appended(bytes)?;
        let xml = std::str::from_utf8(&bytes[..xml_end]).map_err(|error| {
            Fault::new(format!("byte {}", error.valid_up_to()), "no UTF-8 text", WHOLE_FILE)
        })?;
        let mut document = Self::default();
        let open = document.read_events(xml)?;
        match (data, open.as_slice()) {
            (Some(data), [root, appended]) if root == "VTKFile" && appended == "AppendedData" => {
                if let Some(appended) = &mut document.appended {
                    appended.data = data;
                }
            }
            (None, []) => {}
            _ => {
                return Err(Fault::new(
                    "end of file",
                    format!("<{}> still open", open.join("><")),
                    WHOLE_FILE,
                ));
            }
        }
        match document.n_pieces {
            1 => Ok(document),
            n_pieces => {
                Err(Fault::new("UnstructuredGrid", format!("{n_pieces} pieces"), "one Piece"))
            }
        }
    }

    /// Reads the elements; the names of those still open at the end are returned.
    fn read_events(&mut self, xml: &str) -> Result<Vec<String>, Fault> {
        let mut reader = Reader::from_str(xml);
        let mut open: Vec<String> = Vec::new();
        loop {
            let start = position(&reader);
            let event = reader.read_event().map_err(|error| {
                Fault::new(
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
                    return Err(Fault::new("DataArray", "XML references or CDATA", "plain text"));
                }
                Event::Eof => break,
                _ => {}
            }
        }
        if self.n_pieces == 0 && open.is_empty() {
            return Err(Fault::new("file", "no VTKFile element with a Piece", WHOLE_FILE));
        }
        Ok(open)
    }

    fn open_element(&mut self, open: &[String], element: &BytesStart) -> Result<(), Fault> {
        if open.len() > DEEPEST {
            return Ok(());
        }
        let path: Vec<&str> = open.iter().map(String::as_str).chain([element.name().0]).collect();
        match path.as_slice() {
            ["VTKFile"] => self.read_root(element),
            [_] => Err(Fault::new("file", format!("root element {}", path[0]), "VTKFile")),
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

    fn read_root(&mut self, element: &BytesStart) -> Result<(), Fault> {
        let place = "VTKFile";
        let kind = attribute(element, "type")?.unwrap_or_default();
        if kind != "UnstructuredGrid" {
            return Err(Fault::new(
                place,
                format!("type {kind:?}"),
                "type \"UnstructuredGrid\" (.vtu)",
            ));
        }
        let order = attribute(element, "byte_order")?.unwrap_or("LittleEndian".into());
        if order != "LittleEndian" {
            return Err(Fault::new(place, format!("byte_order {order:?}"), "\"LittleEndian\""));
        }
        self.wide_headers = match attribute(element, "header_type")?.as_deref() {
            None | Some("UInt32") => false,
            Some("UInt64") => true,
            Some(other) => {
                return Err(Fault::new(
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
                return Err(Fault::new(place, format!("compressor {other:?}"), allowed));
            }
        };
        Ok(())
    }

    fn read_piece(&mut self, element: &BytesStart) -> Result<(), Fault> {
        self.n_pieces += 1;
        self.n_points = count(element, "NumberOfPoints")?;
        self.n_cells = count(element, "NumberOfCells")?;
        Ok(())
    }

    fn read_appended(&mut self, element: &BytesStart) -> Result<(), Fault> {
        let raw = match attribute(element, "encoding")?.as_deref() {
            Some("raw") => true,
            None | Some("base64") => false,
            Some(other) => {
                let found = format!("encoding {other:?}");
                return Err(Fault::new("AppendedData", found, "\"raw\", \"base64\""));
            }
        };
        self.appended = Some(Appended { raw, data: 0..0 });
        Ok(())
    }

    fn read_array(&mut self, section: Section, element: &BytesStart) -> Result<(), Fault> {
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

    fn take_text(&mut self, text: Range<usize>) -> Result<(), Fault> {
        match self.arrays.last_mut() {
            Some(array) if array.text.is_empty() => {
                array.text = text;
                Ok(())
            }
            Some(array) => {
                Err(Fault::new(&array.name, "data in several pieces", "one piece of text"))
            }
            None => Ok(()),
        }
    }
}

/// Whether the innermost open element is a `DataArray` of a section that is kept.
fn is_array(open: &[String]) -> bool {
    let section = open.len().checked_sub(2).map(|index| open[index].as_str());
    open.last().is_some_and(|name| name == "DataArray")
        && Section::ALL.into_iter().any(|known| Some(known.name()) == section)
}

fn position(reader: &Reader<&[u8]>) -> usize {
    reader.buffer_position() as usize
}

fn attribute(element: &BytesStart, name: &str) -> Result<Option<String>, Fault> {
    let place = element.name().0;
    let broken = |found: String| Fault::new(place, found, "well-formed attributes");
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

fn count(element: &BytesStart, name: &str) -> Result<usize, Fault> {
    let text = attribute(element, name)?.unwrap_or_default();
    text.trim().parse().map_err(|_| {
        Fault::new("Piece", format!("{name} {text:?}"), "a whole number, 0 or greater")
    })
}

/// The end of the XML and the range of the appended data, if there are any.
fn find_appended(bytes: &[u8]) -> Result<(usize, Option<Range<usize>>), Fault> {
    const OPEN: &[u8] = b"<AppendedData";
    const CLOSE: &[u8] = b"</AppendedData>";
    let Some(open) = bytes.windows(OPEN.len()).position(|window| window == OPEN) else {
        return Ok((bytes.len(), None));
    };
    let cut = |found| {
        Fault::new("AppendedData", found, "<AppendedData ...>_data</AppendedData></VTKFile>")
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
