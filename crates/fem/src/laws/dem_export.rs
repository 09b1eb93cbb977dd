//! From e(v) and T(v) to the laws that DEM codes have, and where each is good.

use fem_case::{Body, Case, Scene};
use fem_fit::dem::{
    Dashpot, Elastic, Export, Snippet, Sphere, drake_snippets, lammps_snippets, liggghts_snippets,
    mujoco_snippets, yade_snippets,
};
use fem_fit::{FitError, Model, Outcome, Point, Problem};
use fem_laws::{EndRule, Family, LawError};

use super::chosen_law::model_of;
use super::impact_curve::ImpactCurve;

/// Level of the intervals of the fits, which nobody reads.
const CONFIDENCE: f64 = 0.95;

/// The laws of DEM codes on one curve.
#[derive(Clone, Debug)]
pub struct DemExport {
    /// What they are fitted to.
    pub curve: ImpactCurve,
    /// What snippets are written from.
    pub export: Export,
    /// One e at all speeds on Hertz' spring, viscoelastic damping, linear.
    pub laws: [FittedLaw; 3],
}

/// A law and its values.
#[derive(Clone, Debug)]
pub struct FittedLaw {
    /// Its name in words.
    pub name: &'static str,
    /// The bodies under it.
    pub model: Model,
    /// Values of its parameters, SI.
    pub values: Vec<f64>,
    /// From, to (m/s), largest error of e; see [`ImpactCurve::validity`].
    pub validity: [f64; 3],
}

impl FittedLaw {
    /// Restitution and contact time at a speed, m/s.
    pub fn outcome(&self, speed: f64) -> Option<Outcome> {
        self.model.outcome(&self.values, speed).ok()
    }
}

impl DemExport {
    /// Fits all laws to a curve; `tolerance` is the error of e up to which a law is called good.
    ///
    /// # Errors
    /// Data that do not determine them.
    ///
    /// ```
    /// # use std::path::Path;
    /// # let text = "material.ice = { density = 917, youngs_modulus = 9.3e9, poissons_ratio = 0.33 }
    /// # [[body]]
    /// # name = 'floor'
    /// # wall = {}
    /// # [[body]]
    /// # name = 'ball'
    /// # sphere.diameter = 0.02
    /// # material = 'ice'
    /// # approach_speed = 0.1";
    /// # let case = fem_case::Case::parse("ball.toml", text, Path::new("."), &[])?;
    /// use fem::laws::{DemExport, ImpactCurve};
    /// use fem::measured::Restitutions;
    ///
    /// let ice = Restitutions::of("ice", &[(0.1, 0.6), (0.2, 0.6)]);
    /// let curve = ImpactCurve::measured(case.scene(), &ice)?;
    /// let export = DemExport::of(&case, curve, 0.01)?;
    /// assert!((export.export.hertz.restitution - 0.6).abs() < 1e-6);
    /// assert!(export.snippets()?.iter().any(|snippet| snippet.code == "LAMMPS"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn of(case: &Case, curve: ImpactCurve, tolerance: f64) -> Result<Self, FitError> {
        let scene = case.scene();
        // A restitution that is the same at all speeds does not depend on a stiffness.
        let timeless = |point: &Point| Point { contact_time: None, ..*point };
        let only_e: Vec<Point> = curve.points.iter().map(timeless).collect();
        let fitted = |name, family, points: &[Point], free: &[&str], end_rule| {
            let model = model_of(scene, family, end_rule)?;
            let values = Problem::new(&model, points, free)?.fit(CONFIDENCE)?.values;
            let validity = curve.validity(&model, &values, tolerance)?;
            Ok::<_, FitError>(FittedLaw { name, model, values, validity })
        };
        let (force, overlap) = (EndRule::ZeroForce, EndRule::ZeroOverlap);
        let constant = "one e for all speeds, Hertz";
        let constant = fitted(constant, Family::Tsuji, &only_e, &["alpha"], overlap)?;
        let viscoelastic = "viscoelastic (Kuwabara-Kono)";
        let viscoelastic = fitted(viscoelastic, Family::KuwabaraKono, &only_e, &["a"], force)?;
        let linear = fitted("linear", Family::Linear, &curve.points, &["k", "c"], overlap)?;
        let slowest = curve.speeds().0;
        let of_constant = constant.model.outcome(&constant.values, slowest)?;
        let of_linear = linear.model.outcome(&linear.values, slowest)?;
        let export = Export {
            title: scene.title().replace(char::is_control, " "),
            spheres: spheres(scene),
            pair: *constant.model.pair(),
            speeds: curve.speeds(),
            tolerance,
            hertz: Elastic { restitution: of_constant.restitution, validity: constant.validity },
            dissipation_time: (viscoelastic.values[0], viscoelastic.validity),
            linear: Dashpot {
                restitution: of_linear.restitution,
                contact_time: of_linear.contact_time.unwrap_or(f64::INFINITY),
                validity: linear.validity,
            },
        };
        Ok(Self { curve, export, laws: [constant, viscoelastic, linear] })
    }

    /// Input of LAMMPS, LIGGGHTS, YADE, Drake and MuJoCo.
    ///
    /// # Errors
    /// Numbers that a code's formula does not take.
    pub fn snippets(&self) -> Result<Vec<Snippet>, LawError> {
        let mut snippets = lammps_snippets(&self.export)?;
        snippets.extend(liggghts_snippets(&self.export)?);
        snippets.extend(yade_snippets(&self.export)?);
        snippets.extend(drake_snippets(&self.export));
        snippets.extend(mujoco_snippets(&self.export));
        Ok(snippets)
    }
}

/// The spheres of a scene: two, or one and a wall.
fn spheres(scene: &Scene) -> Vec<Sphere> {
    let sphere = |body: &Body| {
        let (diameter, material) = (body.diameter()?, body.material()?);
        Some(Sphere {
            diameter,
            density: material.density(),
            youngs_modulus: material.instantaneous().youngs_modulus(),
            poissons_ratio: material.instantaneous().poissons_ratio(),
        })
    };
    scene.bodies().iter().filter_map(sphere).collect()
}
