//! The arm's solids, after the CRS A465: the links have their true lengths, everything else is made to look like it.
//!
//! Four parts move: base, waist, upper arm, forearm with the fixed wrist. Part coordinates: base and waist as the world at
//! q1 = 0; upper arm and forearm with x along the link from its joint, y along the joint's axis.

use super::matrix::{Matrix, Vec3, cross, subtract, unit};
use super::mesh::{Kind, Link, Mesh, Place};
use adaptarm_core::robots::{ArmPoints, Point};

/// Number of parts.
pub(crate) const PARTS: usize = 4;

/// Materials, in the order of the shader's colours.
const METAL: u8 = 0;
const PAINT: u8 = 1;
const SIGNAL: u8 = 2;

const fn kind(part: u8, material: u8) -> Kind {
    Kind { part, material }
}

/// All solids for an arm with these link lengths, m; and how many indices the base has, which come first.
pub(crate) fn solids(lengths_m: [f64; 4]) -> (Mesh, usize) {
    let [height, upper, fore, flange] = lengths_m.map(|length| length as f32);
    let mut mesh = Mesh::default();
    base(&mut mesh);
    let still = mesh.indices.len();
    waist(&mut mesh, height);
    upper_arm(&mut mesh, upper);
    forearm(&mut mesh, fore, flange);
    (mesh, still)
}

fn base(mesh: &mut Mesh) {
    let place = Place::along_z([0.0; 3]);
    let foot = [
        [0.0, 0.0],
        [0.0, 0.128],
        [0.004, 0.132],
        [0.020, 0.132],
        [0.026, 0.124],
        [0.030, 0.100],
        [0.046, 0.086],
        [0.150, 0.080],
        [0.154, 0.076],
        [0.154, 0.0],
    ];
    mesh.lathe(place, kind(0, METAL), &foot);
    for step in 0..4 {
        let (sin, cos) = (std::f32::consts::FRAC_PI_4 * (2 * step + 1) as f32).sin_cos();
        let bolt = Place::along_z([0.114 * cos, 0.114 * sin, 0.0]);
        mesh.lathe(bolt, kind(0, PAINT), &[[0.02, 0.009], [0.031, 0.009], [0.031, 0.0]]);
    }
}

/// The turret that turns on the base, up to the shoulder's hub between the upper arm's plates.
fn waist(mesh: &mut Mesh, height: f32) {
    let place = Place::along_z([0.0; 3]);
    mesh.cylinder(place, kind(1, SIGNAL), 0.0815, [0.157, 0.167], 0.002);
    mesh.cylinder(place, kind(1, PAINT), 0.088, [0.170, 0.236], 0.008);
    let hub = Link {
        from: [0.0, 0.215],
        upright: true,
        length: height - 0.215,
        radii: [0.070, 0.064],
        thickness: [-0.046, 0.046],
        bevel: 0.006,
    };
    mesh.link(kind(1, PAINT), &hub);
    // The motor behind the shoulder.
    mesh.cylinder(Place::along_x([-0.118, 0.0, 0.262]), kind(1, METAL), 0.034, [0.0, 0.07], 0.006);
}

fn upper_arm(mesh: &mut Mesh, length: f32) {
    for side in [-1.0_f32, 1.0] {
        let (inside, outside) = (side * 0.050, side * 0.076);
        let thickness = [inside.min(outside), inside.max(outside)];
        let plate = Link { from: [0.0, 0.0], upright: false, length, radii: [0.068, 0.054], thickness, bevel: 0.006 };
        mesh.link(kind(2, PAINT), &plate);
        for (x, radius) in [(0.0, 0.046), (length, 0.036)] {
            let cap = [[0.070, radius], [0.079, radius], [0.083, radius - 0.004], [0.083, 0.0]];
            let mut cap = cap.map(|[height, radius]| [side * height, radius]);
            if side < 0.0 {
                cap.reverse();
            }
            mesh.lathe(Place::along_y([x, 0.0, 0.0]), kind(2, METAL), &cap);
        }
    }
    let middle = Link {
        from: [0.118, 0.0],
        upright: false,
        length: length - 0.118 - 0.096,
        radii: [0.036, 0.032],
        thickness: [-0.052, 0.052],
        bevel: 0.002,
    };
    mesh.link(kind(2, METAL), &middle);
}

fn forearm(mesh: &mut Mesh, length: f32, flange: f32) {
    let housing = Link {
        from: [-0.050, 0.0],
        upright: false,
        length: 0.16,
        radii: [0.046, 0.046],
        thickness: [-0.043, 0.043],
        bevel: 0.007,
    };
    mesh.link(kind(3, PAINT), &housing);
    let elbow = Place::along_x([0.0; 3]);
    let tube = [[0.120, 0.0], [0.120, 0.043], [0.170, 0.041], [0.275, 0.032], [0.280, 0.028], [0.280, 0.0]];
    mesh.lathe(elbow, kind(3, PAINT), &tube);
    mesh.cylinder(elbow, kind(3, SIGNAL), 0.0435, [0.158, 0.167], 0.001);
    let fork = Link {
        from: [0.262, 0.0],
        upright: false,
        length: length - 0.262,
        radii: [0.026, 0.031],
        thickness: [-0.027, 0.027],
        bevel: 0.004,
    };
    mesh.link(kind(3, METAL), &fork);
    mesh.cylinder(Place::along_y([length, 0.0, 0.0]), kind(3, PAINT), 0.022, [-0.034, 0.034], 0.003);
    let wrist = Place::along_x([length, 0.0, 0.0]);
    mesh.cylinder(wrist, kind(3, PAINT), 0.021, [0.020, flange - 0.014], 0.002);
    mesh.cylinder(wrist, kind(3, METAL), 0.031, [flange - 0.015, flange], 0.003);
    mesh.ball(Place::along_x([length + flange, 0.0, 0.0]), kind(3, SIGNAL), 0.013);
}

/// Where the parts are when the arm's points are there and its waist is turned by `q1`, rad.
pub(crate) fn frames(points: &ArmPoints, q1: f64) -> [Matrix; PARTS] {
    let (sin, cos) = q1.sin_cos();
    let (ahead, axis) = ([cos as f32, sin as f32, 0.0], [-sin as f32, cos as f32, 0.0]);
    let up = [0.0, 0.0, 1.0];
    let link = |from: Point, to: Point| {
        let x = unit(subtract(single(to), single(from)));
        Matrix::frame(single(from), [x, axis, cross(x, axis)])
    };
    [
        Matrix::IDENTITY,
        Matrix::frame(single(points.base), [ahead, axis, up]),
        link(points.shoulder, points.elbow),
        link(points.elbow, points.wrist),
    ]
}

fn single(point: Point) -> Vec3 {
    point.map(|coordinate| coordinate as f32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arm::mesh::VERTEX;
    use adaptarm_core::robots::{Kinematics, ROBOTS};

    #[test]
    fn links_reach_from_joint_to_joint_and_the_tip_is_marked() {
        let arm = Kinematics::new(ROBOTS[0]);
        let (mesh, still) = solids(arm.lengths_m());
        assert!(mesh.indices[still..].iter().all(|&index| mesh.vertices[usize::from(index) * VERTEX + 6] > 0.0));
        let points = arm.points(&[0.4, 1.2, -0.9]);
        let frames = frames(&points, 0.4);
        let [_, upper, fore, flange] = arm.lengths_m().map(|length| length as f32);
        for (part, local, expected) in [
            (2, [upper, 0.0, 0.0], points.elbow),
            (3, [fore, 0.0, 0.0], points.wrist),
            (3, [fore + flange, 0.0, 0.0], points.tip),
        ] {
            let [x, y, z, _] = frames[part].apply(local);
            let off = [x, y, z].iter().zip(expected).map(|(a, b)| (a - b as f32).abs()).fold(0.0, f32::max);
            assert!(off < 1e-5, "part {part} is {off} m off");
        }
        let marked = mesh.vertices.chunks_exact(VERTEX).filter(|v| v[6..] == [3.0, f32::from(SIGNAL)]);
        let farthest = marked.map(|v| v[0]).fold(0.0, f32::max);
        assert!((farthest - (fore + flange + 0.013)).abs() < 1e-4);
    }

    #[test]
    fn the_mesh_fits_sixteen_bit_indices_and_stands_on_the_floor() {
        let (mesh, _) = solids(Kinematics::new(ROBOTS[0]).lengths_m());
        assert!(mesh.vertices.len() / VERTEX < usize::from(u16::MAX));
        let triangles = mesh.indices.len() / 3;
        assert!(triangles < 7000, "{triangles} triangles: too many where a processor has to draw them");
        let standing = mesh.vertices.chunks_exact(VERTEX).filter(|v| v[6] < 2.0);
        assert!(standing.map(|v| v[2]).fold(1.0, f32::min).abs() < 1e-6);
    }
}
