#include "engine/retargeting/skin_markers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "engine/base/directions.h"
#include "engine/base/names.h"
#include "engine/base/order_statistics.h"
#include "engine/base/smoothstep.h"

namespace etude {
namespace {

using enum Role;

/// A kind of joint whose markers lie on the skin.
struct SkinJoint {
  Role left, before;       ///< a joint of the left side, and the joint at the limb's other end
  std::string_view size;   ///< the name that files give to the joint's width, without L or R
  double share;            ///< distance from marker to centre ÷ distance between the markers of `left` and `before`
  std::string_view where;  ///< the joints' name in texts for users
};
constexpr std::array<SkinJoint, 4> kSkinJoints = {{{kLeftKnee, kLeftHip, "KNEEWIDTH", 0.12, "knees"},
                                                   {kLeftAnkle, kLeftKnee, "ANKLEWIDTH", 0.085, "ankles"},
                                                   {kLeftElbow, kLeftShoulder, "ELBOWWIDTH", 0.135, "elbows"},
                                                   {kLeftShoulder, kLeftElbow, "SHOULDEROFFSET", 0.135, "shoulders"}}};

/// The distances from markers to centres, metres, by role.
struct SkinDepths {
  std::array<double, kRoleCount> metres{};
  /// For users, joints with their mean distance in cm ("knees 6.2"). `of_file`: the distances follow from the file's
  /// sizes; `of_limb`: from limb lengths.
  std::vector<std::string> of_file, of_limb;
  bool has_elbow_widths = false;
};

/// The joints of one side of a body in one frame. For the right side, too, callers name a joint by its left role.
class SideOf {
 public:
  SideOf(JointPositions& places, bool is_left) : places_(places), is_left_(is_left) {}

  bool is_left() const { return is_left_; }
  Role On(Role left) const { return is_left_ ? left : Mirrored(left); }
  MarkerPosition& operator[](Role left) const { return places_[Index(On(left))]; }
  bool Has(std::initializer_list<Role> roles) const {
    return std::ranges::all_of(roles, [&](Role role) { return (*this)[role].has_value(); });
  }

 private:
  JointPositions& places_;
  bool is_left_;
};

glm::dvec3 Across(const glm::dvec3& v, const glm::dvec3& along) {
  const glm::dvec3 unit = UnitOr(along, glm::dvec3(0));
  return v - glm::dot(v, unit) * unit;
}

/// Returns the joint centre at distance `depth` from `marker`, on the side of `inward`. The lines from the centre to
/// the marker and to the limb's other end are perpendicular.
glm::dvec3 Chord(const glm::dvec3& other_end, const glm::dvec3& marker, const glm::dvec3& inward, double depth) {
  const glm::dvec3 limb = marker - other_end;
  const double length = glm::length(limb);
  const glm::dvec3 aside = UnitOr(Across(inward, limb), glm::dvec3(0));
  if (depth >= length || aside == glm::dvec3(0)) return marker;
  const double share = depth / length;
  return marker - depth * share * limb / length + depth * std::sqrt(1 - share * share) * aside;
}

/// Returns the direction from a marker on the skin to the joint inside the limb. Blends `rough`, which is always known,
/// with the normal of the bend plane, which gets more weight as the limb bends more. A marker that is `depth` beside a
/// straight limb makes the limb seem bent; this apparent bend is subtracted.
glm::dvec3 Inward(const glm::dvec3& rough, const glm::dvec3& upper, const glm::dvec3& lower, double sign,
                  double depth) {
  // kCertain: factor on the apparent bend; kRange: increase of the bend's sine over which the weight rises from 0 to 1.
  constexpr double kCertain = 1.2, kRange = 0.25;
  const double a = std::max(glm::length(upper), 1e-9), b = std::max(glm::length(lower), 1e-9);
  const glm::dvec3 normal = sign * glm::cross(upper, lower);
  const double seeming = kCertain * depth * (1 / a + 1 / b);
  const glm::dvec3 side = UnitOr(Across(rough, upper), glm::dvec3(0));
  return glm::mix(side, UnitOr(normal, side), Smoothstep(seeming, seeming + kRange, glm::length(normal) / (a * b)));
}

SkinDepths DepthsOf(const MarkerSet& set, const std::map<std::string, double>& sizes_m,
                    std::vector<JointPositions>& frames) {
  constexpr double kUsualMarker = 0.014;
  SkinDepths depths;
  const auto size = [&](const std::string& name) {
    const auto found = sizes_m.find(name);
    return found == sizes_m.end() ? std::nullopt : std::optional(found->second);
  };
  for (const SkinJoint& joint : kSkinJoints) {
    if (!LiesUnderSkin(set, joint.left) && !LiesUnderSkin(set, Mirrored(joint.left))) continue;
    std::vector<double> lengths;
    bool is_of_file = true;
    for (const bool is_left : {true, false}) {
      // Compute the marker's depth from the joint's width if the file has it; else take a share of the limb's length.
      const auto width = size((is_left ? "L" : "R") + std::string(joint.size));
      const bool is_offset = joint.left == kLeftShoulder;
      const double radius = 0.5 * size("MARKERDIAMETER").value_or(kUsualMarker);
      if (width)
        depths.metres[Index(is_left ? joint.left : Mirrored(joint.left))] = (is_offset ? *width : *width / 2) + radius;
      is_of_file = is_of_file && width.has_value();
      for (JointPositions& places : frames) {
        const SideOf side(places, is_left);
        if (side.Has({joint.left, joint.before}))
          lengths.push_back(glm::distance(*side[joint.left], *side[joint.before]));
      }
    }
    const double share = lengths.empty() ? 0 : joint.share * LowerPercentile(std::move(lengths), 0.5);
    for (const Role role : {joint.left, Mirrored(joint.left)}) {
      if (depths.metres[Index(role)] == 0) depths.metres[Index(role)] = share;
      if (!LiesUnderSkin(set, role)) depths.metres[Index(role)] = 0;
    }
    const double mean = 50 * (depths.metres[Index(joint.left)] + depths.metres[Index(Mirrored(joint.left))]);
    if (joint.left == kLeftElbow) depths.has_elbow_widths = is_of_file;
    (is_of_file ? depths.of_file : depths.of_limb).push_back(fmt::format("{} {:.1f}", joint.where, mean));
  }
  return depths;
}

void LowerShoulders(JointPositions& places, const SkinDepths& depths) {
  const auto at = [&](Role role) -> MarkerPosition& { return places[Index(role)]; };
  // Take the downward direction from markers on the trunk, otherwise from shoulders to hips.
  glm::dvec3 down(0);
  if (at(kShoulderCentre) && at(kSpine)) {
    down = *at(kSpine) - *at(kShoulderCentre);
  } else if (at(kLeftShoulder) && at(kRightShoulder) && at(kLeftHip) && at(kRightHip)) {
    down = *at(kLeftHip) + *at(kRightHip) - *at(kLeftShoulder) - *at(kRightShoulder);
  }
  for (const Role role : {kLeftShoulder, kRightShoulder}) {
    if (at(role)) *at(role) += depths.metres[Index(role)] * UnitOr(down, glm::dvec3(0));
  }
}

/// Returns the inward direction that a wand shows.
glm::dvec3 ByWand(const glm::dvec3& wand, const glm::dvec3& other_end, const glm::dvec3& marker) {
  return UnitOr(-Across(wand - other_end, marker - other_end), glm::dvec3(0));
}

/// Returns the inward direction at a knee, from the line between the hips and the bend of the knee. Estimates the
/// direction first from the bend of the markers. Moves knee and ankle along this direction to the joint centres, and
/// estimates the direction again from the bend at these centres.
glm::dvec3 KneeInward(const SideOf& side, const SkinDepths& depths) {
  const glm::dvec3 hip = *side[kLeftHip], skin = *side[kLeftKnee], ankle = *side[kLeftAnkle];
  const double sign = side.is_left() ? -1 : 1, depth = depths.metres[Index(side.On(kLeftKnee))];
  const glm::dvec3 rough = *side[kRightHip] - hip;
  const glm::dvec3 first = UnitOr(Inward(rough, skin - hip, ankle - skin, sign, depth), glm::dvec3(0));
  const glm::dvec3 knee = skin + depth * first, centre = ankle + depths.metres[Index(side.On(kLeftAnkle))] * first;
  return Inward(rough, knee - hip, centre - knee, sign, depth);
}

/// For thighs and shanks, left then right: true if the wand stands beside its limb. Wands in front of a limb or behind
/// it are not used.
struct UsedWands {
  std::array<bool, 2> thigh = {}, shank = {};
};
UsedWands FindUsedWands(const std::vector<Wands>& wands, const SkinDepths& depths,
                        std::vector<JointPositions>& frames) {
  constexpr double kAside = 0.3;
  UsedWands used;
  for (const bool is_left : {true, false}) {
    // Compute the median, over the frames, of the cosine of the angle between wand and knee axis.
    std::array<std::vector<double>, 2> cosines;
    const std::size_t index = is_left ? 0 : 1;
    for (std::size_t t = 0; t < frames.size(); ++t) {
      const SideOf side(frames[t], is_left);
      if (!side.Has({kLeftHip, kLeftKnee, kLeftAnkle, kRightHip})) continue;
      const glm::dvec3 hip = *side[kLeftHip], knee = *side[kLeftKnee], ankle = *side[kLeftAnkle];
      const glm::dvec3 inward = UnitOr(KneeInward(side, depths), glm::dvec3(0));
      const auto &thigh = wands[t].thigh[index], &shank = wands[t].shank[index];
      if (thigh) cosines[0].push_back(glm::dot(ByWand(*thigh, hip, knee), inward));
      if (shank) cosines[1].push_back(glm::dot(ByWand(*shank, knee, ankle), inward));
    }
    used.thigh[index] = !cosines[0].empty() && LowerPercentile(std::move(cosines[0]), 0.5) > kAside;
    used.shank[index] = !cosines[1].empty() && LowerPercentile(std::move(cosines[1]), 0.5) > kAside;
  }
  return used;
}

/// The joints from which a knee and an ankle, or an elbow, are moved to their centres.
constexpr std::initializer_list<Role> kNeededForLeg = {kLeftHip, kLeftKnee, kLeftAnkle, kRightHip};
constexpr std::initializer_list<Role> kNeededForElbow = {kLeftShoulder, kRightShoulder, kLeftElbow, kLeftWrist};

void MoveLeg(const SideOf& side, const Wands& wands, const UsedWands& used, const SkinDepths& depths) {
  if (!side.Has(kNeededForLeg)) return;
  const std::size_t index = side.is_left() ? 0 : 1;
  const glm::dvec3 hip = *side[kLeftHip], skin = *side[kLeftKnee], ankle = *side[kLeftAnkle];
  const auto &thigh = wands.thigh[index], &shank = wands.shank[index];
  const glm::dvec3 in = thigh && used.thigh[index] ? ByWand(*thigh, hip, skin) : KneeInward(side, depths);
  const glm::dvec3 knee = Chord(hip, skin, in, depths.metres[Index(side.On(kLeftKnee))]);
  side[kLeftKnee] = knee;
  // The ankle's axis is parallel to the knee's, unless the shank's wand shows another axis.
  const glm::dvec3 at_ankle = shank && used.shank[index] ? ByWand(*shank, knee, ankle)
                              : knee == skin             ? in
                                                         : knee - skin;
  side[kLeftAnkle] = Chord(knee, ankle, at_ankle, depths.metres[Index(side.On(kLeftAnkle))]);
}

/// Returns the elbow's centre under the assumption that the marker is on the outside of the elbow.
glm::dvec3 BesideElbow(const SideOf& side, const SkinDepths& depths) {
  const double depth = depths.metres[Index(side.On(kLeftElbow))];
  // If the file has Plug-in Gait's widths, subtract only a part of the apparent bend, as Plug-in Gait does.
  const double seeming = depths.has_elbow_widths ? 0.3 * depth : depth;
  const glm::dvec3 shoulder = *side[kLeftShoulder], skin = *side[kLeftElbow], wrist = *side[kLeftWrist];
  glm::dvec3 rough = *side[kRightShoulder] - shoulder;
  if (side.Has({kLeftHip}) && glm::length(Across(rough, skin - shoulder)) < 0.5 * glm::length(rough)) {
    rough = *side[kLeftHip] - shoulder;  // for an arm that is held out sideways
  }
  return Chord(shoulder, skin, Inward(rough, skin - shoulder, wrist - skin, side.is_left() ? 1 : -1, seeming), depth);
}

/// Returns the elbow's centre under the assumption that the marker is on the point of the elbow.
glm::dvec3 BeforeElbow(const SideOf& side, double depth) {
  const glm::dvec3 wrist = *side[kLeftWrist], skin = *side[kLeftElbow];
  return Chord(wrist, skin, *side[kLeftShoulder] - skin, depth);
}

/// Returns true if the elbow markers are on the points of the elbows: with that assumption the lengths of the upper
/// arms are far more constant.
bool AreOnElbowPoints(std::vector<JointPositions>& frames, const SkinDepths& depths) {
  constexpr std::size_t kMinFrames = 5;
  constexpr double kBetter = 0.5, kVisible = 0.0005;
  std::array<double, 2> deviations{};
  for (const bool is_left : {true, false}) {
    std::array<std::vector<double>, 2> lengths;
    for (JointPositions& places : frames) {
      const SideOf side(places, is_left);
      if (!side.Has({kLeftShoulder, kRightShoulder, kLeftElbow, kLeftWrist})) continue;
      const double depth = depths.metres[Index(side.On(kLeftElbow))];
      lengths[0].push_back(glm::distance(BesideElbow(side, depths), *side[kLeftShoulder]));
      lengths[1].push_back(glm::distance(BeforeElbow(side, depth), *side[kLeftShoulder]));
    }
    if (lengths[0].size() < kMinFrames) return false;
    for (std::size_t way = 0; way < 2; ++way) {
      double mean = 0, square = 0;
      for (const double length : lengths[way]) mean += length / static_cast<double>(lengths[way].size());
      for (const double length : lengths[way]) square += (length - mean) * (length - mean);
      deviations[way] += std::sqrt(square / static_cast<double>(lengths[way].size()));
    }
  }
  return deviations[1] < kBetter * deviations[0] && deviations[0] - deviations[1] > kVisible;
}

/// Removes the joints `moved` from the frames that do not show all of `needed`, if other frames do: there, the joints
/// would stay on the skin, and so jump by their depth. Keeps joints that lie on no skin.
void RemoveUnmoved(std::vector<JointPositions>& frames, bool is_left, std::initializer_list<Role> needed,
                   std::initializer_list<Role> moved, const SkinDepths& depths) {
  const auto has_all = [&](JointPositions& places) { return SideOf(places, is_left).Has(needed); };
  if (std::ranges::none_of(frames, has_all)) return;
  for (JointPositions& places : frames) {
    if (has_all(places)) continue;
    const SideOf side(places, is_left);
    for (const Role role : moved) {
      if (depths.metres[Index(side.On(role))] > 0) places[Index(side.On(role))].reset();
    }
  }
}

}  // namespace

std::string MoveToJointCentres(const MarkerSet& set, const std::map<std::string, double>& sizes_m,
                               const std::vector<Wands>& wands, std::vector<JointPositions>& frames) {
  if (!set.has_skin_limbs && !set.has_skin_shoulders) return "";
  const SkinDepths depths = DepthsOf(set, sizes_m, frames);
  // Move the shoulders first, because elbows depend on them.
  if (set.has_skin_shoulders) {
    for (JointPositions& places : frames) LowerShoulders(places, depths);
  }
  const UsedWands used = set.has_skin_limbs ? FindUsedWands(wands, depths, frames) : UsedWands{};
  const bool is_on_point = set.has_skin_limbs && AreOnElbowPoints(frames, depths);
  if (set.has_skin_limbs) {
    for (const bool is_left : {true, false}) {
      RemoveUnmoved(frames, is_left, kNeededForLeg, {kLeftKnee, kLeftAnkle}, depths);
      RemoveUnmoved(frames, is_left, kNeededForElbow, {kLeftElbow}, depths);
    }
  }
  for (std::size_t t = 0; t < frames.size() && set.has_skin_limbs; ++t) {
    for (const bool is_left : {true, false}) {
      const SideOf side(frames[t], is_left);
      MoveLeg(side, wands[t], used, depths);
      if (!side.Has(kNeededForElbow)) continue;
      const double depth = depths.metres[Index(side.On(kLeftElbow))];
      side[kLeftElbow] = is_on_point ? BeforeElbow(side, depth) : BesideElbow(side, depths);
    }
  }
  // State which joints were moved, and by which rule.
  if (depths.of_file.empty() && depths.of_limb.empty()) return "";
  std::string said = "Etude placed joint centres under the skin, at these distances from the markers in cm: ";
  if (!depths.of_file.empty()) said += Join(depths.of_file) + " by the file's widths";
  if (!depths.of_file.empty() && !depths.of_limb.empty()) said += "; ";
  if (!depths.of_limb.empty()) said += Join(depths.of_limb) + " by the lengths of the limbs";
  if (is_on_point)
    said +=
        "; Etude assumes that the elbow markers are on the point of the elbow, because then the upper arms keep their "
        "length";
  return said;
}

}  // namespace etude
