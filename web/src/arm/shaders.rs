//! The shaders: solids (lit, as a shadow on the floor, or as a ghost), the floor's grid, and lines of any width.
//!
//! Colours go out with alpha multiplied in, because the page shows through where nothing is drawn.

pub(super) const SOLID_VERTEX: &str = "#version 300 es
layout(location = 0) in vec3 a_position;
layout(location = 1) in vec3 a_normal;
layout(location = 2) in vec2 a_kind;
uniform mat4 u_parts[4];
uniform mat4 u_projection;
uniform vec3 u_light;
uniform bool u_flat;
out vec3 v_at;
out vec3 v_normal;
flat out int v_material;
void main() {
  mat4 part = u_parts[int(a_kind.x)];
  vec3 at = (part * vec4(a_position, 1.0)).xyz;
  if (u_flat) {
    at = vec3(at.xy - u_light.xy * (max(at.z, 0.0) / u_light.z), 0.001);
  }
  v_at = at;
  v_normal = mat3(part) * a_normal;
  v_material = int(a_kind.y);
  gl_Position = u_projection * vec4(at, 1.0);
}";

/// `u_look`: 0 lit, 1 shadow, 2 ghost.
pub(super) const SOLID_FRAGMENT: &str = "#version 300 es
precision highp float;
in vec3 v_at;
in vec3 v_normal;
flat in int v_material;
uniform vec3 u_eye;
uniform vec3 u_light;
uniform vec3 u_colors[3];
uniform vec3 u_ink;
uniform int u_look;
uniform float u_strength;
out vec4 color;
void main() {
  if (u_look == 1) {
    float fade = 1.0 - smoothstep(0.25, 1.0, length(v_at.xy));
    color = vec4(0.0, 0.0, 0.0, u_strength * fade);
    return;
  }
  vec3 n = normalize(v_normal);
  vec3 towards = normalize(u_eye - v_at);
  float facing = abs(dot(n, towards));
  if (u_look == 2) {
    float alpha = mix(0.80, 0.26, pow(facing, 0.6));
    color = vec4(u_ink * alpha, alpha);
    return;
  }
  vec3 base = u_colors[v_material];
  float sky = 0.5 + 0.5 * n.z;
  float key = max(dot(n, u_light), 0.0);
  vec3 side = normalize(vec3(-u_light.y, u_light.x, 0.15));
  float fill = max(dot(n, side), 0.0);
  float shine = pow(max(dot(n, normalize(u_light + towards)), 0.0), 48.0);
  float rim = pow(1.0 - facing, 3.0);
  vec3 lit = base * (mix(0.34, 0.56, sky) + 0.44 * key + 0.08 * fill + 0.20 * facing) + vec3(0.20 * shine) + u_strength * rim;
  color = vec4(min(lit, vec3(1.0)), 1.0);
}";

pub(super) const FLOOR_VERTEX: &str = "#version 300 es
uniform mat4 u_projection;
uniform float u_size;
out vec2 v_at;
void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  v_at = corner * u_size;
  gl_Position = u_projection * vec4(v_at, 0.0, 1.0);
}";

/// Lines every 10 cm, stronger every 50 cm, and a ring as far as the arm reaches.
pub(super) const FLOOR_FRAGMENT: &str = "#version 300 es
precision highp float;
in vec2 v_at;
uniform vec3 u_ink;
uniform float u_size;
uniform float u_reach;
out vec4 color;
float grid(float spacing) {
  vec2 pixel = fwidth(v_at);
  vec2 off = abs(fract(v_at / spacing - 0.5) - 0.5) * spacing;
  vec2 on = (1.0 - smoothstep(vec2(0.0), 1.2 * pixel, off)) * (1.0 - smoothstep(0.15, 0.5, pixel / spacing));
  return max(on.x, on.y);
}
void main() {
  float far = length(v_at);
  float fade = 1.0 - smoothstep(0.35 * u_size, u_size, far);
  float ring = 1.0 - smoothstep(0.0, 1.5 * fwidth(far), abs(far - u_reach));
  float alpha = max(max(0.20 * grid(0.1), 0.48 * grid(0.5)), 0.40 * ring) * fade * fade;
  alpha = max(alpha, 0.055 * fade * fade);
  color = vec4(u_ink * alpha, alpha);
}";

/// Two vertices per point, one on each side of the line; each knows its neighbours: x, y, z (m) and time (s).
pub(super) const LINE_VERTEX: &str = "#version 300 es
layout(location = 0) in vec4 a_before;
layout(location = 1) in vec4 a_at;
layout(location = 2) in vec4 a_after;
uniform mat4 u_projection;
uniform vec2 u_viewport;
uniform float u_width;
uniform float u_now;
out float v_time;
out float v_across;
out float v_half;
void main() {
  float side = float(gl_VertexID & 1) * 2.0 - 1.0;
  vec4 before = u_projection * vec4(a_before.xyz, 1.0);
  vec4 after = u_projection * vec4(a_after.xyz, 1.0);
  vec4 at = u_projection * vec4(a_at.xyz, 1.0);
  vec2 along = (after.xy / after.w - before.xy / before.w) * u_viewport;
  along = dot(along, along) > 1e-8 ? normalize(along) : vec2(1.0, 0.0);
  v_time = a_at.w;
  float age = u_now - v_time;
  float recent = age >= -0.01 ? exp(-age / 0.4) : 0.0;
  v_half = 0.5 * u_width * (1.0 + 0.9 * recent) + 0.75;
  v_across = side * v_half;
  at.xy += vec2(-along.y, along.x) * v_across * 2.0 / u_viewport * at.w;
  gl_Position = at;
}";

/// What is ahead of the shown instant is faint.
pub(super) const LINE_FRAGMENT: &str = "#version 300 es
precision highp float;
in float v_time;
in float v_across;
in float v_half;
uniform vec3 u_ink;
uniform float u_now;
uniform float u_behind;
uniform float u_ahead;
out vec4 color;
void main() {
  float edge = 1.0 - smoothstep(v_half - 1.5, v_half, abs(v_across));
  float alpha = edge * (v_time <= u_now ? u_behind : u_ahead);
  color = vec4(u_ink * alpha, alpha);
}";
