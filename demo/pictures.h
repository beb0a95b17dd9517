#pragma once

#include <cstdint>

#include "demo/measure.h"
#include "demo/picture/image.h"
#include "demo/program/output.h"
#include "demo/scenes/scene_def.h"

namespace pleat::demo {

struct PictureSize {
  int width = 1280, height = 720;
};

/// Runs the scene once more and writes frame_0000.png ... and sheet.png, and video.mp4 where ffmpeg is there. `record`
/// tells the camera where to stand.
void draw_frames(const pleat_api& api, const SceneDef& def, const RunRecord& record, PictureSize size,
                 const OutputFolder& out);

/// Writes stages.png: how the surface comes about, in the frame whose edges are most compressed. Coarse triangles, PN
/// triangles, the full method, and its normals and displacements as sticks (the paper, figure 8).
void draw_stages(const pleat_api& api, const SceneDef& def, const RunRecord& record, PictureSize size,
                 const OutputFolder& out);

}  // namespace pleat::demo
