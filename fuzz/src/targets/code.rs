//! A case made in code, with any value at any key of the schema.

use fem::{Case, CaseFile};
use toml::{Table, Value};

use super::case::try_case;
use super::cases;
use crate::mutate::{Random, number};
use crate::trial::{Taken, Target, rejected};

pub struct CaseInCode {
    seeds: Vec<Table>,
}

impl CaseInCode {
    pub fn new() -> Self {
        let text = |seed: &Vec<u8>| String::from_utf8_lossy(seed).parse().ok();
        Self { seeds: cases().iter().filter_map(text).collect() }
    }
}

impl Target for CaseInCode {
    fn make(&self, random: &mut Random) -> Vec<u8> {
        let mut table = Value::Table(self.seeds[random.below(self.seeds.len())].clone());
        let other = Value::Table(self.seeds[random.below(self.seeds.len())].clone());
        for _ in 0..=random.below(4) {
            change(&mut table, &other, random);
        }
        if let Value::Table(table) = &mut table {
            let limits = Table::from_iter([("elements".to_string(), Value::Integer(3000))]);
            table.insert("limits".to_string(), limits.into());
            if random.once_in(2) {
                let size =
                    Table::from_iter([("contact_element_size".to_string(), Value::Float(1e-3))]);
                table.insert("mesh".to_string(), size.into());
            }
        }
        toml::to_string(&table).unwrap_or_default().into_bytes()
    }

    fn take(&self, input: &[u8]) -> Result<Taken, String> {
        // The target `case` tests texts that are not a case file.
        let Ok(file) = toml::from_str::<CaseFile>(&String::from_utf8_lossy(input)) else {
            return Ok(Taken::Rejected);
        };
        match Case::of(file) {
            Ok(case) => try_case(case),
            Err(error) if error.key().is_some() => rejected(&error.to_string()),
            Err(error) => Err(format!("a fault without a key: {error}")),
        }
    }
}

/// Changes the value at some key, or takes the value of another case.
fn change(value: &mut Value, other: &Value, random: &mut Random) {
    match value {
        Value::Table(table) => {
            let keys: Vec<String> = table.keys().cloned().collect();
            let key = &keys[random.below(keys.len()).min(keys.len().saturating_sub(1))..];
            let Some(key) = key.first() else { return };
            let theirs = other.as_table();
            match random.below(12) {
                0 => drop(table.remove(key)),
                1 => {
                    let theirs: Vec<_> = theirs.into_iter().flatten().collect();
                    if let Some((key, value)) = theirs.get(random.below(theirs.len())) {
                        table.insert(key.to_string(), (*value).clone());
                    }
                }
                _ => {
                    let theirs = theirs.and_then(|theirs| theirs.get(key)).unwrap_or(other);
                    if let Some(value) = table.get_mut(key) {
                        change(value, theirs, random);
                    }
                }
            }
        }
        Value::Array(list) if !list.is_empty() => {
            let k = random.below(list.len());
            match random.below(8) {
                0 => drop(list.remove(k)),
                1 => list.push(list[k].clone()),
                _ => change(&mut list[k], other, random),
            }
        }
        leaf => *leaf = leaf_of(leaf, random),
    }
}

fn leaf_of(leaf: &Value, random: &mut Random) -> Value {
    let number = number(random);
    let float = number.parse().unwrap_or(f64::NAN);
    let unit = || Some(leaf.as_str()?.split_once(' ')?.1);
    match random.below(6) {
        0 => Value::Float(float),
        1 => Value::Integer(float as i64),
        2 => Value::Boolean(random.once_in(2)),
        3 => Value::String(
            random.one_of(&["", "on", "off", "auto", "all", "shear", "\u{1b}", "x y"]).to_string(),
        ),
        _ => match unit() {
            // With its unit the quantity may be valid.
            Some(unit) => Value::String(format!("{number} {unit}")),
            None => Value::Float(float),
        },
    }
}
