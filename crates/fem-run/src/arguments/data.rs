//! Files of measured data.

use std::io::ErrorKind;
use std::path::Path;

use fem::fit::cradle::Measured;
use fem::measured::{
    DataError, Kind, NotMeasured, Restitutions, Table, decode, is_of_library, library_table,
    parse_measured,
};
use fem::{case_identity, digest_of};
use fem_case::Case;

use super::case::CaseArguments;
use super::law::split;
use crate::result_folder::Origin;
use crate::text::{Failure, one_line, standard_output};

/// Options for reading measured data.
#[derive(clap::Args, Debug)]
pub struct ColumnArguments {
    /// Columns of the data by their names in the header: speed=v,restitution=COR,uncertainty=u
    ///
    /// Without a unit in NAME the header gives it, as in v_cm_s or v [cm/s]; speed_cm_s=v sets it.
    #[arg(long, value_name = "NAME=COLUMN,…", value_delimiter = ',')]
    pub columns: Vec<String>,
}

/// Options for reading restitutions over speeds.
#[derive(clap::Args, Debug)]
pub struct RestitutionArguments {
    #[command(flatten)]
    pub columns: ColumnArguments,
    /// Take restitutions that are upper bounds, of bodies whose loss or strength is unknown, as they are
    #[arg(long)]
    pub as_elastic: bool,
}

impl RestitutionArguments {
    /// Reads a table as [`ColumnArguments::read`] does.
    pub fn read(&self, path: &Path) -> Result<Table, Failure> {
        Ok(self.with_bounds(self.columns.read(path)?))
    }

    /// Names the columns of a table in memory.
    pub fn name_columns(&self, table: Table) -> Result<Table, Failure> {
        Ok(self.with_bounds(self.columns.name_columns(table)?))
    }

    fn with_bounds(&self, table: Table) -> Table {
        if self.as_elastic { Restitutions::as_elastic(table) } else { table }
    }

    /// Returns the origin of a result as [`ColumnArguments::origin`] does.
    pub fn origin(
        &self,
        command: &str,
        case: Option<(&CaseArguments, &Case)>,
        data: Option<&Path>,
    ) -> Origin {
        let option = self.as_elastic.then(|| "--as-elastic".to_string());
        self.columns.origin(command, case, data).with_options(option.as_slice())
    }
}

impl ColumnArguments {
    /// Reads a table with commas, semicolons or tabs, decimal points or commas, in UTF-8 or Latin-1; `lib:ice` is a
    /// measurement of the materials library.
    pub fn read(&self, path: &Path) -> Result<Table, Failure> {
        let name = path.display().to_string();
        if is_of_library(&name) {
            let (table, note) = library_table(&name)?;
            standard_output::note(&note);
            return self.name_columns(table);
        }
        self.name_columns(Table::parse(&name, &decode(&read_bytes(path)?))?)
    }

    pub fn name_columns(&self, table: Table) -> Result<Table, Failure> {
        Ok(table.renamed(&self.names()?)?)
    }

    /// Returns each name with the column that it is given to.
    pub fn names(&self) -> Result<Vec<(&str, &str)>, Failure> {
        let names = self.columns.iter().map(|text| {
            let (name, column) = split(text, "--columns")?;
            Ok((name.trim(), column.trim()))
        });
        names.collect()
    }

    /// Returns the origin of a result of `command` from a case, if there is one, and a data file. The digest is that of
    /// their content.
    pub fn origin(
        &self,
        command: &str,
        case: Option<(&CaseArguments, &Case)>,
        data: Option<&Path>,
    ) -> Origin {
        let mut parts = vec![command.as_bytes().to_vec()];
        parts.extend(case.map(|(_, case)| case_identity(case).into_bytes()));
        parts.extend(data.map(|path| {
            let name = || path.as_os_str().as_encoded_bytes().to_vec();
            std::fs::read(path).unwrap_or_else(|_| name())
        }));
        parts.extend(self.columns.iter().map(|text| text.clone().into_bytes()));
        let digest = digest_of(parts.iter().map(Vec::as_slice));
        let origin = match case {
            Some((arguments, _)) => arguments.origin(command, digest),
            None => Origin::of_digest(command, digest),
        };
        let origin = match data.and_then(Path::to_str).filter(|name| is_of_library(name)) {
            Some(name) => origin.with_options(&[name.to_string()]),
            None => data.into_iter().fold(origin, |origin, path| origin.with_file(path)),
        };
        origin.with_options(&self.columns)
    }
}

/// Returns a parser of quantities of one kind, with or without an uncertainty.
pub fn of_kind(kind: Kind) -> impl Fn(&str) -> Result<Measured, NotMeasured> + Clone {
    move |text| parse_measured(kind, text)
}

/// Reads a file of data.
pub fn read_bytes(path: &Path) -> Result<Vec<u8>, Failure> {
    fem_case::read_data_file(path).map_err(|error| {
        let name = one_line(&path.display().to_string());
        let found = match error.kind() {
            ErrorKind::NotFound => "there is no such file".to_string(),
            _ => format!("this file cannot be read: {error}"),
        };
        Failure::bad_input(format!("{name}: {found}"))
            .with_help("name a CSV file with a header, such as validation/data/bridges_ice.csv")
    })
}

impl From<DataError> for Failure {
    fn from(error: DataError) -> Self {
        Failure::bad_input(error.to_string()).with_help_if(error.help)
    }
}
