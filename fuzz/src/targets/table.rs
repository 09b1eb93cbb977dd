//! Tables of measured data, and quantities with their uncertainty.

use fem::Case;
use fem::measured::{
    DataError, Kind, MeasuredPairs, Restitutions, Table, cradle_trials, parse_measured,
};

use super::{files, root};
use crate::mutate::{Random, change_text};
use crate::trial::{Taken, Target, rejected};

const KINDS: [Kind; 3] = [Kind::Length, Kind::Mass, Kind::Angle];
/// Columns that data may have.
const COLUMNS: &str = "speed_m_s,restitution,restitution_uncertainty,diameter_1_mm,diameter_2_mm,contact_time_us\n\
                       0.5,0.9,0.01,22.2,15.9,60\n1,0.85,0.02,22.2,15.9,55\n";
const QUANTITIES: &str = "20 cm ± 1 mm,30 ± 0.5 deg,2 kg ± 50 %,0.35,1e3 mm +/- 2\n";

pub struct DataTable {
    seeds: Vec<Vec<u8>>,
    case: Case,
}

impl DataTable {
    /// # Panics
    /// A shipped case is invalid.
    pub fn new() -> Self {
        let mut seeds: Vec<Vec<u8>> =
            files("validation/data", "csv").into_iter().map(|(_, text)| text).collect();
        seeds.extend([COLUMNS, QUANTITIES].map(|text| text.as_bytes().to_vec()));
        let path = root().join("cases/glass_0.5ms.toml");
        Self { seeds, case: Case::load(&path, &[]).expect("a case") }
    }
}

impl Target for DataTable {
    fn make(&self, random: &mut Random) -> Vec<u8> {
        let mut text = self.seeds[random.below(self.seeds.len())].clone();
        change_text(&mut text, &self.seeds, random);
        text
    }

    fn take(&self, input: &[u8]) -> Result<Taken, String> {
        let text = String::from_utf8_lossy(input);
        for piece in text.split([',', '\n']) {
            for kind in KINDS {
                match parse_measured(kind, piece) {
                    Err(error) => {
                        rejected(&error.to_string().replace(char::is_control, " "))?;
                    }
                    Ok(it) if it.value.is_finite() && it.uncertainty >= 0.0 => {}
                    Ok(it) => return Err(format!("{piece:?} is {it:?}")),
                }
            }
        }
        let scene = self.case.scene();
        let table = match Table::parse("fuzzed.csv", &text) {
            Err(error) => return faulty(&error),
            Ok(table) => table,
        };
        let taken = [
            cradle_trials(&table).map(drop),
            MeasuredPairs::read(&table, scene).map(drop),
            Restitutions::read_with_contact_times(&table, scene).and_then(|read| {
                let wrong = read
                    .points
                    .iter()
                    .find(|point| !(point.restitution >= 0.0 && point.speed > 0.0));
                wrong.map_or(Ok(()), |point| Err(DataError::new("", format!("FINDING {point:?}"))))
            }),
        ];
        let mut is_read = false;
        for one in taken {
            match one {
                Ok(()) => is_read = true,
                Err(error) if error.message.starts_with("FINDING") => return Err(error.message),
                Err(error) => {
                    faulty(&error)?;
                }
            }
        }
        Ok(if is_read { Taken::Accepted } else { Taken::Rejected })
    }
}

fn faulty(error: &DataError) -> Result<Taken, String> {
    rejected(&error.to_string())
}
