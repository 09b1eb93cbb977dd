//! A case with the model that computes it, whichever that is.

use fem_case::{Case, CaseError, CaseFile};
use fem_collision::{Collision, Monitor, Phase, SnapshotRequest, Want};

use crate::method::{Method, Model, Setup, Shared};
use crate::models::method_of;

/// The collision of a case, by the model that it asks for.
///
/// # Errors
/// What the model refuses, at its place in the case.
///
/// ```
/// use fem::schema::{BodyTable, MaterialTable, ModelTable};
/// use fem::{Case, CaseFile};
///
/// let steel = MaterialTable::from_youngs_modulus_poissons_ratio("7850 kg/m^3", "210 GPa", 0.3);
/// let ball = BodyTable::sphere("ball", "1 cm", "steel").approaching("1 m/s");
/// let case = Case::of(
///     CaseFile::of_bodies(ball, BodyTable::wall("floor"))
///         .with_material("steel", steel)
///         .with_model(ModelTable::hertz()),
/// )?;
/// let collision = fem::collide(&case)?;
/// assert_eq!(collision.restitution, Some(1.0));
/// // T = 2.943 δ / v with the largest approach δ = (15 m v² / (16 E* √R))^(2/5), at 1 m/s.
/// let (mass, modulus, radius) = (4.110e-3, 230.8e9, 5e-3_f64);
/// let hertz = 2.943 * (15.0 * mass / (16.0 * modulus * radius.sqrt())).powf(0.4);
/// assert!((collision.contact_time.unwrap() / hertz - 1.0).abs() < 1e-3);
/// # Ok::<(), fem::CaseError>(())
/// ```
pub fn collide(case: &Case) -> Result<Collision, CaseError> {
    Ok(Simulation::new(case.clone())?.run(&mut ()))
}

/// A case that is ready to run.
#[derive(Debug)]
pub struct Simulation {
    /// The case.
    pub case: Case,
    /// What computes it.
    pub model: Box<dyn Model>,
    /// What the run is asked for.
    pub want: Want,
    resolved: CaseFile,
}

impl Simulation {
    /// Builds the model that the case asks for.
    ///
    /// # Errors
    /// What the model refuses, at its place in the case.
    pub fn new(case: Case) -> Result<Self, CaseError> {
        Self::sharing(case, &Shared::default())
    }

    /// Builds the model that the case asks for; what other cases have made already is taken from
    /// `shared`.
    ///
    /// # Errors
    /// As [`Simulation::new`].
    pub fn sharing(case: Case, shared: &Shared) -> Result<Self, CaseError> {
        let method = method_of(case.scene());
        let model = method.build(case.scene(), shared).map_err(|refusal| refusal.in_case(&case))?;
        let resolved = resolve(method, &case)?;
        let want = model.setup().want.clone();
        Ok(Self { case, model, want, resolved })
    }

    /// The case with every default filled in, without the cost of building its model.
    ///
    /// # Errors
    /// What the method refuses before it makes anything.
    pub fn resolve(case: &Case) -> Result<CaseFile, CaseError> {
        resolve(method_of(case.scene()), case)
    }

    /// Element updates to come; see [`Method::price`].
    ///
    /// # Errors
    /// As [`Method::price`].
    pub fn price(case: &Case) -> Result<u64, CaseError> {
        method_of(case.scene()).price(case.scene()).map_err(|refusal| refusal.in_case(case))
    }

    /// What was decided.
    pub fn setup(&self) -> &Setup {
        self.model.setup()
    }

    /// The case with every default filled in: it runs again to the same bits.
    pub fn resolved(&self) -> &CaseFile {
        &self.resolved
    }

    /// Makes the run compute no fields to draw, nor warn of those that could not be had. All else
    /// keeps its bits, the resolved case too.
    pub fn skip_snapshots(&mut self) {
        self.want.snapshots = SnapshotRequest::none();
    }

    /// Computes the collision.
    pub fn run(&mut self, monitor: &mut dyn Monitor) -> Collision {
        monitor.enter(Phase::Collision);
        let approach = self.model.setup().approach;
        self.model.collide(&approach, &self.want, monitor)
    }
}

fn resolve(method: &dyn Method, case: &Case) -> Result<CaseFile, CaseError> {
    method.resolve(case.scene(), case.file().clone()).map_err(|refusal| refusal.in_case(case))
}
