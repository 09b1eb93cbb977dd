//! Results of the shipped cases at default settings against independent numbers: the source paper (Bordbar & Hyppänen
//! 2007), Hertz, and quasi-static finite elements and Ting's theory with the same material (converged at small strain:
//! T = 62.818 µs, F = 107.99 N; e = 0.92763 at constant Poisson's ratio and 0.94811 with elastic bulk modulus).

use std::path::Path;

use fem_case::Case;
use fem_collision::Collision;
use fem_laws::HertzImpact;
use fem_simulation::{Plan, Simulation};

struct Run {
    collision: Collision,
    hertz: HertzImpact,
    element: f64,
}

impl Run {
    fn of(case: &str) -> Self {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases").join(case);
        let case = Case::load(&path, &[]).unwrap_or_else(|error| panic!("{error}"));
        let Plan { estimate, contact_element_size, .. } = Plan::of_case(&case).unwrap();
        let simulation = Simulation::new(case).unwrap_or_else(|error| panic!("{error}"));
        let collision = simulation.run(&mut ());
        assert!(collision.is_complete());
        let (hertz, element) = (estimate.hertz, contact_element_size);
        let run = Self { collision, hertz, element };
        run.assert_balanced();
        run
    }

    fn contact_time(&self) -> f64 {
        self.collision.contact_time.unwrap()
    }

    fn restitution(&self) -> f64 {
        self.collision.restitution.unwrap()
    }

    /// Asserts that energy and momentum are conserved.
    fn assert_balanced(&self) {
        // The residual is 3e-7, from trapezoidal dissipation over a thousand rows and the opening contact.
        assert!(self.collision.residual_relative.unwrap() < 1e-5);
        // Internal forces cancel in each element, contact forces at each point; rounding remains.
        assert!(self.collision.momentum_residual_relative.unwrap() < 1e-12);
    }
}

fn assert_near(value: f64, reference: f64, relative: f64) {
    let difference = value / reference - 1.0;
    assert!(
        difference.abs() <= relative,
        "{value:e} differs from {reference:e} by {difference:.2e}"
    );
}

#[test]
fn elastic_pair_against_paper_and_converged_finite_elements() {
    let run = Run::of("glass_0.5ms_elastic.toml");
    // The paper prints 0.994, which includes its numerical loss; the physical loss is 2e-6.
    let e = run.restitution();
    assert!((1.0 - 1e-4..=1.0 + 1e-5).contains(&e), "{e}");
    // The paper's finite elements differ by 1.6 % because of their penalty compliance.
    assert_near(run.contact_time(), run.hertz.contact_time(), 0.015);
    // Asked is 1 %; the default mesh is within 0.1 %.
    assert_near(run.contact_time(), 62.818e-6, 2e-3);
    assert_near(run.collision.peak_force.unwrap(), 107.99, 5e-3);
    assert_near(run.collision.max_approach.unwrap(), 10.681e-6, 2e-3);
    // Hertz' values at nearly the same force; the axis is fitted from an eighth of a radius on.
    assert_near(run.collision.peak_pressure.unwrap(), 1.027e9, 0.02);
    assert!((run.collision.max_contact_radius.unwrap() - 0.223e-3).abs() < run.element);
}

#[test]
fn viscoelastic_pair_against_paper_and_converged_finite_elements() {
    let run = Run::of("glass_0.5ms.toml");
    let e = run.restitution();
    // The paper prints 0.92 from finite elements and 0.925 from the experiment.
    assert!((e - 0.92).abs() < 0.012 && (e - 0.92763).abs() < 1e-3, "{e}");
    // The case has 2,620 elements and about 13,700 steps; the bound is a third higher.
    assert!(run.collision.element_updates.unwrap() < 48_000_000);
    let e = Run::of("glass_0.5ms_elastic_bulk.toml").restitution();
    assert!((e - 0.94811).abs() < 1e-3, "{e}");
}

#[test]
fn sphere_on_wall_against_hertz() {
    let run = Run::of("glass_on_wall.toml");
    assert!(1.0 - run.restitution() < 1e-3 && run.restitution() <= 1.0 + 1e-5);
    // To first order in a/R a sphere on a plane is 0.9 % faster and 1.2 % harder than Hertz'
    // half-space; the mesh adds up to 0.5 %.
    assert_near(run.contact_time(), (1.0 - 0.009) * run.hertz.contact_time(), 0.004);
    assert_near(run.collision.peak_force.unwrap(), (1.0 + 0.012) * run.hertz.peak_force(), 0.006);
}

#[test]
fn the_mesh_files_of_the_paper_run() {
    let run = Run::of("glass_0.5ms_14um.toml");
    assert_near(run.contact_time(), 62.818e-6, 2e-3);
    assert_near(run.collision.peak_force.unwrap(), 107.99, 5e-3);
}
