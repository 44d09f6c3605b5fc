#include "engine/formats/kinect_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <span>
#include <string_view>

#include "engine/base/names.h"
#include "engine/base/text.h"
#include "engine/formats/kinect_text.h"

namespace etude {
namespace {

/// The joints of the SDKs, in the order of NUI_SKELETON_POSITION_INDEX (v1) and JointType (v2).
constexpr std::array<std::string_view, 20> kV1Names = {
    "HipCenter", "Spine",         "ShoulderCenter", "Head",       "ShoulderLeft", "ElbowLeft", "WristLeft",
    "HandLeft",  "ShoulderRight", "ElbowRight",     "WristRight", "HandRight",    "HipLeft",   "KneeLeft",
    "AnkleLeft", "FootLeft",      "HipRight",       "KneeRight",  "AnkleRight",   "FootRight"};
constexpr std::array<std::string_view, kKinectV2JointCount> kV2Names = {
    "SpineBase",   "SpineMid",      "Neck",         "Head",       "ShoulderLeft", "ElbowLeft", "WristLeft",
    "HandLeft",    "ShoulderRight", "ElbowRight",   "WristRight", "HandRight",    "HipLeft",   "KneeLeft",
    "AnkleLeft",   "FootLeft",      "HipRight",     "KneeRight",  "AnkleRight",   "FootRight", "SpineShoulder",
    "HandTipLeft", "ThumbLeft",     "HandTipRight", "ThumbRight"};

/// The names of the trunk's joints in both SDKs and in Etude.
constexpr std::array<std::array<std::string_view, 3>, 3> kTrunkNames = {
    {{"hipcenter", "hipcentre", "spinebase"},
     {"spine", "spinemid", "spinemid"},
     {"shouldercenter", "shouldercentre", "spineshoulder"}}};

std::span<const std::string_view> SdkNames(std::size_t joints) {
  if (joints == kV1Names.size()) return kV1Names;
  return kV2Names;
}

/// Returns the letters of a heading, in lower case.
std::string LettersOf(std::string_view heading) {
  std::string letters;
  for (const char c : heading) {
    if (IsLower(c) || IsUpper(c) || static_cast<unsigned char>(c) >= 0x80) letters += ToLower(c);
  }
  return letters;
}

/// Takes the axis, 'x', 'y' or 'z', off the letters of a heading: the last letter before a unit, or the first letter.
/// Returns nullopt if they state no axis.
std::optional<char> TakeAxis(std::string& letters) {
  const auto is_axis = [](char c) { return c >= 'x' && c <= 'z'; };
  for (const std::string_view end : {"", "m", "cm", "mm", "position", "pos"}) {
    if (letters.size() <= end.size() || !letters.ends_with(end)) continue;
    const std::size_t at = letters.size() - end.size() - 1;
    if (!is_axis(letters[at])) continue;
    const char axis = letters[at];
    letters.resize(at);
    return axis;
  }
  if (letters.empty() || !is_axis(letters.front())) return std::nullopt;
  const char axis = letters.front();
  letters.erase(0, 1);
  return axis;
}

/// Returns the forms in which the letters of a heading state a joint.
std::vector<std::string> FormsOf(std::string_view sdk_name) {
  const std::string plain = InLowerCase(std::string(sdk_name));
  for (const auto& names : kTrunkNames) {
    if (std::ranges::find(names, plain) != names.end()) return {names.begin(), names.end()};
  }
  for (const std::string_view side : {"left", "right"}) {
    if (plain.ends_with(side)) return {plain, std::string(side) + plain.substr(0, plain.size() - side.size())};
  }
  return {plain};
}

/// Returns the joint that a heading's letters (without the axis) name: the joint with the longest name that occurs in
/// the letters, or whose name with l or r in place of the side equals the letters. Returns nullopt if the letters name
/// no joint.
std::optional<std::size_t> JointNamed(const std::string& letters, std::size_t joints) {
  const auto names = SdkNames(joints);
  std::optional<std::size_t> found;
  std::size_t longest = 0;
  for (std::size_t j = 0; j < names.size(); ++j) {
    for (const std::string& form : FormsOf(names[j])) {
      if (form.size() > longest && letters.find(form) != std::string::npos) {
        found = j;
        longest = form.size();
      }
      for (const std::string_view side : {"left", "right"}) {
        if (!form.starts_with(side)) continue;
        const std::string base = form.substr(side.size()), letter(side.substr(0, 1));
        if (letters == letter + base || letters == base + letter) return j;
      }
    }
  }
  return found;
}

/// A heading, split into words.
struct JointHeading {
  std::optional<char> axis;
  std::string letters;               ///< without the axis
  std::optional<std::size_t> joint;  ///< index in the SDK's order
};

JointHeading JointHeadingOf(std::string_view text, std::size_t joints) {
  JointHeading heading{.axis = {}, .letters = LettersOf(text), .joint = {}};
  heading.axis = TakeAxis(heading.letters);
  heading.joint = JointNamed(heading.letters, joints);
  return heading;
}

/// Returns true if headings name joints: at least three known ones, or at least three different names for which most
/// headings state an axis. "x1", "y1", "joint2_x" and a title of the file name no joints.
bool NameJoints(std::span<const JointHeading> headings) {
  constexpr std::size_t kMinNames = 3;
  std::set<std::size_t> joints;
  std::set<std::string> names;
  std::size_t axes = 0;
  for (const JointHeading& heading : headings) {
    if (heading.joint) joints.insert(*heading.joint);
    if (!heading.axis) continue;
    ++axes;
    names.insert(heading.letters);
  }
  return joints.size() >= kMinNames || (names.size() >= kMinNames && 2 * axes >= headings.size());
}

/// Returns true if each heading stands above the first number of a joint, and the headings of its other numbers are
/// empty, as spreadsheets write cells that are merged.
bool AreMerged(std::span<const std::string> texts, const KinectColumns& columns) {
  if (texts.size() <= columns.first + columns.joints) return false;
  for (std::size_t i = columns.first; i < texts.size(); ++i) {
    if (texts[i].empty() == ((i - columns.first) % columns.per_joint == 0)) return false;
  }
  return true;
}

}  // namespace

Result<std::vector<std::size_t>> FindKinectJoints(const NumberRows& table, const KinectColumns& columns,
                                                  const std::string& file) {
  // Split the headings into words. A longer line is not a line of headings.
  constexpr std::size_t kMaxHeadingBytes = 1 << 16;
  if (table.heading.size() > kMaxHeadingBytes) return std::vector<std::size_t>{};
  std::vector<std::string> texts = HeadingsOf(table.heading);
  if (AreMerged(texts, columns)) std::erase(texts, "");
  std::vector<JointHeading> headings;
  for (const std::string& text : texts) headings.push_back(JointHeadingOf(text, columns.joints));
  if (!NameJoints(headings)) return std::vector<std::size_t>{};
  const auto names = SdkNames(columns.joints);
  const std::string allowed = fmt::format("allowed: {}, each once, or no heading if the joints are in this order",
                                          Join(std::vector<std::string>(names.begin(), names.end())));
  // There is one heading for each number, or one for each joint.
  const bool has_axes = texts.size() == table.columns;
  const bool has_clock = texts.size() == columns.joints + columns.first;
  if (!has_axes && !has_clock && texts.size() != columns.joints) {
    return Fail({file, 1}, "the heading names joints in {} columns, but rows have {} numbers; {}", texts.size(),
                table.columns, allowed);
  }
  // Find the joint of each place in the row.
  const std::size_t step = has_axes ? columns.per_joint : 1, begin = has_axes || has_clock ? columns.first : 0;
  constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  std::vector<std::size_t> places(columns.joints, kNone);
  for (std::size_t place = 0; place < columns.joints; ++place) {
    const std::size_t at = begin + step * place;
    const auto& joint = headings[at].joint;
    if (!joint) {
      return Fail({file, 1}, "the heading of column {} is {}, which names no joint of this Kinect; {}", at + 1,
                  Quote(texts[at]), allowed);
    }
    if (places[*joint] != kNone) {
      return Fail({file, 1}, "the headings of columns {} and {} both name {}; {}", begin + step * places[*joint] + 1,
                  at + 1, names[*joint], allowed);
    }
    places[*joint] = place;
    for (std::size_t i = 0; has_axes && i < step; ++i) {
      const JointHeading& other = headings[at + i];
      const bool fits = i < 3 ? other.axis == std::string_view("xyz")[i] && other.joint == joint
                              : !other.joint || other.joint == joint;
      if (fits) continue;
      return Fail({file, 1},
                  "the headings of columns {} to {} are {}, {} and {}; allowed: x, y and z of one joint, in this order",
                  at + 1, at + 3, Quote(texts[at]), Quote(texts[at + 1]), Quote(texts[at + 2]));
    }
  }
  return places;
}

}  // namespace etude
