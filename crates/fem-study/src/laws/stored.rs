//! The stored forms of fits and exports in SI units: `fit.json` and `export.json`.

use fem_case::schema::End;
use fem_laws::{LawFamily, LawParameter};
use serde_json::{Map, Value, json};

use super::dem_export::DemExport;
use super::law_fit::LawFit;
use super::stored_fit::bodies;
use fem_data::dem::{FittedFriction, Friction, Snippet, Sphere, restitution_of};
use fem_data::estimate::{Fit, Model, Point, Profile, ProfilePoint};

impl LawFit<'_> {
    /// Returns the stored form of the fit in SI units; `case` is the case's name.
    pub fn numbers(&self, case: &str) -> Value {
        let (fit, problem) = (&self.fit, &self.problem);
        let family = problem.model.family();
        let compared = |(model, fit): &(Model, Fit)| json!({ "law": model.family().name(), "values": fit.values, "rms": fit.rms });
        let parameters = family.parameters().iter().enumerate();
        let results: Vec<(&str, f64)> =
            fit.estimates.iter().map(|one| (one.key, self.scale_of(one))).collect();
        json!({
            "case": case,
            "data": self.data.name,
            "law": family.name(),
            "end": End::from(problem.model.end_rule()),
            "points": problem.points.len(),
            "speeds_m_s": self.data.speeds(),
            "scatter": self.scatter(),
            "bodies": bodies(problem.model),
            "model_toml": self.model_toml(),
            "weighted": problem.has_uncertainties(),
            "confidence": self.confidence,
            "parameters": parameters.map(|(k, one)| self.parameter(k, one)).collect::<Value>(),
            "inputs": self.inputs.iter().map(|part| part.numbers(&results)).collect::<Value>(),
            "correlation": fit.correlation,
            "covariance": fit.covariance,
            "quantile": fit.quantile,
            "rms": fit.rms,
            "sum_of_squares": fit.sum_of_squares,
            "degrees_of_freedom": fit.degrees_of_freedom,
            "condition_number": fit.condition,
            "robust": fit.robustness.as_ref().map(|robustness| robustness.numbers(&self.weights())),
            "profile": self.profile.as_ref().map(|profile| self.profile_numbers(profile)),
            "curves": self.curve_numbers(),
            "measured": self.measured_numbers(),
            "compared": self.compared.iter().map(compared).collect::<Value>(),
            "warnings": self.warnings(),
        })
    }

    fn parameter(&self, index: usize, parameter: &LawParameter) -> Value {
        let estimate = self.fit.estimates.iter().find(|estimate| estimate.index == index);
        let profile = self.profile.as_ref().filter(|profile| profile.index == index);
        let family_strength = self.problem.model.family().strength_parameter();
        json!({
            "key": parameter.key,
            "unit": parameter.unit,
            "value": self.fit.values[index],
            "free": estimate.is_some(),
            "standard_error": estimate.and_then(|estimate| estimate.standard_error),
            "standard_error_of_data": estimate.and_then(|estimate| estimate.error_of_data),
            "standard_error_of_law": estimate.map(|estimate| self.error_by_law(estimate)),
            "at_least": self.at_least.filter(|_| family_strength == Some(index)),
            "interval": estimate.and_then(|estimate| estimate.interval),
            "at_bound": estimate.is_some_and(|estimate| estimate.is_at_bound),
            "profile_interval": profile.and_then(|profile| profile.interval),
        })
    }

    /// Returns the restitutions of all laws over the speed, and the confidence band of the fitted one.
    fn curve_numbers(&self) -> Value {
        let speeds = self.curve_speeds();
        let law = |(model, fit): (&Model, &Fit)| json!({ "law": model.family().name(), "restitution": Self::curve((model, fit), &speeds) });
        json!({
            "laws": self.laws().map(law).collect::<Value>(),
            "band": self.band(&speeds),
            "speed_m_s": speeds,
        })
    }

    /// Returns the columns of the data.
    fn measured_numbers(&self) -> Value {
        let points = self.problem.points;
        let column = |value: fn(&Point) -> Option<f64>| points.iter().map(value).collect::<Value>();
        json!({
            "speed_m_s": column(|point| Some(point.speed)),
            "restitution": column(|point| Some(point.restitution)),
            "restitution_uncertainty": column(|point| point.restitution_uncertainty),
            "weight": self.weights(),
        })
    }

    fn profile_numbers(&self, profile: &Profile) -> Value {
        let point = |point: &ProfilePoint| json!({ "value": point.value, "rms": point.rms, "values": point.values });
        json!({
            "key": self.problem.parameter(profile.index).key,
            "points": profile.points.iter().map(point).collect::<Value>(),
        })
    }
}

impl DemExport {
    /// Returns the stored form of the export in SI units; `case` is the case's name.
    pub fn numbers(&self, case: &str, snippets: &[Snippet]) -> Value {
        let (export, points) = (&self.export, &self.curve.points);
        let sphere = |sphere: &Sphere| {
            json!({
                "diameter_m": sphere.diameter,
                "density_kg_m3": sphere.density,
                "youngs_modulus_pa": sphere.youngs_modulus,
                "poissons_ratio": sphere.poissons_ratio,
            })
        };
        let point = |point: &Point| {
            json!({
                "speed_m_s": point.speed,
                "restitution": point.restitution,
                "contact_time_s": point.contact_time,
            })
        };
        json!({
            "case": case,
            "fitted_law": self.curve.law.map(LawFamily::name),
            "wall": export.spheres.len() < 2,
            "spheres": export.spheres.iter().map(sphere).collect::<Value>(),
            "tolerance": export.tolerance,
            "speeds_m_s": export.speeds,
            "effective_mass_kg": export.pair.effective_mass(),
            "effective_radius_m": export.pair.effective_radius(),
            "contact_modulus_pa": export.pair.contact_modulus(),
            "dissipation_time_s": export.of_speed("kuwabara_kono").map(|law| law.values[0]),
            "linear_contact_time_s": export.contact_time,
            "has_hertz_times": self.curve.has_hertz_times,
            "bounds": export.bounds,
            "notes": export.notes,
            "band": self.curve.band.as_ref().map(|band| json!({
                "confidence": band.confidence,
                "largest_half_width": band.widest(),
            })),
            "friction": export.friction.as_ref().map(|friction| self.friction_numbers(friction)),
            "data": points.iter().map(point).collect::<Value>(),
            "snippets": snippets.iter().map(|snippet| self.snippet(snippet)).collect::<Value>(),
        })
    }

    /// Returns the rebound of the patch, in units of μ times the approach speed, and the laws of codes without files: a spring of a
    /// ratio k_t/k_n, and Walton's coefficient β₀.
    fn friction_numbers(&self, friction: &Friction) -> Value {
        let rebound = &friction.rebound;
        let speed = rebound.speed;
        let nearest = self.curve.points.iter().min_by(|one, other| {
            let distance = |point: &Point| (point.speed / speed).ln().abs();
            distance(one).total_cmp(&distance(other))
        });
        let walton = rebound.walton(nearest.map_or(1.0, |point| point.restitution));
        let linear = friction.fitted.get("mfix_lsd.dat");
        let law = |key: &str, fitted: &FittedFriction| json!({ key: fitted.factor, "rms": fitted.rms, "worst": fitted.worst });
        json!({
            "coefficient": rebound.friction,
            "approach_speed_m_s": rebound.speed,
            "tangential_modulus_pa": rebound.modulus,
            "mindlin_stiffness_ratio": rebound.modulus / self.export.pair.contact_modulus(),
            "patch_before": rebound.before,
            "patch_after": rebound.after,
            "linear": linear.map(|fitted| law("stiffness_ratio", fitted)),
            "walton": law("beta_0", &walton),
        })
    }

    /// Returns a file for a code with its range of validity, which is `null` if it is valid at no speed, and the
    /// restitutions that it makes at the speeds of the data.
    fn snippet(&self, snippet: &Snippet) -> Value {
        let [from, to, worst] = snippet.validity;
        let family = LawFamily::from_name(snippet.law);
        let law =
            family.and_then(|family| self.laws.iter().find(|law| law.model.family() == family));
        let of_drake =
            self.export.of_speed("hunt_crossley").filter(|_| snippet.law == "hunt_crossley");
        let at_speed = |point: &Point| match (snippet.restitution, of_drake) {
            (Some(restitution), _) => Some(restitution),
            (None, Some(fitted)) => Some(restitution_of(fitted.values[0] * point.speed)),
            (None, None) => law?.outcome(point.speed).map(|outcome| outcome.restitution),
        };
        let friction = self.export.friction.as_ref();
        let fitted = friction.and_then(|friction| friction.fitted.get(snippet.name));
        let entries = snippet.entries.iter().map(|(key, value)| (key.to_string(), json!(value)));
        json!({
            "file": snippet.name,
            "code": snippet.code,
            "model": snippet.model,
            "entries": entries.collect::<Map<_, _>>(),
            "restitution": snippet.restitution,
            "valid_from_m_s": (from <= to).then_some(from),
            "valid_to_m_s": (from <= to).then_some(to),
            "worst_error": worst,
            "friction": fitted.map(|fitted| json!({
                "stiffness_factor": fitted.factor,
                "patch_after": fitted.after,
                "rms": fitted.rms,
                "worst": fitted.worst,
            })),
            "restitutions_at_data": self.curve.points.iter().map(at_speed).collect::<Vec<_>>(),
        })
    }
}
