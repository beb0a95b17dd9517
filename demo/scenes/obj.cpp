// Wavefront OBJ: `v x y z`, `vt u v`, `f a b c ...`, where a corner is v, v/vt, v//vn or v/vt/vn; indices count from 1,
// negative ones backwards from the last element read so far.
#include "demo/scenes/obj.h"

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <string_view>

#include "demo/byte_order_mark.h"
#include "demo/input_error.h"
#include "engine/pleat.h"

namespace pleat::demo {
namespace {

constexpr std::string_view kBlank = " \t\r";

/// Takes the next word off the front of `line`; empty at its end.
std::string_view take_word(std::string_view& line) {
  const size_t first = line.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return line = {};
  line.remove_prefix(first);
  const std::string_view word = line.substr(0, line.find_first_of(kBlank));
  line.remove_prefix(word.size());
  return word;
}

class ObjReader {
 public:
  explicit ObjReader(const std::string& name) : name_(name) {}

  TriangleMesh read(std::istream& stream) {
    for (std::string line; std::getline(stream, line);) {
      if (++line_ == 1 && line.starts_with(kByteOrderMark)) line.erase(0, kByteOrderMark.size());
      read_line(line);
    }
    if (stream.bad()) throw InputError(name_, line_, "cannot be read further");
    if (mesh_.positions.empty()) throw InputError(name_, "holds no vertex (no `v` line)");
    if (mesh_.triangles.empty()) throw InputError(name_, "holds no face (no `f` line)");
    if (any_uv_) mesh_.uvs = vertex_uvs();
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { throw InputError(name_, line_, message); }

  void read_line(std::string_view line) {
    const std::string_view keyword = take_word(line);
    if (keyword == "v") {
      for (int i = 0; i < 3; ++i) mesh_.positions.push_back(read_number(take_word(line), "vertex"));
      if (mesh_.vertex_count() > PLEAT_MAX_PARTICLES)
        fail("more than " + std::to_string(PLEAT_MAX_PARTICLES) + " vertices");
      uv_of_vertex_.push_back(kNoUv);
    } else if (keyword == "vt") {
      for (int i = 0; i < 2; ++i) uvs_.push_back(read_number(take_word(line), "texture coordinate"));
    } else if (keyword == "f") {
      read_face(line);
    }
  }

  float read_number(std::string_view word, const char* of_what) const {
    float value = 0.0f;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (word.empty()) fail(std::string("a ") + of_what + " lacks a number: is the file cut short?");
    if (error == std::errc::result_out_of_range && end == word.data() + word.size()) {
      const double wide = std::strtod(std::string(word).c_str(), nullptr);  // what is next to nothing is nothing
      if (std::abs(wide) < 1.0) return float(wide);
      fail(too_large(of_what, word));
    }
    if (error != std::errc() || end != word.data() + word.size()) {
      fail(std::string("a ") + of_what + " has `" + std::string(word) + "` where a number should be");
    }
    if (!std::isfinite(value)) fail(std::string("a ") + of_what + " is not finite: `" + std::string(word) + "`");
    return value;
  }

  static std::string too_large(const char* of_what, std::string_view word) {
    return std::string("a ") + of_what + " is out of range: `" + std::string(word) + "`";
  }

  /// Reads one `a/b/c` part off the front of a corner; nothing for an empty part.
  std::optional<long> take_index(std::string_view& corner, std::string_view whole) const {
    const std::string_view part = corner.substr(0, corner.find('/'));
    corner.remove_prefix(std::min(corner.size(), part.size() + 1));
    if (part.empty()) return std::nullopt;
    long index = 0;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), index);
    if (error != std::errc() || end != part.data() + part.size()) {
      fail("a face has `" + std::string(whole) + "` where a corner should be");
    }
    return index;
  }

  /// From the file's counting to ours. `count` elements were read so far.
  uint32_t resolve(long index, size_t count, const char* of_what) const {
    const long resolved = index < 0 ? long(count) + index : index - 1;
    if (index == 0 || resolved < 0 || resolved >= long(count)) {
      fail("a face uses " + std::string(of_what) + " " + std::to_string(index) + ", but only " + std::to_string(count) +
           " were read so far");
    }
    return uint32_t(resolved);
  }

  uint32_t read_corner(const std::string_view whole) {
    std::string_view rest = whole;
    const std::optional<long> position = take_index(rest, whole);
    if (!position) fail("a face has `" + std::string(whole) + "` where a corner should be");
    const uint32_t vertex = resolve(*position, mesh_.vertex_count(), "vertex");
    if (const std::optional<long> uv = take_index(rest, whole)) {
      const uint32_t index = resolve(*uv, uvs_.size() / 2, "texture coordinate");
      if (uv_of_vertex_[vertex] == kNoUv) uv_of_vertex_[vertex] = index;
      any_uv_ = true;
    }
    return vertex;
  }

  void read_face(std::string_view line) {
    uint32_t first = 0, previous = 0;
    int corners = 0;
    for (std::string_view word = take_word(line); !word.empty(); word = take_word(line)) {
      const uint32_t vertex = read_corner(word);
      if (corners == 0) first = vertex;
      if (corners >= 2) mesh_.triangles.insert(mesh_.triangles.end(), {first, previous, vertex});
      previous = vertex;
      ++corners;
    }
    if (corners < 3) fail("a face has " + std::to_string(corners) + " corners, at least 3 are needed");
    if (mesh_.triangle_count() > PLEAT_MAX_TRIANGLES)
      fail("more than " + std::to_string(PLEAT_MAX_TRIANGLES) + " triangles");
  }

  std::vector<float> vertex_uvs() const {
    std::vector<float> uvs(2 * mesh_.vertex_count(), 0.0f);
    for (size_t v = 0; v < mesh_.vertex_count(); ++v) {
      if (uv_of_vertex_[v] == kNoUv) continue;
      uvs[2 * v] = uvs_[2 * uv_of_vertex_[v]];
      uvs[2 * v + 1] = uvs_[2 * uv_of_vertex_[v] + 1];
    }
    return uvs;
  }

  static constexpr uint32_t kNoUv = 0xffffffffu;

  const std::string& name_;
  size_t line_ = 0;
  TriangleMesh mesh_;
  std::vector<float> uvs_;  // as in the file
  std::vector<uint32_t> uv_of_vertex_;
  bool any_uv_ = false;
};

}  // namespace

TriangleMesh read_obj(std::istream& stream, const std::string& name) { return ObjReader(name).read(stream); }

TriangleMesh load_obj(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw InputError(path, "cannot be opened");
  return read_obj(stream, path);
}

}  // namespace pleat::demo
