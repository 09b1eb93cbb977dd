//! Laws that dent beside the map of impacts by explicit elements, `validation/data/flow_map.csv`.

use std::fmt::Write as _;

use fem_laws::laws::{
    ContactLaw, brake, jackson_green, johnson, luding, mdr, mean_pressure, thornton, walton_braun,
};
use fem_laws::{
    FirstYield, HertzImpact, ImpactQuantities, LawImpact, Pair, Partner, YieldingBody,
    largest_von_mises,
};
use fem_material::FlowStress;

use crate::common::{Map, values};

const MAP: &str = include_str!("../../../../validation/data/flow_map.csv");
const PAGE: &str = include_str!("../../../../docs/metals.md");
/// The quantities in the order of the columns of the map.
const QUANTITIES: [&str; 5] =
    ["restitution", "contact_time", "peak_force", "max_approach", "max_contact_radius"];
/// Young's modulus and density of the balls of the map, diameter of the smaller one.
const MODULUS: f64 = 210e9;
const DENSITY: f64 = 7800.0;
const DIAMETER: f64 = 10e-3;

/// A row of the map.
struct Row {
    scene: String,
    nu: f64,
    hardening: f64,
    swift_strain: f64,
    swift_exponent: f64,
    /// Contact modulus over the yield strength.
    ratio: f64,
    times: f64,
    speed: f64,
    /// Over Hertz' values, and error bars of them.
    found: [f64; 5],
    bars: [f64; 5],
}

/// Returns the pair of a scene, and the shares of the law: of the bodies that flow in the flattening, and of an elastic partner in
/// the compliance.
fn scene(row: &Row) -> (Pair, [f64; 2]) {
    let modulus = |of: f64, nu: f64| of / (1.0 - nu * nu);
    let ball = |diameter: f64, modulus: f64| {
        let mass = fem_laws::sphere_mass(diameter, DENSITY);
        Partner::Sphere { radius: 0.5 * diameter, mass, plane_strain_modulus: modulus }
    };
    let own = modulus(MODULUS, row.nu);
    let (other, shares) = match row.scene.as_str() {
        "wall" => (Partner::Wall, [1.0, 0.0]),
        "twins" => (ball(DIAMETER, own), [0.5, 0.0]),
        "radius 3 : 1" => (ball(3.0 * DIAMETER, own), [0.625, 0.0]),
        "elastic ball" | "strength 1.5 : 1" => (ball(DIAMETER, own), [0.75, 0.5]),
        "modulus 3 : 1" => (ball(DIAMETER, 3.0 * own), [0.75, 0.25]),
        "elastic ball on block" => (Partner::HalfSpace { plane_strain_modulus: own }, [0.5, 0.5]),
        other => panic!("{other}"),
    };
    (Pair::new(ball(DIAMETER, own), other).unwrap(), shares)
}

fn rows() -> Vec<Row> {
    let map = Map::read(MAP);
    let rows = map.rows.iter().map(|row| {
        let number = |name: &str| map.number(row, name);
        let each = |end: &str| QUANTITIES.map(|name| number(&format!("{name}{end}")));
        Row {
            scene: map.cell(row, "scene").to_string(),
            nu: number("nu"),
            hardening: number("hardening_over_modulus") * MODULUS,
            swift_strain: number("swift_strain"),
            swift_exponent: number("swift_exponent"),
            ratio: number("modulus_over_strength"),
            times: number("speed_over_yield_speed"),
            speed: number("speed_m_s"),
            found: each("_over_hertz"),
            bars: each("_error"),
        }
    });
    rows.collect()
}

/// The parameters of a law in a row.
struct Contact {
    pair: Pair,
    shares: [f64; 2],
    strength: f64,
    hertz: HertzImpact,
}

impl Row {
    fn contact(&self) -> Contact {
        let (pair, shares) = scene(self);
        let strength = pair.contact_modulus() / self.ratio;
        Contact { pair, shares, strength, hertz: HertzImpact::new(&pair, self.speed).unwrap() }
    }

    /// Whether the impact is one that the law is made for: a/R* below 0.4 and ρv² below 0.1 Y.
    fn is_quasi_static(&self) -> bool {
        let Contact { pair, strength, hertz, .. } = self.contact();
        let radius = self.found[4] * hertz.max_contact_radius();
        radius < 0.4 * pair.effective_radius() && DENSITY * self.speed * self.speed < 0.1 * strength
    }

    /// Returns the quantities of a law over those of the elements, minus 1.
    fn errors(&self, law: impl Fn(&Self, &Contact) -> ContactLaw) -> [f64; 5] {
        let contact = self.contact();
        let Contact { pair, hertz, .. } = &contact;
        let impact = LawImpact::new(pair, law(self, &contact)).impact(self.speed).unwrap();
        let (found, hertz) = (values(&impact), ImpactQuantities::from(hertz).in_order());
        std::array::from_fn(|k| found[k] / hertz[k] / self.found[k] - 1.0)
    }

    fn flow(&self, contact: &Contact) -> FlowStress {
        FlowStress {
            yield_strength: contact.strength,
            modulus: self.hardening,
            strain: self.swift_strain,
            exponent: self.swift_exponent,
        }
    }

    /// Returns the first yield of the scene.
    fn first_yield(&self) -> FirstYield {
        let contact = self.contact();
        let body = |radius: f64| YieldingBody {
            yield_strength: contact.strength,
            poissons_ratio: self.nu,
            plane_strain_modulus: MODULUS / (1.0 - self.nu * self.nu),
            radius,
        };
        let small = 0.5 * DIAMETER;
        let bodies = match self.scene.as_str() {
            "twins" => [Some(body(small)), Some(body(small))],
            "radius 3 : 1" => [Some(body(small)), Some(body(3.0 * small))],
            "elastic ball on block" => [None, Some(body(f64::INFINITY))],
            _ => [Some(body(small)), None],
        };
        let (_, first) = FirstYield::earliest(&contact.hertz, bodies).unwrap();
        assert_eq!(
            [first.flattening_share, first.elastic_share].map(|share| (1e9 * share).round() / 1e9),
            contact.shares,
            "{}",
            self.scene
        );
        first.of_flow(self.flow(&contact), self.nu)
    }

    fn is_of_the_table(&self) -> bool {
        let is_perfect = self.hardening == 0.0 && self.swift_exponent == 0.0;
        self.scene == "wall" && self.nu == 0.3 && is_perfect && self.ratio <= 1000.0
    }
}

fn of_mean_pressure(row: &Row, contact: &Contact) -> ContactLaw {
    mean_pressure(&contact.pair, row.flow(contact), row.nu, contact.shares).unwrap()
}

/// The speeds of first yield of the map are those of this crate.
#[test]
fn the_map_has_the_speeds_of_first_yield() {
    for row in rows() {
        let Contact { strength, hertz, .. } = row.contact();
        let over = hertz.peak_pressure() * largest_von_mises(row.nu) / strength;
        let times = over.powf(2.5);
        assert!((times / row.times - 1.0).abs() < 1e-3, "{} {times} {}", row.scene, row.times);
    }
}

/// The law follows the elements within the errors that it states and the bars of the elements: beside partners that flow and that stay
/// elastic, with linear and power-law hardening, beyond 1000 v_y, and in contacts up to 0.6 R\*. At first yield the waves of fast impacts
/// are left, which are no error of the law.
#[test]
fn the_mean_pressure_law_follows_the_elements_within_its_errors() {
    let mut faults = String::new();
    for row in rows().iter().filter(|row| row.times > 1.0) {
        let first = row.first_yield();
        let impact = first.impact();
        let stated = first.errors(&impact);
        let hertz = ImpactQuantities::from(&row.contact().hertz).in_order();
        if impact.max_contact_radius > 0.6 * row.contact().pair.effective_radius() {
            continue;
        }
        for (k, name) in QUANTITIES.into_iter().enumerate() {
            let found = impact.in_order()[k] / hertz[k];
            let (error, bar) = (found / row.found[k] - 1.0, row.bars[k] / row.found[k]);
            if error.abs() > stated[k] * found / row.found[k] + bar {
                let Row { scene, nu, hardening, ratio, times, .. } = row;
                writeln!(faults, "{scene} {nu} {hardening:e} {ratio} {times} v_y {name} {error:.4} ± {bar:.4}, {stated:?}").unwrap();
            }
        }
    }
    assert!(faults.is_empty(), "\n{faults}");
}

/// A law of the table on the page: its name, what gives its parameters, and the law in a row.
type Entry = (&'static str, &'static str, fn(&Row, &Contact) -> ContactLaw);

/// Speed at which the springs of the table have the restitution and the peak force of the elements, over that of first yield.
const TUNED_AT: f64 = 30.0;

/// Returns the restitution, and the stiffness of a spring (N/m) with the peak force, of the elements at the speed of tuning.
fn tuned(row: &Row) -> (f64, f64) {
    let is_it = |it: &Row| it.is_of_the_table() && it.ratio == row.ratio && it.times == TUNED_AT;
    let row = rows().into_iter().find(is_it).unwrap();
    let Contact { pair, hertz, .. } = row.contact();
    let force = row.found[2] * hertz.peak_force();
    (row.found[0], (force / row.speed).powi(2) / pair.effective_mass())
}

/// A spring whose rebound is stiffer with every approach of the map: δ* is that at 1000 v_y.
fn of_luding(row: &Row, contact: &Contact) -> ContactLaw {
    let (restitution, stiffness) = tuned(row);
    let until = row.speed / row.times * 1000.0 * (contact.pair.effective_mass() / stiffness).sqrt();
    // e² = k₁/k₂ with k₂ = k₁ + (k_p − k₁) δ/δ*.
    let ratio = 1.0 + (restitution.powi(-2) - 1.0) * 1000.0 / TUNED_AT;
    let depth = until * (ratio - 1.0) / (2.0 * contact.pair.effective_radius() * ratio);
    luding(&contact.pair, ratio, stiffness, depth).unwrap()
}

const TABLE: [Entry; 8] = [
    ("mean_pressure", "Y", of_mean_pressure),
    ("jackson_green", "Y", |row, it| jackson_green(&it.pair, it.strength, row.nu).unwrap()),
    ("brake", "Y", |row, it| brake(&it.pair, it.strength, row.nu).unwrap()),
    ("mdr", "Y", |row, it| mdr(&it.pair, it.strength, row.nu, 0.0).unwrap()),
    ("thornton", "Y", |row, it| {
        thornton(&it.pair, it.strength / largest_von_mises(row.nu)).unwrap()
    }),
    ("johnson", "Y", |_, it| johnson(&it.pair, 3.0 * it.strength).unwrap()),
    ("walton_braun", "e and F at 30 v_y", |row, it| {
        let (restitution, stiffness) = tuned(row);
        walton_braun(&it.pair, restitution, stiffness).unwrap()
    }),
    ("luding", "e and F at 30 v_y", of_luding),
];

/// The page states the error of each law beside the elements. If this fails, replace the table of the page.
#[test]
fn the_page_states_the_error_of_each_law() {
    let rows: Vec<Row> = rows();
    let of_table = || rows.iter().filter(|row| row.is_of_the_table() && row.is_quasi_static());
    let mut table = String::new();
    for (name, parameters, law) in TABLE {
        write!(table, "| `{name}` | {parameters} |").unwrap();
        for times in [3.0, 10.0, 100.0, 1000.0] {
            let row = of_table().find(|row| row.ratio == 230.0 && row.times == times).unwrap();
            write!(table, " {:+.1} |", 100.0 * row.errors(law)[0]).unwrap();
        }
        let errors: Vec<[f64; 5]> = of_table().map(|row| row.errors(law)).collect();
        for k in 0..4 {
            let worst = errors.iter().fold(0.0_f64, |worst, errors| worst.max(errors[k].abs()));
            write!(table, " {:.1} |", 100.0 * worst).unwrap();
        }
        table.push('\n');
    }
    assert!(PAGE.contains(&table), "the table of docs/metals.md is\n{table}");
}
