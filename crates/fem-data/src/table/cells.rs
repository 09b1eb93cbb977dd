//! The cells of a table in one string: a record has millions of them.

/// Cells by rows, each row with its line in the text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Cells {
    n_columns: usize,
    text: String,
    /// Where each cell ends.
    ends: Vec<usize>,
    lines: Vec<u64>,
}

impl Cells {
    pub fn new(n_columns: usize) -> Self {
        Self { n_columns, text: String::new(), ends: Vec::new(), lines: Vec::new() }
    }

    /// Adds a row. Cells beyond the columns are left out, and cells that are not there are empty.
    pub fn push<'a>(&mut self, line: u64, cells: impl Iterator<Item = &'a str>) {
        for cell in cells.chain(std::iter::repeat("")).take(self.n_columns) {
            self.text.push_str(cell);
            self.ends.push(self.text.len());
        }
        self.lines.push(line);
    }

    /// Keeps the rows of which a function of a line and its cells is true.
    pub fn retain(&mut self, mut is_kept: impl FnMut(u64, &[&str]) -> bool) {
        let mut row = Vec::new();
        let is_kept: Vec<bool> = (0..self.n_rows())
            .map(|k| {
                row.clear();
                row.extend(self.cells(k));
                is_kept(self.line(k), &row)
            })
            .collect();
        if is_kept.contains(&false) {
            let mut rest = Self::new(self.n_columns);
            for k in (0..self.n_rows()).filter(|k| is_kept[*k]) {
                rest.push(self.line(k), self.cells(k));
            }
            *self = rest;
        }
    }

    pub fn n_rows(&self) -> usize {
        self.lines.len()
    }

    pub fn line(&self, row: usize) -> u64 {
        self.lines[row]
    }

    /// Returns the text of a cell.
    pub fn cell(&self, row: usize, column: usize) -> &str {
        let k = row * self.n_columns + column;
        let start = k.checked_sub(1).map_or(0, |before| self.ends[before]);
        &self.text[start..self.ends[k]]
    }

    fn cells(&self, row: usize) -> impl Iterator<Item = &str> {
        (0..self.n_columns).map(move |column| self.cell(row, column))
    }

    /// Returns the texts of a row.
    pub fn row(&self, row: usize) -> Vec<String> {
        self.cells(row).map(str::to_string).collect()
    }
}
