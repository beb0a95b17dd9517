#include "demo/compare.h"

#include <cstdio>
#include <memory>

#include "demo/input_error.h"
#include "demo/picture/renderer.h"
#include "demo/picture/sheet.h"
#include "demo/program/progress.h"
#include "demo/scenes/scene.h"
#include "demo/view.h"

namespace pleat::demo {
namespace {

constexpr float kCloseUp = 0.14f;    // m, half the side of what is seen
constexpr double kLeastSlant = 0.1;  // sine of the angle between a surface's normal and the vertical

struct Row {
  std::string label;
  SceneDef def;
};

uint32_t last_frame(const CompareOptions& options) { return options.first + options.every * (options.columns - 1); }

std::vector<Row> read_rows(const pleat_api& api, const CompareOptions& options) {
  std::vector<Row> rows;
  for (const std::string& label : options.rows) {
    SceneRequest request = options.scene;
    request.frames = last_frame(options);
    for (size_t begin = 0; begin <= label.size();) {
      const size_t end = std::min(label.find(',', begin), label.size());
      request.settings.push_back(label.substr(begin, end - begin));
      begin = end + 1;
    }
    rows.push_back({label, load_scene(api, request)});
  }
  return rows;
}

std::vector<std::unique_ptr<Scene>> start(const pleat_api& api, const std::vector<Row>& rows) {
  std::vector<std::unique_ptr<Scene>> scenes;
  for (const Row& row : rows) scenes.push_back(std::make_unique<Scene>(api, row.def));
  return scenes;
}

/// Calls `see(column)` in each frame shown.
template <class See>
void play(const CompareOptions& options, std::vector<std::unique_ptr<Scene>>& scenes, const char* what, See see) {
  Progress progress(what, last_frame(options));
  for (uint32_t column = 0; column < options.columns; ++column) {
    const uint32_t frame = options.first + column * options.every;
    while (scenes[0]->frame() < frame) {
      for (auto& scene : scenes) scene->advance();
      progress.step();
    }
    see(column);
  }
}

/// Cells are drawn at twice their size.
void check_size(const CompareOptions& options) {
  const int most = kMostDrawn / 2, columns = options.close_up ? int(options.rows.size()) : int(options.columns);
  const int rows = options.close_up ? 1 : int(options.rows.size());
  if (options.size.width > most || options.size.height > most) {
    throw InputError("--size", "should be at most " + std::to_string(most) + "x" + std::to_string(most));
  }
  const auto [width, height] = sheet_size(rows * columns, columns, options.size.width, options.size.height);
  if (width > kMostPixels || height > kMostPixels) {
    throw InputError("--size", "makes a picture of " + std::to_string(width) + "x" + std::to_string(height) +
                                   " pixels, at most " + std::to_string(kMostPixels) + " are possible");
  }
}

/// Where the cloth's first two drawings are furthest apart.
struct Difference {
  float distance = 0;  // m
  uint32_t column = 0;
  Eigen::Vector3d place = Eigen::Vector3d::Zero(),
                  normal = Eigen::Vector3d::UnitZ();  // relative to followed(); the normal of the second drawing
};

void look_for_difference(const Scene& a, const Scene& b, uint32_t column, Difference& largest) {
  DrawnSurface first = make_surface(a, 0), second = make_surface(b, 0);
  if (first.vertices.size() != second.vertices.size())
    throw InputError("--close-up", "the first two rows should have the same level");
  read_vertices(a, 0, first), read_vertices(b, 0, second);
  for (size_t v = 0; v < first.vertices.size(); ++v) {
    const Eigen::Vector3f x(first.vertices[v].position), y(second.vertices[v].position);
    if ((x - y).norm() <= largest.distance) continue;
    largest = {(x - y).norm(), column, y.cast<double>() - followed(b.def(), b.frame()),
               Eigen::Vector3f(second.vertices[v].normal).cast<double>()};
  }
}

}  // namespace

void compare(const pleat_api& api, const CompareOptions& options) {
  if (options.close_up && options.rows.size() < 2) throw InputError("--close-up", "two rows should be given");
  check_size(options);
  std::vector<Row> rows = read_rows(api, options);
  OutputFile out(options.out);  // what cannot be written is known before the long work

  Eigen::AlignedBox3d box;
  Difference difference;
  {
    std::vector<std::unique_ptr<Scene>> scenes = start(api, rows);
    play(options, scenes, "looking, frame", [&](uint32_t column) {
      for (auto& scene : scenes) box.extend(cloth_box(*scene));
      if (options.close_up) look_for_difference(*scenes[0], *scenes[1], column, difference);
    });
  }
  if (options.close_up) {
    if (difference.distance == 0.0f) throw InputError("--close-up", "the first two rows look the same in all frames");
    std::printf("rows differ most in frame %u: by %.1f mm\n", options.first + difference.column * options.every,
                1e3 * double(difference.distance));
    const Eigen::Vector3d half = Eigen::Vector3d::Constant(double(kCloseUp));
    box = Eigen::AlignedBox3d(difference.place - half, difference.place + half);
    Eigen::Vector3d along = Eigen::Vector3d::UnitY().cross(difference.normal);
    if (along.norm() < kLeastSlant) along = Eigen::Vector3d::UnitX();  // it faces up or down
    for (Row& row : rows)
      row.def.view = difference.normal + along + Eigen::Vector3d(0, 0.3, 0);  // slanting, for relief
  }

  std::vector<std::unique_ptr<Scene>> scenes = start(api, rows);
  std::vector<std::vector<Cell>> cells(rows.size());
  Renderer renderer(2 * options.size.width, 2 * options.size.height);
  play(options, scenes, "drawing, frame", [&](uint32_t column) {
    if (options.close_up && column != difference.column) return;
    for (size_t r = 0; r < rows.size(); ++r) {
      View view(*scenes[r], box, float(options.size.width) / float(options.size.height));
      char time[32];
      std::snprintf(time, sizeof time, "%.2f s: ", scenes[r]->frame() / rows[r].def.rate);
      cells[r].push_back({shrink(renderer.draw(view.frame(*scenes[r])), options.size.width), time + rows[r].label});
    }
  });

  std::vector<Cell> sheet;
  for (const std::vector<Cell>& row : cells) sheet.insert(sheet.end(), row.begin(), row.end());
  out.commit(
      encode_png(contact_sheet(sheet, int(options.close_up ? rows.size() : options.columns)), PngEffort::kSmall));
  std::printf("picture       %s\n", options.out.c_str());
}

}  // namespace pleat::demo
