#include "demo/picture/video.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace pleat::demo {
namespace {

// Starts ffmpeg with `input` as its standard input; no shell, so a path is never read as anything else. -1 on failure.
pid_t spawn_ffmpeg(const std::vector<std::string>& arguments, int input) {
  std::vector<char*> argv;
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = -1;
  const int error = posix_spawnp(&child, "ffmpeg", &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  return error == 0 ? child : -1;
}

}  // namespace

bool ffmpeg_available() {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (access((std::filesystem::path(folder) / "ffmpeg").c_str(), X_OK) == 0) return true;
  }
  return false;
}

Video::Video(const std::filesystem::path& path, int width, int height, double rate)
    : path_(std::filesystem::absolute(path)), part_(path_), width_(width), height_(height) {
  part_ += ".part";
  // A socket instead of a pipe: send() can be told not to raise SIGPIPE when ffmpeg has gone.
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) return;
  const std::string size = std::to_string(width) + "x" + std::to_string(height);
  ffmpeg_ = spawn_ffmpeg({"ffmpeg",
                          "-loglevel",
                          "error",
                          "-y",  //
                          "-f",
                          "rawvideo",
                          "-pix_fmt",
                          "rgba",
                          "-s",
                          size,
                          "-r",
                          std::to_string(rate),
                          "-i",
                          "-",  //
                          "-vf",
                          "crop=trunc(iw/2)*2:trunc(ih/2)*2,scale=out_color_matrix=bt709",  //
                          "-c:v",
                          "libx264",
                          "-crf",
                          "20",
                          "-pix_fmt",
                          "yuv420p",  //
                          "-colorspace",
                          "bt709",
                          "-color_primaries",
                          "bt709",
                          "-color_trc",
                          "bt709",  //
                          "-movflags",
                          "+faststart",
                          "-f",
                          "mp4",
                          "file:" + part_.string()},
                         ends[1]);
  close(ends[1]);
  pipe_ = ends[0];
}

Video::~Video() {
  if (pipe_ < 0) return;  // finished
  close(std::exchange(pipe_, -1));
  if (ffmpeg_ > 0) waitpid(ffmpeg_, nullptr, 0);
  std::error_code ignored;
  std::filesystem::remove(part_, ignored);
}

void Video::add(const Image& frame) {
  if (frame.width != width_ || frame.height != height_) {
    throw std::invalid_argument("video frame of " + std::to_string(frame.width) + "x" + std::to_string(frame.height) +
                                " in a video of " + std::to_string(width_) + "x" + std::to_string(height_));
  }
  for (std::size_t sent = 0; sent < frame.rgba.size();) {
    const ssize_t count = send(pipe_, frame.rgba.data() + sent, frame.rgba.size() - sent, MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return;  // finish() tells
    sent += static_cast<std::size_t>(count);
  }
}

bool Video::finish() {
  if (pipe_ < 0) return false;
  close(std::exchange(pipe_, -1));
  int status = -1;
  while (ffmpeg_ > 0 && waitpid(ffmpeg_, &status, 0) < 0 && errno == EINTR) {
  }
  std::error_code error;
  const bool whole = ffmpeg_ > 0 && WIFEXITED(status) && WEXITSTATUS(status) == 0;
  if (whole) std::filesystem::rename(part_, path_, error);
  if (whole && !error) return true;
  std::filesystem::remove(part_, error);
  return false;
}

}  // namespace pleat::demo
