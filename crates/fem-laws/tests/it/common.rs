//! Materials, pairs and comparisons that several modules share.

use fem_laws::{Impact, Pair, PairRelaxation, Partner, YieldingBody};
use fem_material::{ActsOn, ElasticModuli, Material, PronySeries, PronyTerm};

pub fn assert_close(found: f64, expected: f64, relative: f64) {
    assert!(
        (found - expected).abs() <= relative * expected.abs(),
        "found {found:e}, expected {expected:e}"
    );
}

/// Returns restitution, contact time, peak force, approach and contact radius of an impact that ends.
pub fn values(impact: &Impact) -> [f64; 5] {
    let Impact { restitution, peak_force, max_approach, max_contact_radius, .. } = *impact;
    [restitution, impact.contact_time.unwrap(), peak_force, max_approach, max_contact_radius]
}

/// Asserts that these values of an impact are expected ones, as many as there are.
#[track_caller]
pub fn assert_values(impact: &Impact, expected: &[f64], relative: f64) {
    for (found, expected) in values(impact).into_iter().zip(expected) {
        assert_close(found, *expected, relative);
    }
}

/// Asserts that a history begins and ends as its impact does, is in order and within its peaks of force and approach, to
/// these shares of them, and has the impulse of the momentum that changes.
pub fn assert_history(
    impact: &Impact,
    [speed, mass]: [f64; 2],
    [over_force, over_approach]: [f64; 2],
    of_impulse: f64,
) {
    let (history, last) = (&impact.history, *impact.history.last().unwrap());
    assert_eq!((history[0].time, history[0].approach, history[0].approach_rate), (0.0, 0.0, speed));
    assert_eq!(last.time, impact.contact_time.unwrap());
    assert_eq!(last.approach_rate, -speed * impact.restitution);
    assert!(last.force.abs() < 1e-9 * impact.peak_force);
    assert!(history.is_sorted_by(|a, b| a.time < b.time));
    // ∫ F dt = m* v (1 + e), by the trapezoidal rule on the steps.
    let steps = history.windows(2);
    let impulse =
        steps.map(|two| 0.5 * (two[0].force + two[1].force) * (two[1].time - two[0].time));
    assert_close(impulse.sum(), mass * speed * (1.0 + impact.restitution), of_impulse);
    for instant in history {
        assert!(instant.force <= impact.peak_force * (1.0 + over_force));
        assert!(instant.approach <= impact.max_approach * (1.0 + over_approach));
    }
}

/// Returns a body that yields, by its strength (Pa), modulus (Pa) and radius (m), with ν = 0.3.
pub fn yielding_body(yield_strength: f64, youngs_modulus: f64, radius: f64) -> YieldingBody {
    let plane_strain_modulus = youngs_modulus / 0.91;
    YieldingBody { yield_strength, poissons_ratio: 0.3, plane_strain_modulus, radius }
}

/// A table of validation/data.
pub struct Map<'t> {
    header: Vec<&'t str>,
    pub rows: Vec<Vec<&'t str>>,
}

impl<'t> Map<'t> {
    pub fn read(text: &'t str) -> Self {
        let mut rows: Vec<_> = text.lines().map(cells).collect();
        Self { header: rows.remove(0), rows }
    }

    pub fn cell(&self, row: &[&'t str], name: &str) -> &'t str {
        row[self.header.iter().position(|own| *own == name).unwrap()]
    }

    pub fn number(&self, row: &[&'t str], name: &str) -> f64 {
        self.cell(row, name).parse().unwrap()
    }
}

/// Returns the cells of a line, some of which are in quotation marks and have a comma.
fn cells(mut rest: &str) -> Vec<&str> {
    let mut cells = Vec::new();
    loop {
        let quoted = rest.strip_prefix('"').and_then(|rest| rest.split_once('"'));
        let (cell, after) = match quoted {
            Some((cell, after)) => (cell, after.strip_prefix(',')),
            None => rest.split_once(',').map_or((rest, None), |(cell, after)| (cell, Some(after))),
        };
        cells.push(cell);
        match after {
            Some(after) => rest = after,
            None => return cells,
        }
    }
}

/// Young's modulus (Pa), Poisson's ratio and density (kg/m³).
pub const GLASS: [f64; 3] = [63e9, 0.244, 2390.0];
pub const STEEL: [f64; 3] = [210e9, 0.3, 7800.0];

pub fn moduli(youngs_modulus: f64, poissons_ratio: f64) -> ElasticModuli {
    ElasticModuli::from_youngs_modulus_poissons_ratio(youngs_modulus, poissons_ratio).unwrap()
}

/// Returns a material with Prony terms of weight and relaxation time (s); an elastic one without terms.
pub fn relaxing(
    [youngs_modulus, poissons_ratio, density]: [f64; 3],
    acts_on: ActsOn,
    terms: &[(f64, f64)],
) -> Material {
    let term = |&(weight, relaxation_time): &(f64, f64)| PronyTerm { weight, relaxation_time };
    let series = (!terms.is_empty())
        .then(|| PronySeries::new(terms.iter().map(term).collect(), acts_on).unwrap());
    Material::new(density, moduli(youngs_modulus, poissons_ratio), series).unwrap()
}

/// The same with terms of weight and decay rate (1/s).
pub fn decaying(constants: [f64; 3], acts_on: ActsOn, terms: &[(f64, f64)]) -> Material {
    let terms: Vec<_> = terms.iter().map(|(weight, rate)| (*weight, 1.0 / rate)).collect();
    relaxing(constants, acts_on, &terms)
}

pub fn elastic(constants: [f64; 3]) -> Material {
    relaxing(constants, ActsOn::All, &[])
}

pub fn glass() -> Material {
    elastic(GLASS)
}

pub fn steel() -> Material {
    elastic(STEEL)
}

pub fn relaxation_of(materials: [&Material; 2]) -> PairRelaxation {
    PairRelaxation::new(Some(materials[0]), Some(materials[1])).unwrap()
}

/// Returns the share of its instantaneous modulus in Carson's transform of a series at `s`, 1/s.
pub fn carson(equilibrium_weight: f64, terms: &[PronyTerm], s: f64) -> f64 {
    let decaying = terms.iter().map(|term| {
        let st = s * term.relaxation_time;
        term.weight * st / (1.0 + st)
    });
    equilibrium_weight + decaying.sum::<f64>()
}

/// Returns spheres of 22.2 and 15.9 mm of a material.
pub fn pair_of(material: &Material) -> Pair {
    let sphere = |diameter| Partner::solid_sphere(diameter, material);
    Pair::new(sphere(22.2e-3), sphere(15.9e-3)).unwrap()
}

pub fn glass_pair() -> Pair {
    pair_of(&glass())
}
