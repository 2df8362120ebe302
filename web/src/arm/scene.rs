//! Draws arms side by side: floor, shadow, arm, the tip's way, and the desired arm as a ghost.
//!
//! Keeps solids and paths on the graphics card; a path is made again only when its run has changed.

use super::body::{PARTS, frames, solids};
use super::camera::Look;
use super::gl::{Failed, LinePoint, Lines, Program, Triangles, context};
use super::matrix::{Matrix, Vec3, along, unit};
use super::motion::{Motion, Pose};
use super::shaders;
use super::view::View;
use crate::runs::{Runs, ShownRun};
use adaptarm_core::figures::{Rgb, Theme, scheme_style};
use adaptarm_core::robots::{ArmPoints, Kinematics, Point, ROBOTS, RobotKind};
use std::collections::BTreeMap;
use web_sys::{HtmlCanvasElement, WebGl2RenderingContext as Gl, WebGlSync};

/// Half the floor's side, m.
const FLOOR: f32 = 1.25;
/// Points of a path: about one per pixel that it takes.
const PATH_POINTS: usize = 600;
/// Direction towards the light before it is made a unit.
const LIGHT: Vec3 = [0.42, -0.62, 1.0];
/// Where the axes stand on the floor, and how long they are, m.
const AXES: Vec3 = [-0.24, -0.12, 0.001];
const AXIS: f32 = 0.10;
/// A time after every run's end: lines that are not about time are past.
const ALWAYS: f32 = 1e9;

/// Everything that a context holds.
pub(super) struct Scene {
    gl: Gl,
    solid: Program,
    floor: Program,
    line: Program,
    body: Triangles,
    axes: Lines,
    /// The links of a robot that has no solids.
    links: Lines,
    paths: BTreeMap<String, Path>,
    reach: f32,
    /// Behind everything that has been asked of the graphics card.
    fence: Option<WebGlSync>,
    /// A processor does the graphics card's work.
    pub is_slow: bool,
    /// Edges are smoothed by multisampling.
    pub is_smooth: bool,
}

/// A run's paths, and what they were made from.
struct Path {
    revision: u64,
    exaggeration: f64,
    actual: Lines,
    desired: Lines,
}

/// Where and how an arm is drawn.
struct Cell<'a> {
    look: Look,
    size: [f32; 2],
    theme: Theme,
    view: &'a View,
}

/// The looks of solids, as the shader numbers them.
#[derive(Clone, Copy)]
enum Shown {
    Lit = 0,
    Shadow = 1,
    Ghost = 2,
}

impl Scene {
    pub fn new(canvas: &HtmlCanvasElement, smooth: bool) -> Result<Self, Failed> {
        let (gl, is_slow) = context(canvas, smooth)?;
        let samples = gl.get_parameter(Gl::SAMPLES).ok().and_then(|samples| samples.as_f64());
        let arm = Kinematics::new(ROBOTS[0]);
        Ok(Self {
            solid: Program::new(&gl, shaders::SOLID_VERTEX, shaders::SOLID_FRAGMENT)?,
            floor: Program::new(&gl, shaders::FLOOR_VERTEX, shaders::FLOOR_FRAGMENT)?,
            line: Program::new(&gl, shaders::LINE_VERTEX, shaders::LINE_FRAGMENT)?,
            body: Triangles::new(&gl, &solids(arm.lengths_m()))?,
            axes: Lines::new(&gl, &[])?,
            links: Lines::new(&gl, &[])?,
            paths: BTreeMap::new(),
            reach: arm.lengths_m()[1..].iter().sum::<f64>() as f32,
            fence: None,
            is_slow,
            is_smooth: samples.is_some_and(|samples| samples > 0.0),
            gl,
        })
    }

    /// Draws one arm per run that `view` names, in columns of equal width; a run that does not exist leaves its floor empty.
    pub fn draw(&mut self, runs: &Runs, view: &View) -> Result<(), Failed> {
        let gl = self.gl.clone();
        self.forget(|id| view.arms.iter().any(|arm| arm == id));
        gl.viewport(0, 0, view.width as i32, view.height as i32);
        gl.clear_color(0.0, 0.0, 0.0, 0.0);
        gl.clear(Gl::COLOR_BUFFER_BIT | Gl::DEPTH_BUFFER_BIT | Gl::STENCIL_BUFFER_BIT);
        gl.enable(Gl::DEPTH_TEST);
        gl.depth_func(Gl::LEQUAL);
        gl.blend_func(Gl::ONE, Gl::ONE_MINUS_SRC_ALPHA);
        let theme = if view.dark { Theme::Dark } else { Theme::Light };
        let columns = view.arms.len().max(1) as u32;
        for (column, id) in view.arms.iter().enumerate() {
            let edge = |column: u32| (view.width * column / columns) as i32;
            let (left, right) = (edge(column as u32), edge(column as u32 + 1));
            gl.viewport(left, 0, right - left, view.height as i32);
            let size = [(right - left) as f32, view.height as f32];
            let cell = Cell { look: view.camera.look(size[0] / size[1]), size, theme, view };
            self.draw_floor(&cell);
            self.draw_axes(&cell);
            if let Some(run) = runs.get(id) {
                self.draw_run(&cell, id, run)?;
            }
        }
        if let Some(done) = self.fence.take() {
            gl.delete_sync(Some(&done));
        }
        self.fence = gl.fence_sync(Gl::SYNC_GPU_COMMANDS_COMPLETE, 0);
        gl.flush();
        Ok(())
    }

    /// Whether the latest drawing is still being made.
    pub fn is_busy(&self) -> bool {
        let status = |fence| self.gl.get_sync_parameter(fence, Gl::SYNC_STATUS).as_f64();
        self.fence.as_ref().is_some_and(|fence| status(fence) == Some(f64::from(Gl::UNSIGNALED)))
    }

    /// Deletes the paths of runs that are not wanted any more.
    fn forget(&mut self, wanted: impl Fn(&str) -> bool) {
        let gl = &self.gl;
        self.paths.retain(|id, path| {
            let keep = wanted(id);
            if !keep {
                path.delete(gl);
            }
            keep
        });
    }

    fn draw_floor(&self, cell: &Cell<'_>) {
        let (gl, floor) = (&self.gl, &self.floor);
        floor.select(gl);
        floor.matrices(gl, "u_projection", &[cell.look.projection]);
        floor.number(gl, "u_size", FLOOR);
        floor.number(gl, "u_reach", self.reach);
        floor.vectors(gl, "u_ink", &[color(cell.theme.truth())]);
        gl.enable(Gl::BLEND);
        gl.depth_mask(false);
        gl.bind_vertex_array(None);
        // Seen from below too, if an eye ever gets there.
        gl.disable(Gl::CULL_FACE);
        gl.draw_arrays(Gl::TRIANGLE_STRIP, 0, 4);
    }

    fn draw_axes(&mut self, cell: &Cell<'_>) {
        self.axes.replace(&self.gl, &axes(&cell.look));
        self.prepare_lines(cell, 1.5, ALWAYS);
        self.line.number(&self.gl, "u_behind", 0.9);
        self.line.vectors(&self.gl, "u_ink", &[color(cell.theme.truth())]);
        self.axes.draw(&self.gl);
    }

    fn draw_run(&mut self, cell: &Cell<'_>, id: &str, run: &ShownRun) -> Result<(), Failed> {
        let Some(motion) = Motion::new(run) else { return Ok(()) };
        self.update_path(id, run, &motion, cell.view.exaggeration)?;
        let pose = motion.at(cell.view.time_s, cell.view.exaggeration);
        let paint = color(scheme_style(run.scenario.scheme(), cell.theme).0);
        if run.scenario.robot().kind == RobotKind::CrsA465 {
            self.draw_arm(cell, &pose, paint);
            self.draw_paths(cell, &self.paths[id], paint);
            self.draw_ghost(cell, &pose);
        } else {
            let shrink = self.shrink(&motion);
            self.draw_links(cell, &pose.desired, shrink, 2.0, color(cell.theme.ink()));
            self.draw_links(cell, &pose.actual, shrink, 5.0, paint);
            self.draw_paths(cell, &self.paths[id], paint);
        }
        Ok(())
    }

    /// How much smaller than it is a robot is drawn, so that it reaches no further than the one with solids.
    fn shrink(&self, motion: &Motion<'_>) -> f32 {
        let reach: f64 = motion.kinematics.lengths_m()[1..].iter().sum();
        (self.reach / reach as f32).min(1.0)
    }

    /// Links as lines from joint to joint.
    fn draw_links(&mut self, cell: &Cell<'_>, points: &ArmPoints, shrink: f32, width: f32, ink: Vec3) {
        let points = points.all().map(|[x, y, z]| [shrink * x as f32, shrink * y as f32, shrink * z as f32, 0.0]);
        self.links.replace(&self.gl, &[points.to_vec()]);
        self.prepare_lines(cell, width, ALWAYS);
        self.line.number(&self.gl, "u_behind", 0.95);
        self.line.vectors(&self.gl, "u_ink", &[ink]);
        self.links.draw(&self.gl);
    }

    fn update_path(&mut self, id: &str, run: &ShownRun, motion: &Motion<'_>, exaggeration: f64) -> Result<(), Failed> {
        let current = |path: &Path| path.revision == run.revision && path.exaggeration == exaggeration;
        if self.paths.get(id).is_some_and(current) {
            return Ok(());
        }
        let (mut actual, mut desired) = (Vec::with_capacity(PATH_POINTS), Vec::with_capacity(PATH_POINTS));
        let shrink = self.shrink(motion);
        for sample in motion.path_samples(PATH_POINTS) {
            let pose = motion.at_sample(sample, exaggeration);
            let point = |point: Point| {
                let [x, y, z] = point.map(|coordinate| shrink * coordinate as f32);
                [x, y, z, motion.time_s(sample) as f32]
            };
            actual.push(point(pose.actual.tip));
            desired.push(point(pose.desired.tip));
        }
        if let Some(path) = self.paths.get_mut(id) {
            path.actual.replace(&self.gl, &[actual]);
            path.desired.replace(&self.gl, &[desired]);
            (path.revision, path.exaggeration) = (run.revision, exaggeration);
        } else {
            let (actual, desired) = (Lines::new(&self.gl, &[actual])?, Lines::new(&self.gl, &[desired])?);
            self.paths.insert(id.to_owned(), Path { revision: run.revision, exaggeration, actual, desired });
        }
        Ok(())
    }

    /// The arm and its shadow, which darkens each pixel once.
    fn draw_arm(&self, cell: &Cell<'_>, pose: &Pose, paint: Vec3) {
        let gl = &self.gl;
        let parts = frames(&pose.actual, pose.q[0]);
        gl.enable(Gl::STENCIL_TEST);
        gl.stencil_func(Gl::EQUAL, 0, 0xff);
        gl.stencil_op(Gl::KEEP, Gl::KEEP, Gl::INCR);
        let shadow = if cell.theme == Theme::Dark { 0.42 } else { 0.16 };
        self.prepare_solids(cell, &parts, paint, Shown::Shadow, shadow);
        self.body.draw_moving(gl);
        gl.disable(Gl::STENCIL_TEST);
        gl.disable(Gl::BLEND);
        gl.depth_mask(true);
        let rim = if cell.theme == Theme::Dark { 0.16 } else { -0.10 };
        self.prepare_solids(cell, &parts, paint, Shown::Lit, rim);
        self.body.draw(gl);
    }

    /// The desired arm, as if of glass: its front alone, and behind the arm where both are in one place.
    fn draw_ghost(&self, cell: &Cell<'_>, pose: &Pose) {
        let gl = &self.gl;
        self.prepare_solids(cell, &frames(&pose.desired, pose.q_d[0]), [0.0; 3], Shown::Ghost, 0.0);
        self.solid.vectors(gl, "u_ink", &[color(cell.theme.ink())]);
        gl.enable(Gl::POLYGON_OFFSET_FILL);
        // About half a centimetre, so that surfaces in almost one place do not show through one another in specks.
        gl.polygon_offset(1.0, 1200.0);
        gl.depth_mask(true);
        gl.color_mask(false, false, false, false);
        self.body.draw_moving(gl);
        gl.color_mask(true, true, true, true);
        gl.depth_mask(false);
        self.body.draw_moving(gl);
        gl.disable(Gl::POLYGON_OFFSET_FILL);
        gl.depth_mask(true);
    }

    fn draw_paths(&self, cell: &Cell<'_>, path: &Path, paint: Vec3) {
        let (gl, line) = (&self.gl, &self.line);
        let now = cell.view.time_s as f32;
        self.prepare_lines(cell, 1.0, ALWAYS);
        line.number(gl, "u_behind", 0.65);
        line.vectors(gl, "u_ink", &[color(cell.theme.ink())]);
        path.desired.draw(gl);
        self.prepare_lines(cell, 2.0, now);
        line.number(gl, "u_behind", 0.95);
        line.number(gl, "u_ahead", 0.28);
        line.vectors(gl, "u_ink", &[paint]);
        path.actual.draw(gl);
    }

    fn prepare_solids(&self, cell: &Cell<'_>, parts: &[Matrix; PARTS], paint: Vec3, shown: Shown, strength: f32) {
        let (gl, solid) = (&self.gl, &self.solid);
        gl.enable(Gl::CULL_FACE);
        let (metal, body): (Vec3, Vec3) = match cell.theme {
            Theme::Light => ([0.27, 0.30, 0.35], [0.90, 0.91, 0.93]),
            Theme::Dark => ([0.24, 0.27, 0.32], [0.72, 0.75, 0.80]),
        };
        solid.select(gl);
        solid.matrices(gl, "u_projection", &[cell.look.projection]);
        solid.matrices(gl, "u_parts", parts);
        solid.vectors(gl, "u_light", &[unit(LIGHT)]);
        solid.vectors(gl, "u_eye", &[cell.look.eye]);
        solid.vectors(gl, "u_colors", &[metal, body, paint]);
        solid.integer(gl, "u_look", shown as i32);
        solid.integer(gl, "u_flat", i32::from(matches!(shown, Shown::Shadow)));
        solid.number(gl, "u_strength", strength);
    }

    fn prepare_lines(&self, cell: &Cell<'_>, width: f32, now: f32) {
        let (gl, line) = (&self.gl, &self.line);
        line.select(gl);
        line.matrices(gl, "u_projection", &[cell.look.projection]);
        line.pair(gl, "u_viewport", cell.size);
        line.number(gl, "u_width", width * cell.view.scale);
        line.number(gl, "u_now", now);
        gl.enable(Gl::BLEND);
        gl.disable(Gl::CULL_FACE);
        gl.depth_mask(false);
    }
}

impl Path {
    fn delete(&self, gl: &Gl) {
        self.actual.delete(gl);
        self.desired.delete(gl);
    }
}

/// The axes, each with its letter turned to the eye.
fn axes(look: &Look) -> Vec<Vec<LinePoint>> {
    const LETTERS: [&[[f32; 4]]; 3] = [
        &[[-1.0, -1.0, 1.0, 1.0], [-1.0, 1.0, 1.0, -1.0]],
        &[[0.0, -1.0, 0.0, 0.0], [0.0, 0.0, -1.0, 1.0], [0.0, 0.0, 1.0, 1.0]],
        &[[-1.0, 1.0, 1.0, 1.0], [1.0, 1.0, -1.0, -1.0], [-1.0, -1.0, 1.0, -1.0]],
    ];
    let mut lines = Vec::new();
    let mut stretch = |from: Vec3, to: Vec3| {
        lines.push([from, to].map(|[x, y, z]| [x, y, z, 0.0]).to_vec());
    };
    for (axis, letter) in LETTERS.iter().enumerate() {
        let mut direction = [0.0; 3];
        direction[axis] = 1.0;
        stretch(AXES, along(AXES, AXIS, direction));
        let middle = along(AXES, AXIS + 0.03, direction);
        let at = |x: f32, y: f32| along(along(middle, 0.009 * x, look.right), 0.013 * y, look.up);
        for [x0, y0, x1, y1] in *letter {
            stretch(at(*x0, *y0), at(*x1, *y1));
        }
    }
    lines
}

fn color((red, green, blue): Rgb) -> Vec3 {
    [red, green, blue].map(|channel| f32::from(channel) / 255.0)
}
