#include "demo/pictures.h"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <string>

#include "demo/picture/renderer.h"
#include "demo/picture/sheet.h"
#include "demo/picture/video.h"
#include "demo/program/progress.h"
#include "demo/scenes/scene.h"
#include "demo/view.h"

namespace pleat::demo {
namespace {

constexpr uint32_t kSheetCells = 12;
constexpr int kSheetColumns = 4, kSheetWidth = 480, kStagesWidth = 640, kStagesHeight = 4096;  // pixels

template <typename... Values>
std::string text(const char* format, Values... values) {
  char line[128];
  std::snprintf(line, sizeof line, format, values...);
  return line;
}

float aspect(PictureSize size) { return float(size.width) / float(size.height); }

void add_stick(const float from[3], const float to[3], uint32_t rgba, void* user) {
  static_cast<std::vector<Stick>*>(user)->push_back(
      {Eigen::Vector3f(from[0], from[1], from[2]), Eigen::Vector3f(to[0], to[1], to[2]), rgba, 3.0f});
}

constexpr uint32_t kShownSticks = PLEAT_DEBUG_BASE_NORMALS | PLEAT_DEBUG_FORCE_NORMALS | PLEAT_DEBUG_EDGE_LENGTH;

/// One of the pictures of stages.png: the scene runs again to the frame, with the surface that the picture shows.
class StagePainter {
 public:
  StagePainter(const pleat_api& api, const SceneDef& def, const RunRecord& record, PictureSize size)
      : api_(api), def_(def), record_(record), size_(size), renderer_(size.width, size.height) {}

  Cell coarse() {
    return paint(PLEAT_SURFACE_FLAT, text("coarse: %zu triangles", record_.cloths * record_.garment.triangles),
                 [](View& view, Scene& scene) { return view.coarse(scene); });
  }

  Cell surface(uint32_t surface, const char* label) {
    return paint(surface, text("%s: %zu triangles", label, record_.cloths * record_.cloth.drawn_triangles),
                 [](View& view, Scene& scene) { return view.frame(scene); });
  }

  Cell sticks(uint32_t surface) {
    return paint(
        surface, "normals before (yellow) and after (orange), edge length (purple)", [this](View& view, Scene& scene) {
          Frame frame = view.coarse(scene);  // not the surface, so that no stick hides under it
          scene.check(api_.world_debug_draw(scene.world(), kShownSticks, add_stick, &frame.sticks), "debug drawing");
          return frame;
        });
  }

 private:
  Cell paint(uint32_t surface, const std::string& label, auto compose) {
    SceneDef def = def_;
    def.settings.surface = surface;
    Scene scene(api_, std::move(def));
    Progress progress("drawing stages, frame", record_.most_compressed_frame);
    while (scene.frame() < record_.most_compressed_frame) {
      scene.advance();
      progress.step();
    }
    View view(scene, cloth_box(scene), aspect(size_));
    const int width = std::min({size_.width, kStagesWidth, size_.width * kStagesHeight / size_.height});
    return {shrink(renderer_.draw(compose(view, scene)), width), label};
  }

  const pleat_api& api_;
  const SceneDef& def_;
  const RunRecord& record_;
  PictureSize size_;
  Renderer renderer_;
};

}  // namespace

void draw_frames(const pleat_api& api, const SceneDef& def, const RunRecord& record, PictureSize size,
                 const OutputFolder& out) {
  Scene scene(api, def);
  View view(scene, record.seen, aspect(size));
  Renderer renderer(size.width, size.height);
  std::optional<Video> video;
  if (ffmpeg_available()) video.emplace(out.part("video.mp4"), size.width, size.height, def.rate);
  std::vector<Cell> cells;
  Progress progress("drawing, frame", def.frames);
  for (uint32_t i = 0; i < def.frames; ++i) {
    scene.advance();
    const Image image = renderer.draw(view.frame(scene));
    write_png(out.part(text("frame_%04u.png", i)), image);
    if (video) video->add(image);
    const uint32_t due = uint32_t(uint64_t(cells.size()) * def.frames / std::min(kSheetCells, def.frames));
    if (i == due) {
      cells.push_back(
          {shrink(image, std::min(size.width / 2, kSheetWidth)), text("frame %u, %.2f s", i, (i + 1) / def.rate)});
    }
    progress.step();
  }
  write_png(out.part("sheet.png"), contact_sheet(cells, kSheetColumns), PngEffort::kSmall);
  if (!video) std::fputs("no video: ffmpeg is not on the PATH (Debian: apt install ffmpeg)\n", stderr);
  if (video && !video->finish()) std::fputs("no video: ffmpeg failed\n", stderr);
}

void draw_stages(const pleat_api& api, const SceneDef& def, const RunRecord& record, PictureSize size,
                 const OutputFolder& out) {
  const uint32_t full = def.settings.surface == PLEAT_SURFACE_PAPER ? PLEAT_SURFACE_PAPER : PLEAT_SURFACE_PLEAT;
  StagePainter painter(api, def, record, size);
  const std::vector<Cell> cells = {painter.coarse(), painter.surface(PLEAT_SURFACE_PN, "curved (PN)"),
                                   painter.surface(full, "normal and edge length control"), painter.sticks(full)};
  write_png(out.part("stages.png"), contact_sheet(cells, 2), PngEffort::kSmall);
}

}  // namespace pleat::demo
