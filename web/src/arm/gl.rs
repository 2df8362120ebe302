//! The little of WebGL2 that is needed: programs, triangles and lines as vertex arrays; each failure says what failed.

use super::matrix::{Matrix, Vec3};
use super::mesh::{Mesh, VERTEX};
use std::cell::RefCell;
use std::collections::BTreeMap;
use wasm_bindgen::{JsCast, JsValue};
use web_sys::WebglDebugRendererInfo;
use web_sys::{HtmlCanvasElement, WebGl2RenderingContext as Gl, WebGlContextAttributes};
use web_sys::{WebGlBuffer, WebGlProgram, WebGlShader, WebGlUniformLocation, WebGlVertexArrayObject};

/// What went wrong, for people.
pub(super) type Failed = String;

const FLOAT: i32 = 4;

/// A canvas' WebGL2, and whether a processor has to do the graphics card's work. `smooth` asks for multisampling;
/// it is not given where the browser itself calls WebGL slow.
pub(super) fn context(canvas: &HtmlCanvasElement, smooth: bool) -> Result<(Gl, bool), Failed> {
    let attempt = |slow: bool| -> Option<Gl> {
        let attributes = WebGlContextAttributes::new();
        attributes.set_alpha(true);
        attributes.set_depth(true);
        attributes.set_stencil(true);
        attributes.set_antialias(smooth && !slow);
        attributes.set_fail_if_major_performance_caveat(!slow);
        canvas.get_context_with_context_options("webgl2", attributes.as_ref()).ok()??.dyn_into().ok()
    };
    let fast = attempt(false).map(|gl| {
        let slow = is_drawn_by_processor(&gl);
        (gl, slow)
    });
    fast.or_else(|| attempt(true).map(|gl| (gl, true))).ok_or_else(|| "this browser offers no WebGL2".to_owned())
}

/// Not every browser whose processor draws calls that a caveat; the renderer's name tells.
fn is_drawn_by_processor(gl: &Gl) -> bool {
    // Browsers without the extension say the name themselves.
    let parameter = match gl.get_extension("WEBGL_debug_renderer_info") {
        Ok(Some(_)) => WebglDebugRendererInfo::UNMASKED_RENDERER_WEBGL,
        _ => Gl::RENDERER,
    };
    let name = gl.get_parameter(parameter).ok().and_then(|name| name.as_string()).unwrap_or_default().to_lowercase();
    ["swiftshader", "llvmpipe", "softpipe", "software", "basic render"].iter().any(|known| name.contains(known))
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
    still: i32,
    count: i32,
}

impl Triangles {
    /// Of a mesh whose first `still` indices are of parts that never move.
    pub fn new(gl: &Gl, (mesh, still): &(Mesh, usize)) -> Result<Self, Failed> {
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
        Ok(Self { array, still: *still as i32, count: mesh.indices.len() as i32 })
    }

    pub fn draw(&self, gl: &Gl) {
        gl.bind_vertex_array(Some(&self.array));
        gl.draw_elements_with_i32(Gl::TRIANGLES, self.count, Gl::UNSIGNED_SHORT, 0);
    }

    /// What moves alone.
    pub fn draw_moving(&self, gl: &Gl) {
        gl.bind_vertex_array(Some(&self.array));
        let start = 2 * self.still;
        gl.draw_elements_with_i32(Gl::TRIANGLES, self.count - self.still, Gl::UNSIGNED_SHORT, start);
    }
}

/// Lines on the graphics card: points of four numbers, x, y, z and time.
pub(super) struct Lines {
    array: WebGlVertexArrayObject,
    buffer: WebGlBuffer,
    /// First vertex and number of vertices of each line.
    ranges: Vec<(i32, i32)>,
}

/// A point of a line.
pub(super) type LinePoint = [f32; 4];

impl Lines {
    /// Some lines, of two points or more each.
    pub fn new(gl: &Gl, lines: &[Vec<LinePoint>]) -> Result<Self, Failed> {
        let array = gl.create_vertex_array().ok_or("no vertex array could be made")?;
        gl.bind_vertex_array(Some(&array));
        let buffer = fill(gl, Gl::ARRAY_BUFFER, &[])?;
        // Every point stands in the buffer twice, so that its neighbours are two vertices away.
        for attribute in 0..3 {
            let stride = 4 * FLOAT;
            gl.enable_vertex_attrib_array(attribute);
            gl.vertex_attrib_pointer_with_i32(attribute, 4, Gl::FLOAT, false, stride, 2 * stride * attribute as i32);
        }
        gl.bind_vertex_array(None);
        let mut this = Self { array, buffer, ranges: Vec::new() };
        this.replace(gl, lines);
        Ok(this)
    }

    /// Puts other lines in their place.
    pub fn replace(&mut self, gl: &Gl, lines: &[Vec<LinePoint>]) {
        let mut numbers = Vec::new();
        self.ranges.clear();
        for line in lines {
            self.ranges.push((numbers.len() as i32 / 4, 2 * line.len() as i32));
            // A line's ends are neighbours of themselves: the direction there is that of the first or last stretch.
            let whole = line.first().into_iter().chain(line).chain(line.last());
            numbers.extend(whole.flat_map(|point| [point, point]).flatten());
        }
        gl.bind_buffer(Gl::ARRAY_BUFFER, Some(&self.buffer));
        gl.buffer_data_with_u8_array(Gl::ARRAY_BUFFER, &bytes(&numbers), Gl::DYNAMIC_DRAW);
    }

    pub fn draw(&self, gl: &Gl) {
        gl.bind_vertex_array(Some(&self.array));
        for &(first, count) in &self.ranges {
            gl.draw_arrays(Gl::TRIANGLE_STRIP, first, count);
        }
    }

    /// Gives the memory back.
    pub fn delete(&self, gl: &Gl) {
        gl.delete_vertex_array(Some(&self.array));
        gl.delete_buffer(Some(&self.buffer));
    }
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
