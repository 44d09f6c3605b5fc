#include "engine/retargeting/joint_names.h"

#include <string>

namespace etude {
namespace {

constexpr LimbNames kArmSchemes[] = {
    {{"arm", "forearm", "hand"}},        // MotionBuilder: CMU, Mixamo, MASS, LAFAN1
    {{"shoulder", "elbow", "wrist"}},    // Biovision, and CMU as converted for Poser
    {{"uparm", "lowarm", "hand"}},       // Biovision's own samples
    {{"upperarm", "lowerarm", "hand"}},  // Bandai-Namco, Unreal
};

constexpr LimbNames kLegSchemes[] = {
    {{"upleg", "leg", "foot"}},
    {{"hip", "knee", "ankle"}},
    {{"upleg", "lowleg", "foot"}},
    {{"upperleg", "lowerleg", "foot"}},
};

// CMU has both: its "Neck" (also "lowerneck") lies at the chest, its "Neck1" at the neck's base. Kinect, and our own
// role, call that place the middle of the shoulders.
constexpr std::string_view kNeckNames[] = {"neck1", "neck", "shouldercentre", "shouldercenter"};
constexpr std::string_view kHeadNames[] = {"head"};

/// Lower case, letters and digits only.
std::string Plain(std::string_view name) {
  std::string plain;
  for (char c : name) {
    if (c >= 'A' && c <= 'Z') plain += static_cast<char>(c - 'A' + 'a');
    if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9')) plain += c;
  }
  return plain;
}

bool Matches(std::string_view joint, std::string_view plain_name) {
  joint = joint.substr(joint.find_last_of(':') + 1);
  // With and without the part before the first underscore: it may be a prefix, or "L_".
  return Plain(joint) == plain_name || Plain(joint.substr(joint.find('_') + 1)) == plain_name;
}

}  // namespace

std::span<const LimbNames> ArmSchemes() { return kArmSchemes; }
std::span<const LimbNames> LegSchemes() { return kLegSchemes; }
std::span<const std::string_view> NeckNames() { return kNeckNames; }
std::span<const std::string_view> HeadNames() { return kHeadNames; }

int FindJoint(const Skeleton& skeleton, std::string_view name) {
  for (std::size_t i = 0; i < skeleton.joints.size(); ++i) {
    const Joint& joint = skeleton.joints[i];
    if (!joint.is_end_site && Matches(joint.name, name)) return static_cast<int>(i);
  }
  return -1;
}

int FindJoint(const Skeleton& skeleton, std::string_view name, Side side) {
  const std::string whole = side == Side::kLeft ? "left" : "right";
  const std::string letter = whole.substr(0, 1);
  for (const std::string& form : {whole + std::string(name), letter + std::string(name), std::string(name) + letter}) {
    if (const int joint = FindJoint(skeleton, form); joint >= 0) return joint;
  }
  return -1;
}

}  // namespace etude
