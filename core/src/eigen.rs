//! Eigenvalues and eigenvectors of a symmetric matrix by Jacobi's rotations: slow, exact to rounding, and the same bits
//! everywhere.

/// Sweeps after which any matrix of doubles is diagonal.
const SWEEPS: usize = 30;

/// `A = B diag(d) Bᵀ` of a symmetric n×n matrix given by rows: `(d, B)`, eigenvectors in the columns of B.
pub(crate) fn symmetric_eigen(a: &[f64], n: usize) -> (Vec<f64>, Vec<f64>) {
    let mut a = a.to_vec();
    let mut b = vec![0.0; n * n];
    for i in 0..n {
        b[i * n + i] = 1.0;
    }
    for _ in 0..SWEEPS {
        let mut off = 0.0;
        for i in 0..n {
            for j in 0..i {
                off += a[i * n + j] * a[i * n + j];
            }
        }
        let on: f64 = (0..n).map(|i| a[i * n + i] * a[i * n + i]).sum();
        if off <= 1e-32 * on {
            break;
        }
        for p in 0..n {
            for q in p + 1..n {
                rotate(&mut a, &mut b, n, p, q);
            }
        }
    }
    ((0..n).map(|i| a[i * n + i]).collect(), b)
}

/// One rotation, which makes `a[p][q]` zero.
fn rotate(a: &mut [f64], b: &mut [f64], n: usize, p: usize, q: usize) {
    let apq = a[p * n + q];
    if apq == 0.0 {
        return;
    }
    let theta = (a[q * n + q] - a[p * n + p]) / (2.0 * apq);
    let t = theta.signum() / (theta.abs() + (theta * theta + 1.0).sqrt());
    let c = 1.0 / (t * t + 1.0).sqrt();
    let s = t * c;
    for k in 0..n {
        let (x, y) = (a[k * n + p], a[k * n + q]);
        (a[k * n + p], a[k * n + q]) = (c * x - s * y, s * x + c * y);
    }
    for k in 0..n {
        let (x, y) = (a[p * n + k], a[q * n + k]);
        (a[p * n + k], a[q * n + k]) = (c * x - s * y, s * x + c * y);
    }
    for k in 0..n {
        let (x, y) = (b[k * n + p], b[k * n + q]);
        (b[k * n + p], b[k * n + q]) = (c * x - s * y, s * x + c * y);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_symmetric_matrix_is_its_eigenvectors_and_values(n in 1_usize..9, numbers in prop::collection::vec(-9.0..9.0, 81)) {
            let mut a = vec![0.0; n * n];
            for i in 0..n {
                for j in 0..n {
                    a[i * n + j] = numbers[i.max(j) * 9 + i.min(j)];
                }
            }
            let (d, b) = symmetric_eigen(&a, n);
            for i in 0..n {
                for j in 0..n {
                    let again: f64 = (0..n).map(|k| b[i * n + k] * d[k] * b[j * n + k]).sum();
                    let unit: f64 = (0..n).map(|k| b[k * n + i] * b[k * n + j]).sum();
                    prop_assert!((again - a[i * n + j]).abs() < 1e-12 * 100.0);
                    prop_assert!((unit - f64::from(u8::from(i == j))).abs() < 1e-12);
                }
            }
        }
    }
}
