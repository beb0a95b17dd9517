#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/error/field.h"
#include "bench/error/reference.h"
#include "bench/metrics/size_error.h"
#include "bench/metrics/surface_distance.h"
#include "bench/metrics/wrinkle_spectrum.h"

namespace pleat::bench {

/// What one way to simulate and draw a scene costs, and how far from the truth it comes to rest.
struct Score {
  std::string method, dynamics;
  Grid grid;
  size_t drawn_triangles;
  double ms;  ///< a frame of 1/60 s at rest, median, of the processor's time
  SurfaceDistance error;
  double silhouette_overlap, area_error_percent;
  LengthError edges;         ///< of the particles, against rest
  WrinkleSpectrum wrinkles;  ///< of the particles
  bool peer;
};

/// Lets all come to rest, then measures the frames of all in turn, again and again, so that a slow moment of the
/// machine meets all alike. Calls `step` once for each contestant.
std::vector<Score> hold_contest(const pleat_api& api, const RestScene& scene, const Reference& reference,
                                const std::vector<Contestants>& all, bool quick, const std::function<void()>& step);

}  // namespace pleat::bench
