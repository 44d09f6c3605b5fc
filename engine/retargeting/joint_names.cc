#include "engine/retargeting/joint_names.h"

#include <algorithm>
#include <array>
#include <utility>

#include "engine/base/text.h"

namespace etude {
namespace {

using enum Language;

// Some schemes call the collar bone "shoulder" or a helper joint "hip". Their more specific rows must come before the
// rows in which these words mean the joint itself.
constexpr LimbNames kArmSchemes[] = {
    {{"arm", "forearm", "hand"}},                // MotionBuilder: CMU, LAFAN1, Mixamo, MASS, Rokoko, DeepMotion
    {{"arm", "elbow", "wrist"}},                 // "Shoulder" is the collar bone: MikuMikuDance in English
    {{"upperarm", "elbow", "wrist"}},            // "Shoulder" is the collar bone
    {{"arm", "elbow", "hand"}},                  // "Shoulder" is the collar bone
    {{"upperarm", "elbow", "hand"}},             // "Shoulder" is the collar bone
    {{"shoulder", "elbow", "wrist"}},            // Biovision, CMU as converted for Poser, Xsens, SMPL, Kinect
    {{"shoulder", "elbow", "hand"}},             // CMU as converted for Daz
    {{"uparm", "lowarm", "hand"}},               // Biovision's own samples
    {{"upperarm", "lowerarm", "wrist"}},         // KayKit, whose "hand" is a further bone
    {{"upperarm", "lowerarm", "hand"}},          // Bandai-Namco, VRM, Unreal
    {{"upperarm", "forearm", "hand"}},           // 3ds Max' biped, Blender's rigs
    {{"upperarm", "lowerarm", "palm2"}},         // RobotExpressive of three.js
    {{"upperarm", "lowerarm", "palm"}},          // Quaternius
    {{"upperarm", "lowerarm", "fist"}},          // Quaternius
    {{"upperarm", "forearm", "wrist"}},          // seen in hand-made skeletons
    {{"bicep", "forearm", "hand"}},              // seen in hand-made skeletons
    {{"arm", "forearm", "wrist"}},               // Talking With Hands, GENEA
    {{"uarm", "farm", "hand"}},                  // OptiTrack's classic skeleton
    {{"armstretch", "forearmstretch", "hand"}},  // Auto-Rig Pro
    {{"shldr", "forearm", "hand"}},              // Poser
    {{"shldrbend", "forearmbend", "hand"}},      // Daz Genesis
    {{"humerus", "radius", "wrist"}},            // Acclaim: CMU's originals
    {{"humerus", "elbow", "wrist"}},             // seen in hand-made skeletons
    {{"humerus", "forearm", "hand"}},            // seen in hand-made skeletons
    {{"humerus", "radius", "hand"}},             // seen in hand-made skeletons
    {{"humerus", "ulna", "hand"}},               // OpenSim's bodies, SKEL
    {{"acromial", "elbow", "radiushand"}},       // OpenSim's joints
    {{"armupper", "armlower", "handwrist"}},     // Meta Quest
    {{"uparm", "lowarm", "wrist"}},              // Meta's MHR
    {{"shoulder", "elbow", "radiocarpal"}},      // H-Anim 2
    {{"sjc", "ejc", "wjc"}},                     // joint centres that laboratories compute
    {{"腕", "ひじ", "手首"}, kJapanese},         // MikuMikuDance
    {{"腕", "肘", "手首"}, kJapanese},
    {{"上腕", "前腕", "手"}, kJapanese},
    {{"肩", "肘", "手首"}, kJapanese},
    {{"bras", "avantbras", "main"}, kFrench},
    {{"bras", "avantbras", "poignet"}, kFrench},
    {{"bras", "coude", "poignet"}, kFrench},
    {{"bras", "coude", "main"}, kFrench},
    {{"epaule", "coude", "poignet"}, kFrench},
    {{"epaule", "coude", "main"}, kFrench},
};

constexpr LimbNames kLegSchemes[] = {
    {{"upleg", "leg", "foot"}},                // MotionBuilder and similar schemes
    {{"thigh", "knee", "ankle"}},              // "Hip" is a helper above the thigh
    {{"thigh", "knee", "foot"}},               // "Hip" is a helper above the thigh
    {{"upleg", "knee", "ankle"}},              // "Hip" is a helper above the thigh
    {{"upleg", "knee", "foot"}},               // "Hip" is a helper above the thigh
    {{"leg", "knee", "ankle"}},                // MikuMikuDance in English
    {{"hip", "knee", "ankle"}},                // Biovision and similar schemes
    {{"upleg", "lowleg", "foot"}},             // Biovision's own samples
    {{"upperleg", "lowerleg", "foot"}},        // Bandai-Namco, VRM, KayKit, three.js, Xsens' segments
    {{"thigh", "calf", "foot"}},               // 3ds Max' biped, Unreal
    {{"thigh", "shin", "foot"}},               // Poser, Blender's rigs, Rokoko
    {{"thighbend", "shin", "foot"}},           // Daz Genesis
    {{"hip", "knee", "foot"}},                 // seen in hand-made skeletons
    {{"leg", "shin", "foot"}},                 // "leg" for the thigh: seen in hand-made skeletons
    {{"upleg", "leg", "ankle"}},               // seen in hand-made skeletons
    {{"upperleg", "lowerleg", "ankle"}},       // seen in hand-made skeletons
    {{"upperleg", "shin", "foot"}},            // seen in hand-made skeletons
    {{"thighstretch", "legstretch", "foot"}},  // Auto-Rig Pro
    {{"femur", "tibia", "foot"}},              // Acclaim
    {{"femur", "tibia", "ankle"}},             // seen in hand-made skeletons
    {{"femur", "knee", "ankle"}},              // seen in hand-made skeletons
    {{"femur", "tibia", "talus"}},             // OpenSim's bodies, SKEL
    {{"femur", "tibia", "calcn"}},             // OpenSim's bodies without a subtalar joint
    {{"hip", "walkerknee", "ankle"}},          // OpenSim's joints
    {{"upperleg", "lowerleg", "footankle"}},   // Meta Quest
    {{"hip", "knee", "talocrural"}},           // H-Anim 2
    {{"hjc", "kjc", "ajc"}},                   // joint centres that laboratories compute
    {{"足", "ひざ", "足首"}, kJapanese},       // MikuMikuDance
    {{"足", "膝", "足首"}, kJapanese},
    {{"太もも", "すね", "足"}, kJapanese},
    {{"大腿", "下腿", "足"}, kJapanese},
    {{"股関節", "膝", "足首"}, kJapanese},
    {{"cuisse", "jambe", "pied"}, kFrench},
    {{"cuisse", "jambe", "cheville"}, kFrench},
    {{"cuisse", "mollet", "pied"}, kFrench},
    {{"cuisse", "tibia", "pied"}, kFrench},
    {{"cuisse", "genou", "cheville"}, kFrench},
    {{"hanche", "genou", "cheville"}, kFrench},
    {{"hanche", "genou", "pied"}, kFrench},
};

// In Kinect's scheme and in ours, "shoulder centre" is the base of the neck, midway between the shoulders.
constexpr std::string_view kNeckNames[] = {"shouldercentre",
                                           "shouldercenter",
                                           "spineshoulder",
                                           "neck",
                                           "necklower",
                                           "upperneck",
                                           "vc7",
                                           "首",
                                           "cou"};                                         // "vc7": H-Anim
constexpr std::string_view kHeadNames[] = {"head", "skullbase", "cranium", "頭", "tete"};  // "skullbase": H-Anim

constexpr std::pair<std::string_view, Finger> kFingerNames[] = {
    {"thumb", Finger::kThumb}, {"mid", Finger::kMiddle},    {"index", Finger::kIndex},
    {"ring", Finger::kRing},   {"little", Finger::kLittle}, {"pink", Finger::kLittle},  // "pinky", "pinkie"
};

constexpr std::string_view kTechnicalWords[] = {"jnt", "joint", "jt", "bone"};
constexpr std::size_t kMaxSuffixes = 2;
constexpr std::size_t kMaxNameLength = 64;
constexpr std::size_t kMaxFound = 16;

bool IsBeyondAscii(char c) { return static_cast<unsigned char>(c) >= 0x80; }

/// Returns a UTF-8 name with Latin-1's accented letters replaced by plain letters. The accent may be a separate
/// character, as in names written by macOS.
std::string WithoutAccents(std::string_view name) {
  constexpr std::string_view kPlain =
      "AAAAAA?CEEEEIIII?NOOOOO?OUUUUY??aaaaaa?ceeeeiiii?nooooo?ouuuuy?y";  // from U+00C0
  std::string plain;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const auto here = static_cast<unsigned char>(name[i]);
    const unsigned char next = i + 1 < name.size() ? static_cast<unsigned char>(name[i + 1]) : 0;
    const bool is_latin = here == 0xc3 && next >= 0x80 && next < 0xc0 && kPlain[next - 0x80] != '?';
    const bool is_accent = (here == 0xcc && next >= 0x80) || (here == 0xcd && next >= 0x80 && next < 0xb0);
    if (is_latin) plain += kPlain[next - 0x80];
    if (is_latin || is_accent) {
      ++i;
    } else {
      plain += name[i];
    }
  }
  return plain;
}

/// Returns true if a new word begins at the character `i`, which directly follows a letter or a digit: "upLeg",
/// "Bip01", "LHip" (a capital before a small letter).
bool BeginsWord(std::string_view name, std::size_t i) {
  const char before = name[i - 1];
  const char here = name[i];
  if (IsDigit(here)) return !IsDigit(before);
  if (!IsUpper(here)) return IsDigit(before) && IsLower(here);
  return !IsUpper(before) || (i + 1 < name.size() && IsLower(name[i + 1]));
}

/// Splits a name into its words, in lower case.
std::vector<std::string> WordsOf(std::string_view name) {
  std::vector<std::string> words;
  bool is_inside = false;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const char c = name[i];
    const bool is_part = IsLower(c) || IsUpper(c) || IsDigit(c) || IsBeyondAscii(c);
    if (is_part && (!is_inside || BeginsWord(name, i))) words.emplace_back();
    if (is_part) words.back() += ToLower(c);
    is_inside = is_part;
  }
  return words;
}

bool IsNumber(const std::string& word) { return std::ranges::all_of(word, IsDigit); }

/// Swaps a number and a side after it: "upperarm01.L" is read like "upperarm.L.01", and the number counts as a suffix.
void PutSideBeforeNumber(std::vector<std::string>& words) {
  constexpr std::string_view kSides[] = {"l", "r", "left", "right"};
  if (words.size() < 3 || std::ranges::find(kSides, words.back()) == std::end(kSides)) return;
  if (IsNumber(words[words.size() - 2])) std::swap(words[words.size() - 2], words.back());
}

bool IsTechnical(const std::string& word) {
  return IsNumber(word) || std::ranges::find(kTechnicalWords, word) != std::end(kTechnicalWords);
}

}  // namespace

std::span<const LimbNames> ArmSchemes() { return kArmSchemes; }
std::span<const LimbNames> LegSchemes() { return kLegSchemes; }
std::span<const std::string_view> NeckNames() { return kNeckNames; }
std::span<const std::string_view> HeadNames() { return kHeadNames; }

Finger FingerOf(std::string_view name) {
  name.remove_prefix(name.find_last_of(":|") + 1);
  const std::string letters = InLowerCase(std::string(name));
  for (const auto& [part, finger] : kFingerNames) {
    if (letters.find(part) != std::string::npos) return finger;
  }
  return Finger::kNotNamed;
}

std::vector<bool> EndSites(const Skeleton& skeleton) {
  constexpr std::array<std::string_view, 6> kEndings = {"_End", "_end", "End", "Nub", "_Nub", "_nub"};
  const std::size_t count = skeleton.joints.size();
  std::vector<bool> has_children(count), ends(count);
  for (const Joint& joint : skeleton.joints) {
    if (joint.parent >= 0) has_children[joint.parent] = true;
  }
  for (std::size_t i = 0; i < count; ++i) {
    const Joint& joint = skeleton.joints[i];
    ends[i] = joint.is_end_site;
    if (joint.parent < 0 || has_children[i] || !joint.name.starts_with(skeleton.joints[joint.parent].name)) continue;
    std::string_view ending = std::string_view(joint.name).substr(skeleton.joints[joint.parent].name.size());
    ending = ending.substr(0, ending.find('#'));  // without the "#2" that numbers duplicate names
    ends[i] = ends[i] || std::ranges::find(kEndings, ending) != kEndings.end();
  }
  return ends;
}

JointNames::JointNames(const Skeleton& skeleton) {
  const std::vector<bool> ends = EndSites(skeleton);
  for (std::size_t i = 0; i < skeleton.joints.size(); ++i) {
    if (!ends[i]) AddReadings(skeleton.joints[i], static_cast<int>(i));
  }
  std::ranges::stable_sort(readings_, {}, [](const Reading& reading) { return reading.joint.suffixes; });
}

void JointNames::AddReadings(const Joint& joint, int index) {
  std::string_view name = joint.name;
  name.remove_prefix(name.find_last_of(":|") + 1);
  if (name.size() > kMaxNameLength) return;
  std::vector<std::string> words = WordsOf(WithoutAccents(name));
  PutSideBeforeNumber(words);
  for (std::size_t suffixes = 0; !words.empty(); ++suffixes) {
    std::string rest;
    for (const std::string& word : words) rest += word;
    std::string prefix;
    std::size_t begin = 0;
    for (const std::string& word : words) {
      readings_.push_back({rest.substr(begin), {index, prefix, suffixes}});
      if (!IsDigit(word.front())) prefix += word;
      begin += word.size();
    }
    if (suffixes == kMaxSuffixes || !IsTechnical(words.back())) return;
    words.pop_back();
  }
}

std::vector<NamedJoint> JointNames::FindAny(std::span<const std::string> forms) const {
  std::vector<NamedJoint> found;
  for (const Reading& reading : readings_) {
    if (found.size() < kMaxFound && std::ranges::find(forms, reading.name) != forms.end()) {
      found.push_back(reading.joint);
    }
  }
  return found;
}

std::vector<NamedJoint> JointNames::Find(std::string_view name, Side side, Language language) const {
  constexpr std::string_view kSides[3][2][3] = {{{"left", "l", ""}, {"right", "r", ""}},
                                                {{"gauche", "g", ""}, {"droit", "droite", "d"}},
                                                {{"左", "l", "left"}, {"右", "r", "right"}}};
  const std::string plain(name);
  std::vector<std::string> forms;
  for (const std::string_view word : kSides[static_cast<int>(language)][side == Side::kLeft ? 0 : 1]) {
    if (word.empty()) continue;
    forms.push_back(std::string(word) + plain);
    forms.push_back(plain + std::string(word));
  }
  return FindAny(forms);
}

std::vector<NamedJoint> JointNames::Find(std::string_view name) const {
  const std::string plain(name);
  return FindAny(std::array{plain, "c" + plain, plain + "x"});  // VRoid's "C_Neck", Auto-Rig Pro's "neck.x"
}

}  // namespace etude
