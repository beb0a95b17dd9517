#include "systems/self_candidates.h"

#include <bit>

#include "systems/box.h"
#include "systems/closest_points.h"

namespace pleat {
namespace {

constexpr float kMarginShare = 0.25f;  // of the mean edge length
constexpr float kOverlapShare = 0.1f;  // of the mean edge length: so far beside a face it is still touched
constexpr float kRestShare = 0.5f;     // of the distance at rest that a pair may keep

std::uint32_t bucket_count(std::size_t particle_count) {
  return std::bit_ceil(static_cast<std::uint32_t>(particle_count) + 1u);
}

/// Mean motion between two moments, m.
Vec3 mean_motion(ConstVec3View from, ConstVec3View to, std::uint32_t count) {
  Vec3 sum;
  for (std::uint32_t i = 0; i < count; ++i) sum += to[i] - from[i];
  return sum * (1.0f / static_cast<float>(count));
}

/// The furthest that a particle has moved away from the mean motion, m.
float relative_motion(ConstVec3View from, ConstVec3View to, std::uint32_t count) {
  const Vec3 mean = mean_motion(from, to, count);
  float most2 = 0.0f;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec3 d = to[i] - from[i] - mean;
    most2 = std::max(most2, dot(d, d));
  }
  return std::sqrt(most2);
}

struct Cell {
  std::int32_t x, y, z;
  friend bool operator==(const Cell&, const Cell&) = default;
};

/// Particles by the cells of a hashed grid: those of a bucket lie together, in ascending order.
class HashedGrid {
 public:
  HashedGrid(ConstVec3View points, std::uint32_t count, float cell_size, std::uint32_t* scratch)
      : points_(points),
        inverse_size_(1.0f / cell_size),
        mask_(bucket_count(count) - 1),
        begin_(scratch),
        filed_(scratch + mask_ + 2) {
    std::fill(begin_, filed_, 0u);
    for (std::uint32_t i = 0; i < count; ++i) ++begin_[bucket(cell(points[i]))];
    for (std::uint32_t b = 0; b <= mask_; ++b) begin_[b + 1] += begin_[b];
    for (std::uint32_t i = count; i-- > 0;) filed_[--begin_[bucket(cell(points[i]))]] = i;
  }

  Cell cell(const Vec3& p) const { return {index(p.x), index(p.y), index(p.z)}; }

  template <class Visit>
  void for_each_in(const Cell& c, const Visit& visit) const {
    const std::uint32_t b = bucket(c);
    for (std::uint32_t k = begin_[b]; k < begin_[b + 1]; ++k) {
      if (cell(points_[filed_[k]]) == c) visit(filed_[k]);
    }
  }

 private:
  std::int32_t index(float x) const {
    return static_cast<std::int32_t>(std::clamp(std::floor(x * inverse_size_), -1e9f, 1e9f));
  }
  std::uint32_t bucket(const Cell& c) const {
    const std::uint32_t h = static_cast<std::uint32_t>(c.x) * 73856093u ^ static_cast<std::uint32_t>(c.y) * 19349663u ^
                            static_cast<std::uint32_t>(c.z) * 83492791u;
    return h & mask_;
  }

  ConstVec3View points_;
  float inverse_size_;
  std::uint32_t mask_;
  std::uint32_t* begin_;  // (buckets + 1)
  std::uint32_t* filed_;  // (count)
};

/// One search over all faces.
struct Search {
  const SelfCandidates& in;
  float high, wide;  // m, over and beside a face
  HashedGrid grid;
  const SelfPair* old;  // pairs of the last search that are still ahead, in the order of their faces
  const SelfPair* old_end;
  Stats& stats;

  void search(std::uint32_t face) {
    const Prism prism(*this, face);
    while (old != old_end && old->face < face) ++old;
    const auto meet = [&](std::uint32_t particle) {
      if (prism.holds(in.previous[particle], particle)) add(particle, face);
    };
    const Cell from = grid.cell(prism.box.low), to = grid.cell(prism.box.high);
    const auto cells = [](std::int32_t a, std::int32_t b) { return double(b) - double(a) + 1.0; };
    if (cells(from.x, to.x) * cells(from.y, to.y) * cells(from.z, to.z) > in.garment->particle_count) {
      for (std::uint32_t i = 0; i < in.garment->particle_count; ++i) meet(i);
      return;
    }
    for (std::int32_t x = from.x; x <= to.x; ++x) {
      for (std::int32_t y = from.y; y <= to.y; ++y) {
        for (std::int32_t z = from.z; z <= to.z; ++z) grid.for_each_in({x, y, z}, meet);
      }
    }
  }

 private:
  /// The space over and under a face, up to `high` above it and to `wide` beside it.
  struct Prism {
    float high, wide;
    std::uint32_t corner[3];
    Vec3 x[3], normal, outward[3];
    Box box;

    Prism(const Search& search, std::uint32_t face) : high(search.high), wide(search.wide) {
      for (int k = 0; k < 3; ++k) {
        corner[k] = search.in.garment->face_particle[k][face];
        x[k] = search.in.previous[corner[k]];
        box.include(x[k]);
      }
      box = box.grown(std::max(high, wide));
      normal = normalized_or(cross(x[1] - x[0], x[2] - x[0]), Vec3{});
      for (int k = 0; k < 3; ++k) outward[k] = normalized_or(cross(x[(k + 1) % 3] - x[k], normal), Vec3{});
    }
    bool holds(const Vec3& p, std::uint32_t particle) const {
      if (particle == corner[0] || particle == corner[1] || particle == corner[2] || !box.overlaps({p, p}))
        return false;
      if (std::abs(dot(p - x[0], normal)) > high) return false;
      for (int k = 0; k < 3; ++k) {
        if (dot(p - x[k], outward[k]) > wide) return false;
      }
      return true;
    }
  };

  void add(std::uint32_t particle, std::uint32_t face) const {
    if (*in.pairs.count == in.pairs.capacity) {
      ++stats.contacts_dropped;
      return;
    }
    SelfPair pair{particle, face, 0.0f, 0.0f};
    const SelfPair* before = old;
    while (before != old_end && before->face == face && before->particle != particle) ++before;
    if (before != old_end && before->face == face) {
      pair = *before;
    } else {
      pair.distance = std::min(in.distance, kRestShare * rest_distance(particle, face));
    }
    in.pairs.pairs[(*in.pairs.count)++] = pair;
  }

  float rest_distance(std::uint32_t particle, std::uint32_t face) const {
    const ConstVec3View rest = in.garment->rest_position.view();
    const Vec3 p = rest[particle], a = rest[in.garment->face_particle[0][face]],
               b = rest[in.garment->face_particle[1][face]], c = rest[in.garment->face_particle[2][face]];
    return length(closest_on_triangle(p, a, b, c).point(a, b, c) - p);
  }
};

}  // namespace

std::size_t SelfCandidates::cell_scratch_size(std::size_t particle_count) {
  return bucket_count(particle_count) + 1 + particle_count;
}

bool SelfCandidates::validate() const {
  return garment != nullptr && position.x != nullptr && previous.x != nullptr && distance >= 0.0f &&
         pairs.pairs != nullptr && pairs.count != nullptr && sought_at.x != nullptr && pair_scratch != nullptr &&
         cell_scratch != nullptr;
}

void SelfCandidates::run(Stats& stats) const {
  const std::uint32_t count = garment->particle_count;
  const float margin = kMarginShare * garment->mean_edge_length;
  std::uint32_t kept = 0;
  if (*pairs.count != kNeverSought) {
    if (relative_motion(sought_at, position, count) <= 0.5f * margin) return;
    kept = *pairs.count;
    std::copy(pairs.pairs, pairs.pairs + kept, pair_scratch);
  }
  for (std::uint32_t i = 0; i < count; ++i) sought_at.set(i, previous[i]);

  // Far enough for this substep, however fast it is.
  const float motion = std::max(margin, 2.0f * relative_motion(previous, position, count));
  const float high = 2.0f * distance + motion, wide = kOverlapShare * garment->mean_edge_length + motion;
  const HashedGrid grid(previous, count, garment->mean_edge_length + 2.0f * std::max(high, wide), cell_scratch);
  *pairs.count = 0;
  Search search{*this, high, wide, grid, pair_scratch, pair_scratch + kept, stats};
  for (std::uint32_t f = 0; f < garment->face_count; ++f) search.search(f);
}

}  // namespace pleat
