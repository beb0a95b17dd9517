#pragma once

// Shading language 3.30. Light is computed in linear units; the picture's sRGB format encodes what comes out.
namespace pleat::demo::shader {

// Stands before every shader.
inline constexpr char kCommon[] = R"(
vec3 linear(vec3 srgb) { return mix(srgb / 12.92, pow((srgb + 0.055) / 1.055, vec3(2.4)), step(0.04045, srgb)); }
// A studio sweep, bright around the upper middle. `at`: 0..1 across the picture.
vec3 background(vec2 at) {
  vec2 d = (at - vec2(0.5, 0.62)) * vec2(0.8, 1.0);
  return mix(vec3(0.88, 0.90, 0.92), vec3(0.55, 0.60, 0.66), smoothstep(0.0, 0.85, length(d)));
}
)";

inline constexpr char kBackgroundVertex[] = R"(
out vec2 at;
void main() {
  at = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0;  // one triangle over the whole picture
  gl_Position = vec4(at * 2.0 - 1.0, 1.0, 1.0);  // behind everything
}
)";

inline constexpr char kBackgroundFragment[] = R"(
in vec2 at;
out vec4 colour;
void main() { colour = vec4(background(at), 1.0); }
)";

inline constexpr char kDepthVertex[] = R"(
layout(location = 0) in vec3 position;
uniform mat4 light;
void main() { gl_Position = light * vec4(position, 1.0); }
)";

inline constexpr char kDepthFragment[] = R"(
void main() {}
)";

// A key light with a soft shadow, and a sky that sees less of narrow places.
inline constexpr char kLight[] = R"(
uniform sampler2DShadow key_map, sky_map;
uniform mat4 key_light, sky_light;  // world to light clip space
uniform float key_texel, sky_texel;  // m

// Part of the light that reaches p, 0..1: a tent of bilinear comparisons, three by three. Starting two texels off the
// surface keeps it out of its own shadow.
float visibility(sampler2DShadow map, mat4 light, float texel, vec3 p, vec3 n) {
  vec3 at = (light * vec4(p + n * texel * 2.0, 1.0)).xyz;
  if (abs(at.x) > 1.0 || abs(at.y) > 1.0) return 1.0;
  at = at * 0.5 + 0.5;
  vec2 d = vec2(1.6) / vec2(textureSize(map, 0));
  float corners = texture(map, at + vec3(-d.x, -d.y, 0.0)) + texture(map, at + vec3(d.x, -d.y, 0.0)) +
                  texture(map, at + vec3(-d.x, d.y, 0.0)) + texture(map, at + vec3(d.x, d.y, 0.0));
  float sides = texture(map, at + vec3(-d.x, 0.0, 0.0)) + texture(map, at + vec3(d.x, 0.0, 0.0)) +
                texture(map, at + vec3(0.0, -d.y, 0.0)) + texture(map, at + vec3(0.0, d.y, 0.0));
  return 0.25 * texture(map, at) + 0.125 * sides + 0.0625 * corners;
}
float key_visibility(vec3 p, vec3 n) { return visibility(key_map, key_light, key_texel, p, n); }
float sky_visibility(vec3 p, vec3 n) { return visibility(sky_map, sky_light, sky_texel, p, n); }
)";

inline constexpr char kSurfaceVertex[] = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform mat4 camera;
out vec3 p, n;
void main() {
  p = position;
  n = normal;
  gl_Position = camera * vec4(position, 1.0);
}
)";

inline constexpr char kSurfaceFragment[] = R"(
in vec3 p, n;
uniform vec3 eye, to_key, to_fill;
uniform vec3 front, back;  // linear
uniform bool flat_shaded;
out vec4 colour;

void main() {
  vec3 view = normalize(eye - p);
  vec3 face = cross(dFdx(p), dFdy(p));  // towards the eye
  vec3 normal = normalize(flat_shaded ? face : (gl_FrontFacing ? n : -n));
  vec3 albedo = gl_FrontFacing ? front : back;

  float key = max(dot(normal, to_key), 0.0) * key_visibility(p, normal);
  float sky = mix(0.4, 1.0, sky_visibility(p, normal));
  float fill = max(dot(normal, to_fill), 0.0) * sky;
  vec3 ambient = mix(vec3(0.17, 0.15, 0.15), vec3(0.30, 0.34, 0.40), 0.5 + 0.5 * normal.y) * sky;

  // Cloth: a broad highlight, and fibres that catch light where the surface turns away.
  float sheen = pow(1.0 - max(dot(normal, view), 0.0), 3.0);
  float highlight = pow(max(dot(normal, normalize(view + to_key)), 0.0), 16.0) * key;
  vec3 light = albedo * (ambient + vec3(1.55, 1.46, 1.33) * key + vec3(0.36, 0.42, 0.50) * fill);
  light += (0.06 * highlight + 0.12 * sheen * (0.25 * sky + key)) * mix(vec3(1.0), albedo, 0.5);

  // Filmic shoulder: white is reached at 2.2.
  colour = vec4(light * (1.0 + light / (2.2 * 2.2)) / (1.0 + 0.55 * light), 1.0);
}
)";

inline constexpr char kGroundVertex[] = R"(
uniform mat4 camera;
uniform vec3 centre;
uniform float extent;  // m
out vec3 p;
void main() {
  p = centre + extent * vec3(float(gl_VertexID & 1) * 2.0 - 1.0, 0.0, float(gl_VertexID >> 1) * 2.0 - 1.0);
  gl_Position = camera * vec4(p, 1.0);
}
)";

// The floor is the background with shadows and a grid on it, so it has no horizon.
inline constexpr char kGroundFragment[] = R"(
in vec3 p;
uniform vec3 centre;
uniform float extent, cell;  // m
uniform vec2 picture_size;
out vec4 colour;

float grid(vec2 at, float width) {  // `width` in pixels
  vec2 pixel = fwidth(at);
  vec2 away = abs(fract(at - 0.5) - 0.5) / pixel;
  vec2 line = clamp(0.5 * width + 0.5 - away, 0.0, 1.0) * clamp(0.25 / pixel, 0.0, 1.0);
  return max(line.x, line.y);
}

void main() {
  const vec3 up = vec3(0.0, 1.0, 0.0);
  float fade = 1.0 - smoothstep(0.1, 0.7, length(p.xz - centre.xz) / extent);
  float lines = max(0.4 * grid(p.xz / cell * 4.0, 1.0), grid(p.xz / cell, 1.4));
  float light = 0.55 * key_visibility(p, up) + 0.45 * sky_visibility(p, up);
  vec3 shade = mix(vec3(0.20, 0.22, 0.26), vec3(1.0), light);
  colour = vec4(background(gl_FragCoord.xy / picture_size) * shade * (1.0 - 0.13 * lines * fade), 1.0);
}
)";

inline constexpr char kStickVertex[] = R"(
layout(location = 0) in vec3 a;
layout(location = 1) in vec3 b;
layout(location = 2) in vec4 rgba;
layout(location = 3) in float width;  // pixels
uniform mat4 camera;
uniform vec3 eye;
uniform vec2 picture_size;
out vec4 tint;
void main() {
  // A point moved along its line of sight stays where it is in the picture.
  vec4 from = camera * vec4(mix(a, eye, 0.003), 1.0);
  vec4 to = camera * vec4(mix(b, eye, 0.003), 1.0);
  const float nearest = 1e-3;
  if (from.w < nearest) from = mix(to, from, (to.w - nearest) / (to.w - from.w));
  if (to.w < nearest) to = mix(from, to, (from.w - nearest) / (from.w - to.w));

  bool at_end = (gl_VertexID & 1) == 1;
  vec4 end = at_end ? to : from;
  vec2 along = (to.xy / to.w - from.xy / from.w) * picture_size;
  along = length(along) > 1e-6 ? normalize(along) : vec2(1.0, 0.0);
  vec2 across = vec2(-along.y, along.x) * (gl_VertexID < 2 ? 1.0 : -1.0);
  vec2 corner = (across + (at_end ? along : -along)) * width / picture_size;  // half a width in clip space
  gl_Position = max(from.w, to.w) < nearest ? vec4(2.0, 2.0, 2.0, 1.0) : end + vec4(corner * end.w, 0.0, 0.0);
  tint = vec4(linear(rgba.rgb), rgba.a);
}
)";

inline constexpr char kStickFragment[] = R"(
in vec4 tint;
out vec4 colour;
void main() { colour = tint; }
)";

}  // namespace pleat::demo::shader
