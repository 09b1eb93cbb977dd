//! `[model]`: exactly one model, and for `law` exactly one law with the keys that it needs.

use fem_laws::{EndRule, KeyNeed, KeyRange, KeySet, LawFamily, LawInput};

use super::Check;
use crate::error::CaseError;
use crate::quantity::range::Range;
use crate::quantity::{Count, Number, Quantity};
use crate::scene::defaults;
use crate::scene::model::{CondensedOptions, ModelChoice};
use crate::schema::model_tables::{CondensedTable, LawKey, LawTable, ModelTable};
use crate::source::explain::listed;
use crate::source::toml_syntax::join;

impl From<KeyRange> for Range {
    fn from(range: KeyRange) -> Self {
        match range {
            KeyRange::Positive => Self::POSITIVE,
            KeyRange::NotNegative => Self::NOT_NEGATIVE,
            KeyRange::Restitution => Self::RESTITUTION,
            KeyRange::LikePoissonsRatio => Self::LIKE_POISSONS_RATIO,
        }
    }
}

macro_rules! law_values {
    ($(
        $(#[$doc:meta])*
        $variant:ident, $law:ident, $table:ident, $example:literal;
        formula($($formula:tt)*) = $value:expr;
        given by $([$($set_key:ident $(: $need:expr)?),*])+ $(, values $values:path)?;
        $(ends at $ends:ident;)?
        keys { $($(#[$key_doc:meta])* $key:ident: $kind:ident, $range:ident $(, $role:expr)?;)* }
    )+) => {
        impl Check<'_> {
            /// Returns the keys of the law that is given, with their values in SI.
            ///
            /// # Errors
            /// A value is no number of its kind, or is out of its range.
            fn values_of(&self, table: &LawTable, path: &str) -> Result<Vec<(&'static str, f64)>, CaseError> {
                let mut values = Vec::new();
                $(if let Some(_table) = &table.$law {
                    $(
                        let value = self.optional(
                            &join(path, stringify!($key)),
                            _table.$key.as_ref(),
                            Range::from(KeyRange::$range),
                        )?;
                        values.extend(value.map(|value| (stringify!($key), value)));
                    )*
                })+
                Ok(values)
            }
        }
    };
}

fem_laws::contact_laws!(law_values);

impl Check<'_> {
    /// Returns the model that `[model]` selects; the default without the table.
    pub(super) fn model(&self, table: Option<&ModelTable>) -> Result<ModelChoice, CaseError> {
        let Some(table) = table else { return Ok(defaults::MODEL) };
        let ModelTable { fem, condensed, ting, hertz, law, auto } = table;
        let given = [
            ("fem", fem.is_some()),
            ("condensed", condensed.is_some()),
            ("ting", ting.is_some()),
            ("hertz", hertz.is_some()),
            ("law", law.is_some()),
            ("auto", auto.is_some()),
        ];
        let given: Vec<_> = given.into_iter().filter(|(_, is)| *is).map(|(name, _)| name).collect();
        self.exactly_one("model", &given, "model", "fem = {}, or remove [model]")?;
        if auto.is_some() {
            return Ok(ModelChoice::Auto);
        }
        if let Some(condensed) = condensed {
            return self.condensed_model(condensed);
        }
        if let Some(ting) = ting {
            let tolerance = self.tolerance("model.ting.tolerance", ting.tolerance.as_ref())?;
            return Ok(ModelChoice::Ting {
                finite_size: ting.finite_size.unwrap_or(defaults::FINITE_SIZE),
                tolerance: tolerance.unwrap_or(defaults::TING_TOLERANCE),
            });
        }
        match (hertz, law) {
            (Some(hertz), _) => Ok(ModelChoice::Hertz {
                finite_size: hertz.finite_size.unwrap_or(defaults::FINITE_SIZE),
            }),
            (_, Some(law)) => self.law_model(law),
            _ => Ok(ModelChoice::Fem),
        }
    }

    fn condensed_model(&self, table: &CondensedTable) -> Result<ModelChoice, CaseError> {
        let CondensedTable { vibration_modes, steps, penalty_springs } = table;
        let count = |key: &str, value: &Option<Quantity<Count>>, allowed| {
            let path = join("model.condensed", key);
            let count = self.optional(&path, value.as_ref(), allowed)?;
            Ok::<_, CaseError>(count.map(|count| count as usize))
        };
        let default = defaults::CONDENSED;
        Ok(ModelChoice::Condensed(CondensedOptions {
            vibration_modes: count("vibration_modes", vibration_modes, Range::VIBRATION_MODES)?
                .unwrap_or(default.vibration_modes),
            steps: count("steps", steps, Range::CONDENSED_STEPS)?.unwrap_or(default.steps),
            penalty_springs: penalty_springs.unwrap_or(default.penalty_springs),
        }))
    }

    /// Returns the only key that is given.
    fn exactly_one<'n>(
        &self,
        path: &str,
        given: &[&'n str],
        what: &str,
        example: &str,
    ) -> Result<&'n str, CaseError> {
        match given {
            [one] => Ok(one),
            [] => Err(self
                .error(path, format!("{path} names no {what}"))
                .with_help(format!("write {example}"))),
            [.., last] => {
                let paths: Vec<_> = given.iter().map(|name| join(path, name)).collect();
                let paths: Vec<_> = paths.iter().map(String::as_str).collect();
                let message = format!("{path} has the keys {}", listed(given));
                Err(self
                    .conflict(&join(path, last), &paths, message)
                    .with_help(format!("keep exactly one {what}")))
            }
        }
    }

    fn tolerance(
        &self,
        path: &str,
        given: Option<&Quantity<Number>>,
    ) -> Result<Option<f64>, CaseError> {
        self.optional(path, given, Range::INTEGRATION_TOLERANCE)
    }

    fn law_model(&self, table: &LawTable) -> Result<ModelChoice, CaseError> {
        let example = "law = { kuwabara_kono = { a = \"1e-6 s\" } }";
        let name = self.exactly_one("model.law", &table.given(), "law", example)?;
        let Some(&family) = table.families().first() else { return Ok(ModelChoice::Fem) };
        let path = join("model.law", name);
        let (end, tolerance) = table.inner();
        for (key, is_twice) in [
            ("end", end.is_some() && table.end.is_some()),
            ("tolerance", tolerance.is_some() && table.tolerance.is_some()),
        ] {
            if is_twice {
                let (inner, outer) = (join(&path, key), join("model.law", key));
                let message = format!("{key} is given twice");
                let error = self.conflict(&outer, &[&inner, &outer], message);
                return Err(error.with_help(format!("keep the one in {path}")));
            }
        }
        let inner = self.tolerance(&join(&path, "tolerance"), tolerance)?;
        let outer = self.tolerance("model.law.tolerance", table.tolerance.as_ref())?;
        let end_rule = end.or(table.end).map_or(defaults::LAW_END, EndRule::from);
        let law = self.law_input(family, &path, self.values_of(table, &path)?)?;
        if family.end_rule().is_some_and(|own| own != end_rule) {
            let place = if end.is_some() { join(&path, "end") } else { join("model.law", "end") };
            let message = format!("{name} ends at zero force by its definition");
            let error = self.error(&place, message);
            return Err(error.with_help(match family {
                LawFamily::ZhangWhiten => "remove end; the same law with another end is tsuji",
                _ => "remove end",
            }));
        }
        let tolerance = inner.or(outer).unwrap_or(defaults::LAW_TOLERANCE);
        Ok(ModelChoice::Law { law, end_rule, tolerance })
    }
}

impl Check<'_> {
    /// Returns the set of keys of a law that holds those that are given.
    fn law_keys(
        &self,
        family: LawFamily,
        path: &str,
        given: &[(&'static str, f64)],
    ) -> Result<KeySet, CaseError> {
        let sets = family.key_sets();
        let is_in = |set: &KeySet, key: &str| set.iter().any(|(own, _)| *own == key);
        let with = |keys: &[(&str, f64)]| {
            let holds = |set: &&KeySet| keys.iter().all(|(key, _)| is_in(set, key));
            sets.iter().filter(holds).collect::<Vec<_>>()
        };
        let pairs = given
            .iter()
            .enumerate()
            .flat_map(|(n, second)| given[..n].iter().map(move |first| [*first, *second]));
        if let Some([(first, _), (second, _)]) = pairs.into_iter().find(|it| with(it).is_empty()) {
            let others: Vec<_> = given.iter().map(|(key, _)| join(path, key)).collect();
            let others: Vec<_> = others.iter().map(String::as_str).collect();
            let message = format!("both {first} and {second} are given");
            let error = self.conflict(&join(path, second), &others, message);
            let words = sets
                .iter()
                .filter(|set| !set.is_empty())
                .map(|set| listed(&set.iter().map(|(key, _)| *key).collect::<Vec<_>>()));
            let words = words.collect::<Vec<_>>().join(", or ");
            return Err(error.with_help(format!("give {words}")));
        }
        // The one that lacks the fewest keys.
        let missing = |set: &&KeySet| {
            let required = set.iter().filter(|(_, need)| *need == KeyNeed::Required);
            required.filter(|(key, _)| given.iter().all(|(own, _)| own != key)).count()
        };
        Ok(with(given).into_iter().min_by_key(missing).copied().unwrap_or(&[]))
    }

    /// Returns the law of a family from the keys that are given: those of exactly one of its sets.
    fn law_input(
        &self,
        family: LawFamily,
        path: &str,
        given: Vec<(&'static str, f64)>,
    ) -> Result<LawInput, CaseError> {
        let set = self.law_keys(family, path, &given)?;
        let value = |key: &str| given.iter().find(|(own, _)| *own == key).map(|(_, value)| *value);
        let mut values = Vec::new();
        for &(key, need) in set {
            let value = match (value(key), need) {
                (Some(value), _) => Some(value),
                (None, KeyNeed::Optional) => None,
                (None, KeyNeed::Default(default)) => Some(default),
                (None, KeyNeed::With(other)) if !value(other).is_some_and(|value| value > 0.0) => {
                    Some(0.0)
                }
                (None, KeyNeed::Required | KeyNeed::With(_)) => {
                    let is_it = |own: &&LawKey| (own.family, own.key) == (family, key);
                    let example =
                        LawTable::KEYS.iter().find(is_it).map_or("", |own| own.kind.example);
                    let message = format!("the key `{key}` is missing in {path}");
                    let error = self.error(path, message);
                    // A bare number has no typical size.
                    let value = match example.starts_with('"') {
                        true => format!("{key} = …, such as {example}"),
                        false => format!("{key} = …, a number in SI"),
                    };
                    return Err(error.with_help(format!(
                        "write {value}; fem-run fit finds it from measured restitutions, fem-run invert from one"
                    )));
                }
            };
            values.extend(value.map(|value| (key, value)));
        }
        Ok(LawInput { family, values })
    }
}
