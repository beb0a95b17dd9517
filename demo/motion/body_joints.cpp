#include "demo/motion/body_joints.h"

#include <cctype>
#include <span>
#include <string_view>

#include "demo/input_error.h"

namespace pleat::demo {
namespace {

/// What a part is called once its side is taken off, best name first.
using Names = std::span<const std::string_view>;
constexpr std::string_view kThigh[] = {"upleg", "thigh", "upperleg", "hip"};
constexpr std::string_view kShin[] = {"leg", "shin", "lowerleg", "calf", "knee"};
constexpr std::string_view kFoot[] = {"foot", "ankle"};
constexpr std::string_view kToes[] = {"toebase", "toe", "toes", "ball"};
// A shoulder that stands beside an arm is a clavicle.
constexpr std::string_view kUpperArm[] = {"arm", "upperarm", "uparm", "shldr", "shoulder"};
constexpr std::string_view kForearm[] = {"forearm", "lowerarm", "elbow"};
constexpr std::string_view kNeck[] = {"neck"};
constexpr std::string_view kHead[] = {"head"};
constexpr std::string_view kHand[] = {"hand", "wrist"};

bool upper(char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; }
bool lower(char c) { return std::islower(static_cast<unsigned char>(c)) != 0; }

/// `Character1_LeftUpLeg` -> character left up leg: split at case and at all that is no letter, in lower case.
std::vector<std::string> words_of(std::string_view name) {
  std::vector<std::string> words;
  bool begin = true;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const char c = name[i];
    if (!upper(c) && !lower(c)) {
      begin = true;
      continue;
    }
    if (upper(c) && i > 0 && (lower(name[i - 1]) || (i + 1 < name.size() && lower(name[i + 1])))) begin = true;
    if (begin) words.emplace_back();
    begin = false;
    words.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return words;
}

/// `leftupleg` for all spellings of the left upper leg, whatever stands before it; the last word where no side is said.
std::string canonical(std::string_view name) {
  const auto words = words_of(name);
  for (std::size_t i = 0; i < words.size(); ++i) {
    const bool left = words[i] == "left" || words[i] == "l";
    if (!left && words[i] != "right" && words[i] != "r") continue;
    std::string part;
    for (std::size_t j = i + 1; j < words.size(); ++j) part += words[j];
    if (part.empty() && i > 0) part = words[i - 1];  // thigh_l
    return (left ? "left" : "right") + part;
  }
  return words.empty() ? std::string() : words.back();
}

std::string joint_list(const Skeleton& skeleton) {
  constexpr std::size_t kLongest = 64;
  std::string list;
  for (std::size_t i = 0; i < skeleton.joints.size() && i < kLongest; ++i) {
    list += (i == 0 ? "" : ", ") + skeleton.joints[i].name;
  }
  return skeleton.joints.size() > kLongest ? list + ", ..." : list;
}

class Finder {
 public:
  explicit Finder(const Clip& clip) : clip_(clip) {
    for (const Joint& joint : joints()) canonical_.push_back(canonical(joint.name));
  }

  int find(const std::string& side, Names names, int ancestor = kNoJoint) const {
    for (const auto name : names) {
      const std::string wanted = side + std::string(name);
      for (std::size_t i = 0; i < canonical_.size(); ++i) {
        const int joint = static_cast<int>(i);
        if (canonical_[i] == wanted && (ancestor == kNoJoint || descends(joint, ancestor))) return joint;
      }
    }
    return kNoJoint;
  }

  int require(const std::string& side, const std::string& part, Names names, int ancestor = kNoJoint) const {
    const int joint = find(side, names, ancestor);
    if (joint == kNoJoint) {
      throw InputError(clip_.name,
                       "no joint for the " + side + " " + part + "; the joints are " + joint_list(clip_.skeleton));
    }
    return joint;
  }

  /// The last joint that carries both; kNoJoint where one is the root or carries the other.
  int common_ancestor(int a, int b) const {
    if (descends(a, b) || descends(b, a)) return kNoJoint;
    int joint = parent(a);
    while (joint != kNoJoint && !descends(b, joint)) joint = parent(joint);
    return joint;
  }

  bool descends(int joint, int ancestor) const {
    for (joint = parent(joint); joint != kNoJoint; joint = parent(joint)) {
      if (joint == ancestor) return true;
    }
    return false;
  }

 private:
  const std::vector<Joint>& joints() const { return clip_.skeleton.joints; }
  int parent(int joint) const { return joints()[static_cast<std::size_t>(joint)].parent; }

  const Clip& clip_;
  std::vector<std::string> canonical_;
};

}  // namespace

BodyJoints find_body_joints(const Clip& clip) {
  const Finder finder(clip);
  BodyJoints body;
  for (const Side side : kSides) {
    const std::string name = side == kLeft ? "left" : "right";
    Limb& leg = body.legs[side];
    leg.upper = finder.require(name, "hip joint", kThigh);
    leg.lower = finder.require(name, "knee", kShin, leg.upper);
    leg.end = finder.require(name, "foot", kFoot, leg.lower);
    body.toes[side] = finder.find(name, kToes, leg.end);

    Limb arm;
    arm.upper = finder.find(name, kUpperArm);
    arm.lower = arm.upper == kNoJoint ? kNoJoint : finder.find(name, kForearm, arm.upper);
    arm.end = arm.lower == kNoJoint ? kNoJoint : finder.find(name, kHand, arm.lower);
    if (arm.end != kNoJoint) body.arms[side] = arm;
  }
  body.hips = finder.common_ancestor(body.legs[kLeft].upper, body.legs[kRight].upper);
  if (body.hips == kNoJoint)
    throw InputError(clip.name,
                     "no hips joint: one leg hangs from the other; the joints are " + joint_list(clip.skeleton));
  body.neck = finder.find("", kNeck, body.hips);
  body.head = finder.find("", kHead, body.neck == kNoJoint ? body.hips : body.neck);
  return body;
}

}  // namespace pleat::demo
