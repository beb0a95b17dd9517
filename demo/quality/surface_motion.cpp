#include "demo/quality/surface_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace pleat::demo {
namespace {

using Vertex = DrawnSurface::Vertex;

constexpr double kBinsPerDegree = 100.0;

Vector3d point(std::span<const float> positions, uint32_t index) {
  return {positions[3 * index], positions[3 * index + 1], positions[3 * index + 2]};
}

Vector3d place(const Vertex& vertex) { return {vertex.position[0], vertex.position[1], vertex.position[2]}; }

Vector3d normal(const Vertex& vertex) { return {vertex.normal[0], vertex.normal[1], vertex.normal[2]}; }

/// Exact for small angles too, where the arc cosine of single precision's dot product is not.
double degrees_between(const Vector3d& a, const Vector3d& b) {
  return 180.0 / std::numbers::pi * std::atan2(a.cross(b).norm(), a.dot(b));
}

void count_turns(const std::vector<Vector3d>& before, const std::vector<Vector3d>& now, AngleHistogram& turns) {
  for (size_t i = 0; i < before.size(); ++i) turns.add(degrees_between(before[i], now[i]));
}

double rms(double sum_of_squares, size_t count) { return count ? std::sqrt(sum_of_squares / double(count)) : 0.0; }

}  // namespace

double chain_length(std::span<const Vertex> drawn, std::span<const uint32_t> chain) {
  double length = 0.0;
  for (size_t k = 1; k < chain.size(); ++k) length += (place(drawn[chain[k]]) - place(drawn[chain[k - 1]])).norm();
  return length;
}

double surface_area(std::span<const Vertex> drawn, std::span<const uint32_t> triangles) {
  double area = 0.0;
  for (size_t t = 0; t < triangles.size(); t += 3) {
    const Vector3d a = place(drawn[triangles[t]]);
    area += 0.5 * (place(drawn[triangles[t + 1]]) - a).cross(place(drawn[triangles[t + 2]]) - a).norm();
  }
  return area;
}

void AngleHistogram::add(double degrees) {
  ++counts_[std::min(size_t(std::ceil(degrees * kBinsPerDegree)), counts_.size() - 1)];
}

double AngleHistogram::percentile(double share) const {
  uint64_t all = 0, seen = 0;
  for (const uint64_t count : counts_) all += count;
  size_t bin = 0;
  for (; all > 0 && bin + 1 < counts_.size(); ++bin) {
    seen += counts_[bin];
    if (double(seen) >= share * double(all)) break;
  }
  return double(bin) / kBinsPerDegree;
}

void SurfaceMotionMeter::add_frame(std::span<const float> particles, std::span<const Vertex> drawn) {
  add_turns(particles, drawn);
  add_acceleration(drawn);
  add_lengths(drawn);
  add_area(drawn);
  ++frames_;
}

void SurfaceMotionMeter::add_turns(std::span<const float> particles, std::span<const Vertex> drawn) {
  std::vector<Vector3d> normals, face_normals;
  for (const Vertex& vertex : drawn) normals.push_back(normal(vertex));
  for (size_t t = 0; t < mesh_.triangles.size(); t += 3) {
    const Vector3d a = point(particles, mesh_.triangles[t]);
    const Vector3d b = point(particles, mesh_.triangles[t + 1]), c = point(particles, mesh_.triangles[t + 2]);
    face_normals.push_back((b - a).cross(c - a));
  }
  count_turns(normals_, normals, turns_);
  count_turns(face_normals_, face_normals, face_turns_);
  normals_ = std::move(normals);
  face_normals_ = std::move(face_normals);
}

void SurfaceMotionMeter::add_acceleration(std::span<const Vertex> drawn) {
  std::vector<Vector3d> places;
  for (const Vertex& vertex : drawn) places.push_back(place(vertex));
  const auto& [last, last_but_one] = before_;
  for (size_t v = 0; v < last_but_one.size(); ++v) {
    squared_acceleration_ += (places[v] - 2.0 * last[v] + last_but_one[v]).squaredNorm();
    ++accelerations_;
  }
  before_[1] = std::exchange(before_[0], std::move(places));
}

void SurfaceMotionMeter::add_lengths(std::span<const Vertex> drawn) {
  for (size_t e = 0; e < mesh_.edges.size(); ++e) {
    const double error = chain_length(drawn, mesh_.edges[e]) / mesh_.rest_lengths[e] - 1.0;
    squared_length_error_ += error * error;
    ++lengths_;
  }
}

void SurfaceMotionMeter::add_area(std::span<const Vertex> drawn) {
  const double error = surface_area(drawn, mesh_.drawn_triangles) / mesh_.rest_area - 1.0;
  area_error_ += error;
  if (std::abs(error) > std::abs(worst_area_error_)) worst_area_error_ = error;
}

SurfaceMotion SurfaceMotionMeter::result() const {
  SurfaceMotion motion{};
  motion.normal_turn_deg = turns_.percentile(0.99);
  motion.flat_turn_deg = face_turns_.percentile(0.99);
  motion.acceleration_mm = 1000.0 * rms(squared_acceleration_, accelerations_);
  motion.length_rms_percent = 100.0 * rms(squared_length_error_, lengths_);
  motion.area_mean_percent = frames_ ? 100.0 * area_error_ / double(frames_) : 0.0;
  motion.area_worst_percent = 100.0 * worst_area_error_;
  return motion;
}

}  // namespace pleat::demo
