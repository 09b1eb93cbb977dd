//! Files of measured data, and their faults.

use std::path::Path;

use fem::measured::{DataError, Table, decode};

use crate::failure::Failure;
use crate::law_arguments::split;
use crate::standard_output::one_line;

/// How a file of measured data is to be read.
#[derive(clap::Args, Debug)]
pub struct ColumnArguments {
    /// What the columns of --data are, by their names in its header:
    /// speed=v,restitution=COR,uncertainty=u
    ///
    /// A name that has no unit takes that of the header, v_cm_s or v [cm/s]; speed_cm_s=v gives one.
    #[arg(long, value_name = "NAME=COLUMN,…", value_delimiter = ',')]
    pub columns: Vec<String>,
}

impl ColumnArguments {
    /// Reads a table: commas, semicolons or tabs, decimal points or commas, UTF-8 or Latin-1.
    ///
    /// # Errors
    /// A file that cannot be read, is no CSV, has no row, or not the columns that are named.
    pub fn read(&self, path: &Path) -> Result<Table, Failure> {
        let name = path.display().to_string();
        let bytes = std::fs::read(path).map_err(|error| {
            let name = one_line(&name);
            Failure::bad_input(format!("{name}: this file cannot be read: {error}"))
                .with_help("name a CSV file with a header, such as validation/data/bridges_ice.csv")
        })?;
        self.name_columns(Table::parse(&name, &decode(&bytes))?)
    }

    /// A table whose columns have the names that are given.
    ///
    /// # Errors
    /// Not the columns that are named.
    pub fn name_columns(&self, table: Table) -> Result<Table, Failure> {
        let names = self.columns.iter().map(|text| {
            let (name, column) = split(text, "--columns")?;
            Ok((name.trim(), column.trim()))
        });
        let names: Vec<(&str, &str)> = names.collect::<Result<_, Failure>>()?;
        Ok(table.renamed(&names)?)
    }

    /// All of it in one text: results of other columns are other results.
    pub fn text(&self) -> String {
        self.columns.join(",")
    }
}

impl From<DataError> for Failure {
    fn from(error: DataError) -> Self {
        let failure = Failure::bad_input(error.to_string());
        match error.help {
            Some(help) => failure.with_help(help),
            None => failure,
        }
    }
}
