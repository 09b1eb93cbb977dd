//! `relaxation.toml`: a series as a case has it.

use fem_case::schema::{ActsOn, RelaxationTable, TermTable};

use super::calibration::Calibration;
use fem_simulation::results::PROGRAM;

impl Calibration {
    /// The table that gives the material what was found; none where nothing relaxes.
    pub fn relaxation(&self) -> Option<RelaxationTable> {
        let terms = self.terms().into_iter();
        let terms =
            terms.map(|term| TermTable::with_relaxation_time(term.weight, term.relaxation_time));
        let terms: Vec<TermTable> = terms.collect();
        (!terms.is_empty()).then(|| RelaxationTable { acts_on: self.acts_on(), terms })
    }

    /// Which moduli relax, as a case says it.
    pub fn acts_on(&self) -> ActsOn {
        self.target.acts_on.into()
    }

    /// The table of the relaxation as text to paste into a case file; only comments where nothing relaxes.
    pub fn relaxation_toml(&self) -> String {
        let resolution = &self.fit.resolution;
        let mut text = format!(
            "# By {PROGRAM} calibrate from {}: {} of {} combinations of weights are the data's.\n",
            self.measured.data.name,
            resolution.n_determined(),
            self.fit.weights.len(),
        );
        let terms = self.terms();
        if terms.is_empty() {
            return text + "# No term has a weight: the data show no loss.\n";
        }
        text += &format!("[material.{}.relaxation]\n", toml_key(&self.target.material));
        text += &format!("acts_on = \"{}\"\nterms = [\n", self.acts_on().word());
        for term in terms {
            text += &format!(
                "    {{ weight = {:?}, relaxation_time = {:?} }},\n",
                term.weight, term.relaxation_time
            );
        }
        text + "]\n"
    }
}

/// A name as a key of TOML.
fn toml_key(name: &str) -> String {
    let is_bare = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    match !name.is_empty() && name.chars().all(is_bare) {
        true => name.to_string(),
        // A string of JSON is one of TOML.
        false => serde_json::Value::from(name).to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_are_no_bare_keys_are_quoted() {
        assert_eq!(toml_key("soda-lime_1"), "soda-lime_1");
        assert_eq!(toml_key("a \"b\""), "\"a \\\"b\\\"\"");
        assert_eq!(toml_key(""), "\"\"");
    }
}
