//! `[model]`: exactly one model, and for `law` exactly one law with the keys that it needs.

use fem_laws::{EndRule, LawImpact, Ting};

use super::{Allowed, Check, NOT_NEGATIVE, POSITIVE, allowed};
use crate::error::CaseError;
use crate::explain::listed;
use crate::key_path::join;
use crate::model::{CondensedOptions, Dashpot, Dissipation, Law, ModelChoice};
use crate::model_tables::{CondensedTable, End, LawTable, ModelTable};
use crate::quantity::{Count, Number, Quantity, QuantityKind};

const RESTITUTION: Allowed = allowed("greater than 0 and at most 1", |x| x > 0.0 && x <= 1.0);
const TOLERANCE: Allowed = allowed("from 1e-10 to 1e-2", |x| (1e-10..=1e-2).contains(&x));
const MODES: Allowed =
    allowed("a whole number from 0 to 100", |x| (0.0..=100.0).contains(&x) && x.fract() == 0.0);
const STEPS: Allowed =
    allowed("a whole number from 50 to 100000", |x| (50.0..=1e5).contains(&x) && x.fract() == 0.0);
const LIKE_POISSON: Allowed = allowed("between -1 and 1", |x| x > -1.0 && x < 1.0);

impl Check<'_> {
    /// The model that `[model]` chooses; absent, explicit finite elements.
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
        self.exactly_one("model", &given, "model", "fem = {}, or leave [model] out")?;
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

    /// The one key that is given.
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
                    .with_help(format!("exactly one {what} computes the collision")))
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
        let law = Keys { check: self, path: &path }.law(table)?;
        if law.family().end_rule().is_some_and(|own| own != end_rule) {
            let place = if end.is_some() { join(&path, "end") } else { join("model.law", "end") };
            let message = format!("{name} ends at zero force by its definition");
            let error = self.error(&place, message);
            return Err(error.with_help("leave end out; the same law with another end is tsuji"));
        }
        let tolerance = inner.or(outer).unwrap_or(LawImpact::DEFAULT_TOLERANCE);
        Ok(ModelChoice::Law { law, end_rule, tolerance })
    }
}

/// Reads the keys of one law.
struct Keys<'a> {
    check: &'a Check<'a>,
    path: &'a str,
}

impl Keys<'_> {
    fn law(&self, table: &LawTable) -> Result<Law, CaseError> {
        if let Some(keys) = &table.linear {
            return self.linear(keys);
        }
        if let Some(keys) = &table.power {
            let damping = self.optional("c", keys.c.as_ref(), NOT_NEGATIVE)?;
            let exponent = self.optional("n", keys.n.as_ref(), NOT_NEGATIVE)?;
            if damping.is_some_and(|damping| damping > 0.0) && exponent.is_none() {
                return Err(self.missing("n", "0.5"));
            }
            return Ok(Law::Power {
                stiffness: self.needed("k", keys.k.as_ref(), POSITIVE)?,
                elastic_exponent: self.needed("gamma", keys.gamma.as_ref(), POSITIVE)?,
                damping: damping.unwrap_or_default(),
                damping_exponent: exponent.unwrap_or_default(),
            });
        }
        if let Some(keys) = &table.kuwabara_kono {
            let viscosities = (keys.eta_1.as_ref(), keys.eta_2.as_ref());
            let given = self.dissipation(keys.a.as_ref(), viscosities)?;
            return Ok(Law::KuwabaraKono(given.unwrap_or(Dissipation::Relaxation)));
        }
        if let Some(keys) = &table.hunt_crossley {
            return Ok(Law::HuntCrossley {
                restitution: self.needed("e", keys.e.as_ref(), RESTITUTION)?,
                speed: self.optional("v", keys.v.as_ref(), POSITIVE)?,
            });
        }
        if let Some(keys) = &table.tsuji {
            return Ok(Law::Tsuji(self.damping(keys.e.as_ref(), keys.alpha.as_ref())?));
        }
        if let Some(keys) = &table.zhang_whiten {
            return Ok(Law::ZhangWhiten(self.damping(keys.e.as_ref(), keys.alpha.as_ref())?));
        }
        if let Some(keys) = &table.falcon {
            return Ok(Law::Falcon { damping: self.needed("c", keys.c.as_ref(), NOT_NEGATIVE)? });
        }
        if let Some(keys) = &table.mishra_murty {
            return Ok(Law::MishraMurty {
                stiffness: self.needed("k", keys.k.as_ref(), POSITIVE)?,
                damping: self.needed("c", keys.c.as_ref(), NOT_NEGATIVE)?,
            });
        }
        if let Some(keys) = &table.schwager_poeschel {
            let viscosities = (keys.eta_1.as_ref(), keys.eta_2.as_ref());
            let given = self.dissipation(keys.a.as_ref(), viscosities)?;
            let none = || self.missing("a", "\"1e-6 s\"");
            return Ok(Law::SchwagerPoeschel(given.ok_or_else(none)?));
        }
        if let Some(keys) = &table.morgado_oppenheim {
            return Ok(Law::MorgadoOppenheim {
                eta_1: self.needed("eta_1", keys.eta_1.as_ref(), NOT_NEGATIVE)?,
                eta_2: self.needed("eta_2", keys.eta_2.as_ref(), LIKE_POISSON)?,
            });
        }
        if let Some(keys) = &table.bordbar_hyppanen {
            return Ok(Law::BordbarHyppanen {
                dissipation_time: self.needed("a", keys.a.as_ref(), NOT_NEGATIVE)?,
                damping_exponent: self.needed("n", keys.n.as_ref(), NOT_NEGATIVE)?,
            });
        }
        Ok(Law::Hertz)
    }

    /// `k` and `c`, or `e` and `contact_time`.
    fn linear(&self, keys: &crate::model_tables::LinearTable) -> Result<Law, CaseError> {
        let by_outcome = keys.e.is_some() || keys.contact_time.is_some();
        if by_outcome && (keys.k.is_some() || keys.c.is_some()) {
            let at = |key| join(self.path, key);
            let error = self.check.conflict(
                &at(if keys.e.is_some() { "e" } else { "contact_time" }),
                &[&at("contact_time"), &at("e"), &at("k"), &at("c")],
                "linear mixes its coefficients with what is to come out",
            );
            return Err(error.with_help("give k and c, or e and contact_time"));
        }
        if by_outcome {
            return Ok(Law::LinearFromRestitution {
                restitution: self.needed("e", keys.e.as_ref(), RESTITUTION)?,
                contact_time: self.needed("contact_time", keys.contact_time.as_ref(), POSITIVE)?,
            });
        }
        Ok(Law::Linear {
            stiffness: self.needed("k", keys.k.as_ref(), POSITIVE)?,
            damping: self.optional("c", keys.c.as_ref(), NOT_NEGATIVE)?.unwrap_or_default(),
        })
    }

    /// `a`, or `eta_1` and `eta_2`, or none of them.
    fn dissipation<T: QuantityKind, V: QuantityKind>(
        &self,
        time: Option<&Quantity<T>>,
        viscosities: (Option<&Quantity<V>>, Option<&Quantity<V>>),
    ) -> Result<Option<Dissipation>, CaseError> {
        let shear = self.optional("eta_1", viscosities.0, NOT_NEGATIVE)?;
        let bulk = self.optional("eta_2", viscosities.1, NOT_NEGATIVE)?;
        let time = self.optional("a", time, NOT_NEGATIVE)?;
        match (time, shear, bulk) {
            (None, None, None) => Ok(None),
            (Some(time), None, None) => Ok(Some(Dissipation::Time(time))),
            (None, Some(shear), Some(bulk)) => Ok(Some(Dissipation::Viscosities { shear, bulk })),
            (None, None, Some(_)) => Err(self.missing("eta_1", "\"1e4 Pa s\"")),
            (None, Some(_), None) => Err(self.missing("eta_2", "\"1e4 Pa s\"")),
            (Some(_), ..) => {
                let at = |key| join(self.path, key);
                let message = "both a and viscosities are given";
                let error = self.check.conflict(&at("a"), &[&at("eta_1"), &at("eta_2")], message);
                Err(error.with_help("give a, or eta_1 and eta_2"))
            }
        }
    }

    /// The damping of a law that takes `e` or `alpha`.
    fn damping(
        &self,
        restitution: Option<&Quantity<Number>>,
        coefficient: Option<&Quantity<Number>>,
    ) -> Result<Dashpot, CaseError> {
        match (restitution, coefficient) {
            (Some(_), Some(_)) => {
                let (e, alpha) = (join(self.path, "e"), join(self.path, "alpha"));
                let error = self.check.conflict(&alpha, &[&e], "both e and alpha are given");
                Err(error.with_help("keep one of the two"))
            }
            (None, Some(_)) => {
                Ok(Dashpot::Coefficient(self.needed("alpha", coefficient, NOT_NEGATIVE)?))
            }
            _ => Ok(Dashpot::Restitution(self.needed("e", restitution, RESTITUTION)?)),
        }
    }

    fn optional<K: QuantityKind>(
        &self,
        key: &str,
        quantity: Option<&Quantity<K>>,
        allowed: Allowed,
    ) -> Result<Option<f64>, CaseError> {
        self.check.optional(&join(self.path, key), quantity, allowed)
    }

    fn needed<K: QuantityKind>(
        &self,
        key: &str,
        quantity: Option<&Quantity<K>>,
        allowed: Allowed,
    ) -> Result<f64, CaseError> {
        let value = self.optional(key, quantity, allowed)?;
        value.ok_or_else(|| self.missing(key, K::KIND.example))
    }

    fn missing(&self, key: &str, example: &str) -> CaseError {
        let message = format!("the key `{key}` is missing in {}", self.path);
        self.check.error(self.path, message).with_help(format!("write {key} = {example}"))
    }
}
