#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace pleat::demo {

/// What one column of a clip's frames moves: x, y, z of a position, then of a rotation.
enum class Channel { kPositionX, kPositionY, kPositionZ, kRotationX, kRotationY, kRotationZ };

/// A joint of a skeleton. Lengths are in the file's units, see kMetresPerUnit.
struct Joint {
  std::string name;                         ///< unique in its skeleton
  int parent = -1;                          ///< index of a joint that comes earlier; -1: the root
  Eigen::Vector3d offset;                   ///< from the parent, at rest; a position channel replaces its component
  std::vector<Channel> channels;            ///< in file order; rotations multiply left to right
  std::size_t first_column = 0;             ///< of this joint's channels in a frame
  std::optional<Eigen::Vector3d> end_site;  ///< where the bone of a last joint ends, from the joint
};

struct Skeleton {
  std::vector<Joint> joints;      ///< the root first, parents before children
  std::size_t channel_count = 0;  ///< of all joints: the columns of a frame
};

/// A recorded motion of a skeleton.
struct Clip {
  std::string name;  ///< the file it came from, for messages
  Skeleton skeleton;
  std::vector<double> frames;  ///< (frame_count, channel_count), row by row; file units and degrees
  double frame_time = 0;       ///< from one frame to the next, s

  std::size_t frame_count() const { return frames.size() / skeleton.channel_count; }
  /// From the first frame to the last, s.
  double duration() const { return frame_time * static_cast<double>(frame_count() - 1); }
};

/// Motion capture is written in centimetres.
inline constexpr double kMetresPerUnit = 0.01;

}  // namespace pleat::demo
