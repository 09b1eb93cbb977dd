//! The text and bytes of a `.vtu`, of arrays already checked.

use std::fmt::Write;

use quick_xml::escape::escape;

use crate::blocks::compress;
use crate::section::Section;
use crate::values::Values;
use crate::writer::{NamedArray, VtuWriter};
use crate::{Encoding, VTK_QUAD};

/// The file: XML, appended data (empty if inline), XML again.
pub(crate) struct RenderedFile {
    encoding: Encoding,
    xml: String,
    appended: Vec<u8>,
    end: &'static str,
}

impl RenderedFile {
    pub(crate) fn new(writer: &VtuWriter) -> std::io::Result<Self> {
        let encoding = writer.encoding;
        let mut file = Self { encoding, xml: String::new(), appended: Vec::new(), end: "" };
        file.push_line(0, "<?xml version=\"1.0\"?>");
        file.push_line(
            0,
            "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" \
             header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">",
        );
        file.push_line(1, "<UnstructuredGrid>");
        file.push_grid(writer)?;
        file.push_line(1, "</UnstructuredGrid>");
        if encoding.is_appended() {
            file.push_line(1, &format!("<AppendedData encoding=\"{}\">", encoding.appended_name()));
            file.xml.push('_');
            // meshio cuts raw data at the last line break before the closing tag.
            file.end = "\n  </AppendedData>\n</VTKFile>\n";
        } else {
            file.end = "</VTKFile>\n";
        }
        Ok(file)
    }

    /// The file's bytes, to be written one after the other.
    pub(crate) fn parts(&self) -> [&[u8]; 3] {
        [self.xml.as_bytes(), &self.appended, self.end.as_bytes()]
    }

    fn push_line(&mut self, level: usize, line: &str) {
        let _ = writeln!(self.xml, "{:1$}{line}", "", 2 * level);
    }

    fn push_grid(&mut self, writer: &VtuWriter) -> std::io::Result<()> {
        let n_points = writer.points.len();
        let n_cells = writer.quads.len();
        let time = writer.time.map(|time| [time]);
        let time = time.as_ref().map(|time| NamedArray {
            section: Section::FieldData,
            name: "TimeValue",
            components: 1,
            values: time.into(),
        });
        let field: Vec<&NamedArray> =
            time.iter().chain(of_section(writer, Section::FieldData)).collect();
        if !field.is_empty() {
            self.push_line(2, "<FieldData>");
            for array in field {
                self.push_array(array)?;
            }
            self.push_line(2, "</FieldData>");
        }
        self.push_line(
            2,
            &format!("<Piece NumberOfPoints=\"{n_points}\" NumberOfCells=\"{n_cells}\">"),
        );
        self.push_data(writer, Section::PointData)?;
        self.push_data(writer, Section::CellData)?;
        self.push_mesh(writer)?;
        self.push_line(2, "</Piece>");
        Ok(())
    }

    fn push_data(&mut self, writer: &VtuWriter, section: Section) -> std::io::Result<()> {
        let mut attributes = String::new();
        for (attribute, components) in [("Scalars", 1), ("Vectors", 3)] {
            if let Some(array) =
                of_section(writer, section).find(|array| array.components == components)
            {
                let _ = write!(attributes, " {attribute}=\"{}\"", escape(array.name));
            }
        }
        self.push_line(3, &format!("<{}{attributes}>", section.name()));
        for array in of_section(writer, section) {
            self.push_array(array)?;
        }
        self.push_line(3, &format!("</{}>", section.name()));
        Ok(())
    }

    fn push_mesh(&mut self, writer: &VtuWriter) -> std::io::Result<()> {
        let n_cells = writer.quads.len() as i64;
        let connectivity: Vec<i64> =
            writer.quads.as_flattened().iter().map(|&point| point.into()).collect();
        let offsets: Vec<i64> = (1..=n_cells).map(|cell| 4 * cell).collect();
        let types = vec![VTK_QUAD; writer.quads.len()];
        self.push_line(3, "<Points>");
        self.push_values(
            Section::Points,
            "Points",
            3,
            Values::Float64(writer.points.as_flattened()),
        )?;
        self.push_line(3, "</Points>");
        self.push_line(3, "<Cells>");
        self.push_values(Section::Cells, "connectivity", 1, Values::Int64(&connectivity))?;
        self.push_values(Section::Cells, "offsets", 1, Values::Int64(&offsets))?;
        self.push_values(Section::Cells, "types", 1, Values::UInt8(&types))?;
        self.push_line(3, "</Cells>");
        Ok(())
    }

    fn push_values(
        &mut self,
        section: Section,
        name: &str,
        components: usize,
        values: Values,
    ) -> std::io::Result<()> {
        self.push_array(&NamedArray { section, name, components, values })
    }

    fn push_array(&mut self, array: &NamedArray) -> std::io::Result<()> {
        let &NamedArray { section, name, components, values } = array;
        let data = self.encoding.encode(&compress(&values.to_le_bytes())?);
        let _ = write!(
            self.xml,
            "        <DataArray type=\"{}\" Name=\"{}\"",
            values.scalar_type().name(),
            escape(name)
        );
        if components != 1 {
            let _ = write!(self.xml, " NumberOfComponents=\"{components}\"");
        }
        if section == Section::FieldData {
            let _ = write!(self.xml, " NumberOfTuples=\"{}\"", values.len() / components);
        }
        if self.encoding.is_appended() {
            let _ = writeln!(self.xml, " format=\"appended\" offset=\"{}\"/>", self.appended.len());
            self.appended.extend(data);
        } else {
            let text = String::from_utf8_lossy(&data);
            let _ = writeln!(self.xml, " format=\"binary\">{text}</DataArray>");
        }
        Ok(())
    }
}

fn of_section<'w, 'a>(
    writer: &'w VtuWriter<'a>,
    section: Section,
) -> impl Iterator<Item = &'w NamedArray<'a>> {
    writer.arrays.iter().filter(move |array| array.section == section)
}
