#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "demo/motion/figure.h"
#include "demo/scenes/scene_def.h"
#include "engine/pleat.h"

namespace pleat::bench {

/// How a rectangle of cloth is cut into triangles.
enum class Pattern {
  kAlternating,  ///< squares whose diagonals alternate: four and eight edges meet in turn
  kOneWay,       ///< squares whose diagonals all run one way
  kStaggered,    ///< every other row is shifted by half an edge: isosceles triangles
};

/// Particles along v (rows) and along u (columns) of a rectangle of cloth; a shifted row has one more.
struct Grid {
  uint32_t rows, columns;
  Pattern pattern = Pattern::kAlternating;
  uint32_t particles() const { return rows * columns + (pattern == Pattern::kStaggered ? rows / 2 : 0); }
};

/// A rectangle of cloth that can come to rest in one way only, so that how far a simulation of it is from the truth can
/// be said point by point. u runs along its width, v along its depth, both 0..1.
struct RestScene {
  std::string_view name, title;
  float width, depth;                            ///< m, at rest
  float bend_stiffness;                          ///< N m
  std::array<Grid, 4> coarse;                    ///< about 33, 66, 264 and 1056 particles
  Grid fine;                                     ///< of the reference
  bool (*pinned)(double u, double v);            ///< asked at particles
  Eigen::Vector3d (*start)(double u, double v);  ///< m, where it starts
  std::optional<demo::CapsulePose> body;         ///< that it lies on
};

/// Two corners pinned at full distance; a bowl from four corners; a sheet over a cylinder; a stiff strip held by its
/// middle line, which is clamped as both sides weigh alike; a catenary.
std::span<const RestScene> rest_scenes();

/// The sheet over the cylinder without it: what lies on it in the truth is pinned there.
RestScene held_on_body(const RestScene& scene);

/// Where the particles of a grid start, (P,3) m.
std::vector<float> start_positions(const RestScene& scene, Grid grid);

/// Settings of the scene: the library's own, without friction, which would let it rest in many ways, and with more air
/// damping, which brings it to rest sooner and not elsewhere.
pleat_cloth_settings rest_settings(const pleat_api& api, const RestScene& scene);

inline constexpr float kSpring =
    1000.0f;  ///< N/m, of the cloth that all this is about: both ways, without strain limit

/// The substep, s, in which explicit steps carry these springs and the scene's bending on a grid, with some reserve.
double stable_substep(const pleat_api& api, const RestScene& scene, Grid grid);

/// What a Scene or a peer runs. Its garment lies flat, as it was cut: place the particles at the start yourself.
demo::SceneDef rest_scene_def(const pleat_api& api, const RestScene& scene, Grid grid,
                              const pleat_cloth_settings& settings, double rate);

/// Points of a grid at the places of another, linear in between, (N,3) m.
std::vector<float> resampled(std::span<const float> points, Grid from, Grid to);

/// Triangles between the points of a grid; diagonals alternate.
std::vector<uint32_t> grid_triangles(const pleat_api& api, Grid grid);

}  // namespace pleat::bench
