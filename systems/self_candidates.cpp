#include "systems/self_candidates.h"

#include <bit>

#include "systems/box.h"
#include "systems/closest_points.h"
#include "systems/contact_row.h"

namespace pleat {
namespace {

constexpr float kMarginShare = 0.25f;  // of the mean edge length
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
  float reach;
  HashedGrid grid;
  const SelfPair* old;  // pairs of the last search that are still ahead, in the order of their faces
  const SelfPair* old_end;
  Stats& stats;

  void search(std::uint32_t face) {
    const Prism prism(in, face, reach);
    while (old != old_end && old->face < face) ++old;
    const auto meet = [&](std::uint32_t particle) {
      if (prism.holds(in.previous[particle], particle)) add(particle, face);
    };
    const Cell low = grid.cell(prism.box.low), high = grid.cell(prism.box.high);
    const auto span = [](std::int32_t from, std::int32_t to) { return double(to) - double(from) + 1.0; };
    if (span(low.x, high.x) * span(low.y, high.y) * span(low.z, high.z) > in.garment->particle_count) {
      for (std::uint32_t i = 0; i < in.garment->particle_count; ++i) meet(i);
      return;
    }
    for (std::int32_t x = low.x; x <= high.x; ++x) {
      for (std::int32_t y = low.y; y <= high.y; ++y) {
        for (std::int32_t z = low.z; z <= high.z; ++z) grid.for_each_in({x, y, z}, meet);
      }
    }
  }

 private:
  /// The space over and under a face, `reach` beyond it on all sides.
  struct Prism {
    float reach;
    std::uint32_t corner[3];
    Vec3 x[3], normal, outward[3];
    Box box;

    Prism(const SelfCandidates& in, std::uint32_t face, float distance) : reach(distance) {
      for (int k = 0; k < 3; ++k) {
        corner[k] = in.garment->face_particle[k][face];
        x[k] = in.previous[corner[k]];
        box.include(x[k]);
      }
      box = box.grown(reach);
      normal = normalized_or(cross(x[1] - x[0], x[2] - x[0]), Vec3{});
      for (int k = 0; k < 3; ++k) outward[k] = normalized_or(cross(x[(k + 1) % 3] - x[k], normal), Vec3{});
    }
    bool holds(const Vec3& p, std::uint32_t particle) const {
      if (particle == corner[0] || particle == corner[1] || particle == corner[2] || !box.overlaps({p, p}))
        return false;
      if (std::abs(dot(p - x[0], normal)) > reach) return false;
      for (int k = 0; k < 3; ++k) {
        if (dot(p - x[k], outward[k]) > reach) return false;
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

  // Wide enough for this substep, however fast it is.
  const float reach =
      distance + kLeastContactMargin + std::max(margin, 2.0f * relative_motion(previous, position, count));
  const HashedGrid grid(previous, count, garment->mean_edge_length + 2.0f * reach, cell_scratch);
  *pairs.count = 0;
  Search search{*this, reach, grid, pair_scratch, pair_scratch + kept, stats};
  for (std::uint32_t f = 0; f < garment->face_count; ++f) search.search(f);
}

}  // namespace pleat
