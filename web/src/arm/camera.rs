//! From where the arm is looked at: an eye that goes round it and nearer or farther, within limits, never below the floor.

use super::matrix::{Matrix, Vec3};
use serde::Deserialize;

/// What the eye goes round, m: the middle of what moves.
const TARGET: Vec3 = [0.12, 0.0, 0.42];
/// Half of what must be in view at zoom 1, m.
const HALF_HEIGHT: f32 = 0.47;
const HALF_WIDTH: f32 = 0.41;
/// Tangent of half the angle that the height spans: 28°, about a short telephoto lens.
const SLOPE: f32 = 0.249_328;
const PITCH_RAD: [f32; 2] = [0.03, 1.52];
const ZOOM: [f32; 2] = [0.5, 3.0];

/// Where the page put the eye: round the z axis from x, above the floor, and times nearer than everything in view.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Camera {
    pub yaw_rad: f32,
    pub pitch_rad: f32,
    pub zoom: f32,
}

/// A camera for a viewport.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Look {
    pub eye: Vec3,
    /// Of the picture, in space.
    pub right: Vec3,
    pub up: Vec3,
    /// From space to the picture.
    pub projection: Matrix,
}

impl Camera {
    /// For a viewport `aspect` times as wide as high. What is out of range is brought back: a picture cannot be refused.
    pub fn look(self, aspect: f32) -> Look {
        let (sin_yaw, cos_yaw) = self.yaw_rad.sin_cos();
        let (sin_pitch, cos_pitch) = self.pitch_rad.clamp(PITCH_RAD[0], PITCH_RAD[1]).sin_cos();
        let distance = HALF_HEIGHT.max(HALF_WIDTH / aspect) / SLOPE / self.zoom.clamp(ZOOM[0], ZOOM[1]);
        let towards = [cos_pitch * cos_yaw, cos_pitch * sin_yaw, sin_pitch];
        let eye = super::matrix::along(TARGET, distance, towards);
        let view = Matrix::look_at(eye, TARGET);
        let perspective = Matrix::perspective(SLOPE, aspect, 0.05 * distance, distance + 4.0);
        let row = |n: usize| [view.0[n], view.0[4 + n], view.0[8 + n]];
        Look { eye, right: row(0), up: row(1), projection: perspective.times(&view) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_arm_at_home_is_in_view_in_every_shape_from_every_side() {
        for aspect in [0.4, 0.9, 1.7, 3.0] {
            for step in 0..24 {
                let look = Camera { yaw_rad: step as f32, pitch_rad: 0.1 + 0.05 * step as f32, zoom: 1.0 }.look(aspect);
                for point in [[0.0, 0.0, 0.05], [0.0, 0.0, 0.635], [0.4, 0.0, 0.635]] {
                    let [x, y, _, w] = look.projection.apply(point);
                    assert!(w > 0.0 && x.abs() < w && y.abs() < w, "{point:?} is out of view at {aspect}, step {step}");
                }
            }
        }
    }

    #[test]
    fn what_is_right_and_up_is_so_in_the_picture() {
        let look = Camera { yaw_rad: 0.7, pitch_rad: 0.4, zoom: 1.0 }.look(1.3);
        for (axis, direction) in [look.right, look.up].into_iter().enumerate() {
            let moved = look.projection.apply(super::super::matrix::along(TARGET, 0.1, direction));
            assert!(moved[axis] > 0.05 && moved[1 - axis].abs() < 1e-4, "{moved:?}");
        }
    }

    #[test]
    fn nobody_gets_lost() {
        let lost = Camera { yaw_rad: 1e3, pitch_rad: -9.0, zoom: 1e9 }.look(1.0);
        assert!(lost.eye[2] > 0.0, "below the floor");
        assert!(lost.projection.0.iter().all(|number| number.is_finite()));
        let [x, y, _, w] = lost.projection.apply(TARGET);
        assert!(w > 0.5 && x.abs() < 0.1 * w && y.abs() < 0.1 * w);
    }
}
