//! The three computations in FLINT.

use flint3_sys as sys;
use secant::linalg::Matrix;
use std::ffi::CString;

/// A matrix of FLINT's rationals. It lives until the process ends.
pub struct RationalMatrix {
    inner: sys::fmpq_mat_struct,
    size: usize,
}

impl RationalMatrix {
    /// Converts a square matrix.
    pub fn new(a: &Matrix) -> Self {
        let n = a.rows();
        let mut inner = sys::fmpq_mat_struct::default();
        // SAFETY: the matrix is initialised with n x n entries before they are written, through valid C strings.
        unsafe {
            sys::fmpq_mat_init(&mut inner, n as sys::slong, n as sys::slong);
            for i in 0..n {
                for j in 0..n {
                    let text = CString::new(a[(i, j)].to_string()).expect("digits");
                    let entry = sys::fmpq_mat_entry(&inner, i as sys::slong, j as sys::slong);
                    assert_eq!(sys::fmpq_set_str(entry, text.as_ptr(), 10), 0);
                }
            }
        }
        Self { inner, size: n }
    }

    /// The characteristic polynomial.
    pub fn char_poly(&self) {
        let mut f = sys::fmpq_poly_struct::default();
        // SAFETY: the polynomial is initialised before and cleared after its use.
        unsafe {
            sys::fmpq_poly_init(&mut f);
            sys::fmpq_mat_charpoly(&mut f, &self.inner);
            sys::fmpq_poly_clear(&mut f);
        }
    }

    /// The Jordan form with its transformation.
    pub fn jordan_form(&self) {
        let n = self.size as sys::slong;
        // SAFETY: the context and the matrices are initialised before and cleared after their use.
        unsafe {
            let mut ctx = sys::ca_ctx_struct::default();
            sys::ca_ctx_init(&mut ctx);
            let mut matrices: [sys::ca_mat_struct; 3] = Default::default();
            for m in &mut matrices {
                sys::ca_mat_init(m, n, n, &mut ctx);
            }
            let [j, p, a] = &mut matrices;
            sys::ca_mat_set_fmpq_mat(a, &self.inner, &mut ctx);
            assert_eq!(sys::ca_mat_jordan_form(j, p, a, &mut ctx), 1, "FLINT found a Jordan form");
            for m in &mut matrices {
                sys::ca_mat_clear(m, &mut ctx);
            }
            sys::ca_ctx_clear(&mut ctx);
        }
    }

    /// All eigenvalues, and the exact comparison of the moduli of all pairs.
    pub fn modulus_classes(&self) {
        let n = self.size as sys::slong;
        // SAFETY: the vector has n initialised entries, all pointers stay inside it.
        unsafe {
            let values = sys::_qqbar_vec_init(n);
            sys::qqbar_eigenvalues_fmpq_mat(values, &self.inner, 0);
            for i in 0..self.size {
                for j in 0..i {
                    std::hint::black_box(sys::qqbar_cmpabs(values.add(i), values.add(j)));
                }
            }
            sys::_qqbar_vec_clear(values, n);
        }
    }
}
