#include "tests/fuzz/host_script.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

namespace pleat::fuzz {
namespace {

constexpr std::uint32_t kMostCalls = 96, kMostSide = 7;
constexpr std::size_t kMostClothes = 3, kMostBodies = 4;

/// Takes arguments off the bytes; zeros when they have run out.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t count) : data_(data), left_(count) {}
  bool empty() const { return left_ == 0; }
  std::uint32_t byte() {
    if (left_ == 0) return 0;
    --left_;
    return *data_++;
  }
  std::uint32_t below(std::uint32_t end) { return byte() % end; }
  bool rarely() { return byte() == 0xff; }
  /// Everyday numbers mostly; now and then extreme ones, and any bits at all.
  float number(float usual = 1.0f) {
    constexpr float kInf = std::numeric_limits<float>::infinity();
    constexpr std::array kExtremes = {
        0.0f, 1e-45f, 1e-30f, 1e-9f, 1e-6f, 1e-3f, 1e3f,  1e5f,
        1e6f, 1e9f,   1e12f,  1e30f, 3e38f, kInf,  -kInf, std::numeric_limits<float>::quiet_NaN()};
    const std::uint32_t kind = byte();
    if (kind < 0xc0) return usual * (static_cast<float>(kind) - 96.0f) / 48.0f;
    if (kind < 0xfc) return kExtremes[kind % kExtremes.size()] * (kind & 32 ? -1.0f : 1.0f);
    std::uint32_t bits = 0;
    for (int k = 0; k < 4; ++k) bits = bits << 8 | byte();
    float value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  }
  /// Around `usual`, by powers of two.
  float scaled(float usual) {
    const std::uint32_t kind = byte();
    return kind < 0xe0 ? usual * std::exp2((static_cast<float>(kind) - 112.0f) / 8.0f) : number(usual);
  }
  void numbers(float* to, std::size_t count, float usual = 1.0f) {
    for (std::size_t i = 0; i < count; ++i) to[i] = number(usual);
  }

 private:
  const std::uint8_t* data_;
  std::size_t left_;
};

class Host {
 public:
  Host(const std::uint8_t* data, std::size_t count) : bytes_(data, count) {}
  ~Host() { api_.world_destroy(world_); }
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  Seen play() {
    make_world();
    make_garment();
    make_cloth();
    for (std::uint32_t i = 0; i < kMostCalls && !bytes_.empty() && seen_.fault.empty(); ++i) {
      call();
      look();
    }
    seen_.stats.size = sizeof seen_.stats;
    note(api_.world_stats(world_, &seen_.stats));
    return seen_;
  }

 private:
  void note(pleat_result result) {
    ++(result == PLEAT_OK ? seen_.accepted : seen_.refused);
    if (result == PLEAT_ERROR_INTERNAL) seen_.fault = "a call failed inside";
  }

  void make_world() {
    pleat_world_def def;
    note(api_.world_def_init(&def, sizeof def));
    def.log = [](std::uint32_t, const char*, void*) {};
    note(api_.world_create(&def, &world_));
    if (bytes_.below(2) == 1) set_air();
  }

  void make_garment() {
    pleat_shape_def shape;
    note(api_.shape_def_init(&shape, sizeof shape));
    shape.rows = 2 + bytes_.below(kMostSide);
    shape.columns = 2 + bytes_.below(kMostSide);
    shape.alternate = bytes_.below(2);
    std::uint32_t vertices = 0, triangles = 0;
    note(api_.shape_size(&shape, &vertices, &triangles));
    std::vector<float> x(3 * vertices), mass(vertices);
    std::vector<std::uint32_t> t(3 * triangles), pins;
    note(api_.shape_build(&shape, x.data(), t.data()));
    for (std::uint32_t n = bytes_.below(4); n > 0; --n) x[bytes_.byte() % x.size()] = bytes_.number();
    for (std::uint32_t n = bytes_.below(3); n > 0; --n) t[bytes_.byte() % t.size()] = bytes_.byte() % (vertices + 1);
    for (std::uint32_t n = bytes_.below(4); n > 0; --n) pins.push_back(bytes_.byte() % vertices);
    for (std::uint32_t n = bytes_.below(3); n > 0; --n) mass[bytes_.byte() % vertices] = bytes_.scaled(0.01f);
    pleat_garment_def def;
    note(api_.garment_def_init(&def, sizeof def));
    def.positions = x.data(), def.vertex_count = vertices;
    def.triangles = t.data(), def.triangle_count = triangles;
    def.pins = pins.data(), def.pin_count = static_cast<std::uint32_t>(pins.size());
    def.added_mass = mass.data();
    pleat_mesh_report report{};
    report.size = sizeof report;
    pleat_garment made{};
    const pleat_result result = api_.garment_create(world_, &def, &report, &made);
    note(result);
    if (result == PLEAT_OK) garment_ = made;
  }

  void change(pleat_cloth_settings& s) {
    float* const floats[] = {&s.density,       &s.stiffness,      &s.stretch_limit,    &s.bend_stiffness,
                             &s.edge_damping,  &s.bend_damping,   &s.air_damping,      &s.drag_coefficient,
                             &s.thickness,     &s.friction,       &s.lift_coefficient, &s.inner_friction,
                             &s.self_distance, &s.teleport_speed, &s.sleep_speed,      &s.buckling_strain};
    constexpr std::array kUsual = {0.2f,  30.0f, 0.01f, 1e-4f, 4.0f,  4.0f,  0.1f,  1.0f,
                                   0.01f, 0.3f,  0.5f,  0.1f,  0.01f, 50.0f, 0.01f, 0.01f};
    for (std::uint32_t n = bytes_.below(8); n > 0; --n) {
      const std::uint32_t k = bytes_.below(static_cast<std::uint32_t>(kUsual.size()));
      *floats[k] = bytes_.scaled(kUsual[k]);
    }
    if (bytes_.below(2) == 1) s.integrator = bytes_.below(6);
    if (bytes_.below(4) == 1) s.substeps = bytes_.below(66);
    if (bytes_.below(4) == 1) s.sweeps = bytes_.below(10);
    if (bytes_.below(2) == 1) s.surface = bytes_.below(8), s.level = bytes_.below(4);
    if (bytes_.below(4) == 1) s.tangents = bytes_.below(2), s.fold_sweeps = bytes_.below(9);
    if (bytes_.below(4) == 1) s.layer = bytes_.below(4);
    s.face_response = bytes_.below(2);
    if (bytes_.rarely()) s.collides_with = bytes_.below(4);
  }

  void make_cloth() {
    if (clothes_.size() == kMostClothes) return;
    pleat_cloth_def def;
    note(api_.cloth_def_init(&def, sizeof def));
    def.garment = garment_;
    change(def.settings);
    pleat_cloth made{};
    const pleat_result result = api_.cloth_create(world_, &def, &made);
    note(result);
    if (result == PLEAT_OK) clothes_.push_back(made);
  }

  /// Gone ones now and then, which have to be refused.
  template <class Id>
  Id any(const std::vector<Id>& ids) {
    const std::uint32_t k = bytes_.byte();
    if (ids.empty() || k == 0xff) return {k, 1};
    return ids[k % ids.size()];
  }
  template <class Id>
  static void forget(std::vector<Id>& ids, const Id& gone) {
    std::erase_if(ids, [&](const Id& id) { return id.index == gone.index && id.generation == gone.generation; });
  }

  std::uint32_t particles_of(pleat_cloth cloth) {
    pleat_cloth_info info{};
    info.size = sizeof info;
    return api_.cloth_info(world_, cloth, &info) == PLEAT_OK ? info.particles : 0;
  }

  void move_pins() {
    pleat_garment_info info{};
    info.size = sizeof info;
    note(api_.garment_info(world_, garment_, &info));
    std::vector<float> x(3 * info.pins + 3);
    bytes_.numbers(x.data(), 3 * info.pins, bytes_.scaled(0.5f));
    note(api_.cloth_move_pins(world_, any(clothes_), x.data(), 0, info.pins));
  }

  void write_particles() {
    const pleat_cloth cloth = any(clothes_);
    const std::uint32_t n = particles_of(cloth);
    std::vector<float> x(3 * n + 3), v(3 * n + 3);
    note(api_.cloth_read_particles(world_, cloth, x.data(), v.data(), n));
    const float size = bytes_.scaled(0.5f);
    for (std::uint32_t k = 1 + bytes_.below(16); n > 0 && k > 0; --k) {
      (bytes_.below(2) == 0 ? x : v)[bytes_.byte() % (3 * n)] = bytes_.number(size);
    }
    note(api_.cloth_write_particles(world_, cloth, x.data(), v.data(), n));
  }

  void teleport() {
    float from[3], to[3], rotation[4] = {0, 0, 0, 1};
    bytes_.numbers(from, 3), bytes_.numbers(to, 3, 10.0f);
    if (bytes_.below(2) == 1) {
      bytes_.numbers(rotation, 4);
      const float l = std::sqrt(rotation[0] * rotation[0] + rotation[1] * rotation[1] + rotation[2] * rotation[2] +
                                rotation[3] * rotation[3]);
      for (float& q : rotation) q /= l;
    }
    note(api_.cloth_teleport(world_, any(clothes_), from, to, bytes_.rarely() ? nullptr : rotation));
  }

  void make_body() {
    if (bodies_.size() == kMostBodies) return;
    pleat_collider_def def;
    note(api_.collider_def_init(&def, sizeof def));
    def.shape = bytes_.below(8);
    bytes_.numbers(def.a, 3, 0.5f), bytes_.numbers(def.b, 3, 0.5f);
    def.radius = bytes_.scaled(0.1f), def.radius_b = bytes_.scaled(0.1f);
    bytes_.numbers(def.position, 3, 0.5f);
    for (float& extent : def.half_extents) extent = bytes_.scaled(0.2f);
    float corners[18];
    bytes_.numbers(corners, 18, 0.5f);
    constexpr std::uint32_t kFaces[] = {0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1, 5, 2, 1, 5, 3, 2, 5, 4, 3, 5, 1, 4};
    def.positions = corners, def.vertex_count = 6;
    def.triangles = kFaces, def.triangle_count = 8;
    pleat_collider made{};
    const pleat_result result = api_.collider_create(world_, &def, &made);
    note(result);
    if (result == PLEAT_OK) bodies_.push_back(made);
  }

  void move_body() {
    const pleat_collider body = any(bodies_);
    float x[18], rotation[4] = {0, 0, 0, 1};
    bytes_.numbers(x, 18, 0.5f);
    note(api_.collider_move_capsule(world_, body, x, x + 3));
    note(api_.collider_move_mesh(world_, body, x, 0, 6));
    const float angle = x[3];
    rotation[0] = std::sin(angle), rotation[3] = std::cos(angle);
    note(api_.collider_move_rigid(world_, body, x, rotation));
  }

  void set_body() {
    const pleat_collider body = any(bodies_);
    pleat_collider_settings s{};
    s.size = sizeof s;
    note(api_.collider_get(world_, body, &s));
    s.friction = bytes_.scaled(0.5f), s.thickness = bytes_.scaled(0.01f);
    s.radius = bytes_.scaled(0.1f), s.radius_b = bytes_.scaled(0.1f);
    if (bytes_.rarely()) s.groups = bytes_.below(4);
    note(api_.collider_set(world_, body, &s));
    note(api_.collider_set_enabled(world_, body, bytes_.below(2)));
  }

  void set_air() {
    float v[3];
    bytes_.numbers(v, 3, 10.0f);
    note(bytes_.below(2) == 0 ? api_.world_set_wind(world_, v) : api_.world_set_gravity(world_, v));
    note(api_.world_set_gust(world_, bytes_.number(2.0f), bytes_.scaled(2.0f), bytes_.byte()));
  }

  void set_cloth() {
    const pleat_cloth cloth = any(clothes_);
    pleat_cloth_settings s{};
    s.size = sizeof s;
    note(api_.cloth_get(world_, cloth, &s));
    change(s);
    note(api_.cloth_set(world_, cloth, &s));
  }

  void save() {
    std::uint64_t bytes = 0;
    note(api_.world_state_size(world_, &bytes));
    saved_.resize(bytes);
    note(api_.world_save(world_, saved_.data(), bytes));
  }

  /// As it was saved, or with some of its bytes changed.
  void load() {
    std::vector<char> state = saved_;
    for (std::uint32_t n = bytes_.below(4); n > 0 && !state.empty(); --n) {
      const std::size_t high = bytes_.byte(), at = 256 * high + bytes_.byte();
      state[at % state.size()] = static_cast<char>(bytes_.byte());
    }
    note(api_.world_load(world_, state.data(), state.size()));
  }

  void call() {
    switch (bytes_.below(16)) {
      case 0:
        return make_cloth();
      case 1:
        return set_cloth();
      case 2:
        return move_pins();
      case 3:
        return write_particles();
      case 4:
        return teleport();
      case 5:
        return make_body();
      case 6:
        return move_body();
      case 7:
        return set_body();
      case 8:
        return set_air();
      case 9: {
        const pleat_cloth gone = any(clothes_);
        note(api_.cloth_destroy(world_, gone));
        return forget(clothes_, gone);
      }
      case 10: {
        const pleat_collider gone = any(bodies_);
        note(api_.collider_destroy(world_, gone));
        return forget(bodies_, gone);
      }
      case 11: {
        pleat_contact_report report{};
        report.size = sizeof report;
        return note(api_.cloth_contact_report(world_, any(clothes_), &report));
      }
      case 12:
        note(api_.garment_destroy(world_, garment_));
        return bytes_.below(2) == 0 ? save() : load();
      case 13:
        return note(api_.cloth_set_visible(world_, any(clothes_), bytes_.below(2)));
      default:
        return note(api_.world_step(world_, bytes_.scaled(1.0f / 60)));
    }
  }

  void look() {
    for (const pleat_cloth cloth : clothes_) {
      pleat_cloth_info info{};
      info.size = sizeof info;
      note(api_.cloth_info(world_, cloth, &info));
      std::vector<float> x(3 * info.particles), v(3 * info.particles), drawn(6 * info.drawn_vertices);
      note(api_.cloth_read_particles(world_, cloth, x.data(), v.data(), info.particles));
      pleat_vertex_target target;
      note(api_.vertex_target_init(&target, sizeof target));
      target.data = drawn.data(), target.stride = 24, target.capacity = info.drawn_vertices;
      target.position_offset = 0, target.normal_offset = 12;
      note(api_.cloth_read_vertices(world_, cloth, &target));
      std::vector<float> corners(6);
      note(api_.cloth_bounds(world_, cloth, corners.data(), corners.data() + 3));
      std::vector<std::uint16_t> packed(6 * info.drawn_vertices);
      target.data = packed.data(), target.stride = 12, target.normal_offset = 6;
      target.position_format = target.normal_format = PLEAT_FORMAT_16;
      note(api_.cloth_read_vertices(world_, cloth, &target));
      need_finite("a corner of the bounds", corners);
      need_finite("a position", x), need_finite("a velocity", v), need_finite("the drawn surface", drawn);
    }
  }
  void need_finite(const char* what, const std::vector<float>& values) {
    const bool finite = std::all_of(values.begin(), values.end(), [](float x) { return std::isfinite(x); });
    if (!finite && seen_.fault.empty()) seen_.fault = std::string(what) + " is not finite";
  }

  const pleat_api& api_ = *pleat_get_api(PLEAT_API_MAJOR);
  Bytes bytes_;
  Seen seen_;
  pleat_world* world_ = nullptr;
  pleat_garment garment_{};
  std::vector<pleat_cloth> clothes_;
  std::vector<pleat_collider> bodies_;
  std::vector<char> saved_;
};

}  // namespace

Seen play(const std::uint8_t* bytes, std::size_t count) { return Host(bytes, count).play(); }

}  // namespace pleat::fuzz
