#include "demo/picture/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "demo/picture/light.h"
#include "demo/picture/offscreen.h"
#include "demo/picture/program.h"
#include "demo/picture/shaders.h"
#include "demo/picture/shapes.h"

namespace pleat::demo {
namespace {

struct Part {
  const Mesh* mesh;
  GLint first_vertex;
  std::size_t first_index;
};

template <class T>
void upload(const Gl& gl, GLenum target, const std::vector<T>& data) {
  gl.BufferData(target, static_cast<GLsizeiptr>(data.size() * sizeof(T)), data.data(), GL_STREAM_DRAW);
}

}  // namespace

struct Renderer::Impl {
  Offscreen offscreen;
  const Gl& gl;
  Program background, depth, surface, ground, stick;
  ShadowMap key_map, sky_map;
  GLuint empty_array = 0, mesh_array = 0, stick_array = 0;
  GLuint vertex_buffer = 0, index_buffer = 0, stick_buffer = 0;
  std::vector<Part> parts;

  Impl(int width, int height);
  void upload_meshes(const std::vector<const Mesh*>& meshes);
  void draw_mesh(const Part& part);
  void draw_depth(const ShadowMap& map, const LightView& light);
  void draw_surfaces(const Frame& frame, const Eigen::Matrix4f& camera, const LightView& key, const LightView& sky);
  void draw_ground(const Frame& frame, const Eigen::Matrix4f& camera, const LightView& key, const LightView& sky);
  void draw_background();
  void draw_sticks(const Frame& frame, const Eigen::Matrix4f& camera);
  void set_lights(const Program& program, const LightView& key, const LightView& sky);
};

Renderer::Impl::Impl(int width, int height)
    : offscreen(width, height),
      gl(offscreen.gl()),
      background(gl, shader::kCommon, shader::kBackgroundVertex, shader::kBackgroundFragment),
      depth(gl, "", shader::kDepthVertex, shader::kDepthFragment),
      surface(gl, (std::string(shader::kCommon) + shader::kLight).c_str(), shader::kSurfaceVertex,
              shader::kSurfaceFragment),
      ground(gl, (std::string(shader::kCommon) + shader::kLight).c_str(), shader::kGroundVertex,
             shader::kGroundFragment),
      stick(gl, shader::kCommon, shader::kStickVertex, shader::kStickFragment),
      key_map(gl, 512),
      sky_map(gl, 64) {
  const auto attribute = [this](GLuint index, GLint count, GLenum type, std::size_t stride, std::size_t offset) {
    gl.EnableVertexAttribArray(index);
    gl.VertexAttribPointer(index, count, type, type == GL_UNSIGNED_BYTE, static_cast<GLsizei>(stride),
                           reinterpret_cast<const void*>(offset));
  };
  gl.GenVertexArrays(1, &empty_array);
  gl.GenVertexArrays(1, &mesh_array);
  gl.GenVertexArrays(1, &stick_array);
  gl.GenBuffers(1, &vertex_buffer);
  gl.GenBuffers(1, &index_buffer);
  gl.GenBuffers(1, &stick_buffer);

  gl.BindVertexArray(mesh_array);
  gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, index_buffer);
  gl.BindBuffer(GL_ARRAY_BUFFER, vertex_buffer);
  attribute(0, 3, GL_FLOAT, 6 * sizeof(float), 0);
  attribute(1, 3, GL_FLOAT, 6 * sizeof(float), 3 * sizeof(float));

  gl.BindVertexArray(stick_array);
  gl.BindBuffer(GL_ARRAY_BUFFER, stick_buffer);
  attribute(0, 3, GL_FLOAT, 8 * sizeof(float), 0);
  attribute(1, 3, GL_FLOAT, 8 * sizeof(float), 3 * sizeof(float));
  attribute(2, 4, GL_UNSIGNED_BYTE, 8 * sizeof(float), 6 * sizeof(float));
  attribute(3, 1, GL_FLOAT, 8 * sizeof(float), 7 * sizeof(float));
  for (GLuint i = 0; i < 4; ++i) gl.VertexAttribDivisor(i, 1);
}

void Renderer::Impl::upload_meshes(const std::vector<const Mesh*>& meshes) {
  std::vector<float> vertices;
  std::vector<std::uint32_t> indices;
  parts.clear();
  for (const Mesh* mesh : meshes) {
    parts.push_back({mesh, static_cast<GLint>(vertices.size() / 6), indices.size()});
    vertices.insert(vertices.end(), mesh->vertices.begin(), mesh->vertices.end());
    indices.insert(indices.end(), mesh->indices.begin(), mesh->indices.end());
  }
  gl.BindVertexArray(mesh_array);
  gl.BindBuffer(GL_ARRAY_BUFFER, vertex_buffer);
  upload(gl, GL_ARRAY_BUFFER, vertices);
  upload(gl, GL_ELEMENT_ARRAY_BUFFER, indices);
}

void Renderer::Impl::draw_mesh(const Part& part) {
  gl.DrawElementsBaseVertex(GL_TRIANGLES, static_cast<GLsizei>(part.mesh->indices.size()), GL_UNSIGNED_INT,
                            reinterpret_cast<const void*>(part.first_index * sizeof(std::uint32_t)), part.first_vertex);
}

void Renderer::Impl::draw_depth(const ShadowMap& map, const LightView& light) {
  gl.BindFramebuffer(GL_FRAMEBUFFER, map.framebuffer);
  gl.Viewport(0, 0, map.size, map.size);
  gl.Enable(GL_DEPTH_TEST);
  gl.Clear(GL_DEPTH_BUFFER_BIT);
  depth.use();
  depth.set("light", light.projection);
  gl.Enable(GL_POLYGON_OFFSET_FILL);
  gl.PolygonOffset(1.5f, 4);
  for (const Part& part : parts) draw_mesh(part);
  gl.Disable(GL_POLYGON_OFFSET_FILL);
}

void Renderer::Impl::set_lights(const Program& program, const LightView& key, const LightView& sky) {
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_2D, key_map.texture);
  gl.ActiveTexture(GL_TEXTURE1);
  gl.BindTexture(GL_TEXTURE_2D, sky_map.texture);
  program.set("key_map", 0);
  program.set("sky_map", 1);
  program.set("key_light", key.projection);
  program.set("sky_light", sky.projection);
  program.set("key_texel", key.texel);
  program.set("sky_texel", sky.texel);
}

void Renderer::Impl::draw_surfaces(const Frame& frame, const Eigen::Matrix4f& camera, const LightView& key,
                                   const LightView& sky) {
  gl.BindVertexArray(mesh_array);
  surface.use();
  set_lights(surface, key, sky);
  surface.set("camera", camera);
  surface.set("eye", frame.camera.eye);
  surface.set("to_key", key_direction(frame.camera));
  surface.set("to_fill", fill_direction(frame.camera));
  for (const Part& part : parts) {
    surface.set_colour("front", part.mesh->front);
    surface.set_colour("back", part.mesh->back);
    surface.set("flat_shaded", part.mesh->flat ? 1 : 0);
    draw_mesh(part);
  }
}

void Renderer::Impl::draw_ground(const Frame& frame, const Eigen::Matrix4f& camera, const LightView& key,
                                 const LightView& sky) {
  const Camera& view = frame.camera;
  const float distance = (view.eye - view.target).norm();
  gl.BindVertexArray(empty_array);
  ground.use();
  set_lights(ground, key, sky);
  ground.set("camera", camera);
  ground.set("centre", Eigen::Vector3f(view.target.x(), *frame.ground, view.target.z()));
  ground.set("extent", 3 * distance);
  ground.set("cell", std::exp2(std::round(std::log2(distance / 6))));
  ground.set("picture_size", static_cast<float>(offscreen.width()), static_cast<float>(offscreen.height()));
  gl.DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

// Last and only where nothing else is, so that no pixel is shaded twice.
void Renderer::Impl::draw_background() {
  gl.BindVertexArray(empty_array);
  background.use();
  gl.DepthFunc(GL_LEQUAL);
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
  gl.DepthFunc(GL_LESS);
}

void Renderer::Impl::draw_sticks(const Frame& frame, const Eigen::Matrix4f& camera) {
  struct Instance {
    std::array<float, 6> ends;
    std::array<std::uint8_t, 4> rgba;
    float width;
  };
  static_assert(sizeof(Instance) == 8 * sizeof(float));
  std::vector<Instance> instances;
  const auto add = [&instances](const Stick& s) {
    const auto byte = [&s](int shift) { return static_cast<std::uint8_t>(s.rgba >> shift); };
    instances.push_back(
        {{s.a.x(), s.a.y(), s.a.z(), s.b.x(), s.b.y(), s.b.z()}, {byte(24), byte(16), byte(8), byte(0)}, s.width});
  };
  for (const Mesh& mesh : frame.meshes) {
    if ((mesh.wire & 255) != 0) std::ranges::for_each(wire_sticks(mesh), add);
  }
  std::ranges::for_each(frame.sticks, add);

  gl.BindVertexArray(stick_array);
  gl.BindBuffer(GL_ARRAY_BUFFER, stick_buffer);
  upload(gl, GL_ARRAY_BUFFER, instances);
  stick.use();
  stick.set("camera", camera);
  stick.set("eye", frame.camera.eye);
  stick.set("picture_size", static_cast<float>(offscreen.width()), static_cast<float>(offscreen.height()));
  gl.Enable(GL_BLEND);
  gl.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  gl.DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(instances.size()));
  gl.Disable(GL_BLEND);
}

Renderer::Renderer(int width, int height) : impl_(std::make_unique<Impl>(width, height)) {}
Renderer::~Renderer() = default;

Image Renderer::draw(const Frame& frame) {
  validate(frame);
  Impl& my = *impl_;
  const Gl& gl = my.gl;
  my.offscreen.begin();

  std::vector<Mesh> bodies;
  for (const Capsule& capsule : frame.capsules) bodies.push_back(capsule_mesh(capsule));
  std::vector<const Mesh*> meshes;
  for (const Mesh& mesh : frame.meshes) meshes.push_back(&mesh);
  for (const Mesh& body : bodies) meshes.push_back(&body);
  my.upload_meshes(meshes);

  Eigen::AlignedBox3f box = bounds(frame);
  if (box.isEmpty()) box.extend(frame.camera.target);
  const LightView key = light_view(key_direction(frame.camera), box, my.key_map.size);
  const LightView sky = light_view(Eigen::Vector3f::UnitY(), box, my.sky_map.size);
  my.draw_depth(my.key_map, key);
  my.draw_depth(my.sky_map, sky);

  my.offscreen.bind_picture();
  gl.Clear(GL_DEPTH_BUFFER_BIT);
  const float distance = (frame.camera.eye - frame.camera.target).norm();
  const float aspect = static_cast<float>(my.offscreen.width()) / static_cast<float>(my.offscreen.height());
  const Eigen::Matrix4f camera = view_projection(frame.camera, aspect, 0.02f * distance, 20 * distance);
  my.draw_surfaces(frame, camera, key, sky);
  if (frame.ground && frame.camera.eye.y() > *frame.ground) my.draw_ground(frame, camera, key, sky);
  my.draw_background();
  my.draw_sticks(frame, camera);
  return my.offscreen.read();
}

}  // namespace pleat::demo
