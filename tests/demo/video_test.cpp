// Films: with ffmpeg, without it, and with one that dies.
#include "demo/picture/video.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <stdexcept>

namespace pleat::demo {
namespace {

namespace fs = std::filesystem;

// Gives each test a folder of its own, and back the PATH that it may have changed.
class VideoFile : public testing::Test {
 protected:
  void SetUp() override {
    folder = fs::temp_directory_path() / ("pleat_video_test_" + std::to_string(getpid()));
    fs::create_directories(folder / "bin");
    fs::create_directories(folder / "out");
  }
  void TearDown() override {
    setenv("PATH", path.c_str(), 1);
    fs::remove_all(folder);
  }
  // A film of `count` frames; true when there is one.
  bool film(const fs::path& file, int width = 64, int height = 48, int count = 20) {
    Video video(file, width, height, 30);
    for (int i = 0; i < count; ++i)
      video.add(make_image(width, height, 0x102030ffu + 0x08000000u * static_cast<unsigned>(i)));
    return video.finish();
  }
  void use_fake_ffmpeg(const char* script) {
    std::ofstream(folder / "bin" / "ffmpeg") << "#!/bin/sh\n" << script << '\n';
    fs::permissions(folder / "bin" / "ffmpeg", fs::perms::owner_all);
    setenv("PATH", ((folder / "bin").string() + ":/bin:/usr/bin").c_str(), 1);
  }
  bool nothing_left() const { return fs::is_empty(folder / "out"); }

  fs::path folder;
  std::string path = std::getenv("PATH");
};

TEST_F(VideoFile, IsMadeWhateverItsName) {
  if (!ffmpeg_available()) GTEST_SKIP() << "ffmpeg is not installed";
  for (const char* name : {"plain.mp4", "two words; touch x '\"$(touch y)%d.mp4", "-y", "a:b.mp4"}) {
    EXPECT_TRUE(film(folder / "out" / name)) << name;
    EXPECT_GT(fs::file_size(folder / "out" / name), 500u);
  }
  EXPECT_TRUE(film(folder / "out" / "odd.mp4", 65, 47));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / "out"), {}), 5);
}

TEST_F(VideoFile, MissingFfmpegIsNoError) {
  setenv("PATH", (folder / "bin").c_str(), 1);
  EXPECT_FALSE(ffmpeg_available());
  EXPECT_FALSE(film(folder / "out" / "a.mp4"));
  EXPECT_TRUE(nothing_left());
  unsetenv("PATH");
  EXPECT_FALSE(ffmpeg_available());
}

TEST_F(VideoFile, FfmpegThatDiesLeavesNothing) {
  use_fake_ffmpeg("exit 1");
  EXPECT_TRUE(ffmpeg_available());
  EXPECT_FALSE(film(folder / "out" / "a.mp4", 640, 480));  // more than any buffer holds: the pipe breaks
  use_fake_ffmpeg("for last; do :; done; echo half > \"${last#file:}\"; cat > /dev/null; exit 1");
  EXPECT_FALSE(film(folder / "out" / "a.mp4"));
  EXPECT_TRUE(nothing_left());
}

TEST_F(VideoFile, FailureKeepsTheOldFilm) {
  std::ofstream(folder / "out" / "a.mp4") << "old";
  use_fake_ffmpeg("exit 1");
  EXPECT_FALSE(film(folder / "out" / "a.mp4"));
  EXPECT_EQ(fs::file_size(folder / "out" / "a.mp4"), 3u);
}

TEST_F(VideoFile, GivenUpLeavesNothing) {
  use_fake_ffmpeg("for last; do :; done; cat > \"${last#file:}\"");
  { Video(folder / "out" / "a.mp4", 64, 48, 30).add(make_image(64, 48, 0)); }
  EXPECT_TRUE(nothing_left());
}

TEST_F(VideoFile, RefusesAFrameOfAnotherSize) {
  use_fake_ffmpeg("cat > /dev/null");
  Video video(folder / "out" / "a.mp4", 64, 48, 30);
  EXPECT_THROW(video.add(make_image(64, 47, 0)), std::invalid_argument);
}

}  // namespace
}  // namespace pleat::demo
