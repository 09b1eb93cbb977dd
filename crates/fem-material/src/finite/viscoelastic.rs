//! A hyperelastic solid that relaxes: Maxwell branches parallel to an equilibrium spring.
//!
//! ```math
//! W = g_\infty W(F) + \sum_k g_k W(F F_{v,k}^{-1}), \qquad
//! \tau = \frac{\partial W}{\partial F} F^T, \qquad
//! D = \sum_k \frac1{\tau_k}\left[\tfrac12\, \mathrm{dev}\,\tau_k : \mathrm{dev}\,\bar b_{e,k}
//! + \tfrac13 \mathrm{tr}\,\tau_k\, (J_{e,k} - 1)\right]
//! ```
//!
//! Every branch has the law's own form, scaled by its weight, and its own metric C_v, which flows
//! as [`ViscousStep`] says. The stored energy W and the dissipated power D are functions of the
//! state, and W grows by the work of P less D.
//!
//! With [`ActsOn::All`] shape and volume flow with the same times, so that Poisson's ratio is constant. With
//! [`ActsOn::Shear`] only the shape flows. All laws are linear in K and G: the branches have the part of the law that
//! is proportional to G, and K stays elastic.
//!
//! D ≥ 0: of the shape since of τ and b the larger belongs to the larger (Baker & Ericksen's
//! inequalities, which hold wherever a law is elliptic); of the volume for neo-Hooke and Hencky,
//! whose pressure has the sign of J_e − 1. With ln J the sum is not negative. St Venant-Kirchhoff
//! keeps neither beyond its limits of stability, nor D ≥ 0 there.
//!
//! Limits: at small strain it is the Prony series, each term exact for a constant rate. At finite
//! strain relaxation in the long run is that of all branches flowing with constant times; the
//! viscosity of rubber that depends on the stress is not in it.

use super::branches::Branches;
use super::hyperelastic::{Hyperelastic, HyperelasticLaw, Inverted, upright};
use super::kinematics::{Strain, push_forward};
use super::number::{Number, inverse_cube_root_change};
use super::tensor::{AxisymmetricTensor, SymmetricTensor};
use super::viscous::{InverseMetric, ViscousStep, ViscousStrain};
use crate::prony::{ActsOn, PronySeries};

/// A hyperelastic solid that relaxes. Its history at a point is one [`ViscousStrain`] per term.
#[derive(Debug, Clone, PartialEq)]
pub struct Viscoelastic {
    equilibrium: Hyperelastic,
    branches: Vec<Branch>,
    volume_flows: bool,
    /// All branches at once, for lanes.
    together: Branches,
}

/// A Maxwell branch.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Branch {
    /// The law with the branch's moduli.
    solid: Hyperelastic,
    relaxation_time: f64,
}

impl Viscoelastic {
    /// Creates a viscoelastic solid with this instantaneous law.
    pub fn new(instantaneous: &Hyperelastic, relaxation: &PronySeries) -> Self {
        let equilibrium_weight = relaxation.equilibrium_weight();
        let volume_flows = relaxation.acts_on() == ActsOn::All;
        let (of_bulk, lasting_bulk) =
            if volume_flows { (1.0, equilibrium_weight) } else { (0.0, 1.0) };
        let weights: Vec<f64> = relaxation.terms().iter().map(|term| term.weight).collect();
        let branches = relaxation.terms().iter().map(|term| Branch {
            solid: instantaneous.scaled(of_bulk * term.weight, term.weight),
            relaxation_time: term.relaxation_time,
        });
        let together = Branches {
            law: instantaneous.law(),
            bulk: instantaneous.bulk_modulus(),
            shear: instantaneous.shear_modulus(),
            equilibrium_weight,
            weights,
            volume_flows,
        };
        Self {
            equilibrium: instantaneous.scaled(lasting_bulk, equilibrium_weight),
            branches: branches.collect(),
            volume_flows,
            together,
        }
    }

    /// Returns the law that all branches have.
    pub fn law(&self) -> HyperelasticLaw {
        self.equilibrium.law()
    }

    /// Returns all branches at once, for the stress on lanes.
    pub fn branches(&self) -> &Branches {
        &self.together
    }

    /// Returns the number of entries in the history of a point.
    pub fn n_terms(&self) -> usize {
        self.branches.len()
    }

    /// Creates the update of histories over a time step, s.
    pub fn step(&self, time_step: f64) -> ViscousStep {
        let times = self.branches.iter().map(|branch| branch.relaxation_time);
        ViscousStep::new(times, self.volume_flows, time_step)
    }

    /// Returns the stored energy per undeformed volume W, J/m³.
    ///
    /// # Errors
    /// det F is not positive.
    pub fn energy(
        &self,
        h: &AxisymmetricTensor,
        history: &[ViscousStrain],
    ) -> Result<f64, Inverted> {
        upright(h)?;
        Ok(self.energy_and_dissipation_rate(h, history).0)
    }

    /// Returns the first Piola-Kirchhoff stress, Pa.
    ///
    /// # Errors
    /// det F is not positive.
    #[inline]
    pub fn first_piola(
        &self,
        h: &AxisymmetricTensor,
        history: &[ViscousStrain],
    ) -> Result<AxisymmetricTensor, Inverted> {
        upright(h)?;
        Ok(self.together.first_piola(h, inverse_metrics(history)).0)
    }

    /// Returns the Cauchy stress, Pa.
    ///
    /// # Errors
    /// det F is not positive.
    pub fn cauchy(
        &self,
        h: &AxisymmetricTensor,
        history: &[ViscousStrain],
    ) -> Result<SymmetricTensor, Inverted> {
        let strain = upright(h)?;
        let stress = self.together.kirchhoff(h, &strain, inverse_metrics(history));
        Ok(stress.times(1.0 / (1.0 + strain.volume_change)))
    }

    /// Returns the stored energy (J/m³) and the dissipated power (W/m³), on one number or on lanes. They are valid
    /// where J − 1 > −1.
    #[inline(always)]
    pub fn energy_and_dissipation_rate<N: Number>(
        &self,
        h: &AxisymmetricTensor<N>,
        history: &[ViscousStrain<N>],
    ) -> (N, N) {
        let strain = Strain::of(h);
        let one = N::splat(1.0);
        let (mut energy, mut rate) = (self.equilibrium.energy_of(&strain), N::splat(0.0));
        for (branch, viscous) in self.branches.iter().zip(history) {
            let elastic = self.elastic_strain(h, &strain, viscous);
            energy = energy + branch.solid.energy_of(&elastic);
            let stress = branch.solid.kirchhoff(&elastic);
            let z = inverse_cube_root_change(elastic.volume_change);
            let unimodular = (one + z) * (one + z);
            let mut dissipated =
                N::splat(0.5) * (unimodular * deviatoric_dot(&stress, &elastic.left));
            if self.volume_flows {
                let volume = stress.trace() * elastic.volume_change;
                dissipated = dissipated.plus_product(N::splat(1.0 / 3.0), volume);
            }
            rate = rate.plus_product(N::splat(branch.relaxation_time.recip()), dissipated);
        }
        (energy, rate)
    }

    /// Returns A = ∂P/∂F at a fixed history, Pa, for the components rr, ry, yr, yy, tt: the stiffness for changes that
    /// are short compared with the relaxation times.
    ///
    /// # Errors
    /// det F is not positive.
    pub fn tangent(
        &self,
        h: &AxisymmetricTensor,
        history: &[ViscousStrain],
    ) -> Result<[[f64; 5]; 5], Inverted> {
        let mut sum = self.equilibrium.tangent(h)?;
        for (branch, viscous) in self.branches.iter().zip(history) {
            let inverse = viscous.inverse_stretch();
            let elastic = branch.solid.tangent(&elastic_gradient(h, &inverse))?;
            add_elastic_tangent(&mut sum, &elastic, &inverse);
        }
        Ok(sum)
    }

    /// Returns an upper bound of the largest eigenvalue of ∂P/∂F at a fixed history, exact to 2.6 %, Pa.
    ///
    /// # Errors
    /// det F is not positive.
    pub fn largest_stiffness(
        &self,
        h: &AxisymmetricTensor,
        history: &[ViscousStrain],
    ) -> Result<f64, Inverted> {
        Ok(largest_eigenvalue(self.tangent(h, history)?))
    }

    /// Returns b_e − 1 and J_e − 1 of the elastic part of a branch: b_e = J_v^{−2/3} F C̄_v⁻¹ Fᵀ.
    #[inline(always)]
    fn elastic_strain<N: Number>(
        &self,
        h: &AxisymmetricTensor<N>,
        strain: &Strain<N>,
        viscous: &ViscousStrain<N>,
    ) -> Strain<N> {
        let (inverse, _) = viscous.inverse();
        let left = strain.left.plus(&push_forward(&inverse, h));
        if !self.volume_flows {
            return Strain { left, volume_change: strain.volume_change };
        }
        let z = inverse_cube_root_change(viscous.volume_change);
        let change = z + z + z * z;
        // 1/J_v = (1 + z)³.
        let inverse_volume = (N::splat(1.0) + z) * (N::splat(1.0) + change);
        Strain {
            left: left.rescaled(change),
            volume_change: (strain.volume_change - viscous.volume_change) * inverse_volume,
        }
    }
}

/// Returns the inverse metric of each term.
fn inverse_metrics(history: &[ViscousStrain]) -> impl Iterator<Item = InverseMetric> {
    history.iter().map(ViscousStrain::inverse_metric)
}

/// Returns dev A : dev B.
#[inline(always)]
fn deviatoric_dot<N: Number>(a: &SymmetricTensor<N>, b: &SymmetricTensor<N>) -> N {
    let mean = b.trace() * N::splat(1.0 / 3.0);
    let deviator = SymmetricTensor { rr: b.rr - mean, yy: b.yy - mean, tt: b.tt - mean, ry: b.ry };
    a.dot(&deviator)
}

/// Returns F_e − 1 for F_e = F U_v⁻¹.
fn elastic_gradient(h: &AxisymmetricTensor, inverse: &SymmetricTensor) -> AxisymmetricTensor {
    let (f_rr, f_yy) = (1.0 + h.rr, 1.0 + h.yy);
    AxisymmetricTensor {
        rr: f_rr * inverse.rr + h.ry * inverse.ry - 1.0,
        ry: f_rr * inverse.ry + h.ry * inverse.yy,
        yr: h.yr * inverse.rr + f_yy * inverse.ry,
        yy: h.yr * inverse.ry + f_yy * inverse.yy - 1.0,
        tt: (1.0 + h.tt) * inverse.tt - 1.0,
    }
}

/// Adds T A_e Tᵀ, with δF_e = Tᵀ δF = δF U_v⁻¹.
fn add_elastic_tangent(
    sum: &mut [[f64; 5]; 5],
    elastic: &[[f64; 5]; 5],
    inverse: &SymmetricTensor,
) {
    let SymmetricTensor { rr, yy, tt, ry } = *inverse;
    let t = [
        [rr, ry, 0.0, 0.0, 0.0],
        [ry, yy, 0.0, 0.0, 0.0],
        [0.0, 0.0, rr, ry, 0.0],
        [0.0, 0.0, ry, yy, 0.0],
        [0.0, 0.0, 0.0, 0.0, tt],
    ];
    for k in 0..5 {
        for l in 0..5 {
            let pairs = (0..5).flat_map(|m| (0..5).map(move |n| (m, n)));
            sum[k][l] += pairs.map(|(m, n)| t[k][m] * elastic[m][n] * t[l][n]).sum::<f64>();
        }
    }
}

/// Returns an upper bound of the largest eigenvalue of a symmetric matrix, (tr A⁶⁴)^(1/64), too large by a factor of
/// at most 5^(1/64).
fn largest_eigenvalue(matrix: [[f64; 5]; 5]) -> f64 {
    let size = matrix.iter().flatten().fold(0.0f64, |largest, x| largest.max(x.abs()));
    if size == 0.0 {
        return 0.0;
    }
    let mut power = matrix.map(|row| row.map(|x| x / size));
    for _ in 0..6 {
        power = std::array::from_fn(|k| {
            std::array::from_fn(|l| (0..5).map(|m| power[k][m] * power[m][l]).sum())
        });
    }
    let mut root: f64 = (0..5).map(|k| power[k][k]).sum();
    for _ in 0..6 {
        root = root.sqrt();
    }
    size * root
}
