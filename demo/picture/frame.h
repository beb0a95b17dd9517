#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "demo/picture/camera.h"

namespace pleat::demo {

// Colours are sRGB with alpha, 0xRRGGBBAA.

/// Triangles with one colour a side. Lit on both sides, so a garment may be looked into.
struct Mesh {
  std::vector<float> vertices;         // 6 each: position (m), normal (any length)
  std::vector<std::uint32_t> indices;  // 3 a triangle, counter-clockwise seen from the front
  std::uint32_t front = 0xb23a35ff;
  std::uint32_t back = 0x8a4a50ff;
  bool flat = false;       // shade by the triangles' own normals
  std::uint32_t wire = 0;  // colour of the triangles' edges; alpha 0: none
};

/// All points within `radius` of the segment ab; a tapered one is the hull of its end balls.
struct Capsule {
  Eigen::Vector3f a, b;  // m
  float radius;          // m
  std::uint32_t rgba = 0xc9c3baff;
  float taper = 0.0f;  // what the ball about b has more, m
};

/// A straight line, `width` pixels thick at any distance, unlit. Drawn a touch nearer than it is, so that it stays
/// whole on a surface it lies in.
struct Stick {
  Eigen::Vector3f a, b;  // m
  std::uint32_t rgba;
  float width = 2;  // pixels
};

/// All that one picture shows.
struct Frame {
  Camera camera;
  std::optional<float> ground;  // y of the floor, m
  std::vector<Capsule> capsules;
  std::vector<Mesh> meshes;
  std::vector<Stick> sticks;
};

/// Refuses what cannot be drawn: non-finite numbers, indices out of range, a field of view outside 0..pi.
/// Errors: std::invalid_argument that names the thing, its number and its value.
void validate(const Frame& frame);

/// Box of meshes and capsules, m; empty when there are none.
Eigen::AlignedBox3f bounds(const Frame& frame);

}  // namespace pleat::demo
