// Cantilevers: strips and square sheets, clamped level at one end, that bend under their own weight.
//
// The energy of a sheet bent to a cylinder is B kappa^2 / 2 in any direction, and without a Poisson effect: wide sheets
// and narrow strips, which are free to curl across, droop alike.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

#include "bench/validation/check.h"
#include "bench/validation/elastica.h"
#include "bench/validation/rig.h"

namespace pleat::bench {
namespace {

constexpr uint32_t kCells = 20, kManyCells = 2000;  // along a strip; of the continuum
constexpr double kDensity = 0.2f, kFall = 9.81f;

/// 1 m long from its clamp to its free end.
struct Strip {
  demo::TriangleMesh mesh;
  std::vector<uint32_t> pins;
  double clamp = 0.0;         ///< x up to which it is held, m
  std::vector<uint32_t> tip;  ///< the free end is in their middle
};

// A clamp of two rows of pins holds the cloth to halfway between them: the fold at the second row is the bending of
// half a cell to either side of it.

/// Squares with one diagonal, `across` of them side by side; `turned`: in every other square the other diagonal.
Strip squares(uint32_t across, uint32_t cells, bool turned) {
  Strip strip;
  const double a = 1.0 / (cells + 0.5);
  const uint32_t line = across + 1;
  for (uint32_t i = 0; i < cells + 2; ++i) {
    for (uint32_t j = 0; j < line; ++j) {
      strip.mesh.positions.insert(strip.mesh.positions.end(), {float(a * i), 0.0f, float(a * j)});
      const uint32_t d = line * i + j, b = d - line, c = d - 1, o = b - 1;  // o b behind, c d ahead
      if (i < 2) strip.pins.push_back(d);
      if (i == cells + 1) strip.tip.push_back(d);
      if (i == 0 || j == 0) continue;
      if (turned && (i + j) % 2 == 1) {
        strip.mesh.triangles.insert(strip.mesh.triangles.end(), {o, b, d, o, d, c});
      } else {
        strip.mesh.triangles.insert(strip.mesh.triangles.end(), {o, b, c, b, d, c});
      }
    }
  }
  strip.clamp = a / 2;
  return strip;
}

Strip grid_strip(uint32_t across, uint32_t cells = kCells) { return squares(across, cells, false); }

/// Equilateral triangles, `across` rows of them, edges along the strip.
Strip equilateral_strip(uint32_t across, uint32_t cells = kCells) {
  Strip strip;
  const uint32_t line = cells + 2;
  const double a = 1.0 / (cells + 0.75), h = a * std::sqrt(0.75);
  for (uint32_t j = 0; j <= across; ++j) {
    const uint32_t odd = j % 2;
    for (uint32_t i = 0; i < line; ++i) {
      strip.mesh.positions.insert(strip.mesh.positions.end(), {float(a * (i + 0.5 * odd)), 0.0f, float(h * j)});
      const uint32_t p = line * j + i, q = p - line;  // q: beside it in the row before
      if (i < 2 - odd) strip.pins.push_back(p);
      if (i == line - 1) strip.tip.push_back(p);
      if (i == 0 || j == 0) continue;
      if (odd == 1) {
        strip.mesh.triangles.insert(strip.mesh.triangles.end(), {p - 1, q - 1, q, p - 1, q, p});
      } else {
        strip.mesh.triangles.insert(strip.mesh.triangles.end(), {p - 1, q - 1, p, p, q - 1, q});
      }
    }
  }
  strip.clamp = 0.5 * a;
  return strip;
}

/// Height over width of the tip as seen from the clamp, once it is at rest after `time` s. The strip is `length` m
/// long.
double droop(const pleat_api& api, const Strip& strip, const pleat_cloth_settings& settings, double length, double dt,
             double time) {
  RigDef def;
  def.mesh = strip.mesh;
  for (float& x : def.mesh.positions) x *= float(length);
  def.pins = strip.pins;
  def.settings = settings;
  Rig rig(api, def);
  rig.step(dt, int(time / dt));
  double x = -strip.clamp * length, y = 0.0;
  for (const uint32_t i : strip.tip) {
    x += rig.position(i)[0] / double(strip.tip.size());
    y -= rig.position(i)[1] / double(strip.tip.size());
  }
  return y / x;
}

/// Of a strip of 1 m.
double droop(const pleat_api& api, const Strip& strip, double gamma) {
  pleat_cloth_settings settings = bare_settings(api);
  settings.bend_stiffness = float(kDensity * kFall / gamma);
  settings.stiffness = 4000.0f;
  settings.air_damping = 10.0f;
  const double dt = std::min(5e-5 * std::sqrt(gamma), 1e-4);  // what the hinges, and then the edges, bear unsoftened
  return droop(api, strip, settings, 1.0, dt, 3.0);
}

}  // namespace

Checks cantilever(const pleat_api& api) {
  Checks checks;
  const Strip strip[] = {equilateral_strip(1), grid_strip(1)};
  const Strip sheet[] = {equilateral_strip(kCells), grid_strip(kCells)};
  const Strip alternating = squares(kCells, kCells, true);
  constexpr double kMostOfZigzag = 20.0;  // at 50, bent by half a radian a cell, it hangs 8 % too high
  constexpr const char* kMesh[] = {"equilateral", "grid"};
  for (const double gamma : {1.0, 2.0, 5.0, 8.0, 10.0, 20.0, 50.0}) {
    for (size_t m = 0; m < 2; ++m) {
      const std::string name = "gamma " + std::to_string(int(gamma)) + ", " + kMesh[m];
      checks.push_back(
          relative(name + " strip, discrete", elastica_droop(gamma, kCells), droop(api, strip[m], gamma), 3e-2));
      checks.push_back(
          relative(name + " sheet, continuum", elastica_droop(gamma, kManyCells), droop(api, sheet[m], gamma), 5e-2));
    }
    if (gamma > kMostOfZigzag) continue;
    checks.push_back(relative("gamma " + std::to_string(int(gamma)) + ", alternating sheet, continuum",
                              elastica_droop(gamma, kManyCells), droop(api, alternating, gamma), 5e-2));
  }
  return checks;
}

Checks fabrics(const pleat_api& api) {
  constexpr const char* kNames[] = {"polyester", "trousers", "denim", "blanket",
                                    "interlock", "ponte",    "sweat", "nylon"};
  constexpr double kGamma = 8.0;  // a strip whose chord hangs at 41.5 degrees, as when bending length is measured
  Checks checks;
  for (uint32_t fabric = 0; fabric < std::size(kNames); ++fabric) {
    pleat_cloth_settings settings = bare_settings(api);
    if (api.fabric_apply(fabric, &settings) != PLEAT_OK) throw std::runtime_error("the library lacks a fabric");
    settings.air_damping = 60.0f;
    const double weight = double(settings.density) * kFall;
    const double length = std::cbrt(kGamma * double(settings.bend_stiffness) / weight);
    const std::pair<const char*, Strip (*)(uint32_t, uint32_t)> meshes[] = {{"equilateral", equilateral_strip},
                                                                            {"grid", grid_strip}};
    for (const auto& [mesh, strip] : meshes) {
      double coarse = 0.0, fine = 0.0;
      for (const uint32_t cells : {10u, 20u}) {
        const double edge = length / cells, particle = std::sqrt(0.75) * double(settings.density) * edge * edge / 2;
        const double dt = std::min(0.5 * std::sqrt(particle / double(settings.stiffness)), 1e-4);
        coarse = fine, fine = droop(api, strip(1, cells), settings, length, dt, 1.0);
      }
      const std::string name = std::string(kNames[fabric]) + ", " + mesh;
      checks.push_back(relative(name + ", 10 cells against 20", fine, coarse, 3e-2));
      checks.push_back(relative(name + ", continuum", elastica_droop(kGamma, kManyCells), fine, 3e-2));
    }
  }
  return checks;
}

}  // namespace pleat::bench
