//! Solids as triangles: bodies of revolution and tapered links with rounded edges, each vertex with its normal, the part of
//! the arm that it moves with, and its material.

use super::matrix::{Vec3, along, cross, dot, subtract, unit};
use std::f32::consts::TAU;

/// Numbers per vertex: position, normal, part, material.
pub(crate) const VERTEX: usize = 8;
/// Corners of a circle of this radius, m: as many as the eye misses not.
fn corners(radius: f32) -> usize {
    ((8.0 + 320.0 * radius) as usize).clamp(10, 44) / 2 * 2
}

/// Triangles of one or more solids.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Mesh {
    pub vertices: Vec<f32>,
    pub indices: Vec<u16>,
}

/// Where a solid stands in its part: an origin and three axes at right angles.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Place {
    pub origin: Vec3,
    pub axes: [Vec3; 3],
}

/// What a solid belongs to and looks like.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Kind {
    pub part: u8,
    pub material: u8,
}

const X: Vec3 = [1.0, 0.0, 0.0];
const Y: Vec3 = [0.0, 1.0, 0.0];
const Z: Vec3 = [0.0, 0.0, 1.0];

impl Place {
    /// Axis of revolution along the part's x, y or z.
    pub const fn along_x(origin: Vec3) -> Self {
        Self { origin, axes: [Y, Z, X] }
    }
    pub const fn along_y(origin: Vec3) -> Self {
        Self { origin, axes: [Z, X, Y] }
    }
    pub const fn along_z(origin: Vec3) -> Self {
        Self { origin, axes: [X, Y, Z] }
    }

    fn point(&self, [x, y, z]: Vec3) -> Vec3 {
        along(along(along(self.origin, x, self.axes[0]), y, self.axes[1]), z, self.axes[2])
    }

    fn direction(&self, [x, y, z]: Vec3) -> Vec3 {
        along(along(along([0.0; 3], x, self.axes[0]), y, self.axes[1]), z, self.axes[2])
    }
}

impl Mesh {
    /// Turns a profile of `(height, radius)`, lowest first, about the place's third axis; each stretch has its own normals.
    pub fn lathe(&mut self, place: Place, kind: Kind, profile: &[[f32; 2]]) {
        debug_assert!(profile.windows(2).all(|pair| pair[0][0] <= pair[1][0]), "a profile starts at its lowest");
        let round = corners(profile.iter().map(|[_, radius]| *radius).fold(0.0, f32::max));
        for pair in profile.windows(2) {
            let [[z0, r0], [z1, r1]] = [pair[0], pair[1]];
            let normal = unit([z1 - z0, 0.0, r0 - r1]);
            let ring = |step: usize, z: f32, r: f32| {
                let (sin, cos) = (TAU / round as f32 * (step % round) as f32).sin_cos();
                (place.point([r * cos, r * sin, z]), place.direction([normal[0] * cos, normal[0] * sin, normal[2]]))
            };
            self.strip(kind, (0..=round).map(|step| [ring(step, z0, r0), ring(step, z1, r1)]));
        }
    }

    /// A cylinder between two heights along the place's third axis, with its edges taken off.
    pub fn cylinder(&mut self, place: Place, kind: Kind, radius: f32, [low, high]: [f32; 2], bevel: f32) {
        let inner = radius - bevel;
        let profile =
            [[low, 0.0], [low, inner], [low + bevel, radius], [high - bevel, radius], [high, inner], [high, 0.0]];
        self.lathe(place, kind, &profile);
    }

    /// A ball.
    pub fn ball(&mut self, place: Place, kind: Kind, radius: f32) {
        let profile: Vec<_> = (0..=8)
            .map(|step| {
                let (sin, cos) = (TAU / 16.0 * step as f32).sin_cos();
                [-radius * cos, radius * sin]
            })
            .collect();
        self.lathe(place, kind, &profile);
    }

    /// A link: what a band round two circles spans, as thick as `[low, high]` along the part's y, with its edges taken off.
    /// Circles are at `from` (x, z) and `length` farther along `axis` (0: x, 2: z).
    pub fn link(&mut self, kind: Kind, shape: &Link) {
        let Link { from, upright, length, radii, thickness: [low, high], bevel } = *shape;
        let turn = ((radii[0] - radii[1]) / length).acos();
        let half = corners(radii[0]) / 4 * 2;
        // Round the first circle where the band lies on it, then round the second, then back to the start.
        let first = (0..=half).map(|n| (turn + (TAU - 2.0 * turn) * n as f32 / half as f32, 0));
        let second = (0..=half).map(|n| (turn * (2.0 * n as f32 / half as f32 - 1.0), 1));
        let outline: Vec<_> = first.chain(second).chain([(turn, 0)]).collect();
        let place = |along: f32, across: f32| if upright { [-across, along] } else { [along, across] };
        let at = |(angle, circle): (f32, usize), inset: f32, y: f32, lean: f32| {
            let (sin, cos) = angle.sin_cos();
            let radius = radii[circle] - inset;
            let [x, z] = place(length * circle as f32 + radius * cos, radius * sin);
            let [nx, nz] = place(cos, sin);
            ([from[0] + x, y, from[1] + z], unit([nx, lean, nz]))
        };
        let (inner_low, inner_high) = (low + bevel, high - bevel);
        self.strip(kind, outline.iter().map(|&c| [at(c, bevel, low, -1.0), at(c, 0.0, inner_low, -1.0)]));
        self.strip(kind, outline.iter().map(|&c| [at(c, 0.0, inner_low, 0.0), at(c, 0.0, inner_high, 0.0)]));
        self.strip(kind, outline.iter().map(|&c| [at(c, 0.0, inner_high, 1.0), at(c, bevel, high, 1.0)]));
        // Flat sides as bands across, from the first circle's far end to the second's: a fan would have slivers.
        let across = (0..=half / 2).rev().map(|n| [outline[n], outline[half - n]]);
        let across = across.chain((0..=half / 2).map(|n| [outline[2 * half + 1 - n], outline[half + 1 + n]]));
        for (y, lean) in [(low, -1.0), (high, 1.0)] {
            let flat = |c| (at(c, bevel, y, lean).0, [0.0, lean, 0.0]);
            self.strip(kind, across.clone().map(|pair| pair.map(flat)));
        }
    }

    /// A band of triangles between pairs of (position, normal), each counter-clockwise for those who see its front.
    fn strip(&mut self, kind: Kind, pairs: impl Iterator<Item = [(Vec3, Vec3); 2]>) {
        let start = (self.vertices.len() / VERTEX) as u16;
        let mut count = 0;
        for (position, normal) in pairs.flatten() {
            self.vertices.extend(position);
            self.vertices.extend(normal);
            self.vertices.extend([f32::from(kind.part), f32::from(kind.material)]);
            count += 1;
        }
        for n in (start..start + count).step_by(2).take(usize::from(count / 2).saturating_sub(1)) {
            for [a, b, c] in [[n, n + 1, n + 2], [n + 2, n + 1, n + 3]] {
                self.indices.extend(if self.is_front(a, b, c) { [a, b, c] } else { [a, c, b] });
            }
        }
    }

    /// Whether a triangle runs counter-clockwise where its first and last corners' normals point.
    fn is_front(&self, a: u16, b: u16, c: u16) -> bool {
        let at = |index: u16, from: usize| -> Vec3 {
            let start = usize::from(index) * VERTEX + from;
            [self.vertices[start], self.vertices[start + 1], self.vertices[start + 2]]
        };
        let face = cross(subtract(at(b, 0), at(a, 0)), subtract(at(c, 0), at(a, 0)));
        dot(face, at(a, 3)) + dot(face, at(b, 3)) + dot(face, at(c, 3)) > 0.0
    }
}

/// Shape of a link.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Link {
    /// Centre of the first circle, x and z.
    pub from: [f32; 2],
    /// Along z instead of x.
    pub upright: bool,
    pub length: f32,
    pub radii: [f32; 2],
    pub thickness: [f32; 2],
    pub bevel: f32,
}

#[cfg(test)]
mod tests {
    use super::*;

    const KIND: Kind = Kind { part: 1, material: 2 };

    /// Volume that the triangles enclose; only right if the solid is closed and every triangle's front is outside.
    fn volume(mesh: &Mesh) -> f32 {
        let corner = |index: u16| -> Vec3 {
            let at = usize::from(index) * VERTEX;
            [mesh.vertices[at], mesh.vertices[at + 1], mesh.vertices[at + 2]]
        };
        let triangles = mesh.indices.chunks_exact(3);
        let six = triangles.map(|t| {
            let [a, b, c] = [0, 1, 2].map(|n| corner(t[n]));
            dot(a, cross(subtract(b, a), subtract(c, a)))
        });
        six.sum::<f32>() / 6.0
    }

    #[test]
    fn solids_are_closed_and_their_normals_point_outwards() {
        let mut mesh = Mesh::default();
        mesh.cylinder(Place::along_x([0.3, -0.2, 0.5]), KIND, 0.1, [0.0, 0.2], 0.0005);
        let expected = TAU / 2.0 * 0.01 * 0.2;
        assert!((volume(&mesh) / expected - 1.0).abs() < 0.02, "cylinder {} {expected}", volume(&mesh));

        let mut mesh = Mesh::default();
        mesh.ball(Place::along_z([0.1, 0.0, 0.0]), KIND, 0.1);
        let expected = TAU * 2.0 / 3.0 * 1e-3;
        assert!((volume(&mesh) / expected - 1.0).abs() < 0.05, "ball {} {expected}", volume(&mesh));

        for upright in [false, true] {
            let mut mesh = Mesh::default();
            let radii = [0.1, 0.1];
            let link = Link { from: [0.2, 0.1], upright, length: 0.3, radii, thickness: [-0.05, 0.02], bevel: 0.0005 };
            mesh.link(KIND, &link);
            let expected = (0.3 * 0.2 + TAU / 2.0 * 0.01) * 0.07;
            assert!((volume(&mesh) / expected - 1.0).abs() < 0.02, "link {} {expected}", volume(&mesh));
        }
    }

    #[test]
    fn normals_are_units_and_indices_exist() {
        let mut mesh = Mesh::default();
        let link = Link {
            from: [0.0, 0.0],
            upright: false,
            length: 0.3,
            radii: [0.1, 0.05],
            thickness: [0.0, 0.1],
            bevel: 0.01,
        };
        mesh.link(KIND, &link);
        mesh.ball(Place::along_y([0.0; 3]), KIND, 0.1);
        for vertex in mesh.vertices.chunks_exact(VERTEX) {
            let normal = [vertex[3], vertex[4], vertex[5]];
            assert!((dot(normal, normal) - 1.0).abs() < 1e-5, "{normal:?}");
            assert_eq!(vertex[6..], [1.0, 2.0]);
        }
        assert!(mesh.indices.iter().all(|&index| usize::from(index) < mesh.vertices.len() / VERTEX));
    }
}
