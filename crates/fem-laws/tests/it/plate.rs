//! Impact on a thin plate: Zener's equation by every model, energy, gravity, and the figures of a steel ball.

use fem_laws::laws::{ContactLaw, hertz, linear, mean_pressure, thornton};
use fem_laws::{
    FiniteSize, FirstYield, FreePlate, HertzImpact, Impact, ImpactPath, LawError, LawImpact,
    MIN_RESTITUTION, Pair, PairRelaxation, Partner, SINKING_LAMBDA, Ting, largest_von_mises,
    plate_lambda, plate_mobility, plate_thickness_error, plate_thickness_factor, plate_wave_travel,
};
use fem_material::{ActsOn, FlowStress, Material};

use crate::common::{
    self, Map, STEEL, assert_close, assert_values, relaxation_of, steel, values, yielding_body,
};

const SPEED: f64 = 1.0;

/// A steel ball of 10 mm on steel.
fn pair() -> Pair {
    Pair::new(Partner::solid_sphere(10e-3, &steel()), Partner::half_space(&steel())).unwrap()
}

fn elastic() -> PairRelaxation {
    relaxation_of([&steel(), &steel()])
}

/// Returns the mobility for a λ of the pair at [`SPEED`].
fn mobility(lambda: f64) -> f64 {
    lambda / plate_lambda(&HertzImpact::new(&pair(), SPEED).unwrap(), 1.0)
}

/// Returns Ting's model and a law of the pair on a plate of this mobility.
fn ting_on_plate(pair: &Pair, relaxation: PairRelaxation, mobility: f64) -> Ting {
    Ting::new(pair, relaxation).with_plate(mobility).unwrap()
}

fn law_on_plate(law: ContactLaw, mobility: f64) -> LawImpact {
    LawImpact::new(&pair(), law).with_plate(mobility).unwrap()
}

/// Returns the elastic impacts of every model: Ting's, Hertz' law and one that never dents.
fn elastic_impacts(lambda: f64) -> [(&'static str, Impact); 3] {
    let (pair, mobility) = (pair(), mobility(lambda));
    let law = |law| law_on_plate(law, mobility).impact(SPEED).unwrap();
    let ting = ting_on_plate(&pair, elastic(), mobility).impact(SPEED).unwrap();
    let never = thornton(&pair, 1e14).unwrap();
    [("ting", ting), ("law", law(hertz(&pair).unwrap())), ("dent", law(never))]
}

/// Returns e, T/T₀ and F/F₀ of Zener's ü + (1 + λ d/dt) u^(3/2) = 0 by the classical Runge–Kutta method, for u and
/// q = u̇ + λ u^(3/2), with the end by linear interpolation of the last of many steps.
fn zener(lambda: f64) -> [f64; 3] {
    let rate = |[u, q]: [f64; 2]| {
        let force = u.max(0.0).powf(1.5);
        [q - lambda * force, -force]
    };
    let step = 1e-4;
    let (mut state, mut time, mut peak): ([f64; 2], f64, f64) = ([0.0, 1.0], 0.0, 0.0);
    loop {
        let at = |share: f64, k: [f64; 2]| [0, 1].map(|i: usize| state[i] + share * step * k[i]);
        let a = rate(state);
        let b = rate(at(0.5, a));
        let c = rate(at(0.5, b));
        let d = rate(at(1.0, c));
        let next: [f64; 2] =
            std::array::from_fn(|i| state[i] + step / 6.0 * (a[i] + 2.0 * (b[i] + c[i]) + d[i]));
        peak = peak.max(next[0].max(0.0).powf(1.5));
        if next[0] <= 0.0 {
            let last = time + step * state[0] / (state[0] - next[0]);
            // Hertz' contact in these units: T₀ = 3.21804, F₀ = (5/4)^(3/5).
            let hertz = HertzImpact::new(&pair(), SPEED).unwrap();
            let unit = (pair().effective_mass() / hertz.stiffness()).powf(0.4) * SPEED.powf(-0.2);
            return [-next[1], last * unit / hertz.contact_time(), peak / 1.25_f64.powf(0.6)];
        }
        (state, time) = (next, time + step);
    }
}

fn ratios(impact: &Impact) -> [f64; 3] {
    let hertz = HertzImpact::new(&pair(), SPEED).unwrap();
    [
        impact.restitution,
        impact.contact_time.unwrap() / hertz.contact_time(),
        impact.peak_force / hertz.peak_force(),
    ]
}

/// Every model of an elastic contact solves Zener's equation, to five digits. The largest λ leaves e = 2e-3.
#[test]
fn elastic_models_on_a_plate_equal_zeners_equation() {
    for lambda in [0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0] {
        let expected = zener(lambda);
        for (name, impact) in elastic_impacts(lambda) {
            let found = ratios(&impact);
            for k in 0..3 {
                let error = (found[k] - expected[k]).abs();
                assert!(error < 5e-6, "{name} {lambda} {k}: {} {}", found[k], expected[k]);
            }
        }
    }
}

/// The rate of the loss at small λ is ∫ u³ dt of Hertz' motion u̇² = 1 − ⅘ u^(5/2): ⅘ (5/4)^(8/5) B(8/5, ½), here by the midpoint
/// rule over u = u_m (1 − x²), which removes the root at the turning point.
#[test]
fn a_stiff_plate_takes_the_share_of_a_weak_dashpot() {
    let largest = 1.25_f64.powf(0.4);
    let n = 20_000;
    let of_cell = |k: i32| {
        let x = (f64::from(k) + 0.5) / f64::from(n);
        let u = largest * (1.0 - x * x);
        let speed = (1.0 - 0.8 * u.powf(2.5)).sqrt();
        2.0 * u.powi(3) / speed * 2.0 * largest * x / f64::from(n)
    };
    let limit: f64 = (0..n).map(of_cell).sum();
    assert_close(limit, 1.7301, 1e-4);
    let rate = |lambda: f64| {
        let ting = ting_on_plate(&pair(), elastic(), mobility(lambda));
        -ting.impact(SPEED).unwrap().restitution.ln() / lambda
    };
    // Linear in λ; five digits of e leave 2e-4 of the rate at 0.05.
    let found = 2.0 * rate(0.05) - rate(0.1);
    assert_close(found, limit, 2e-3);
}

/// A plate that takes all, such as a foil, ends every model at once: the ball has no restitution, gives the plate all of its
/// momentum, and its peak force is 1/λ in units of the motion at large λ. At the limit the results are those of the
/// whole motion, whose restitution falls as 0.6793 λ⁻⁵ (an integration by SciPy's LSODA at 1e-11, λ from 3.3 to 20) to a thousandth.
#[test]
fn a_ball_sinks_in_with_a_foil() {
    let sunk = |lambda: f64| mobility(lambda) * pair().effective_mass() * SPEED;
    for lambda in [1.001 * SINKING_LAMBDA, 120.0, 1e4] {
        for (_, impact) in elastic_impacts(lambda) {
            assert_eq!((impact.restitution, impact.contact_time), (0.0, None), "{lambda}");
            assert_close(impact.max_approach, sunk(lambda), 1e-12);
        }
    }
    // Here the contact grows without a turn, since the ball relaxes.
    let (relaxing_pair, relaxation) = relaxing();
    let creeping = ting_on_plate(&relaxing_pair, relaxation, mobility(120.0));
    let impact = creeping.impact(SPEED).unwrap();
    assert_eq!((impact.restitution, impact.contact_time), (0.0, None));
    assert_close(impact.max_approach, sunk(120.0), 1e-12);
    for (name, k) in [("ting", 0), ("law", 1), ("dent", 2)] {
        let asymptote = |lambda: f64| 0.6793 * lambda.powi(-5);
        let at = |lambda: f64| elastic_impacts(lambda)[k].1.clone();
        assert!((1.0..1.03).contains(&(MIN_RESTITUTION / asymptote(SINKING_LAMBDA))), "{name}");
        assert_close(at(3.6).restitution, asymptote(3.6), 1e-3);
        let limit = SINKING_LAMBDA;
        let [below, above] = [0.999 * limit, 1.001 * limit].map(at);
        // λ differs by 2e-3.
        assert_close(above.peak_force, below.peak_force, 2.5e-3);
        assert_close(above.max_contact_radius, below.max_contact_radius, 2.5e-3);
        assert_close(above.max_approach, below.max_approach, 1e-2);
        let [one, other] = [1e3, 1e4].map(|lambda| at(lambda).peak_force * lambda);
        assert_close(one, other, 2e-2);
    }
}

fn relaxing() -> (Pair, PairRelaxation) {
    let ball = common::relaxing(STEEL, ActsOn::All, &[(0.3, 2e-5)]);
    (pair(), relaxation_of([&ball, &steel()]))
}

/// Work of the motion = what contact, material and plate have, from ∫F dδ and the state; and the impulse is the change of
/// momentum.
#[test]
fn the_energy_is_accounted_for() {
    let (relaxing_pair, relaxation) = relaxing();
    for lambda in [0.05, 0.7] {
        let mobility = mobility(lambda);
        let ting = |pair, relaxation| ting_on_plate(pair, relaxation, mobility).impact(SPEED);
        let law = |law| law_on_plate(law, mobility).impact(SPEED);
        let dent = mean_pressure(&pair(), FlowStress::perfect(1e9), 0.3, [1.0, 0.5]).unwrap();
        let tolerance = 1e-6;
        for (name, impact) in [
            ("elastic", ting(&pair(), elastic())),
            ("relaxing", ting(&relaxing_pair, relaxation.clone())),
            ("linear", law(linear(1e7, 50.0).unwrap())),
            ("dent", law(dent)),
        ] {
            let impact = impact.unwrap();
            let end = impact.history.last().unwrap();
            let energy = 0.5 * pair().effective_mass() * SPEED * SPEED;
            let lost = energy * (1.0 - impact.restitution.powi(2));
            let known =
                end.strain_energy.unwrap_or(0.0) + end.dissipated.unwrap() + end.plate.unwrap();
            let off = (known - lost).abs();
            assert!(off < tolerance * energy, "{name} {lambda}: {known:e} {lost:e}");
            assert!((end.work - lost).abs() < tolerance * energy, "{name} {lambda}");
            assert!(end.plate.unwrap() > 0.02 * energy, "{name}");
            // Between the instants, too.
            let (rate, path) = (pair(), ImpactPath::new(&impact, &pair(), None));
            let middle = path.at(0.37 * end.time).unwrap();
            let taken =
                0.5 * rate.effective_mass() * (SPEED.powi(2) - middle.approach_rate.powi(2));
            assert!((middle.work - taken).abs() < 1e-4 * energy, "{name} {lambda}");
        }
    }
}

/// A plate takes from a contact that relaxes, too, and both lose more than each alone.
#[test]
fn plate_and_relaxation_lose_together() {
    let (pair, relaxation) = relaxing();
    let relaxing = |ting: Ting| ting.impact(SPEED).unwrap().restitution;
    let alone = relaxing(Ting::new(&pair, relaxation.clone()));
    let mobility = mobility(0.1);
    let plate = relaxing(ting_on_plate(&pair, elastic(), mobility));
    let both = relaxing(ting_on_plate(&pair, relaxation, mobility));
    assert!(both < alone.min(plate) - 0.05, "{both} {alone} {plate}");
    // The losses are almost independent.
    assert_close(both, alone * plate, 0.02);
}

/// The limit of a heavy plate is the contact alone, as is the limit of a slow ball.
#[test]
fn a_heavy_plate_is_a_half_space() {
    let plain = Ting::new(&pair(), elastic()).impact(SPEED).unwrap();
    let heavy = ting_on_plate(&pair(), elastic(), mobility(1e-9)).impact(SPEED).unwrap();
    assert_values(&heavy, &values(&plain)[..3], 1e-8);
}

#[test]
fn a_ball_that_falls_on_a_plate_leaves_it_or_stays() {
    let g = 9.81;
    let fast = ting_on_plate(&pair(), elastic(), mobility(0.2));
    let without = fast.impact(SPEED).unwrap();
    let with = fast.clone().with_gravity(g).unwrap().impact(SPEED).unwrap();
    assert_close(with.restitution, without.restitution, 1e-3);
    let law = law_on_plate(hertz(&pair()).unwrap(), mobility(0.2));
    let law = law.with_gravity(g).unwrap().impact(SPEED).unwrap();
    assert_close(law.restitution, with.restitution, 1e-6);
    let slow = fast.with_gravity(g).unwrap().impact(1e-4).unwrap();
    assert!(slow.contact_time.is_none() && slow.restitution == 0.0, "{}", slow.restitution);
}

#[test]
fn a_mobility_must_be_positive() {
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let found = Ting::new(&pair(), elastic()).with_plate(bad);
        assert!(matches!(found, Err(LawError::NotPositive { .. })), "{bad}");
        let law = LawImpact::new(&pair(), hertz(&pair()).unwrap()).with_plate(bad);
        assert!(law.is_err(), "{bad}");
    }
}

/// Thin plates with the factor of finite thickness beside explicit elements, `validation/data/plate_map.csv`. Without it their loss is
/// too small by up to a factor of 5.
#[test]
fn finite_thickness_gives_the_loss_of_elements() {
    let map = include_str!("../../../../validation/data/plate_map.csv");
    let map = Map::read(map);
    let mut worst: f64 = 0.0;
    for cells in &map.rows {
        let number = |name: &str| map.number(cells, name);
        let [ball, plate] = ["ball", "plate"].map(|name| map_material(map.cell(cells, name)));
        let (speed, diameter) = (number("speed_m_s"), 10e-3);
        let thickness = 0.5 * diameter * number("thickness_over_radius");
        let sphere = Partner::solid_sphere(diameter, &ball);
        let pair = Pair::new(sphere, Partner::half_space(&plate)).unwrap();
        let hertz = HertzImpact::new(&pair, speed).unwrap();
        let travel = plate_wave_travel(&hertz, &plate, thickness);
        let mobility = plate_mobility(&plate, thickness);
        // The script computes both by itself.
        assert_close(travel, number("wave_travel"), 1e-4);
        assert_close(plate_lambda(&hertz, mobility), number("lambda"), 1e-4);
        let relaxation = relaxation_of([&ball, &plate]);
        let size = FiniteSize::new(Some((0.5 * diameter, &ball)), None).unwrap();
        let ting = Ting::new(&pair, relaxation).with_finite_size(size);
        let factor = plate_thickness_factor(&plate, travel);
        let found = ting.with_plate(mobility * factor).unwrap().impact(speed).unwrap().restitution;
        let expected = number("restitution");
        let error = (found - expected).abs() - number("restitution_error");
        let part = error / (1.0 - expected) / plate_thickness_error(travel);
        assert!(part < 1.0, "{cells:?}: {found} {part}");
        worst = worst.max(part);
    }
    // The stated error is not far too large.
    assert!(map.rows.len() > 90 && worst > 0.5, "{} {worst}", map.rows.len());
}

/// The materials of the script `plate_map.py`.
fn map_material(name: &str) -> Material {
    let (modulus, density, ratio) = match name {
        "steel" => (210e9, 7800.0, 0.3),
        "steel, nu 0.15" => (210e9, 7800.0, 0.15),
        "steel, nu 0.45" => (210e9, 7800.0, 0.45),
        "aluminium" => (70e9, 2700.0, 0.33),
        "glass" => (63e9, 2390.0, 0.24),
        "polymer" => (5.4e9, 1190.0, 0.36),
        "carbide" => (600e9, 15000.0, 0.22),
        other => panic!("{other}"),
    };
    common::elastic([modulus, ratio, density])
}

/// A ball of 12 mm of steel on a plate of the same.
fn larger_pair() -> Pair {
    Pair::new(Partner::solid_sphere(12e-3, &steel()), Partner::half_space(&steel())).unwrap()
}

/// The larger ball with Y = 235 MPa, at a speed (m/s) on a plate of a thickness (m).
fn yielding(speed: f64, thickness: f64) -> FirstYield {
    let body = |radius| yielding_body(235e6, 210e9, radius);
    let hertz = HertzImpact::new(&larger_pair(), speed).unwrap();
    let bodies = [Some(body(6e-3)), Some(body(f64::INFINITY))];
    let plate = FreePlate { material: steel(), thickness, diameter: f64::INFINITY };
    FirstYield::earliest(&hertz, bodies).unwrap().1.with_plate(&plate).unwrap()
}

/// Restitution, contact time and peak force by explicit elements of this program with a tolerance of 1 %. They differ from the law
/// by its errors, which cover the thickness that it leaves out, and by the bars of the elements.
#[test]
fn a_dented_plate_gives_the_impacts_of_elements() {
    for (thickness, elements, bars) in [
        (3e-3, [0.0666, 46.75e-6, 950.5], [0.004, 2e-7, 8.0]),
        (5e-3, [0.2231, 38.61e-6, 1176.6], [0.004, 2e-7, 20.0]),
        (10e-3, [0.3337, 37.44e-6, 1289.9], [0.005, 3e-7, 10.0]),
        (20e-3, [0.3693, 37.34e-6, 1320.3], [0.006, 3e-7, 10.0]),
    ] {
        let first = yielding(3.0, thickness);
        let impact = first.impact();
        let errors = first.errors(&impact);
        for (k, value) in impact.in_order().into_iter().take(3).enumerate() {
            let (difference, allowed) = ((value - elements[k]).abs(), errors[k] * value + bars[k]);
            assert!(difference < allowed, "{thickness} {k}: {value} {}", elements[k]);
            // The bars are no help if they are far larger.
            assert!(errors[k] < 0.14, "{thickness} {k}: {}", errors[k]);
        }
    }
    // No wave returns from 10 cm: a half-space.
    let [thick, block] = [0.1, 1.0].map(|thickness| yielding(3.0, thickness).impact());
    assert_eq!(thick, block);
    assert_close(block.restitution, 0.373, 0.01);
}

/// A thin plate is compliant, so that the ball yields at a higher speed, from which on Hertz' spring on the plate reaches the pressure of
/// first yield.
#[test]
fn a_thin_plate_delays_first_yield() {
    let mut last = yielding(1.0, 1.0).speed;
    for thickness in [1e-3, 0.3e-3, 0.1e-3] {
        let first = yielding(1.0, thickness);
        assert!(first.speed > last, "{thickness}: {} {last}", first.speed);
        last = first.speed;
        let mobility = plate_mobility(&steel(), thickness);
        let pair = larger_pair();
        let model = LawImpact::new(&pair, hertz(&pair).unwrap()).with_plate(mobility).unwrap();
        let radius = model.impact(last).unwrap().max_contact_radius;
        let modulus = pair.contact_modulus() / pair.effective_radius();
        let pressure = 2.0 / std::f64::consts::PI * modulus * radius;
        assert_close(pressure * largest_von_mises(0.3), 235e6, 1e-3);
        let at = |times: f64| yielding(times * last, thickness);
        assert!(at(0.99).ratio() < 1.0 && at(1.01).ratio() > 1.0);
        // It falls with speed by itself on so thin a plate.
        assert_close(at(0.99).impact().restitution, at(1.01).impact().restitution, 0.04);
    }
}
