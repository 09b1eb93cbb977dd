//! The parts of a `.vtu` that hold arrays.

/// Where an array stands, and so how many tuples it has.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Section {
    FieldData,
    PointData,
    CellData,
    Points,
    Cells,
}

impl Section {
    pub(crate) const ALL: [Self; 5] =
        [Self::FieldData, Self::PointData, Self::CellData, Self::Points, Self::Cells];

    /// The name of its XML element.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::FieldData => "FieldData",
            Self::PointData => "PointData",
            Self::CellData => "CellData",
            Self::Points => "Points",
            Self::Cells => "Cells",
        }
    }
}
