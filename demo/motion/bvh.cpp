#include "demo/motion/bvh.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>
#include <string_view>

#include "demo/byte_order_mark.h"
#include "demo/input_error.h"

namespace pleat::demo {
namespace {

constexpr std::size_t kMaxJoints = 4096;
constexpr std::size_t kMaxNumbers = 10'000'000;
constexpr double kMaxMagnitude = 1e7;  // 100 km, or 28,000 turns: more is a broken file

constexpr std::array<std::string_view, 6> kChannelNames = {"Xposition", "Yposition", "Zposition",
                                                           "Xrotation", "Yrotation", "Zrotation"};

/// The text, as words, or as the words of one line; knows the line for messages.
class Text {
 public:
  Text(std::istream& stream, const std::string& name) : stream_(stream), name_(name) {}

  [[noreturn]] void fail(const std::string& message) const { throw InputError(name_, line_number_, message); }

  bool next_line() {
    if (!std::getline(stream_, line_)) {
      if (stream_.bad()) fail("cannot be read");
      rest_ = {};
      return false;
    }
    rest_ = line_;
    if (++line_number_ == 1 && rest_.starts_with(kByteOrderMark)) rest_.remove_prefix(kByteOrderMark.size());
    return true;
  }

  /// The next word of this line; empty at its end.
  std::string_view word_of_line() {
    constexpr std::string_view kBlank = " \t\r\v\f";
    rest_.remove_prefix(std::min(rest_.find_first_not_of(kBlank), rest_.size()));
    const std::string_view word = rest_.substr(0, rest_.find_first_of(kBlank));
    rest_.remove_prefix(word.size());
    return word;
  }

  /// The next word of the text.
  std::string_view word(const std::string& expected) {
    for (;;) {
      if (const auto found = word_of_line(); !found.empty()) return found;
      if (!next_line()) fail("the file ends where " + expected + " should be");
    }
  }

  void expect(const std::string& expected) {
    if (const auto found = word(expected); found != expected) fail("expected " + expected + ", found " + quoted(found));
  }

  double number(std::string_view word) const {
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size()) fail("expected a number, found " + quoted(word));
    if (!std::isfinite(value) || std::abs(value) > kMaxMagnitude) {
      fail(quoted(word) + " is not a finite number of sensible size");
    }
    return value;
  }

  std::size_t count(std::string_view word) const {
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size()) fail("expected a count, found " + quoted(word));
    return value;
  }

  /// A word of the file as it may stand in a message.
  static std::string quoted(std::string_view word) {
    constexpr std::size_t kLongest = 40;
    std::string text(1, '\'');
    text += word.substr(0, kLongest);
    std::ranges::replace_if(
        text, [](unsigned char c) { return std::iscntrl(c); }, '?');
    return text += word.size() > kLongest ? "...'" : "'";
  }

 private:
  std::istream& stream_;
  const std::string& name_;
  std::string line_;
  std::string_view rest_;  // of line_, not yet taken
  std::size_t line_number_ = 0;
};

Eigen::Vector3d read_offset(Text& text) {
  text.expect("OFFSET");
  Eigen::Vector3d offset;
  for (double& component : offset) component = text.number(text.word("a component of OFFSET"));
  return offset;
}

std::vector<Channel> read_channels(Text& text) {
  const std::size_t count = text.count(text.word("the number of channels"));
  if (count > kChannelNames.size()) text.fail("a joint has at most 6 channels, found " + std::to_string(count));
  std::vector<Channel> channels;
  for (std::size_t i = 0; i < count; ++i) {
    const auto word = text.word("a channel");
    const auto name = std::find(kChannelNames.begin(), kChannelNames.end(), word);
    if (name == kChannelNames.end()) text.fail("unknown channel " + Text::quoted(word));
    const auto channel = static_cast<Channel>(name - kChannelNames.begin());
    if (std::find(channels.begin(), channels.end(), channel) != channels.end()) {
      text.fail("channel " + Text::quoted(word) + " twice in one joint");
    }
    channels.push_back(channel);
  }
  return channels;
}

/// From the joint's name to its offset; the joint stays open.
int open_joint(Text& text, int parent, std::vector<Joint>& joints) {
  if (joints.size() == kMaxJoints) text.fail("more than " + std::to_string(kMaxJoints) + " joints");
  Joint joint;
  joint.name = text.word("the joint's name");
  joint.parent = parent;
  if (std::any_of(joints.begin(), joints.end(), [&](const Joint& other) { return other.name == joint.name; })) {
    text.fail("a second joint named " + Text::quoted(joint.name));
  }
  text.expect("{");
  joint.offset = read_offset(text);
  joints.push_back(std::move(joint));
  return static_cast<int>(joints.size()) - 1;
}

Skeleton read_skeleton(Text& text) {
  Skeleton skeleton;
  auto& joints = skeleton.joints;
  text.expect("HIERARCHY");
  text.expect("ROOT");
  int open = open_joint(text, -1, joints);
  while (open >= 0) {
    const auto word = text.word("}");
    Joint& joint = joints[static_cast<std::size_t>(open)];
    if (word == "JOINT") {
      open = open_joint(text, open, joints);
    } else if (word == "CHANNELS") {
      if (!joint.channels.empty()) text.fail("CHANNELS twice in joint " + Text::quoted(joint.name));
      joint.channels = read_channels(text);
      joint.first_column = skeleton.channel_count;
      skeleton.channel_count += joint.channels.size();
    } else if (word == "End") {
      if (joint.end_site) text.fail("End Site twice in joint " + Text::quoted(joint.name));
      text.expect("Site");
      text.expect("{");
      joint.end_site = read_offset(text);
      text.expect("}");
    } else if (word == "}") {
      open = joint.parent;
    } else {
      text.fail("expected CHANNELS, JOINT, End Site or }, found " + Text::quoted(word));
    }
  }
  if (skeleton.channel_count == 0) text.fail("no joint has a channel, so nothing can move");
  return skeleton;
}

void read_frames(Text& text, Clip& clip) {
  text.expect("MOTION");
  text.expect("Frames:");
  const std::size_t frame_count = text.count(text.word("the number of frames"));
  const std::size_t channel_count = clip.skeleton.channel_count;
  if (frame_count == 0) text.fail("a clip needs at least one frame");
  if (frame_count > kMaxNumbers / channel_count) {
    text.fail(std::to_string(frame_count) + " frames of " + std::to_string(channel_count) + " channels are too many");
  }
  text.expect("Frame");
  text.expect("Time:");
  clip.frame_time = text.number(text.word("the frame time"));
  if (clip.frame_time <= 0) text.fail("the frame time must be positive, found " + std::to_string(clip.frame_time));

  do {
    auto word = text.word_of_line();
    if (word.empty()) continue;
    if (clip.frame_count() == frame_count)
      text.fail("more than the declared " + std::to_string(frame_count) + " frames");
    std::size_t columns = 0;
    for (; !word.empty(); word = text.word_of_line(), ++columns) clip.frames.push_back(text.number(word));
    if (columns != channel_count) {
      text.fail("a frame of " + std::to_string(columns) + " numbers for " + std::to_string(channel_count) +
                " channels");
    }
  } while (text.next_line());
  if (clip.frame_count() != frame_count) {
    text.fail("the file ends after " + std::to_string(clip.frame_count()) + " of " + std::to_string(frame_count) +
              " frames");
  }
}

}  // namespace

Clip read_bvh(std::istream& stream, const std::string& name) {
  Text text(stream, name);
  Clip clip;
  clip.name = name;
  clip.skeleton = read_skeleton(text);
  read_frames(text, clip);
  return clip;
}

Clip load_bvh(const std::string& path, std::size_t first_frame) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw InputError(path, "cannot be opened");
  Clip clip = read_bvh(stream, path);
  if (first_frame >= clip.frame_count()) {
    throw InputError(path, "has no frame " + std::to_string(first_frame) + ", only " +
                               std::to_string(clip.frame_count()) + " frames from 0");
  }
  const auto dropped = static_cast<std::ptrdiff_t>(first_frame * clip.skeleton.channel_count);
  clip.frames.erase(clip.frames.begin(), clip.frames.begin() + dropped);
  return clip;
}

}  // namespace pleat::demo
