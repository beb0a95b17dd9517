#pragma once

#include <sys/types.h>

#include <filesystem>

#include "demo/picture/image.h"

namespace pleat::demo {

/// Whether a program `ffmpeg` is on PATH.
bool ffmpeg_available();

/// An H.264 film, frames of one size piped to ffmpeg. The file appears under its name only when whole; whatever goes
/// wrong, nothing half-written stays. ffmpeg's own complaints go to stderr. Unlike pictures a film is a convenience:
/// its failure is a return value, not an exception.
class Video {
 public:
  /// Starts ffmpeg. width and height in pixels (an odd last column or row is cut off), rate in frames per second.
  Video(const std::filesystem::path& path, int width, int height, double rate);
  ~Video();
  Video(const Video&) = delete;
  Video& operator=(const Video&) = delete;

  /// Hands a frame over; ignored once ffmpeg is gone. Errors: std::invalid_argument for a frame of another size.
  void add(const Image& frame);

  /// Waits for ffmpeg. True when the film is there.
  bool finish();

 private:
  std::filesystem::path path_, part_;
  int width_, height_;
  pid_t ffmpeg_ = -1;
  int pipe_ = -1;
};

}  // namespace pleat::demo
