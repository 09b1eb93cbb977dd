//! `[model]`: exactly one model, and for `law` exactly one law with the keys that it needs.

use fem_laws::{EndRule, KeyNeed, KeyRange, KeySet, LawFamily, LawImpact, LawInput, Ting};

use super::{Allowed, Check, NOT_NEGATIVE, POSITIVE, allowed};
use crate::error::CaseError;
use crate::quantity::{Count, Number, Quantity};
use crate::scene::model::{CondensedOptions, ModelChoice};
use crate::schema::model_tables::{CondensedTable, End, LawKey, LawTable, ModelTable};
use crate::source::explain::listed;
use crate::source::toml_syntax::join;

const RESTITUTION: Allowed = allowed("greater than 0 and at most 1", |x| x > 0.0 && x <= 1.0);
const TOLERANCE: Allowed = allowed("from 1e-10 to 1e-2", |x| (1e-10..=1e-2).contains(&x));
const MODES: Allowed =
    allowed("a whole number from 0 to 100", |x| (0.0..=100.0).contains(&x) && x.fract() == 0.0);
const STEPS: Allowed =
    allowed("a whole number from 50 to 100000", |x| (50.0..=1e5).contains(&x) && x.fract() == 0.0);
const LIKE_POISSON: Allowed = allowed("between -1 and 1", |x| x > -1.0 && x < 1.0);

impl Allowed {
    /// Returns the numbers that a key of a law allows.
    pub(crate) fn by(range: KeyRange) -> Self {
        match range {
            KeyRange::Positive => POSITIVE,
            KeyRange::NotNegative => NOT_NEGATIVE,
            KeyRange::Restitution => RESTITUTION,
            KeyRange::LikePoissonsRatio => LIKE_POISSON,
        }
    }
}

impl Check<'_> {
    /// Returns the model that `[model]` selects; by default explicit finite elements.
    pub(super) fn model(&self, table: Option<&ModelTable>) -> Result<ModelChoice, CaseError> {
        let Some(table) = table else { return Ok(ModelChoice::default()) };
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
                finite_size: ting.finite_size.unwrap_or_default(),
                tolerance: tolerance.unwrap_or(Ting::DEFAULT_TOLERANCE),
            });
        }
        match (hertz, law) {
            (Some(hertz), _) => {
                Ok(ModelChoice::Hertz { finite_size: hertz.finite_size.unwrap_or_default() })
            }
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
        let default = CondensedOptions::default();
        Ok(ModelChoice::Condensed(CondensedOptions {
            vibration_modes: count("vibration_modes", vibration_modes, MODES)?
                .unwrap_or(default.vibration_modes),
            steps: count("steps", steps, STEPS)?.unwrap_or(default.steps),
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
        self.optional(path, given, TOLERANCE)
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
        let end_rule = EndRule::from(end.or(table.end).unwrap_or(End::ZeroForce));
        let law = self.law_input(family, &path, table.values(self, &path)?)?;
        if family.end_rule().is_some_and(|own| own != end_rule) {
            let place = if end.is_some() { join(&path, "end") } else { join("model.law", "end") };
            let message = format!("{name} ends at zero force by its definition");
            let error = self.error(&place, message);
            return Err(error.with_help("remove end; the same law with another end is tsuji"));
        }
        let tolerance = inner.or(outer).unwrap_or(LawImpact::DEFAULT_TOLERANCE);
        Ok(ModelChoice::Law { law, end_rule, tolerance })
    }
}

impl Check<'_> {
    /// Returns the law of a family from the keys that are given: those of exactly one of its sets.
    fn law_input(
        &self,
        family: LawFamily,
        path: &str,
        given: Vec<(&'static str, f64)>,
    ) -> Result<LawInput, CaseError> {
        let sets = family.key_sets();
        let is_in = |set: &KeySet, key: &str| set.iter().any(|(own, _)| *own == key);
        // The first key given of each set of which one is given.
        let firsts: Vec<_> = sets
            .iter()
            .filter_map(|set| Some((set, given.iter().find(|(key, _)| is_in(set, key))?.0)))
            .collect();
        let set = match *firsts.as_slice() {
            [] => sets.iter().find(|set| set.is_empty()).or(sets.first()).copied().unwrap_or(&[]),
            [(set, _)] => set,
            [(_, first), (_, second), ..] => {
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
        };
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
                    return Err(error.with_help(format!("write {key} = {example}")));
                }
            };
            values.extend(value.map(|value| (key, value)));
        }
        Ok(LawInput { family, values })
    }
}
