#include "demo/run.h"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>

#include "demo/measure.h"
#include "demo/report.h"

namespace pleat::demo {

void run(const pleat_api& api, const RunOptions& options) {
  const SceneDef def = load_scene(api, options.scene);
  // What cannot be written is known before the long work.
  std::optional<OutputFolder> out;
  std::optional<OutputFile> json;
  if (options.render) out.emplace(options.out);
  if (!options.json.empty()) json.emplace(options.json);

  const RunRecord record = measure(api, def);
  std::vector<std::filesystem::path> files;
  if (out) {
    draw_frames(api, def, record, options.size, *out);
    if (api.features & PLEAT_FEATURE_SMOOTHING) draw_stages(api, def, record, options.size, *out);
    files = out->commit();
  }
  if (json) json->commit(report_json(def, record, files));
  print_report(def, record);
  if (out) std::printf("pictures      %s (%zu files)\n", out->path().c_str(), files.size());
  if (json) std::printf("report        %s\n", options.json.c_str());
}

}  // namespace pleat::demo
