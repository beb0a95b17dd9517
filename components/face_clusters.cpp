#include "components/face_clusters.h"

#include <algorithm>
#include <tuple>

namespace pleat {
namespace {

struct Clusters {
  Garment& garment;
  ConstVec3View rest = garment.rest_position.view();

  /// Three times the middle of a face.
  Vec3 place(std::uint32_t face) const {
    const auto& corner = garment.face_particle;
    return rest[corner[0][face]] + rest[corner[1][face]] + rest[corner[2][face]];
  }
  void part(std::uint32_t* begin, std::uint32_t* end) {
    const auto count = end - begin;
    if (count <= std::ptrdiff_t{kFacesPerCluster}) {
      std::sort(begin, end);
      garment.cluster_end.push_back(static_cast<std::uint32_t>(end - garment.clustered_faces.data()));
      return;
    }
    Vec3 low = place(*begin), high = low;
    for (const std::uint32_t* face = begin; face != end; ++face) {
      const Vec3 p = place(*face);
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    const Vec3 extent = high - low;
    float Vec3::*const longest = extent.x >= std::max(extent.y, extent.z) ? &Vec3::x
                                 : extent.y >= extent.z                   ? &Vec3::y
                                                                          : &Vec3::z;
    std::uint32_t* const middle = begin + count / 2;
    std::nth_element(begin, middle, end, [&](std::uint32_t a, std::uint32_t b) {
      return std::tuple(place(a).*longest, a) < std::tuple(place(b).*longest, b);
    });
    part(begin, middle);
    part(middle, end);
  }
};

}  // namespace

void find_face_clusters(Garment& garment) {
  garment.clustered_faces.resize(garment.face_count);
  for (std::uint32_t f = 0; f < garment.face_count; ++f) garment.clustered_faces[f] = f;
  garment.cluster_end.resize(0);
  Clusters{garment}.part(garment.clustered_faces.begin(), garment.clustered_faces.end());
}

}  // namespace pleat
