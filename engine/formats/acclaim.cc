#include "engine/formats/acclaim.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "engine/base/angles.h"
#include "engine/base/names.h"
#include "engine/formats/acclaim_lines.h"

namespace etude {
namespace {

constexpr std::size_t kMaxBones = 1000;
constexpr double kCmuRateHz = 120;
constexpr double kMaxRadians = 4 * kPi;  // a larger angle must be in degrees

glm::dquat TurnAbout(int axis, double angle) {
  glm::dvec3 direction(0);
  direction[axis] = 1;
  return glm::angleAxis(angle, direction);
}

/// Returns the rotation by three angles about the axes that `order` names ("XYZ"); the rotation about the first axis is
/// applied first.
Result<glm::dquat> TurnInOrder(const glm::dvec3& angles, std::string_view order, const Place& place) {
  glm::dquat turn(1, 0, 0, 0);
  bool is_order = order.size() == 3;
  for (std::size_t i = 0; is_order && i < order.size(); ++i) {
    const int axis = (order[i] | 0x20) - 'x';
    is_order = axis >= 0 && axis < 3;
    if (is_order) turn = TurnAbout(axis, angles[static_cast<int>(i)]) * turn;
  }
  if (!is_order) return Fail(place, "found axes {}; allowed: an order such as XYZ", Quote(order));
  return turn;
}

std::optional<AcclaimSkeleton::Channel> ChannelNamed(std::string_view name) {
  if (name.size() != 2) return std::nullopt;
  const int kind = name[0] | 0x20, axis = (name[1] | 0x20) - 'x';
  if ((kind != 'r' && kind != 't') || axis < 0 || axis > 2) return std::nullopt;
  return AcclaimSkeleton::Channel{kind == 'r', axis};
}

struct AcclaimBone {
  std::string name;
  glm::dvec3 end{0};  ///< vector from the bone's beginning to its end, in the rest pose
  glm::dquat axes{1, 0, 0, 0};
  std::vector<AcclaimSkeleton::Channel> channels = {};
  glm::dvec3 begin{0};  ///< position of the root; 0 for all other bones
};

class SkeletonReader {
 public:
  /// If `is_told_degrees` is true, all angles are read as degrees, whatever unit the file states.
  SkeletonReader(std::string_view text, const std::string& file, bool is_told_degrees)
      : file_(file), lines_(text, file), is_told_degrees_(is_told_degrees) {}

  bool ExceedsRadians() const { return !in_degrees_ && largest_ > kMaxRadians; }

  Result<AcclaimSkeleton> Read() {
    bool has_line = lines_.Next();
    while (has_line) {
      if (!lines_.IsSection()) return Fail(lines_.At(), "found {}; allowed: a section such as :bonedata", Found());
      const std::string section(lines_.words.front().text.substr(1));
      Result<bool> read = section == "units"       ? ReadUnits()
                          : section == "root"      ? ReadRoot()
                          : section == "bonedata"  ? ReadBones()
                          : section == "hierarchy" ? ReadHierarchy()
                                                   : SkipSection();
      if (!read) return tl::unexpected(read.error());
      has_line = *read;
    }
    if (bones_.size() < 2)
      return Fail({file_}, "found no bones; allowed: an Acclaim skeleton with :root and :bonedata");
    return Assemble();
  }

 private:
  std::string Found() const { return Quote(lines_.words.front().text); }

  Result<bool> SkipSection() {
    while (lines_.Next()) {
      if (lines_.IsSection()) return true;
    }
    return false;
  }

  Result<bool> ReadUnits() {
    while (lines_.Next()) {
      if (lines_.IsSection()) return true;
      if (!lines_.Is("angle")) continue;
      const std::string_view unit = lines_.words.size() > 1 ? lines_.words[1].text : "";
      if (unit != "deg" && unit != "rad")
        return Fail(lines_.At(1), "found angles in {}; allowed: deg, rad", Quote(unit));
      in_degrees_ = is_told_degrees_ || unit == "deg";
    }
    return false;
  }

  double Radians(double angle) {
    largest_ = std::max(largest_, std::abs(angle));
    return in_degrees_ ? angle * kPi / 180 : angle;
  }

  Result<void> ReadChannels(AcclaimBone& bone) {
    bone.channels.clear();
    for (std::size_t i = 1; i < lines_.words.size(); ++i) {
      const auto channel = ChannelNamed(lines_.words[i].text);
      if (!channel)
        return Fail(lines_.At(i), "found channel {}; allowed: rx, ry, rz, tx, ty, tz", Quote(lines_.words[i].text));
      bone.channels.push_back(*channel);
    }
    return {};
  }

  Result<bool> ReadRoot() {
    AcclaimBone& root = bones_.front();
    // Read the root's channels, position and orientation, in any order.
    glm::dvec3 angles(0);
    std::string order = "XYZ";
    Place place = lines_.At();
    bool has_line = false;
    while ((has_line = lines_.Next()) && !lines_.IsSection()) {
      if (lines_.Is("order")) RETURN_IF_ERROR(ReadChannels(root));
      if (lines_.Is("axis") && lines_.words.size() > 1) {
        order = lines_.words[1].text;
        place = lines_.At(1);
      }
      if (lines_.Is("position")) {
        ASSIGN_OR_RETURN(root.begin, lines_.Vector(1));
      }
      if (lines_.Is("orientation")) {
        ASSIGN_OR_RETURN(angles, lines_.Vector(1));
      }
    }
    for (int i = 0; i < 3; ++i) angles[i] = Radians(angles[i]);
    ASSIGN_OR_RETURN(root.axes, TurnInOrder(angles, order, place));
    return has_line;
  }

  Result<void> ReadBone() {
    // Read the bone's properties up to 'end'.
    AcclaimBone bone;
    const Place place = lines_.At();
    glm::dvec3 direction(0);
    double length = 0;
    while (lines_.Next() && !lines_.Is("end")) {
      if (lines_.IsSection()) return Fail(lines_.At(), "the bone that begins on line {} has no 'end'", place.line);
      if (lines_.Is("name") && lines_.words.size() > 1) bone.name = lines_.words[1].text;
      if (lines_.Is("direction")) {
        ASSIGN_OR_RETURN(direction, lines_.Vector(1));
      }
      if (lines_.Is("length")) {
        ASSIGN_OR_RETURN(length, lines_.Number(1));
      }
      if (lines_.Is("dof")) RETURN_IF_ERROR(ReadChannels(bone));
      if (lines_.Is("axis")) {
        ASSIGN_OR_RETURN(auto angles, lines_.Vector(1));
        for (int i = 0; i < 3; ++i) angles[i] = Radians(angles[i]);
        const std::string_view order = lines_.words.size() > 4 ? lines_.words[4].text : "XYZ";
        ASSIGN_OR_RETURN(bone.axes, TurnInOrder(angles, order, lines_.At(4)));
      }
    }
    // Check and store the bone.
    if (bone.name.empty()) return Fail(place, "a bone without a name");
    if (FindBone(bone.name)) return Fail(place, "found the bone {} twice; allowed: once", Quote(bone.name));
    if (bones_.size() > kMaxBones) return Fail(place, "more than {} bones", kMaxBones);
    bone.end = direction * length;
    bones_.push_back(std::move(bone));
    return {};
  }

  Result<bool> ReadBones() {
    while (lines_.Next()) {
      if (lines_.IsSection()) return true;
      if (!lines_.Is("begin"))
        return Fail(lines_.At(), "found {}; allowed: 'begin', followed by the properties of a bone", Found());
      RETURN_IF_ERROR(ReadBone());
    }
    return false;
  }

  std::optional<std::size_t> FindBone(std::string_view name) const {
    const auto found = std::ranges::find(bones_, name, &AcclaimBone::name);
    return found == bones_.end() ? std::nullopt : std::optional<std::size_t>(found - bones_.begin());
  }

  Result<bool> ReadHierarchy() {
    while (lines_.Next()) {
      if (lines_.IsSection()) return true;
      if (lines_.Is("begin") || lines_.Is("end")) continue;
      std::vector<std::size_t> named;
      for (std::size_t i = 0; i < lines_.words.size(); ++i) {
        const auto bone = FindBone(lines_.words[i].text);
        if (!bone) return Fail(lines_.At(i), "there is no bone {}", Quote(lines_.words[i].text));
        if (i > 0 && (*bone == 0 || !parent_of_.emplace(*bone, named.front()).second)) {
          return Fail(lines_.At(i), "the bone {} already has a parent", Quote(lines_.words[i].text));
        }
        named.push_back(*bone);
      }
    }
    return false;
  }

  /// Builds the skeleton, with parents before their children.
  Result<AcclaimSkeleton> Assemble() const {
    AcclaimSkeleton made;
    made.in_degrees = in_degrees_;
    // Go down the hierarchy depth first; a bone without children gets an end site.
    std::map<std::size_t, int> joint_of;
    std::vector<std::size_t> waiting = {0};
    while (!waiting.empty()) {
      const std::size_t b = waiting.back();
      waiting.pop_back();
      const AcclaimBone& bone = bones_[b];
      const auto parent = parent_of_.find(b);
      const bool is_root = parent == parent_of_.end();
      joint_of[b] = static_cast<int>(made.skeleton.joints.size());
      made.skeleton.joints.push_back({.name = bone.name,
                                      .parent = is_root ? -1 : joint_of.at(parent->second),
                                      .rest = {.translation = is_root ? bone.begin : bones_[parent->second].end}});
      made.channels.push_back(bone.channels);
      made.axes.push_back(bone.axes);
      bool is_end = true;
      for (auto child = parent_of_.rbegin(); child != parent_of_.rend(); ++child) {
        if (child->second != b) continue;
        waiting.push_back(child->first);
        is_end = false;
      }
      if (!is_end) continue;
      made.skeleton.joints.push_back(
          {.name = bone.name + "_end", .parent = joint_of[b], .rest = {.translation = bone.end}, .is_end_site = true});
      made.channels.emplace_back();
      made.axes.emplace_back(1, 0, 0, 0);
    }
    // Every bone must have been reached from the root.
    if (joint_of.size() == bones_.size()) return made;
    const auto lost =
        std::ranges::find_if(bones_, [&](const AcclaimBone& bone) { return !joint_of.contains(*FindBone(bone.name)); });
    return Fail({file_}, "the bone {} has no parent; allowed: a :hierarchy that connects every bone to the root",
                Quote(lost->name));
  }

  std::string file_;
  AcclaimLines lines_;
  bool in_degrees_ = true, is_told_degrees_ = false;
  double largest_ = 0;  ///< largest angle read so far, in the file's unit
  std::vector<AcclaimBone> bones_ = {AcclaimBone{.name = "root"}};
  std::map<std::size_t, std::size_t> parent_of_;
};

/// Reads the line of one joint in a frame of a motion.
Result<LocalTransform> ReadTransform(const AcclaimLines& lines, const AcclaimSkeleton& skeleton, std::size_t joint,
                                     bool in_degrees, double& largest) {
  const auto& channels = skeleton.channels[joint];
  if (lines.words.size() != channels.size() + 1) {
    return Fail(lines.At(), "found {} numbers for bone {}; allowed: {}, one for each channel of the bone",
                lines.words.size() - 1, Quote(lines.words.front().text), channels.size());
  }
  LocalTransform local = skeleton.skeleton.joints[joint].rest;
  glm::dquat turn(1, 0, 0, 0);
  for (std::size_t i = 0; i < channels.size(); ++i) {
    ASSIGN_OR_RETURN(const double value, lines.Number(i + 1));
    if (channels[i].turns) {
      largest = std::max(largest, std::abs(value));
      turn = TurnAbout(channels[i].axis, in_degrees ? value * kPi / 180 : value) * turn;
    } else {
      local.translation[channels[i].axis] += value;
    }
  }
  const glm::dquat& axes = skeleton.axes[joint];
  local.rotation = axes * turn * glm::conjugate(axes);
  return local;
}

/// The frames of a motion, and the largest angles of its root and of all other bones in the file's unit.
struct AcclaimFrames {
  Clip clip;
  bool in_degrees = true;
  double of_root = 0, of_bones = 0;
  std::vector<std::string_view> still = {};  ///< bones with channels that have no values in any frame
  bool has_rate = false;
  std::vector<std::string_view> unknown = {};  ///< the first words of lines with ':' that are not used
};

/// Reads the frames. If `is_told_degrees` is true, all angles are read as degrees, whatever unit the file states.
Result<AcclaimFrames> ReadFrames(std::string_view text, const AcclaimSkeleton& skeleton, const std::string& file,
                                 bool is_told_degrees) {
  // Look up bones by their names.
  std::map<std::string_view, std::size_t> joint_of;
  for (std::size_t joint = 0; joint < skeleton.skeleton.joints.size(); ++joint) {
    if (!skeleton.skeleton.joints[joint].is_end_site) joint_of[skeleton.skeleton.joints[joint].name] = joint;
  }
  AcclaimFrames read{.clip = {.name = "acclaim", .skeleton = skeleton.skeleton, .rate_hz = kCmuRateHz, .frames = {}}};
  Clip& clip = read.clip;
  bool& in_degrees = read.in_degrees = is_told_degrees || skeleton.in_degrees;
  double last = 0;
  std::vector<std::size_t> counts(clip.skeleton.joints.size());  // number of frames in which each joint has values
  AcclaimLines lines(text, file);
  // A line is a directive, the number of the next frame, or the values of one bone.
  while (lines.Next()) {
    if (lines.IsSection()) {
      if (lines.IsSection(":DEGREES")) {
        in_degrees = true;
      } else if (lines.IsSection(":RADIANS")) {
        in_degrees = is_told_degrees;
      } else if (lines.IsSection(":SAMPLES-PER-SECOND")) {
        ASSIGN_OR_RETURN(clip.rate_hz, lines.Number(1));
        constexpr double kMinRate_hz = 0.1, kMaxRate_hz = 10'000;
        if (!(clip.rate_hz >= kMinRate_hz && clip.rate_hz <= kMaxRate_hz)) {
          return Fail(lines.At(1), "the rate is {:g} Hz; allowed: {:g} to {:g} Hz", clip.rate_hz, kMinRate_hz, kMaxRate_hz);
        }
        read.has_rate = true;
      } else if (!lines.IsSection(":FULLY-SPECIFIED")) {
        read.unknown.push_back(lines.words.front().text);
      }
    } else if (lines.words.size() == 1 && !joint_of.contains(lines.words.front().text)) {
      ASSIGN_OR_RETURN(const double number, lines.Number(0));
      if (!clip.frames.empty() && number != last + 1) {
        return Fail(lines.At(), "found frame {} after frame {}; allowed: frame numbers that increase by 1", number,
                    last);
      }
      last = number;
      // A frame takes the memory of all bones even if the file leaves some out, so limit the memory.
      constexpr double kMaxFrameBytes = 1e9;
      const double bytes = static_cast<double>(clip.frames.size() + 1) *
                           static_cast<double>(clip.skeleton.joints.size() * sizeof(LocalTransform));
      if (bytes > kMaxFrameBytes) {
        return Fail(lines.At(), "{} frames of {} joints take {:.0f} MB; allowed: at most {:.0f} MB",
                    clip.frames.size() + 1, clip.skeleton.joints.size(), bytes / 1e6, kMaxFrameBytes / 1e6);
      }
      clip.frames.push_back(RestPose(clip.skeleton));
    } else {
      const auto joint = joint_of.find(lines.words.front().text);
      if (joint == joint_of.end()) {
        return Fail(lines.At(), "the skeleton has no bone {}", Quote(lines.words.front().text));
      }
      if (clip.frames.empty()) return Fail(lines.At(), "found a bone before the number of the first frame");
      if (++counts[joint->second] != clip.frames.size()) {
        return Fail(lines.At(),
                    "bone {} appears twice in this frame, or is missing in an earlier frame; allowed: each bone once "
                    "in each frame",
                    Quote(joint->first));
      }
      ASSIGN_OR_RETURN(
          clip.frames.back()[joint->second],
          ReadTransform(lines, skeleton, joint->second, in_degrees, joint->second == 0 ? read.of_root : read.of_bones));
    }
  }
  if (clip.frames.empty()) return Fail({file}, "no frames");
  for (const auto& [name, joint] : joint_of) {
    if (counts[joint] == clip.frames.size() || skeleton.channels[joint].empty()) continue;
    if (counts[joint] > 0)
      return Fail({file}, "bone {} is missing in the last frame or frames; allowed: each bone once in each frame",
                  Quote(name));
    read.still.push_back(name);
  }
  return read;
}

}  // namespace

bool IsAcclaimMotion(std::string_view text) {
  AcclaimLines lines(text.substr(0, 4096), "");
  const auto is_of_motion = [&](const char* section) { return lines.IsSection(section); };
  if (!lines.Next() || !lines.IsSection()) return false;
  if (std::ranges::any_of(std::array{":FULLY-SPECIFIED", ":DEGREES", ":RADIANS"}, is_of_motion)) return true;
  while (lines.IsSection()) {
    if (!lines.Next()) return false;
  }
  return lines.words.size() == 1 && lines.Number(0).has_value();
}

Result<AcclaimSkeleton> ReadAcclaimSkeleton(std::string_view text, const std::string& file) {
  SkeletonReader reader(text, file, false);
  auto read = reader.Read();
  if (!read || !reader.ExceedsRadians()) return read;
  read = SkeletonReader(text, file, true).Read();
  if (read) {
    read->remark =
        "the skeleton file states radians, but Etude reads its angles as degrees, because some angles exceed 4π";
  }
  return read;
}

Result<Clip> ReadAcclaimMotion(std::string_view text, const AcclaimSkeleton& skeleton, const std::string& file,
                               AcclaimFacts* facts) {
  ASSIGN_OR_RETURN(auto read, ReadFrames(text, skeleton, file, false));
  std::string remark;
  constexpr double kMinDegrees = 0.5;  // a recording whose angles are all smaller shows only the rest pose
  const double largest = std::max(read.of_root, read.of_bones);
  if (!read.in_degrees && read.of_bones > kMaxRadians) {
    remark = fmt::format(
        "the file states radians, but Etude reads its angles as degrees, because the largest is {:.4g}", largest);
    ASSIGN_OR_RETURN(read, ReadFrames(text, skeleton, file, true));
  } else if (!read.in_degrees && read.of_root > kMaxRadians) {
    // A body that keeps turning in one direction can rotate its root by any angle, so the unit is not changed.
    remark = fmt::format(
        "the root turns by {:.4g} radians; if the file's angles are degrees, add the line :DEGREES to the file",
        read.of_root);
  } else if (read.in_degrees && largest > kMinDegrees && largest <= 2 * kPi) {
    remark = fmt::format(
        "no angle is larger than {:.2g} degrees; if the file's angles are radians, add the line :RADIANS to the file",
        largest);
  }
  if (facts == nullptr) return std::move(read.clip);
  facts->has_rate = read.has_rate;
  std::vector<std::string>& remarks = facts->remarks;
  if (!read.still.empty()) {
    remarks.push_back(fmt::format("bones without values, which keep their rest pose: {}", fmt::join(read.still, ", ")));
  }
  if (!read.unknown.empty()) remarks.push_back(fmt::format("not used: {}", fmt::join(read.unknown, ", ")));
  if (!skeleton.remark.empty()) remarks.push_back(skeleton.remark);
  if (!remark.empty()) remarks.push_back(remark);
  return std::move(read.clip);
}

}  // namespace etude
