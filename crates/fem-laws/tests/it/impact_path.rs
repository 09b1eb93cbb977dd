//! A collision between its instants, and the energies along it.

use fem_laws::laws::{self, ContactLaw};
use fem_laws::{FiniteSize, HertzImpact, Impact, ImpactPath, LawImpact, Ting};
use fem_material::{ActsOn, Material};

use crate::common::{GLASS, decaying, glass_pair as pair, relaxation_of};

const SPEED: f64 = 0.5;

fn glass(terms: &[(f64, f64)]) -> Material {
    decaying(GLASS, ActsOn::All, terms)
}

fn ting(terms: &[(f64, f64)], is_finite: bool) -> Impact {
    let material = glass(terms);
    let ting = Ting::new(&pair(), relaxation_of([&material; 2]));
    let sizes = || FiniteSize::new(Some((11.1e-3, &material)), Some((7.95e-3, &material)));
    let ting = if is_finite { ting.with_finite_size(sizes().unwrap()) } else { ting };
    ting.impact(SPEED).unwrap()
}

/// Worst imbalance of ½m*v² at the instants and at 1000 times, of ½m*v².
fn imbalance(impact: &Impact, law: Option<&ContactLaw>) -> (f64, f64) {
    let pair = pair();
    let initial = 0.5 * pair.effective_mass() * SPEED * SPEED;
    let of = |rate: f64, work: f64| {
        (initial - 0.5 * pair.effective_mass() * rate * rate - work).abs() / initial
    };
    let path = ImpactPath::new(impact, &pair, law);
    let end = impact.history.last().unwrap().time;
    let between = (0..=1000).map(|k| path.at(end * k as f64 / 1000.0).unwrap());
    let worst = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
    (
        worst(&mut impact.history.iter().map(|i| of(i.approach_rate, i.work))),
        worst(&mut between.map(|i| of(i.approach_rate, i.work))),
    )
}

#[test]
fn energy_is_balanced_at_and_between_the_instants() {
    let hertz = HertzImpact::new(&pair(), SPEED).unwrap().impact();
    // Hertz by rounding; the others by their tolerance of 1e-8, and by interpolation between.
    for (name, impact) in [
        ("hertz", hertz),
        ("elastic ting", ting(&[], false)),
        ("finite", ting(&[], true)),
        ("ting", ting(&[(1.0, 2708.0)], false)),
        ("two terms", ting(&[(0.5, 2708.0), (0.3, 1e6)], true)),
    ] {
        let (at, between) = imbalance(&impact, None);
        assert!(at < 1e-7, "{name}: {at:e}");
        assert!(between < 2e-5, "{name}: {between:e}");
    }
    for law in [
        laws::hertz(&pair()).unwrap(),
        laws::kuwabara_kono(&pair(), 3e-6).unwrap(),
        laws::linear(1e7, 30.0).unwrap(),
        laws::bordbar_hyppanen(&pair(), 1e-6, 1.0).unwrap(),
    ] {
        let impact = LawImpact::new(&pair(), law).impact(SPEED).unwrap();
        let (at, between) = imbalance(&impact, Some(&law));
        assert!(at < 1e-7, "{law:?}: {at:e}");
        assert!(between < 2e-5, "{law:?}: {between:e}");
        assert!(impact.history.is_sorted_by(|a, b| a.dissipated <= b.dissipated));
    }
}

#[test]
fn elastic_impact_path_equals_hertz_motion() {
    let closed = HertzImpact::new(&pair(), SPEED).unwrap();
    let end = closed.contact_time();
    let peak = closed.peak_force();
    let law = laws::hertz(&pair()).unwrap();
    let integrated = LawImpact::new(&pair(), law).impact(SPEED).unwrap();
    for (impact, law) in
        [(closed.impact(), None), (integrated, Some(&law)), (ting(&[], false), None)]
    {
        let pair = pair();
        let path = ImpactPath::new(&impact, &pair, law);
        for k in 0..=500 {
            let time = end * f64::from(k) / 500.0;
            let (found, expected) = (path.at(time).unwrap(), closed.at(time));
            let pressure = closed.pressure(expected.approach);
            assert!((found.approach - expected.approach).abs() < 2e-6 * closed.max_approach());
            assert!((found.approach_rate - expected.approach_rate).abs() < 2e-5 * SPEED);
            // Three instants are a coarse net where the force is largest.
            assert!((found.force - expected.force).abs() < 5e-4 * peak, "{k}: {found:?}");
            let radius = (found.contact_radius - pressure.contact_radius).abs();
            assert!(radius < 2e-3 * closed.max_contact_radius(), "{k}: {found:?} {pressure:?}");
            if let Some(centre) = found.centre_pressure {
                let off = (centre - pressure.peak_pressure).abs();
                assert!(off < 2e-3 * closed.peak_pressure(), "{k}: {found:?} {pressure:?}");
            }
        }
        // Free flight after, first touch before.
        let after = path.at(1.5 * end).unwrap();
        assert!((after.approach + 0.5 * SPEED * end).abs() < 1e-4 * SPEED * end);
        assert_eq!(path.at(-1.0).unwrap(), impact.history[0]);
    }
}

#[test]
fn relaxing_impact_dissipates_the_lost_kinetic_energy() {
    let impact = ting(&[(1.0, 2708.0)], false);
    let (first, last) = (impact.history[1], *impact.history.last().unwrap());
    assert_eq!((first.strain_energy, first.dissipated), (None, None));
    let initial = 0.5 * pair().effective_mass() * SPEED * SPEED;
    let lost = initial * (1.0 - impact.restitution.powi(2));
    assert!((last.dissipated.unwrap() - lost).abs() < 1e-7 * initial);
    let highest = impact.history.iter().filter_map(|instant| instant.centre_pressure);
    let highest = highest.fold(0.0, f64::max);
    let peak = impact.peak_pressure.unwrap();
    assert!(highest <= peak * (1.0 + 1e-6) && highest > 0.99 * peak, "{highest} {peak}");
}
