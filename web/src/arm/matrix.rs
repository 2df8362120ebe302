//! Four by four matrices as shaders take them: single precision, column by column.

use std::array::from_fn;

/// A vector.
pub(crate) type Vec3 = [f32; 3];

/// A matrix, column by column.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Matrix(pub [f32; 16]);

impl Matrix {
    pub const IDENTITY: Self = Self([1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1.]);

    /// Takes a frame's own coordinates to those that `origin` and the three axes are given in.
    pub fn frame(origin: Vec3, [x, y, z]: [Vec3; 3]) -> Self {
        let mut columns = Self::IDENTITY.0;
        for (column, axis) in [x, y, z, origin].iter().enumerate() {
            columns[4 * column..4 * column + 3].copy_from_slice(axis);
        }
        Self(columns)
    }

    /// `self` after `other`.
    pub fn times(&self, other: &Self) -> Self {
        Self(from_fn(|at| (0..4).map(|k| self.0[4 * k + at % 4] * other.0[4 * (at / 4) + k]).sum()))
    }

    /// The view of an eye at `eye` that looks at `target`; z is up.
    pub fn look_at(eye: Vec3, target: Vec3) -> Self {
        let back = unit(subtract(eye, target));
        let right = unit(cross([0.0, 0.0, 1.0], back));
        let up = cross(back, right);
        let rows = [right, up, back];
        let mut columns = Self::IDENTITY.0;
        for (row, axis) in rows.iter().enumerate() {
            for (column, component) in axis.iter().enumerate() {
                columns[4 * column + row] = *component;
            }
            columns[12 + row] = -dot(*axis, eye);
        }
        Self(columns)
    }

    /// Perspective with `slope` = tan of half the angle that the height spans.
    pub fn perspective(slope: f32, aspect: f32, near: f32, far: f32) -> Self {
        let mut columns = [0.0; 16];
        columns[0] = 1.0 / (slope * aspect);
        columns[5] = 1.0 / slope;
        columns[10] = -(far + near) / (far - near);
        columns[11] = -1.0;
        columns[14] = -2.0 * far * near / (far - near);
        Self(columns)
    }

    /// A point in homogeneous coordinates.
    #[cfg(test)]
    pub fn apply(&self, [x, y, z]: Vec3) -> [f32; 4] {
        from_fn(|row| self.0[row] * x + self.0[4 + row] * y + self.0[8 + row] * z + self.0[12 + row])
    }
}

pub(crate) fn subtract(a: Vec3, b: Vec3) -> Vec3 {
    from_fn(|n| a[n] - b[n])
}

/// `a + k b`.
pub(crate) fn along(a: Vec3, k: f32, b: Vec3) -> Vec3 {
    from_fn(|n| a[n] + k * b[n])
}

pub(crate) fn dot(a: Vec3, b: Vec3) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn cross(a: Vec3, b: Vec3) -> Vec3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(crate) fn unit(a: Vec3) -> Vec3 {
    let length = dot(a, a).sqrt();
    a.map(|component| component / length)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_looked_at_is_in_the_middle_and_up_is_up() {
        let view = Matrix::look_at([2.0, -1.0, 1.5], [0.1, 0.2, 0.4]);
        let whole = Matrix::perspective(0.25, 2.0, 0.1, 10.0).times(&view);
        let project = |point| {
            let [x, y, z, w] = whole.apply(point);
            [x / w, y / w, z / w]
        };
        let [x, y, depth] = project([0.1, 0.2, 0.4]);
        assert!(x.abs() < 1e-5 && y.abs() < 1e-5 && (-1.0..1.0).contains(&depth));
        assert!(project([0.1, 0.2, 0.5])[1] > 0.05, "z is not up");
        assert!(project([0.2, 0.2, 0.4])[0] > 0.0, "x is not to the right of an eye on the other side of y");
    }

    #[test]
    fn a_frame_takes_its_origin_and_axes_where_they_are() {
        let frame = Matrix::frame([1.0, 2.0, 3.0], [[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]);
        assert_eq!(frame.apply([0.0; 3]), [1.0, 2.0, 3.0, 1.0]);
        assert_eq!(frame.apply([1.0, 0.0, 0.0]), [1.0, 3.0, 3.0, 1.0]);
        assert_eq!(Matrix::IDENTITY.times(&frame), frame);
    }
}
