#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "demo/quality/distance.h"
#include "demo/scenes/triangle_mesh.h"

namespace pleat::bench {

/// A corner of a triangle mesh, and triangle t of it; m.
demo::Vector3d corner(const demo::TriangleMesh& mesh, uint32_t vertex);
demo::Triangle triangle(const demo::TriangleMesh& mesh, size_t t);

/// Unit normal of a triangle; zero where it has no area.
demo::Vector3d normal(const demo::Triangle& triangle);

/// A point of a surface, and the normal of the triangle it lies in.
struct AreaSample {
  demo::Vector3d point, normal;
};

/// `count` points, each part of the surface with as many as its area asks for: the area is cut into `count` equal
/// shares and each gets one, at a place that `seed` decides. The same on every machine. None for a mesh without area.
std::vector<AreaSample> area_samples(const demo::TriangleMesh& mesh, size_t count, uint32_t seed);

}  // namespace pleat::bench
