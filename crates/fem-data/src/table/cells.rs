//! The cells of a table in one string: a record has millions of them.

/// Cells by rows, each row with its line in the text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Cells {
    n_columns: usize,
    text: String,
    /// Where the first cell begins in `text`.
    start: usize,
    /// Where each cell ends.
    ends: Vec<usize>,
    lines: Vec<u64>,
}

impl Cells {
    pub fn new(n_columns: usize) -> Self {
        Self { n_columns, text: String::new(), start: 0, ends: Vec::new(), lines: Vec::new() }
    }

    /// Adds a row. Cells beyond the columns are left out, and cells that are not there are empty.
    pub fn push<'a>(&mut self, line: u64, cells: impl Iterator<Item = &'a str>) {
        for cell in cells.chain(std::iter::repeat("")).take(self.n_columns) {
            self.text.push_str(cell);
            self.ends.push(self.text.len());
        }
        self.lines.push(line);
    }

    /// Removes the first row.
    pub fn remove_first(&mut self) {
        let last = self.ends.drain(..self.n_columns).next_back();
        self.start = last.unwrap_or(self.start);
        self.lines.remove(0);
    }

    /// Returns the cells without some rows.
    pub fn without(self, is_left_out: impl Fn(&Self, usize) -> bool) -> Self {
        if !(0..self.n_rows()).any(|row| is_left_out(&self, row)) {
            return self;
        }
        let mut rest = Self::new(self.n_columns);
        for row in (0..self.n_rows()).filter(|row| !is_left_out(&self, *row)) {
            rest.push(self.line(row), (0..self.n_columns).map(|column| self.cell(row, column)));
        }
        rest
    }

    pub fn n_columns(&self) -> usize {
        self.n_columns
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
        let start = k.checked_sub(1).map_or(self.start, |before| self.ends[before]);
        &self.text[start..self.ends[k]]
    }

    /// Returns the texts of a row.
    pub fn row(&self, row: usize) -> Vec<String> {
        (0..self.n_columns).map(|column| self.cell(row, column).to_string()).collect()
    }
}
