#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/motion/body.h"
#include "engine/motion/clip.h"

namespace etude {

/// The language that a scheme writes sides in: left, right, l, r; gauche, droit, droite, g, d; 左, 右, l, r.
enum class Language { kEnglish, kFrench, kJapanese };

/// The names that one naming scheme gives to the three joints of a limb, without the side.
struct LimbNames {
  std::array<std::string_view, 3> joints;  ///< from the trunk outwards
  Language language = Language::kEnglish;
};

/// Lists the schemes of arms: shoulder, elbow, wrist. A scheme counts only when it names all three, since one word
/// means different joints in different schemes: MotionBuilder's "LeftShoulder" is the collar bone.
std::span<const LimbNames> ArmSchemes();
/// Lists the schemes of legs: hip, knee, ankle.
std::span<const LimbNames> LegSchemes();
/// The base of the neck. CMU's "Neck" lies at the chest: whoever uses these must look where a joint is.
std::span<const std::string_view> NeckNames();
std::span<const std::string_view> HeadNames();

/// The finger that a joint belongs to by its own name alone, in the order in which they suit as the tip of a hand.
enum class Finger { kMiddle, kIndex, kRing, kLittle, kNotNamed, kThumb };
/// Returns the finger of a name: "LeftHandThumb2", "thumb_01_l" and "lthumb" are thumbs. 3ds Max' biped numbers its
/// fingers, the thumb being "Finger0", as others begin with the index finger: such names say nothing.
Finger FingerOf(std::string_view name);

/// A joint that bears a name.
struct NamedJoint {
  int joint = -1;
  std::string prefix;        ///< the words before the name, without numbers: "mixamorig", "bip", nothing
  std::size_t suffixes = 0;  ///< words left away behind it: 1 in "l_arm_JNT"
};

/// The joints of a skeleton by the words of their names. Words end at signs, blanks and where upper case or a number
/// begins; case does not count. What stands before a colon or a bar, words in front and technical words behind
/// ("JNT", "joint", "bone", a number) may be there or not: "mixamorig:LeftArm", "Character1_LeftArm", "l_arm_JNT" and
/// "LeftArm_09" are all the left "arm"; "LeftForeArm" is not, for "fore" stands behind the side. A side is written
/// "LeftArm", "L_Arm", "lArm", "ArmLeft", "Arm.L". Letters beyond ASCII are part of words; Latin ones count without
/// their accents ("Épaule" is "epaule"). End sites have no names of their own.
class JointNames {
 public:
  explicit JointNames(const Skeleton& skeleton);

  /// Finds at most sixteen joints of that name: those with the fewest suffixes first, then in the skeleton's order.
  std::vector<NamedJoint> Find(std::string_view name, Side side, Language language = Language::kEnglish) const;
  /// Finds joints of the middle: "Neck", "J_Bip_C_Neck".
  std::vector<NamedJoint> Find(std::string_view name) const;

 private:
  /// A way to read a joint's name.
  struct Reading {
    std::string name;
    NamedJoint joint;
  };

  void AddReadings(const Joint& joint, int index);
  std::vector<NamedJoint> FindAny(std::span<const std::string> forms) const;

  std::vector<Reading> readings_;
};

}  // namespace etude
