//! The stiffness matrix of an element in two parts, one a modulus, and that of a fully integrated element, the reference of tests.

use nalgebra::SMatrix;

use crate::geometry::{QuadGeometry, QuadraturePoint, quadrature};

/// Matrix of an element, 8 × 8.
pub type ElementMatrix = SMatrix<f64, 8, 8>;

/// Stiffness of an element for unit moduli, in m: the stiffness is
/// `bulk_modulus * bulk + shear_modulus * deviatoric`, in N/m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ElementStiffness {
    /// Stiffness for unit bulk modulus.
    pub bulk: ElementMatrix,
    /// Stiffness for unit shear modulus, hourglass stiffness included.
    pub deviatoric: ElementMatrix,
}

impl ElementStiffness {
    /// Returns the stiffness for the given moduli (Pa), N/m.
    #[inline]
    pub fn combine(&self, bulk_modulus: f64, shear_modulus: f64) -> ElementMatrix {
        self.bulk * bulk_modulus + self.deviatoric * shear_modulus
    }
}

/// Returns the element matrices of the B-bar element: the dilatation is the element's mean,
/// the deviatoric strain is integrated with 2 × 2 Gauss points.
pub fn b_bar(corners: &[[f64; 2]; 4]) -> ElementStiffness {
    let geometry = QuadGeometry::new(corners);
    let mean = geometry.dilatation();
    let bulk = mean * mean.transpose() * geometry.volume;
    let mut deviatoric = ElementMatrix::zeros();
    for p in quadrature(corners) {
        for i in 0..8 {
            for j in 0..8 {
                let (e, f) = (unit_strain(&p, i), unit_strain(&p, j));
                let trace = (e[0] + e[1] + e[2]) * (f[0] + f[1] + f[2]);
                let product = e[0] * f[0] + e[1] * f[1] + e[2] * f[2];
                deviatoric[(i, j)] += p.weight * (2.0 * (product - trace / 3.0) + e[3] * f[3]);
            }
        }
    }
    ElementStiffness { bulk, deviatoric }
}

/// Returns the strain at a point due to a unit displacement of degree of freedom i.
fn unit_strain(p: &QuadraturePoint, i: usize) -> [f64; 4] {
    let a = i / 2;
    if i.is_multiple_of(2) {
        [p.gradient_r[a], 0.0, p.shape[a] / p.radius, p.gradient_y[a]]
    } else {
        [0.0, p.gradient_y[a], 0.0, p.gradient_r[a]]
    }
}
