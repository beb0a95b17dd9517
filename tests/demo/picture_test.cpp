// The renderer, seen through its pictures; the camera; what a frame may not hold.
#include <gtest/gtest.h>
#include <png.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "demo/picture/light.h"
#include "demo/picture/renderer.h"

namespace pleat::demo {
namespace {

using Eigen::Vector3f;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// A square in the xy plane that faces +z.
Mesh square(float half) {
  Mesh mesh;
  for (const auto& [x, y] : {std::pair{-half, -half}, {half, -half}, {half, half}, {-half, half}}) {
    mesh.vertices.insert(mesh.vertices.end(), {x, y, 0, 0, 0, 1});
  }
  mesh.indices = {0, 1, 2, 0, 2, 3};
  return mesh;
}

// A quarter of a wavy tube, open to the viewer: folds, both sides and shadow in one.
Mesh curved_sheet() {
  constexpr int kColumns = 48, kRows = 8;
  Mesh mesh;
  for (int row = 0; row <= kRows; ++row) {
    for (int column = 0; column <= kColumns; ++column) {
      const float u = static_cast<float>(column) / kColumns, v = static_cast<float>(row) / kRows;
      const float angle = (0.2f + 1.3f * u) * std::numbers::pi_v<float>, radius = 0.5f + 0.06f * std::sin(9 * angle);
      const Vector3f p(radius * std::cos(angle), 0.3f + 0.6f * v, -radius * std::sin(angle));
      const float slope = 0.54f * std::cos(9 * angle);  // of the radius
      const Vector3f n(radius * std::cos(angle) + slope * std::sin(angle), 0,
                       -radius * std::sin(angle) + slope * std::cos(angle));
      mesh.vertices.insert(mesh.vertices.end(), p.begin(), p.end());
      mesh.vertices.insert(mesh.vertices.end(), n.begin(), n.end());
    }
  }
  for (std::uint32_t row = 0; row < kRows; ++row) {
    for (std::uint32_t column = 0; column < kColumns; ++column) {
      const std::uint32_t a = row * (kColumns + 1) + column, b = a + 1, c = a + kColumns + 1, d = c + 1;
      mesh.indices.insert(mesh.indices.end(), {a, b, d, a, d, c});
    }
  }
  return mesh;
}

Frame example() {
  Frame frame;
  frame.ground = 0.0f;
  frame.capsules = {{{0.1f, 0.15f, 0.0f}, {0.0f, 0.8f, 0.1f}, 0.12f}};
  frame.meshes = {curved_sheet()};
  frame.sticks = {{{-0.6f, 0.1f, 0.5f}, {0.6f, 0.1f, 0.5f}, 0xe0a010ff, 3}};
  frame.camera = frame_box(bounds(frame), {0.3f, 0.4f, 1}, 0.5f, 16.0f / 9);
  return frame;
}

Image read_png(const std::filesystem::path& path) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  Image image;
  if (!png_image_begin_read_from_file(&png, path.c_str())) return image;
  png.format = PNG_FORMAT_RGBA;
  image = make_image(static_cast<int>(png.width), static_cast<int>(png.height), 0);
  png_image_finish_read(&png, nullptr, image.rgba.data(), 0, nullptr);
  return image;
}

// Takes its time, unlike write_png.
void write_small_png(const std::filesystem::path& path, const Image& image) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width);
  png.height = static_cast<png_uint_32>(image.height);
  png.format = PNG_FORMAT_RGBA;
  png_image_write_to_file(&png, path.c_str(), 0, image.rgba.data(), 0, nullptr);
}

int brightness(const Image& image, int x, int y) {
  const std::uint8_t* p = image.pixel(x, y);
  return p[0] + p[1] + p[2];
}

// Brightness where the camera sees a point of the world.
int brightness_at(const Image& image, const Camera& camera, const Vector3f& point) {
  const float aspect = static_cast<float>(image.width) / static_cast<float>(image.height);
  const Eigen::Vector4f clip = view_projection(camera, aspect, 0.1f, 100) * point.homogeneous();
  const float x = (clip.x() / clip.w() * 0.5f + 0.5f) * static_cast<float>(image.width);
  const float y = (0.5f - clip.y() / clip.w() * 0.5f) * static_cast<float>(image.height);
  return brightness(image, static_cast<int>(x), static_cast<int>(y));
}

TEST(PictureGolden, LooksAsItDid) {
  const Image image = Renderer(224, 126).draw(example());
  const std::filesystem::path path = std::filesystem::path(PLEAT_GOLDEN_DIR) / "picture.png";
  if (std::getenv("PLEAT_UPDATE_GOLDEN")) write_small_png(path, image);
  const Image golden = read_png(path);
  ASSERT_EQ(golden.width, image.width) << "no golden picture " << path;
  ASSERT_EQ(golden.height, image.height);
  double sum = 0;
  int far_off = 0;
  for (std::size_t i = 0; i < image.rgba.size(); ++i) {
    const int difference = std::abs(image.rgba[i] - golden.rgba[i]);
    sum += difference;
    far_off += difference > 24;
  }
  EXPECT_LT(sum / static_cast<double>(image.rgba.size()), 0.5);
  EXPECT_LT(far_off / static_cast<double>(image.rgba.size()), 0.002);
}

TEST(Picture, IsTheSameEachTime) {
  Renderer renderer(160, 90), other(90, 160);
  const Image first = renderer.draw(example());
  other.draw(example());  // a second context on the thread leaves the first alone
  EXPECT_EQ(renderer.draw(example()).rgba, first.rgba);
}

TEST(Picture, IsOpaque) {
  const Image image = Renderer(16, 16).draw(Frame{});
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) ASSERT_EQ(image.rgba[i], 255);
}

TEST(Picture, BallThrowsItsShadowAwayFromTheKeyLight) {
  const Vector3f centre(0, 0.8f, 0);
  Frame frame;
  frame.ground = 0.0f;
  frame.camera = {{0, 3, 6}, {0, 0.4f, 0}, {0, 1, 0}, 0.6f};
  Renderer renderer(320, 180);
  const Image bare = renderer.draw(frame);
  frame.capsules = {{centre, centre, 0.25f}};
  const Image shadowed = renderer.draw(frame);

  const Vector3f key = key_direction(frame.camera);
  const Vector3f in_shadow = centre - key * (centre.y() / key.y());
  const Vector3f towards_light(-in_shadow.x(), 0, -in_shadow.z());
  EXPECT_LT(brightness_at(shadowed, frame.camera, in_shadow), 0.88 * brightness_at(bare, frame.camera, in_shadow));
  EXPECT_EQ(brightness_at(shadowed, frame.camera, towards_light), brightness_at(bare, frame.camera, towards_light));
}

TEST(Picture, LitSquareDoesNotShadeItself) {
  Frame frame;
  frame.camera = {{0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 0.6f};
  frame.meshes = {square(1)};
  frame.meshes[0].front = 0x808080ff;
  const Image image = Renderer(160, 160).draw(frame);
  for (int y = 50; y < 110; ++y) {
    for (int x = 50; x < 110; ++x) {
      ASSERT_NEAR(brightness(image, x, y), brightness(image, x - 1, y), 6) << x << ' ' << y;
    }
  }
}

TEST(Picture, SidesHaveTheirOwnColours) {
  Frame frame;
  frame.camera = {{0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 0.6f};
  frame.meshes = {square(1)};
  frame.meshes[0].front = 0xff0000ff;
  frame.meshes[0].back = 0x0000ffff;
  Renderer renderer(64, 64);
  const Image front = renderer.draw(frame);
  frame.camera.eye = {0, 0, -4};
  const Image back = renderer.draw(frame);
  EXPECT_GT(front.pixel(32, 32)[0], front.pixel(32, 32)[2] + 50);
  EXPECT_GT(back.pixel(32, 32)[2], back.pixel(32, 32)[0] + 50);
  // Both sides are lit by the same rig.
  EXPECT_NEAR(front.pixel(32, 32)[0], back.pixel(32, 32)[2], 40);
}

TEST(Picture, FlatShadingIgnoresVertexNormals) {
  Frame frame;
  frame.camera = {{0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 0.6f};
  frame.meshes = {square(1)};
  Renderer renderer(64, 64);
  frame.meshes[0].flat = true;
  const Image plain = renderer.draw(frame);
  for (std::size_t i = 0; i < 4; ++i) frame.meshes[0].vertices[6 * i + 3] = i == 0 || i == 3 ? -2.0f : 2.0f;
  EXPECT_EQ(renderer.draw(frame).rgba, plain.rgba);
  frame.meshes[0].flat = false;
  const Image bent = renderer.draw(frame);
  EXPECT_GT(brightness(bent, 22, 32), brightness(bent, 42, 32) + 30);  // the left leans to the key light
}

TEST(Picture, SticksKeepTheirWidthInPixels) {
  Frame frame;
  frame.sticks = {{{-9, 0, 0}, {9, 0, 0}, 0xff0000ff, 6}};
  Renderer renderer(64, 64);
  for (const float distance : {2.0f, 20.0f}) {
    frame.camera = {{0, 0, distance}, {0, 0, 0}, {0, 1, 0}, 0.6f};
    const Image image = renderer.draw(frame);
    int rows = 0;
    for (int y = 0; y < image.height; ++y) rows += image.pixel(32, y)[1] < 100;
    EXPECT_NEAR(rows, 6, 1) << distance;
  }
}

TEST(Picture, StickThroughTheCameraIsCutNotDropped) {
  Frame frame;
  frame.camera = {{0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 0.6f};
  frame.sticks = {{{0, -0.3f, 0}, {0, -0.3f, 9}, 0xff0000ff, 4}};
  const Image image = Renderer(64, 64).draw(frame);
  EXPECT_LT(image.pixel(32, 60)[1], 100);
}

TEST(Picture, WireDrawsTheEdges) {
  Frame frame;
  frame.camera = {{0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 0.6f};
  frame.meshes = {square(0.8f)};
  Renderer renderer(200, 200);
  const Image plain = renderer.draw(frame);
  frame.meshes[0].wire = 0x000000ff;
  const Image wired = renderer.draw(frame);
  EXPECT_LT(brightness(wired, 100, 100), 0.8 * brightness(plain, 100, 100));  // the diagonal
  EXPECT_EQ(brightness(wired, 120, 130), brightness(plain, 120, 130));        // inside a triangle
}

TEST(Picture, RefusesWhatCannotBeDrawn) {
  const std::vector<std::pair<const char*, std::function<void(Frame&)>>> breaks = {
      {"camera", [](Frame& f) { f.camera.eye = f.camera.target; }},
      {"camera", [](Frame& f) { f.camera.up = f.camera.eye - f.camera.target; }},
      {"camera", [](Frame& f) { f.camera.eye.x() = kNan; }},
      {"field of view", [](Frame& f) { f.camera.fov_y = 0; }},
      {"field of view", [](Frame& f) { f.camera.fov_y = 4; }},
      {"ground", [](Frame& f) { f.ground = kNan; }},
      {"mesh 0: index 4242 of", [](Frame& f) { f.meshes[0].indices[1] = 4242; }},
      {"mesh 0: vertex 1 ", [](Frame& f) { f.meshes[0].vertices[7] = kNan; }},
      {"multiple of 6", [](Frame& f) { f.meshes[0].vertices.pop_back(); }},
      {"multiple of 3", [](Frame& f) { f.meshes[0].indices.pop_back(); }},
      {"capsule 0", [](Frame& f) { f.capsules[0].b.z() = std::numeric_limits<float>::infinity(); }},
      {"capsule 0: radius", [](Frame& f) { f.capsules[0].radius = -1; }},
      {"stick 0", [](Frame& f) { f.sticks[0].a.x() = kNan; }},
      {"stick 0: width", [](Frame& f) { f.sticks[0].width = 0; }},
  };
  validate(example());
  for (const auto& [what, damage] : breaks) {
    Frame frame = example();
    damage(frame);
    try {
      validate(frame);
      FAIL() << what << " was accepted";
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
    }
  }
  EXPECT_THROW(Renderer(0, 90), std::invalid_argument);
  EXPECT_THROW(Renderer(160, 8193), std::invalid_argument);
}

TEST(Picture, SurvivesEmptyTinyAndHugeThings) {
  Renderer renderer(64, 36);
  Frame frame = example();
  frame.meshes.push_back({});
  frame.capsules.push_back({{0, 0, 0}, {0, 0, 0}, 0});
  frame.sticks.push_back({{0, 1, 0}, {0, 1, 0}, 0xff0000ff});
  EXPECT_NO_THROW(renderer.draw(frame));
  frame.meshes[0].vertices[0] = 1e30f;
  EXPECT_NO_THROW(renderer.draw(frame));
}

TEST(Camera, FramesABoxTightly) {
  const Eigen::AlignedBox3f box(Vector3f(-1, 0, -0.5f), Vector3f(2, 1.5f, 0.5f));
  for (const float aspect : {0.5f, 1.0f, 16.0f / 9}) {
    for (const Vector3f& direction : {Vector3f(0, 0, 1), Vector3f(1, 0.5f, -1), Vector3f(-3, 2, 0.1f)}) {
      const Camera camera = frame_box(box, direction, 0.6f, aspect);
      EXPECT_TRUE(camera.target.isApprox(box.center()));
      EXPECT_GT((camera.eye - camera.target).normalized().dot(direction.normalized()), 0.9999f);
      float outermost = 0;
      for (int i = 0; i < 8; ++i) {
        const Vector3f corner = box.corner(static_cast<Eigen::AlignedBox3f::CornerType>(i));
        const Eigen::Vector4f clip = view_projection(camera, aspect, 0.1f, 100) * corner.homogeneous();
        outermost = std::max({outermost, std::abs(clip.x() / clip.w()), std::abs(clip.y() / clip.w())});
      }
      EXPECT_NEAR(outermost, 0.95f, 1e-3f);
    }
  }
  EXPECT_THROW(frame_box(Eigen::AlignedBox3f(), {0, 0, 1}, 0.6f, 1), std::invalid_argument);
  EXPECT_THROW(frame_box(box, {0, 1, 0}, 0.6f, 1), std::invalid_argument);
  EXPECT_THROW(frame_box(box, {kNan, 0, 1}, 0.6f, 1), std::invalid_argument);
}

}  // namespace
}  // namespace pleat::demo
