#pragma once

#include <cstddef>
#include <istream>
#include <string>

#include "demo/motion/clip.h"

namespace pleat::demo {

/// Reads a Biovision hierarchy: one skeleton of nested joints, then one line of numbers a frame.
/// Joints may have any channels in any order, or none. `name` stands for the file in messages and in the clip.
/// Throws InputError, naming the line, on anything that is not a whole, finite, reasonably small clip:
/// at most 4096 joints, 10 million numbers, no number beyond 1e7.
Clip read_bvh(std::istream& stream, const std::string& name);

/// The same from a file, without the frames before `first_frame` (recordings often start with a calibration pose).
Clip load_bvh(const std::string& path, std::size_t first_frame = 0);

}  // namespace pleat::demo
