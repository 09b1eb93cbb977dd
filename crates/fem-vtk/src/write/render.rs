//! Renders the text and bytes of a `.vtu` from validated arrays.

use std::fmt::Write;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use quick_xml::escape::escape;

use crate::blocks::{Compressed, compress};
use crate::vtk_types::{ScalarType, Section};
use crate::write::writer::{NamedArray, VtuWriter};

/// A file: XML, the arrays in Base64 in one block, the default of VTK's writer, and [`END`].
#[derive(Default)]
pub(crate) struct RenderedFile {
    xml: String,
    appended: String,
}

const END: &str = "\n  </AppendedData>\n</VTKFile>\n";

impl RenderedFile {
    pub(crate) fn new(writer: &VtuWriter) -> std::io::Result<Self> {
        let mut file = Self::default();
        file.push_line(0, "<?xml version=\"1.0\"?>");
        file.push_line(
            0,
            "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" \
             header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">",
        );
        file.push_line(1, "<UnstructuredGrid>");
        file.push_grid(writer)?;
        file.push_line(1, "</UnstructuredGrid>");
        file.push_line(1, "<AppendedData encoding=\"base64\">");
        file.xml.push('_');
        Ok(file)
    }

    /// Returns the consecutive parts of the file.
    pub(crate) fn parts(&self) -> [&[u8]; 3] {
        [&self.xml, &self.appended, END].map(str::as_bytes)
    }

    fn push_line(&mut self, level: usize, line: &str) {
        let _ = writeln!(self.xml, "{:1$}{line}", "", 2 * level);
    }

    fn push_grid(&mut self, writer: &VtuWriter) -> std::io::Result<()> {
        let n_points = writer.grid.points.len();
        let n_cells = writer.grid.quads.len();
        let time = writer.time.map(|time| [time]);
        let time = time.as_ref().map(|time| NamedArray {
            section: Section::FieldData,
            name: "TimeValue",
            components: 1,
            values: time.into(),
        });
        let field: Vec<&NamedArray> =
            time.iter().chain(writer.of_section(Section::FieldData)).collect();
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
                writer.of_section(section).find(|array| array.components == components)
            {
                let _ = write!(attributes, " {attribute}=\"{}\"", escape(array.name));
            }
        }
        self.push_line(3, &format!("<{}{attributes}>", section.name()));
        for array in writer.of_section(section) {
            self.push_array(array)?;
        }
        self.push_line(3, &format!("</{}>", section.name()));
        Ok(())
    }

    fn push_mesh(&mut self, writer: &VtuWriter) -> std::io::Result<()> {
        let grid = writer.grid.compressed()?;
        self.push_line(3, "<Points>");
        let points = Declaration::new("Points", ScalarType::Float64, 3);
        self.push_compressed(&points, &grid.points);
        self.push_line(3, "</Points>");
        self.push_line(3, "<Cells>");
        for (name, scalar_type, data) in [
            ("connectivity", ScalarType::Int64, &grid.connectivity),
            ("offsets", ScalarType::Int64, &grid.offsets),
            ("types", ScalarType::UInt8, &grid.types),
        ] {
            self.push_compressed(&Declaration::new(name, scalar_type, 1), data);
        }
        self.push_line(3, "</Cells>");
        Ok(())
    }

    fn push_array(&mut self, array: &NamedArray) -> std::io::Result<()> {
        let &NamedArray { section, name, components, values } = array;
        let mut declaration = Declaration::new(name, values.scalar_type(), components);
        if section == Section::FieldData {
            declaration.n_tuples = Some(values.len() / components);
        }
        self.push_compressed(&declaration, &compress(&values.to_le_bytes())?);
        Ok(())
    }

    fn push_compressed(&mut self, declaration: &Declaration, data: &Compressed) {
        let &Declaration { name, scalar_type, components, n_tuples } = declaration;
        let _ = write!(
            self.xml,
            "        <DataArray type=\"{}\" Name=\"{}\"",
            scalar_type.name(),
            escape(name)
        );
        if components != 1 {
            let _ = write!(self.xml, " NumberOfComponents=\"{components}\"");
        }
        if let Some(n_tuples) = n_tuples {
            let _ = write!(self.xml, " NumberOfTuples=\"{n_tuples}\"");
        }
        let _ = writeln!(self.xml, " format=\"appended\" offset=\"{}\"/>", self.appended.len());
        // Base64 pads header and blocks separately.
        STANDARD.encode_string(&data.header, &mut self.appended);
        STANDARD.encode_string(&data.blocks, &mut self.appended);
    }
}

/// The attributes of a `DataArray`.
struct Declaration<'a> {
    name: &'a str,
    scalar_type: ScalarType,
    components: usize,
    /// The number of tuples, if it is not the number of points or cells.
    n_tuples: Option<usize>,
}

impl<'a> Declaration<'a> {
    fn new(name: &'a str, scalar_type: ScalarType, components: usize) -> Self {
        Self { name, scalar_type, components, n_tuples: None }
    }
}
