// Which small triangles are drawn on a garment at one level of tessellation, and where each drawn vertex lies on the
// coarse mesh. Drawn vertices are shared: those at particles come first, then those on edges, then those inside faces,
// so that positions and normals agree across faces by construction and no crack can open.
//
//   fan      each face is split in four at its edges' midpoints; the three corner patches are drawn with 4 triangles,
//            the middle one as a fan of 6 around its centre: 18 in all (the paper, section 5)
//   n = 1..8 each of the four patches is drawn with n^2 triangles: 4 n^2 in all
//
// Shaded vertices are the drawn ones and, where creases are, twins of them: the same place with the normal of the other
// side. What moves the surface moves drawn vertices, of which there is one a place; what shades it, and the host's
// index buffer, goes by shaded vertices.
#pragma once

#include <array>
#include <cstdint>
#include <memory_resource>

#include "components/column.h"
#include "components/garment.h"

namespace pleat {

/// One vertex inside a face, the same for every face: `patch` 0..2 = the corner patch at corner 0..2, 3 = the middle.
/// `local` are its barycentrics in that patch (corner order below), `face` those in the whole face; both sum to 1.
///   patch 0: (V0, M01, M20)   patch 1: (V1, M12, M01)   patch 2: (V2, M20, M12)   middle: (M01, M12, M20)
struct InnerPoint {
  std::uint32_t patch;
  float local[3];
  float face[3];
  std::array<float, 6> bend;  // of the face's PN triangle, at `face`
  float fold[3];              // share of the fold over the face's edge 0, 1, 2 (1 on its middle, 0 at the corners)
};

struct TessellationPattern {
  explicit TessellationPattern(std::pmr::memory_resource* memory)
      : inner(memory),
        indices(memory),
        twins(memory),
        face_vertices(memory),
        face_shaded(memory),
        drawn_lanes(memory),
        shaded_lanes(memory),
        face_weights(memory),
        face_triangles(memory) {}

  std::uint32_t level = 0;     // 0 = fan
  std::uint32_t segments = 0;  // drawn segments on each coarse edge: 4 at the fan level, else 2 n
  std::uint32_t vertex_count = 0, triangle_count = 0;
  std::uint32_t first_edge_vertex = 0;  // = particle count; edge e owns segments - 1 vertices from its lower end on
  std::uint32_t first_face_vertex = 0;  // face f owns inner.size() vertices
  Column<InnerPoint> inner;
  Column<std::uint32_t> indices;  // 3 shaded vertices a drawn triangle, counter-clockwise like the face
  Column<std::uint32_t> twins;    // of which drawn vertex shaded vertex vertex_count + i is the twin

  // The same triangles as one list for all faces, over each face's own numbering of its vertices: the corners, then the
  // vertices along sides 0, 1 and 2 as the face runs, then the inner ones.
  std::uint32_t vertices_per_face = 0;
  Column<std::uint32_t> face_vertices;  // vertices_per_face a face: their drawn vertices
  Column<std::uint32_t> face_shaded;    // the same: their shaded vertices; empty where there are no twins
  // The same for kernels, kLanes faces at once: for each of their own numbers one vertex a face. What the last faces
  // leave empty repeats the last one.
  Column<std::uint32_t> drawn_lanes, shaded_lanes;
  Column<std::array<float, 3>> face_weights;  // their barycentrics in the face
  Column<std::uint32_t> face_triangles;       // 3 of a face's own numbers a triangle

  std::uint32_t shaded_count() const { return vertex_count + static_cast<std::uint32_t>(twins.size()); }
  /// The drawn vertex where a shaded one is.
  std::uint32_t place(std::uint32_t shaded) const {
    return shaded < vertex_count ? shaded : twins[shaded - vertex_count];
  }
  /// Of face `begin`, a multiple of kLanes, and those next to it.
  const std::uint32_t* drawn_of_faces(std::uint32_t begin) const {
    return drawn_lanes.data() + std::size_t{begin} * vertices_per_face;
  }
  const std::uint32_t* shaded_of_faces(std::uint32_t begin) const {
    return (twins.size() == 0 ? drawn_lanes : shaded_lanes).data() + std::size_t{begin} * vertices_per_face;
  }
  const std::uint32_t* shaded_vertices() const { return twins.size() == 0 ? face_vertices.data() : face_shaded.data(); }

  /// Of edge_vertex, as a fraction of the edge.
  float along_edge(std::uint32_t step) const { return static_cast<float>(step) / static_cast<float>(segments); }
  std::uint32_t edge_vertex(std::uint32_t edge, std::uint32_t step) const {  // step 1 .. segments - 1
    return first_edge_vertex + edge * (segments - 1) + (step - 1);
  }
  std::uint32_t face_vertex(std::uint32_t face, std::uint32_t inner_index) const {
    return first_face_vertex + face * static_cast<std::uint32_t>(inner.size()) + inner_index;
  }
};

inline constexpr std::uint32_t kMaxTessellationLevel = 8;
inline constexpr std::uint32_t kMaxVerticesPerFace =
    (2 * kMaxTessellationLevel + 1) * (2 * kMaxTessellationLevel + 2) / 2;

/// level: 0 (fan) .. 8. Throws std::bad_alloc.
TessellationPattern build_tessellation(const Garment& garment, std::uint32_t level, std::pmr::memory_resource* memory);

}  // namespace pleat
