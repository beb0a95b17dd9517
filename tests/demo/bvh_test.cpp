#include "demo/motion/bvh.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "demo/input_error.h"

namespace pleat::demo {
namespace {

const std::string kValid =
    "HIERARCHY\n"                                     // 1
    "ROOT hips\n"                                     // 2
    "{\n"                                             // 3
    "  OFFSET 1 2 3\n"                                // 4
    "  CHANNELS 6 Xposition Yposition Zposition "     //
    "Zrotation Xrotation Yrotation\n"                 // 5
    "  JOINT spine\n"                                 // 6
    "  {\n"                                           // 7
    "    OFFSET 0 10 0\n"                             // 8
    "    CHANNELS 3 Yrotation Xrotation Zrotation\n"  // 9
    "    End Site\n"                                  // 10
    "    {\n"                                         // 11
    "      OFFSET 0 5.5 0\n"                          // 12
    "    }\n"                                         // 13
    "  }\n"                                           // 14
    "  JOINT stump\n"                                 // 15
    "  {\n"                                           // 16
    "    OFFSET -1e1 0 0\n"                           // 17
    "    CHANNELS 0\n"                                // 18
    "  }\n"                                           // 19
    "}\n"                                             // 20
    "MOTION\n"                                        // 21
    "Frames: 2\n"                                     // 22
    "Frame Time: 0.04\n"                              // 23
    "0 90 0 10 20 30 1 2 3\n"                         // 24
    "0.5 91 0 11 21 31 -1.5e-1 0 4\n";                // 25

Clip read(const std::string& text) {
  std::istringstream stream(text);
  return read_bvh(stream, "clip.bvh");
}

/// The valid clip with one place changed.
std::string changed(const std::string& from, const std::string& to) {
  std::string text = kValid;
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(Bvh, ReadsSkeletonAndFrames) {
  const Clip clip = read(kValid);
  ASSERT_EQ(clip.skeleton.joints.size(), 3u);
  const auto& [hips, spine, stump] =
      std::tie(clip.skeleton.joints[0], clip.skeleton.joints[1], clip.skeleton.joints[2]);
  EXPECT_EQ(hips.name, "hips");
  EXPECT_EQ(hips.parent, -1);
  EXPECT_EQ(hips.offset, Eigen::Vector3d(1, 2, 3));
  EXPECT_FALSE(hips.end_site);
  EXPECT_EQ(spine.parent, 0);
  EXPECT_EQ(spine.first_column, 6u);
  EXPECT_EQ(spine.channels, (std::vector{Channel::kRotationY, Channel::kRotationX, Channel::kRotationZ}));
  EXPECT_EQ(spine.end_site, Eigen::Vector3d(0, 5.5, 0));
  EXPECT_EQ(stump.parent, 0);
  EXPECT_TRUE(stump.channels.empty());
  EXPECT_EQ(stump.offset, Eigen::Vector3d(-10, 0, 0));
  EXPECT_EQ(clip.frame_count(), 2u);
  EXPECT_EQ(clip.frame_time, 0.04);
  EXPECT_EQ(clip.duration(), 0.04);
  EXPECT_EQ(clip.frames[1], 90);
  EXPECT_EQ(clip.frames[15], -0.15);
}

TEST(Bvh, AcceptsWhatWritersDo) {
  std::string dos;
  for (const char c : kValid) dos += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(read(dos).frames, read(kValid).frames);
  EXPECT_EQ(read(kValid + "\n  \n").frame_count(), 2u) << "empty lines at the end";
  EXPECT_EQ(read(kValid.substr(0, kValid.size() - 1)).frame_count(), 2u) << "no newline at the end";
  EXPECT_EQ(read(changed("Frames: 2", "Frames:\t2")).frame_count(), 2u);
  EXPECT_EQ(read(changed("ROOT hips\n{", "ROOT hips {")).frame_count(), 2u);
  EXPECT_EQ(read("\xEF\xBB\xBF" + kValid).frames, read(kValid).frames) << "a byte order mark";
  EXPECT_EQ(read(changed("CHANNELS 0\n", "\n")).frame_count(), 2u) << "a joint may leave CHANNELS out";
}

struct Broken {
  std::string what;
  std::string text;
  int line;
  std::string says;
};

class BadBvh : public testing::TestWithParam<Broken> {};

TEST_P(BadBvh, IsRefusedWithItsLine) {
  const Broken& broken = GetParam();
  try {
    read(broken.text);
    FAIL() << broken.what << " was accepted";
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.rfind("clip.bvh:" + std::to_string(broken.line) + ": ", 0), 0u) << message;
    EXPECT_NE(message.find(broken.says), std::string::npos) << message;
  }
}

std::string many_joints() {
  std::string text = "HIERARCHY\n";
  for (int i = 0; i <= 4096; ++i) {
    text += (i == 0 ? "ROOT j" : "JOINT j") + std::to_string(i) + " { OFFSET 0 0 0\n";
  }
  return text;
}

INSTANTIATE_TEST_SUITE_P(
    One, BadBvh,
    testing::Values(
        Broken{"Empty", "", 0, "the file ends where HIERARCHY should be"},
        Broken{"OtherFormat", "glTF\x02", 1, "expected HIERARCHY, found 'glTF"},
        Broken{"ControlCharacters", "HIER\x1b[2J", 1, "found 'HIER?[2J'"},
        Broken{"NoRoot", changed("ROOT", "JOINT"), 2, "expected ROOT, found 'JOINT'"},
        Broken{"NoJoints", "HIERARCHY\nMOTION\nFrames: 1\nFrame Time: 1\n\n", 2, "expected ROOT, found 'MOTION'"},
        Broken{"NoOpeningBrace", changed("spine\n  {", "spine\n"), 8, "expected {, found 'OFFSET'"},
        Broken{"NoClosingBrace", changed("}\nMOTION", "MOTION"), 20, "found 'MOTION'"},
        Broken{"BraceTooMany", changed("}\nMOTION", "}\n}\nMOTION"), 21, "expected MOTION, found '}'"},
        Broken{"EndSiteOpen", changed("5.5 0\n    }", "5.5 0\n    JOINT"), 13, "expected }, found 'JOINT'"},
        Broken{"EndSiteTwice", changed("CHANNELS 0\n", "End Site { OFFSET 0 0 0 }\nEnd Site { OFFSET 0 0 0 }\n"), 19,
               "End Site twice"},
        Broken{"NoOffset", changed("    OFFSET 0 10 0\n", ""), 8, "expected OFFSET, found 'CHANNELS'"},
        Broken{"ShortOffset", changed("0 10 0", "0 10"), 9, "expected a number, found 'CHANNELS'"},
        Broken{"NanOffset", changed("0 10 0", "0 nan 0"), 8, "'nan' is not a finite number"},
        Broken{"DuplicateJoint", changed("stump", "spine"), 15, "a second joint named 'spine'"},
        Broken{"JointIsItsOwnParent", changed("JOINT spine", "JOINT hips"), 6, "a second joint named 'hips'"},
        Broken{"SecondRoot", changed("}\nMOTION", "}\nROOT other\nMOTION"), 21, "expected MOTION, found 'ROOT'"},
        Broken{"UnknownWord", changed("CHANNELS 0", "SCALE 2"), 18, "found 'SCALE'"},
        Broken{"UnknownChannel", changed("Yrotation Xrotation Zrotation", "Yrotation Xrotation Wrotation"), 9,
               "unknown channel 'Wrotation'"},
        Broken{"ChannelTwice", changed("Yrotation Xrotation Zrotation", "Yrotation Xrotation Xrotation"), 9,
               "'Xrotation' twice"},
        Broken{"ChannelsTwice", changed("    End Site", "    CHANNELS 1 Xposition\n    End Site"), 10,
               "CHANNELS twice"},
        Broken{"TooFewChannels", changed("CHANNELS 6", "CHANNELS 5"), 5, "found 'Yrotation'"},
        Broken{"TooManyChannels", changed("CHANNELS 3", "CHANNELS 4"), 10, "unknown channel 'End'"},
        Broken{"AbsurdChannels", changed("CHANNELS 3", "CHANNELS 7"), 9, "at most 6 channels"},
        Broken{"NegativeChannels", changed("CHANNELS 3", "CHANNELS -3"), 9, "expected a count, found '-3'"},
        Broken{"NothingMoves", "HIERARCHY\nROOT a {\nOFFSET 0 0 0\n}\nMOTION\nFrames: 1\nFrame Time: 1\n\n", 4,
               "no joint has a channel"},
        Broken{"NoMotion", kValid.substr(0, kValid.find("MOTION")), 20, "the file ends where MOTION should be"},
        Broken{"NoFrames", changed("Frames: 2", "Frames: 0"), 22, "at least one frame"},
        Broken{"NegativeFrames", changed("Frames: 2", "Frames: -2"), 22, "expected a count, found '-2'"},
        Broken{"AbsurdFrames", changed("Frames: 2", "Frames: 4000000000"), 22, "too many"},
        Broken{"OverflowingFrames", changed("Frames: 2", "Frames: 99999999999999999999"), 22, "expected a count"},
        Broken{"TooFewFrames", changed("Frames: 2", "Frames: 3"), 25, "ends after 2 of 3 frames"},
        Broken{"TooManyFrames", changed("Frames: 2", "Frames: 1"), 25, "more than the declared 1 frames"},
        Broken{"ZeroFrameTime", changed("0.04", "0"), 23, "must be positive"},
        Broken{"NegativeFrameTime", changed("0.04", "-0.04"), 23, "must be positive"},
        Broken{"NanFrameTime", changed("0.04", "nan"), 23, "'nan' is not a finite number"},
        Broken{"ShortFrame", changed("30 1 2 3", "30 1 2"), 24, "a frame of 8 numbers for 9 channels"},
        Broken{"LongFrame", changed("30 1 2 3", "30 1 2 3 4"), 24, "a frame of 10 numbers for 9 channels"},
        Broken{"FrameOnTimeLine", changed("0.04\n", "0.04 5\n"), 23, "a frame of 1 numbers for 9 channels"},
        Broken{"NanInFrame", changed("0 90 0", "0 NaN 0"), 24, "'NaN' is not a finite number"},
        Broken{"InfInFrame", changed("0 90 0", "0 -inf 0"), 24, "'-inf' is not a finite number"},
        Broken{"HugeInFrame", changed("0 90 0", "0 1e30 0"), 24, "sensible size"},
        Broken{"OutOfDouble", changed("0 90 0", "0 1e999 0"), 24, "expected a number"},
        Broken{"WordInFrame", changed("0 90 0", "0 9o 0"), 24, "expected a number, found '9o'"},
        Broken{"CutInFrame", kValid.substr(0, kValid.size() - 8), 25, "a frame of 7 numbers"},
        Broken{"LongWord", changed("hips\n", "hips\n" + std::string(100000, 'x')), 3, "xxx...'"},
        Broken{"ManyJoints", many_joints(), 4098, "more than 4096 joints"}),
    [](const auto& broken) { return broken.param.what; });

TEST(Bvh, EveryCutIsRefused) {
  const std::size_t last_frame = kValid.find("0.5 91");
  for (std::size_t length = 0; length < last_frame; ++length) {
    EXPECT_THROW(read(kValid.substr(0, length)), InputError) << "the first " << length << " characters";
  }
}

TEST(Bvh, LoadNamesTheFile) {
  try {
    load_bvh("no_such.bvh");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "no_such.bvh: cannot be opened");
  }
  EXPECT_THROW(load_bvh(testing::TempDir()), InputError) << "a folder";
}

TEST(Bvh, LoadLeavesOutTheFirstFrames) {
  const std::string kick = PLEAT_SCENES "/kick.bvh";
  const Clip whole = load_bvh(kick), rest = load_bvh(kick, 4);
  ASSERT_EQ(rest.frame_count(), whole.frame_count() - 4);
  EXPECT_EQ(rest.frames.front(), whole.frames[4 * whole.skeleton.channel_count]);
  EXPECT_EQ(load_bvh(kick, whole.frame_count() - 1).frame_count(), 1u);
  EXPECT_THROW(load_bvh(kick, whole.frame_count()), InputError);
}

TEST(Bvh, ReadsRecordings) {
  const std::string folder = PLEAT_SHARED_DATA "/mocap/";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no recordings in " << folder;
  const std::vector<std::pair<std::string, std::size_t>> files = {{"mass_kick", 231},
                                                                  {"mass_walk", 132},
                                                                  {"mass_run", 66},
                                                                  {"mass_pirouette", 485},
                                                                  {"mass_dance", 381},
                                                                  {"cmu_05_03_dance_arabesque", 435},
                                                                  {"cmu_13_13_forward_jump", 440}};
  for (const auto& [name, frame_count] : files) {
    const Clip clip = load_bvh(folder + name + ".bvh");
    EXPECT_EQ(clip.frame_count(), frame_count) << name;
    EXPECT_EQ(clip.frame_time, 0.00833333) << name;
  }
}

}  // namespace
}  // namespace pleat::demo
