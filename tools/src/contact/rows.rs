//! The rows of the table of contact methods: one per scene, method and stiffness.

use fem::{Case, Collision, OutputRequest, Simulation};
use std::path::Path;

/// A scene, with the limits of its restitution, contact time (s) and peak force (N) for small elements,
/// from docs/accuracy.md.
#[derive(Clone, Copy, Debug)]
pub struct Scene {
    /// The name of the scene.
    pub name: &'static str,
    text: &'static str,
    limit: [f64; 3],
}

const ELASTIC: Scene = Scene {
    name: "elastic",
    text: include_str!("../../../cases/glass_0.5ms_elastic.toml"),
    limit: [1.0, 62.818e-6, 107.99],
};
const ALL: Scene = Scene {
    name: "all moduli relax",
    text: include_str!("../../../cases/glass_0.5ms.toml"),
    limit: [0.92763, 62.445e-6, 104.49],
};
const SHEAR: Scene = Scene {
    name: "shear relaxes",
    text: include_str!("../../../cases/glass_0.5ms_elastic_bulk.toml"),
    limit: [0.94811, 62.548e-6, 105.49],
};

const METHODS: [&str; 3] = ["massless", "penalty", "node_to_surface"];

/// A scene with a contact method and a penalty factor.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    pub scene: Scene,
    pub method: &'static str,
    /// The value of `contact.penalty_factor`.
    pub factor: f64,
}

/// Returns all rows, in the order of the page. Springs of a thousand times the usual stiffness would take a
/// minute between masses, and gain energy.
pub fn rows() -> Vec<Row> {
    let scenes = [(ELASTIC, 1.0), (ALL, 1.0), (SHEAR, 1.0), (ELASTIC, 10.0)];
    let all = scenes.into_iter().flat_map(|(scene, factor)| {
        METHODS.into_iter().map(move |method| Row { scene, method, factor })
    });
    all.chain([Row { scene: ELASTIC, method: METHODS[0], factor: 1000.0 }]).collect()
}

impl Row {
    /// Returns the simulation of the row.
    pub fn simulation(&self) -> Simulation {
        let overrides = [
            format!("contact.method='{}'", self.method),
            format!("contact.penalty_factor={}", self.factor),
            "mesh.contact_element_size='27.884 um'".to_string(),
            "time.mass_scaling=2e-4".to_string(),
        ];
        let case = Case::parse("glass.toml", self.scene.text, Path::new("."), &overrides);
        let simulation = Simulation::new(case.expect("a case")).expect("a scene");
        simulation.with_output_request(OutputRequest::quantities()).expect("a run")
    }

    /// Returns the cells of the row after its run.
    pub fn cells(&self, run: &Collision) -> Vec<String> {
        let [e, time, force] = [run.restitution, run.contact_time, run.peak_force]
            .map(|number| number.expect("a complete run"));
        let [limit_e, limit_time, limit_force] = self.scene.limit;
        let percent = |found: f64, limit: f64| format!("{:+.2}", 100.0 * (found / limit - 1.0));
        let share = |number: Option<f64>| format!("{:.1e}", number.expect("explicit elements"));
        vec![
            self.scene.name.to_string(),
            format!("`{}`", self.method),
            self.factor.to_string(),
            format!("{:+.1}", 1e4 * (e - limit_e)),
            percent(time, limit_time),
            percent(force, limit_force),
            share(run.force_scatter.map(|scatter| scatter / force)),
            share(run.residual_relative),
            run.contact_episodes.to_string(),
            format!("{:.2}", 1e9 * run.time_step.expect("explicit elements")),
            run.element_updates.expect("explicit elements").to_string(),
        ]
    }
}
