#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/motion/body.h"
#include "engine/motion/clip.h"

namespace etude {

/// The language in which a scheme names sides: left, right, l, r; gauche, droit, droite, g, d; 左, 右, l, r.
enum class Language { kEnglish, kFrench, kJapanese };

/// The names of the three joints of a limb in one naming scheme, without the side.
struct LimbNames {
  std::array<std::string_view, 3> joints;  ///< from the trunk outwards
  Language language = Language::kEnglish;
};

/// Lists the schemes of arms: shoulder, elbow, wrist. A scheme is used only if it names all three, because a word can
/// mean different joints in different schemes: MotionBuilder's "LeftShoulder" is the collar bone.
std::span<const LimbNames> ArmSchemes();
/// Lists the schemes of legs: hip, knee, ankle.
std::span<const LimbNames> LegSchemes();
/// Lists the names of the base of the neck. The caller must check the joint's position, because CMU's "Neck" lies at
/// the chest.
std::span<const std::string_view> NeckNames();
std::span<const std::string_view> HeadNames();

/// The finger that a joint's name states. The order is the preference for the tip of a hand, best first.
enum class Finger { kMiddle, kIndex, kRing, kLittle, kNotNamed, kThumb };
/// Returns the finger that a name states: "LeftHandThumb2", "thumb_01_l" and "lthumb" are thumbs. Numbered names are
/// kNotNamed, because 3ds Max' biped calls the thumb "Finger0" while others begin with the index finger.
Finger FingerOf(std::string_view name);

/// Returns true for each end site: BVH's own; in formats without end sites, each joint without children that is named
/// after its parent, such as "Head_End", "Head_end" or "HeadNub" below "Head". The same skeleton therefore gives the
/// same result in both kinds of formats.
std::vector<bool> EndSites(const Skeleton& skeleton);

/// A joint that was found by its name.
struct NamedJoint {
  int joint = -1;
  std::string prefix;        ///< the words before the name, without numbers: "mixamorig", "bip", or empty
  std::size_t suffixes = 0;  ///< the number of ignored words after the name: 1 in "l_arm_JNT"
};

/// The joints of a skeleton, indexed by the words of their names. Words end at punctuation, blanks, capital letters and
/// numbers; case is ignored. Text before a colon or a vertical bar, words at the beginning, and technical words at the
/// end ("JNT", "joint", "bone", a number) are ignored: "mixamorig:LeftArm", "Character1_LeftArm", "l_arm_JNT" and
/// "LeftArm_09" are all the left "arm"; "LeftForeArm" is not, because "fore" comes after the side. A side may be
/// written as in "LeftArm", "L_Arm", "lArm", "ArmLeft" or "Arm.L". Letters beyond ASCII are part of words; Latin
/// letters are compared without accents ("Épaule" is "epaule"). End sites have no names of their own.
class JointNames {
 public:
  explicit JointNames(const Skeleton& skeleton);

  /// Finds at most sixteen joints with this name and side: those with the fewest suffixes first, then in the skeleton's
  /// order.
  std::vector<NamedJoint> Find(std::string_view name, Side side, Language language = Language::kEnglish) const;
  /// Finds joints of the body's middle, such as "Neck" or "J_Bip_C_Neck".
  std::vector<NamedJoint> Find(std::string_view name) const;

 private:
  /// One possible interpretation of a joint's name.
  struct Reading {
    std::string name;
    NamedJoint joint;
  };

  void AddReadings(const Joint& joint, int index);
  std::vector<NamedJoint> FindAny(std::span<const std::string> forms) const;

  std::vector<Reading> readings_;
};

}  // namespace etude
