//! The stiffness matrix of an element in two parts, one a modulus.

use nalgebra::SMatrix;

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
