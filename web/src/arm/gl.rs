//! The little of WebGL2 that is needed: programs, triangles and lines as vertex arrays; each failure says what failed.

use super::matrix::{Matrix, Vec3};
use super::mesh::{Mesh, VERTEX};
use std::cell::RefCell;
use std::collections::BTreeMap;
use wasm_bindgen::{JsCast, JsValue};
use web_sys::{HtmlCanvasElement, WebGl2RenderingContext as Gl, WebGlContextAttributes};
use web_sys::{WebGlBuffer, WebGlProgram, WebGlShader, WebGlUniformLocation, WebGlVertexArrayObject};

/// What went wrong, for people.
pub(super) type Failed = String;

const FLOAT: i32 = 4;

/// A canvas' WebGL2.
pub(super) fn context(canvas: &HtmlCanvasElement) -> Result<Gl, Failed> {
    let attributes = WebGlContextAttributes::new();
    attributes.set_alpha(true);
    attributes.set_antialias(true);
    attributes.set_depth(true);
    attributes.set_stencil(true);
    canvas
        .get_context_with_context_options("webgl2", attributes.as_ref())
        .ok()
        .flatten()
        .and_then(|context| context.dyn_into().ok())
        .ok_or_else(|| "this browser offers no WebGL2".to_owned())
}

/// A linked pair of shaders.
pub(super) struct Program {
    program: WebGlProgram,
    /// By name; a uniform that the compiler dropped has no place.
    places: RefCell<BTreeMap<&'static str, Option<WebGlUniformLocation>>>,
}

impl Program {
    pub fn new(gl: &Gl, vertex: &str, fragment: &str) -> Result<Self, Failed> {
        let program = gl.create_program().ok_or("no program could be made")?;
        for (kind, source) in [(Gl::VERTEX_SHADER, vertex), (Gl::FRAGMENT_SHADER, fragment)] {
            gl.attach_shader(&program, &compile(gl, kind, source)?);
        }
        gl.link_program(&program);
        if gl.get_program_parameter(&program, Gl::LINK_STATUS) == JsValue::TRUE {
            Ok(Self { program, places: RefCell::default() })
        } else {
            Err(gl.get_program_info_log(&program).unwrap_or_default())
        }
    }

    /// Draws with this from here on.
    pub fn select(&self, gl: &Gl) {
        gl.use_program(Some(&self.program));
    }

    fn place(&self, gl: &Gl, name: &'static str) -> Option<WebGlUniformLocation> {
        let mut places = self.places.borrow_mut();
        places.entry(name).or_insert_with(|| gl.get_uniform_location(&self.program, name)).clone()
    }

    pub fn number(&self, gl: &Gl, name: &'static str, value: f32) {
        gl.uniform1f(self.place(gl, name).as_ref(), value);
    }

    pub fn integer(&self, gl: &Gl, name: &'static str, value: i32) {
        gl.uniform1i(self.place(gl, name).as_ref(), value);
    }

    pub fn pair(&self, gl: &Gl, name: &'static str, [x, y]: [f32; 2]) {
        gl.uniform2f(self.place(gl, name).as_ref(), x, y);
    }

    pub fn vectors(&self, gl: &Gl, name: &'static str, values: &[Vec3]) {
        gl.uniform3fv_with_f32_array(self.place(gl, name).as_ref(), values.as_flattened());
    }

    pub fn matrices(&self, gl: &Gl, name: &'static str, values: &[Matrix]) {
        let numbers: Vec<f32> = values.iter().flat_map(|matrix| matrix.0).collect();
        gl.uniform_matrix4fv_with_f32_array(self.place(gl, name).as_ref(), false, &numbers);
    }
}

fn compile(gl: &Gl, kind: u32, source: &str) -> Result<WebGlShader, Failed> {
    let shader = gl.create_shader(kind).ok_or("no shader could be made")?;
    gl.shader_source(&shader, source);
    gl.compile_shader(&shader);
    if gl.get_shader_parameter(&shader, Gl::COMPILE_STATUS) == JsValue::TRUE {
        Ok(shader)
    } else {
        Err(gl.get_shader_info_log(&shader).unwrap_or_default())
    }
}

/// Triangles on the graphics card.
pub(super) struct Triangles {
    array: WebGlVertexArrayObject,
    count: i32,
}

impl Triangles {
    pub fn new(gl: &Gl, mesh: &Mesh) -> Result<Self, Failed> {
        let array = gl.create_vertex_array().ok_or("no vertex array could be made")?;
        gl.bind_vertex_array(Some(&array));
        fill(gl, Gl::ARRAY_BUFFER, &bytes(&mesh.vertices))?;
        for (attribute, size, offset) in [(0, 3, 0), (1, 3, 3), (2, 2, 6)] {
            gl.enable_vertex_attrib_array(attribute);
            let (stride, offset) = (VERTEX as i32 * FLOAT, offset * FLOAT);
            gl.vertex_attrib_pointer_with_i32(attribute, size, Gl::FLOAT, false, stride, offset);
        }
        let indices: Vec<u8> = mesh.indices.iter().flat_map(|index| index.to_le_bytes()).collect();
        fill(gl, Gl::ELEMENT_ARRAY_BUFFER, &indices)?;
        gl.bind_vertex_array(None);
        Ok(Self { array, count: mesh.indices.len() as i32 })
    }

    pub fn draw(&self, gl: &Gl) {
        gl.bind_vertex_array(Some(&self.array));
        gl.draw_elements_with_i32(Gl::TRIANGLES, self.count, Gl::UNSIGNED_SHORT, 0);
    }
}

/// Lines on the graphics card: stretches between points of four numbers, x, y, z and time.
pub(super) struct Lines {
    array: WebGlVertexArrayObject,
    buffer: WebGlBuffer,
    /// Numbers from a stretch to the next: 4 where they hang together, 8 where each has its own two points.
    step: usize,
    count: i32,
}

impl Lines {
    /// Of a path, each point joined to the next.
    pub fn path(gl: &Gl, points: &[f32]) -> Result<Self, Failed> {
        Self::new(gl, points, 4)
    }

    /// Of stretches that do not hang together.
    pub fn stretches(gl: &Gl, points: &[f32]) -> Result<Self, Failed> {
        Self::new(gl, points, 8)
    }

    fn new(gl: &Gl, points: &[f32], step: usize) -> Result<Self, Failed> {
        let array = gl.create_vertex_array().ok_or("no vertex array could be made")?;
        gl.bind_vertex_array(Some(&array));
        let buffer = fill(gl, Gl::ARRAY_BUFFER, &bytes(points))?;
        for attribute in 0..2 {
            gl.enable_vertex_attrib_array(attribute);
            let (stride, offset) = (step as i32 * FLOAT, attribute as i32 * 4 * FLOAT);
            gl.vertex_attrib_pointer_with_i32(attribute, 4, Gl::FLOAT, false, stride, offset);
            gl.vertex_attrib_divisor(attribute, 1);
        }
        gl.bind_vertex_array(None);
        Ok(Self { array, buffer, step, count: stretches(points, step) })
    }

    /// Puts other points in their place.
    pub fn replace(&mut self, gl: &Gl, points: &[f32]) {
        gl.bind_buffer(Gl::ARRAY_BUFFER, Some(&self.buffer));
        gl.buffer_data_with_u8_array(Gl::ARRAY_BUFFER, &bytes(points), Gl::DYNAMIC_DRAW);
        self.count = stretches(points, self.step);
    }

    pub fn draw(&self, gl: &Gl) {
        gl.bind_vertex_array(Some(&self.array));
        gl.draw_arrays_instanced(Gl::TRIANGLE_STRIP, 0, 4, self.count);
    }

    /// Gives the memory back.
    pub fn delete(&self, gl: &Gl) {
        gl.delete_vertex_array(Some(&self.array));
        gl.delete_buffer(Some(&self.buffer));
    }
}

/// How many stretches these numbers make: one per two points, or per point but the last.
fn stretches(points: &[f32], step: usize) -> i32 {
    (points.len() + step).saturating_sub(8) as i32 / step as i32
}

/// A new buffer in the bound vertex array.
fn fill(gl: &Gl, target: u32, bytes: &[u8]) -> Result<WebGlBuffer, Failed> {
    let buffer = gl.create_buffer().ok_or("no buffer could be made")?;
    gl.bind_buffer(target, Some(&buffer));
    gl.buffer_data_with_u8_array(target, bytes, Gl::STATIC_DRAW);
    Ok(buffer)
}

/// Wherever WebGL runs, numbers are little-endian.
fn bytes(numbers: &[f32]) -> Vec<u8> {
    numbers.iter().flat_map(|number| number.to_le_bytes()).collect()
}
