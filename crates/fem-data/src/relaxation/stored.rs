//! The stored forms of a relaxation: `relaxation.json` and the tables of a case.

use serde_json::{Value, json};

use fem_collision::PROGRAM;
use fem_material::engineering::{Unit, number, show};
use fem_material::{GAS_CONSTANT, ShiftLaw, ZERO_CELSIUS};

use super::found::FoundRelaxation;
use super::superposition::{FittedShift, Superposition};
use crate::table::{ModulusPoint, TestKind};

/// Smaller shares of a modulus are rounding.
const LEAST_UNCERTAINTY: f64 = 1e-5;

/// Returns the numbers of shifts for JSON.
fn superposition(found: &Superposition) -> Value {
    let log10 = |ln: f64| ln / std::f64::consts::LN_10;
    let blocks = found.blocks.iter().map(|block| {
        json!({
            "temperature_k": block.temperature,
            "points": block.points.len(),
            "log10_shift": log10(block.ln_shift),
            "log10_shift_uncertainty": log10(block.shift_uncertainty),
            "log10_vertical_shift": log10(block.ln_vertical),
        })
    });
    let law = |fitted: &FittedShift| {
        let mut numbers = match &fitted.law {
            ShiftLaw::Wlf { c1, c2 } => json!({
                "c1": c1,
                "c1_uncertainty": fitted.uncertainties[0],
                "c2_k": c2,
                "c2_uncertainty_k": fitted.uncertainties[1],
            }),
            ShiftLaw::Arrhenius { activation_temperature } => json!({
                "activation_temperature_k": activation_temperature,
                "activation_temperature_uncertainty_k": fitted.uncertainties[0],
                "activation_energy_j_mol": GAS_CONSTANT * activation_temperature,
            }),
            ShiftLaw::Table(_) => json!({}),
        };
        numbers["misfit"] = json!(fitted.misfit);
        numbers["largest_deviation_log10"] = json!(fitted.largest_deviation);
        numbers
    };
    json!({
        "reference_temperature_k": found.reference_temperature(),
        "blocks": blocks.collect::<Value>(),
        "wlf": found.wlf.as_ref().map(law),
        "arrhenius": found.arrhenius.as_ref().map(law),
    })
}

impl FoundRelaxation {
    /// Returns the columns of the residuals at the reference temperature: frequency (Hz) or time (s), measured and fitted moduli (Pa).
    pub fn columns(&self) -> &'static [&'static str] {
        match self.table.kind {
            TestKind::Oscillation => &[
                "frequency_hz",
                "storage_modulus_pa",
                "loss_modulus_pa",
                "fitted_storage_modulus_pa",
                "fitted_loss_modulus_pa",
            ],
            TestKind::Relaxation => {
                &["time_s", "relaxation_modulus_pa", "fitted_relaxation_modulus_pa"]
            }
        }
    }

    /// Returns the rows below [`FoundRelaxation::columns`].
    pub fn rows(&self) -> impl Iterator<Item = Vec<f64>> {
        self.points.iter().map(|point| {
            let ModulusPoint { at, storage, loss, .. } = *point;
            let [fitted_storage, fitted_loss] = self.series.moduli(self.table.kind, at);
            match self.table.kind {
                TestKind::Oscillation => {
                    vec![at / std::f64::consts::TAU, storage, loss, fitted_storage, fitted_loss]
                }
                TestKind::Relaxation => vec![at, storage, fitted_storage],
            }
        })
    }

    /// Returns all numbers for JSON, SI.
    pub fn numbers(&self) -> Value {
        let series = &self.series;
        let whole = series.instantaneous_modulus();
        let terms = series.terms.iter().map(|term| {
            json!({
                "relaxation_time_s": term.relaxation_time,
                "weight": term.modulus / whole,
                "modulus_pa": term.modulus,
                "modulus_uncertainty_pa": term.uncertainty,
            })
        });
        json!({
            "data": self.table.name,
            "test": self.table.kind.word(),
            "modulus": self.modulus().key(),
            "acts_on": self.acts_on(),
            "bulk_modulus_pa": self.bulk_modulus,
            "points": self.points.len(),
            "temperature_k": self.temperature,
            "band_hz": self.band(),
            "instantaneous_modulus_pa": whole,
            "instantaneous_modulus_uncertainty_pa": series.instantaneous_uncertainty,
            "fastest_modulus_relative_uncertainty": series.fastest_uncertainty,
            "equilibrium_modulus_pa": series.equilibrium_modulus,
            "equilibrium_modulus_uncertainty_pa": series.equilibrium_uncertainty,
            "terms": terms.collect::<Value>(),
            "loss_uncertainty": self.loss_uncertainty(),
            "rms": series.rms,
            "scatter": self.scatter,
            "shift_law": self.shift_law().map(|law| match law {
                ShiftLaw::Wlf { .. } => "wlf",
                ShiftLaw::Arrhenius { .. } => "arrhenius",
                ShiftLaw::Table(_) => "table",
            }),
            "superposition": self.superposition.as_ref().map(superposition),
            "warnings": self.warnings(),
        })
    }

    /// Returns the table `relaxation` of a material as text, without its header.
    pub fn relaxation_toml(&self) -> String {
        let [from, to] = self.band();
        let whole = self.series.instantaneous_modulus();
        let mut text = format!(
            "# Prony series by {PROGRAM} from {}, measured from {} to {}; {} = \"{}\"\n",
            self.table.name,
            show(from, "Hz"),
            show(to, "Hz"),
            self.modulus().key(),
            Unit::fitting(whole, "Pa").with_digits(6).show(whole),
        );
        text += &format!("acts_on = \"{}\"\n", self.acts_on().word());
        let rows = self.loss_uncertainty();
        let rows = rows.iter().map(|(frequency, loss)| format!("[{frequency:.4e}, {loss:.5}]"));
        let rows = rows.collect::<Vec<_>>().join(", ");
        text += &format!(
            "band = {{ from = {from:?}, to = {to:?}, loss_uncertainty = [{rows}] }} # Hz\n"
        );
        text += &format!("{} = {whole:.6e} # Pa, of the fastest contacts\n", self.modulus().key());
        if let Some(temperature) = self.temperature {
            let celsius = temperature - ZERO_CELSIUS;
            text += &format!("reference_temperature = {temperature:.2} # K, {celsius:.1} degC\n");
        }
        text += &self
            .shift_law()
            .map_or(String::new(), |law| format!("shift = {}\n", shift_toml(&law)));
        text += "terms = [\n";
        for (weight, time) in self.weights() {
            // Rounded down, so that the sum does not exceed 1.
            let weight = (weight * 1e7).floor() * 1e-7;
            text += &format!("    {{ weight = {weight:.7}, relaxation_time = {time:.5e} }},\n");
        }
        text + "]\n"
    }

    /// Returns the table of the material as text to paste into a case file, without `relaxation`; density (kg/m³) and
    /// Poisson's ratio are comments if they are not given. The uncertainty of the modulus is that of the scale of all moduli, by the storage
    /// modulus at the highest measured frequency: the weights have that of faster terms.
    pub fn material_toml(
        &self,
        name: &str,
        density: Option<f64>,
        poissons_ratio: Option<f64>,
    ) -> String {
        let whole = self.series.instantaneous_modulus();
        let unit = Unit::fitting(whole, "Pa");
        let own = whole * self.series.fastest_uncertainty;
        let uncertainty = match (LEAST_UNCERTAINTY * whole..whole).contains(&own) {
            true => format!(" ± {}", number(unit.scaled(own), 2)),
            false => String::new(),
        };
        // The glassy modulus and the weights vary together, so that the modulus in the band is known better than both.
        let note = if uncertainty.is_empty() {
            ""
        } else {
            " # ± of the modulus at the highest rate measured"
        };
        let modulus = format!("{}{uncertainty} {}", number(unit.scaled(whole), 6), unit.symbol());
        let given = |key: &str, value: Option<String>, example: &str| match value {
            Some(value) => format!("{key} = {value}\n"),
            None => format!("# {key} = {example}\n"),
        };
        let density = density.map(|density| format!("\"{density:?} kg/m^3\""));
        let other = match self.bulk_modulus {
            Some(bulk) => given("bulk_modulus", Some(format!("\"{bulk:?} Pa\"")), ""),
            None => {
                given("poissons_ratio", poissons_ratio.map(|ratio| format!("{ratio:?}")), "0.35")
            }
        };
        format!(
            "[material.{}]\n{}{} = \"{modulus}\"{note}\n{other}",
            toml_key(name),
            given("density", density, "\"1200 kg/m^3\""),
            self.modulus().key(),
        )
    }
}

/// Returns a name as a key of TOML.
pub fn toml_key(name: &str) -> String {
    let is_bare = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    match !name.is_empty() && name.chars().all(is_bare) {
        true => name.to_string(),
        // A string of JSON is one of TOML.
        false => serde_json::Value::from(name).to_string(),
    }
}

/// Returns a shift law as TOML.
pub fn shift_toml(law: &ShiftLaw) -> String {
    match law {
        ShiftLaw::Wlf { c1, c2 } => format!("{{ wlf = {{ c1 = {c1:.5}, c2 = {c2:.4} }} }}"),
        ShiftLaw::Arrhenius { activation_temperature } => {
            format!("{{ arrhenius = {{ activation_temperature = {activation_temperature:.1} }} }}")
        }
        ShiftLaw::Table(rows) => {
            let rows =
                rows.iter().map(|(temperature, log10)| format!("[{temperature:.2}, {log10:.4}]"));
            format!("{{ table = [{}] }}", rows.collect::<Vec<_>>().join(", "))
        }
    }
}
