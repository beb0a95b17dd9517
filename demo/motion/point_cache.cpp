#include "demo/motion/point_cache.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "demo/input_error.h"

namespace pleat::demo {
namespace {

static_assert(std::endian::native == std::endian::little, "the numbers are read as they lie in the file");

constexpr char kMagic[12] = "POINTCACHE2";
constexpr std::uint64_t kMostNumbers = std::uint64_t{1} << 28;
constexpr std::size_t kMostAtOnce = std::size_t{1} << 20;  // numbers

struct Header {
  char magic[12];
  std::int32_t version, points;
  float start, rate;
  std::int32_t samples;
};
static_assert(sizeof(Header) == 32);

}  // namespace

std::vector<float> PointCache::at(double sample) const {
  const double clamped = std::clamp(sample, 0.0, double(samples - 1));
  const std::size_t before = std::min(std::size_t(clamped), samples - 1), after = std::min(before + 1, samples - 1);
  const float t = float(clamped - double(before));
  const float *from = positions.data() + 3 * points * before, *to = positions.data() + 3 * points * after;
  std::vector<float> now(3 * points);
  for (std::size_t i = 0; i < now.size(); ++i) now[i] = from[i] + (to[i] - from[i]) * t;
  return now;
}

PointCache read_point_cache(std::istream& stream, const std::string& name) {
  Header header;
  if (!stream.read(reinterpret_cast<char*>(&header), sizeof header)) throw InputError(name, "is cut short");
  if (std::memcmp(header.magic, kMagic, sizeof kMagic) != 0 || header.version != 1) {
    throw InputError(name, "is not a point cache (PC2, version 1)");
  }
  if (header.points < 1 || header.samples < 1 ||
      3 * std::uint64_t(header.points) * std::uint64_t(header.samples) > kMostNumbers) {
    throw InputError(name, "says it holds " + std::to_string(header.samples) + " samples of " +
                               std::to_string(header.points) + " points");
  }
  PointCache cache{std::size_t(header.points), std::size_t(header.samples), {}};
  for (std::size_t left = 3 * cache.points * cache.samples; left > 0;) {  // not all at once: the header may lie
    const std::size_t count = std::min(left, kMostAtOnce), before = cache.positions.size();
    cache.positions.resize(before + count);
    if (!stream.read(reinterpret_cast<char*>(cache.positions.data() + before), std::streamsize(count * sizeof(float))))
      throw InputError(name, "is cut short");
    left -= count;
  }
  cache.positions.shrink_to_fit();
  const auto bad = std::ranges::find_if(cache.positions, [](float x) { return !std::isfinite(x); });
  if (bad != cache.positions.end()) {
    const std::size_t point = std::size_t(bad - cache.positions.begin()) / 3;
    throw InputError(name, "sample " + std::to_string(point / cache.points) + ": point " +
                               std::to_string(point % cache.points) + " is not finite");
  }
  return cache;
}

}  // namespace pleat::demo
