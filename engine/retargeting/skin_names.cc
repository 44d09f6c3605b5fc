#include "engine/retargeting/skin_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/order_statistics.h"
#include "engine/retargeting/joint_names.h"

namespace etude {
namespace {

using Words = std::span<const std::string_view>;

/// The names of a joint's markers, without their side: outer and inner marker, or one marker alone.
struct SkinNames {
  Role left;
  std::string_view outer, inner = "";
};
// The first row whose names a person has counts, so pairs come before single markers.
constexpr SkinNames kSkinNames[] = {
    {Role::kLeftShoulder, "shoulder"},
    {Role::kLeftShoulder, "acromium"},
    {Role::kLeftShoulder, "acromion"},
    {Role::kLeftShoulder, "acr"},
    {Role::kLeftShoulder, "sho"},
    {Role::kLeftShoulder, "sae"},
    {Role::kLeftShoulder, "shouldertop"},
    {Role::kLeftElbow, "elbow", "elbowmedial"},
    {Role::kLeftElbow, "elbow", "melbow"},
    {Role::kLeftElbow, "lelbow", "melbow"},
    {Role::kLeftElbow, "elbowlat", "elbowmed"},
    {Role::kLeftElbow, "lel", "mel"},
    {Role::kLeftElbow, "lee", "mee"},
    {Role::kLeftElbow, "hle", "hme"},
    {Role::kLeftElbow, "armlatepicondyle", "armmedepicondyle"},
    {Role::kLeftElbow, "elbowout", "elbowin"},
    {Role::kLeftElbow, "elbowout"},
    {Role::kLeftElbow, "elbow"},
    {Role::kLeftWrist, "wristlat", "wristmed"},
    {Role::kLeftWrist, "lwrist", "mwrist"},
    {Role::kLeftWrist, "radius", "ulna"},
    {Role::kLeftWrist, "faradius", "faulna"},
    {Role::kLeftWrist, "rsp", "usp"},
    {Role::kLeftWrist, "radialstyloid", "ulnarstyloid"},
    {Role::kLeftWrist, "wristout", "wristin"},
    {Role::kLeftWrist, "wrist"},
    {Role::kLeftKnee, "knee", "kneemedial"},
    {Role::kLeftKnee, "knee", "mknee"},
    {Role::kLeftKnee, "kneelat", "kneemed"},
    {Role::kLeftKnee, "lfc", "mfc"},
    {Role::kLeftKnee, "lek", "mek"},
    {Role::kLeftKnee, "fle", "fme"},
    {Role::kLeftKnee, "kneelatepicondyle", "kneemedepicondyle"},
    {Role::kLeftKnee, "kneeout", "kneein"},
    {Role::kLeftKnee, "kneeout"},
    {Role::kLeftKnee, "knee"},
    {Role::kLeftKnee, "kneelat"},
    {Role::kLeftKnee, "lfc"},
    {Role::kLeftKnee, "lek"},
    {Role::kLeftAnkle, "ankle", "anklemedial"},
    {Role::kLeftAnkle, "ankle", "mankle"},
    {Role::kLeftAnkle, "anklelat", "anklemed"},
    {Role::kLeftAnkle, "lmal", "mmal"},
    {Role::kLeftAnkle, "lm", "mm"},
    {Role::kLeftAnkle, "fal", "tam"},
    {Role::kLeftAnkle, "latmalleolus", "medmalleolus"},
    {Role::kLeftAnkle, "ankleout", "anklein"},
    {Role::kLeftAnkle, "ankleout"},
    {Role::kLeftAnkle, "ankle"},
    {Role::kLeftAnkle, "anklelat"},
    {Role::kLeftAnkle, "lmal"},
    {Role::kLeftAnkle, "lm"},
    {Role::kLeftFoot, "toe"},
    {Role::kLeftFoot, "toetip"},
    {Role::kLeftFoot, "fm2"},
    {Role::kLeftFoot, "toein", "toeout"},
    {Role::kLeftHand, "fin"},
    {Role::kLeftHand, "handout"},
};
constexpr std::string_view kSides[] = {"l", "r", "left", "right"};
constexpr std::string_view kHipCentres[] = {"hipjc", "hjc", "hipjointcentre", "hipjointcenter"};
constexpr std::string_view kInnerKnees[] = {"kneemedial", "kneemed", "mknee", "mfc", "mek", "fme"};
constexpr std::string_view kFrontSpines[] = {"asis", "asi", "ias", "waist/front"};
constexpr std::string_view kBackSpines[] = {"psis", "psi", "ips", "waist/back"};
constexpr std::string_view kSacra[] = {"sacral", "vsacral", "sacrum", "sacr", "vsac"};
constexpr std::string_view kThigh[] = {"thigh"}, kKnee[] = {"knee"}, kShank[] = {"shank"};

/// The markers of one person, by the words of their names.
class NamedMarkers {
 public:
  NamedMarkers(const MarkerColumns& columns, std::span<const std::string> names)
      : points_(PointsOf(columns, names)), known_(points_) {
    for (const auto& [key, column] : columns) keys_.push_back(key);
  }

  /// Returns the key of the first of the names that exists on a side, or in the middle of the body; "" if none exists.
  /// For "waist/front", the word before the side must be "waist".
  std::string Find(Words words, std::optional<Side> side) const {
    for (const std::string_view word : words) {
      const std::size_t slash = word.find('/');
      const std::string_view before = slash == word.npos ? "" : word.substr(0, slash);
      const std::string_view name = slash == word.npos ? word : word.substr(slash + 1);
      for (const NamedJoint& found : side ? known_.Find(name, *side) : known_.Find(name)) {
        // "R_LElbow" is not the left elbow.
        const bool is_of_side = std::ranges::find(kSides, found.prefix) != std::end(kSides);
        if (before.empty() ? !is_of_side : found.prefix == before) return keys_[static_cast<std::size_t>(found.joint)];
      }
    }
    return "";
  }
  bool HasBoth(Words words) const { return !Find(words, Side::kLeft).empty() && !Find(words, Side::kRight).empty(); }

 private:
  static Skeleton PointsOf(const MarkerColumns& columns, std::span<const std::string> names) {
    Skeleton points;
    for (const auto& [key, column] : columns) points.joints.push_back({.name = names[column], .rest = {}});
    return points;
  }

  Skeleton points_;
  JointNames known_;
  std::vector<std::string> keys_;
};

bool ShowsSkin(const NamedMarkers& markers) {
  if (markers.HasBoth(kFrontSpines) || markers.HasBoth(kBackSpines) || markers.HasBoth(kInnerKnees)) return true;
  return markers.HasBoth(kThigh) && markers.HasBoth(kKnee) && markers.HasBoth(kShank);
}

void AddLimbs(const NamedMarkers& markers, MarkerSet& set) {
  for (const bool is_left : {true, false}) {
    const Side side = is_left ? Side::kLeft : Side::kRight;
    const auto add = [&](Role left, std::vector<std::string> keys) {
      set.rules.push_back({is_left ? left : Mirrored(left), std::move(keys)});
    };
    std::optional<Role> done;
    for (const SkinNames& row : kSkinNames) {
      const std::string outer = markers.Find(std::array{row.outer}, side);
      const std::string inner = markers.Find(std::array{row.inner}, side);
      if (row.left == done || outer.empty() || (inner.empty() && !row.inner.empty())) continue;
      add(row.left, row.inner.empty() ? std::vector{outer} : std::vector{outer, inner});
      done = row.left;
    }
    // Use the file's hip joint centres if the pelvis does not determine the hips.
    const std::string hip = markers.Find(kHipCentres, side);
    if (set.pelvis.front().empty() && !hip.empty()) add(Role::kLeftHip, {hip});
    set.wands[is_left ? 0 : 1] = markers.Find(kThigh, side);
    set.wands[is_left ? 2 : 3] = markers.Find(kShank, side);
  }
}

}  // namespace

std::optional<MarkerSet> SetOfSkinNames(const MarkerColumns& columns, std::span<const std::string> names) {
  const NamedMarkers markers(columns, names);
  if (!ShowsSkin(markers)) return std::nullopt;
  MarkerSet set{.name = "skin markers (Helen Hayes)", .key = "", .rules = {}};
  set.has_skin_limbs = set.has_skin_shoulders = true;
  // The pelvis: the two markers on its back, or the one on the sacrum.
  if (markers.HasBoth(kFrontSpines)) {
    const std::string sacrum = markers.Find(kSacra, std::nullopt);
    const std::string left = markers.Find(kBackSpines, Side::kLeft), right = markers.Find(kBackSpines, Side::kRight);
    const bool has_both = !left.empty() && !right.empty();
    if (has_both || !sacrum.empty()) {
      set.pelvis = {markers.Find(kFrontSpines, Side::kLeft), markers.Find(kFrontSpines, Side::kRight),
                    has_both ? left : sacrum, has_both ? right : sacrum};
    }
  }
  AddLimbs(markers, set);
  // The middle of the body: the mean of front and back.
  for (const auto& [role, front, back] :
       {SkinNames{Role::kHead, "fronthead", "rearhead"}, SkinNames{Role::kShoulderCentre, "clav", "c7"},
        SkinNames{Role::kShoulderCentre, "sjn", "cv7"}, SkinNames{Role::kShoulderCentre, "ij", "c7spinalprocess"},
        SkinNames{Role::kShoulderCentre, "chest", "backtop"}, SkinNames{Role::kSpine, "strn", "t10"}}) {
    const std::string one = markers.Find(std::array{front}, std::nullopt);
    const std::string other = markers.Find(std::array{back}, std::nullopt);
    if (!one.empty() && !other.empty()) set.rules.push_back({role, {one, other}});
  }
  return set;
}

std::string DescribeWandAsHip(const MarkerMotion& markers, const MarkerSet& set, const MarkerColumns& columns) {
  constexpr double kMinThigh = 0.75;
  for (const Role hip : {Role::kLeftHip, Role::kRightHip}) {
    const bool is_left = hip == Role::kLeftHip;
    std::array<std::size_t, 3> leg{};
    bool is_whole = true;
    for (std::size_t i = 0; i < leg.size(); ++i) {
      const Role left = std::array{Role::kLeftHip, Role::kLeftKnee, Role::kLeftAnkle}[i];
      const auto rule = std::ranges::find(set.rules, is_left ? left : Mirrored(left), &MarkerRule::role);
      is_whole = is_whole && rule != set.rules.end() && !rule->is_joint && HasAll(columns, rule->markers);
      if (is_whole) leg[i] = columns.find(rule->markers.front())->second;
    }
    if (!is_whole || MarkerKey(markers.names[leg[0]]).find("thigh") == std::string::npos) continue;
    std::vector<double> shares;
    for (const auto& frame : markers.frames) {
      if (!frame[leg[0]] || !frame[leg[1]] || !frame[leg[2]]) continue;
      const double shank = glm::distance(*frame[leg[1]], *frame[leg[2]]);
      if (shank > 0) shares.push_back(glm::distance(*frame[leg[0]], *frame[leg[1]]) / shank);
    }
    const double share = shares.empty() ? kMinThigh : LowerPercentile(std::move(shares), 0.5);
    if (share >= kMinThigh) continue;
    return fmt::format(
        "{} is on the thigh instead of the hip, because its distance from {} is {:.2f} times the distance from that "
        "marker to {}; allowed: markers of the pelvis, or a joint map (--joint-map) that states which markers are the "
        "joints",
        markers.names[leg[0]], markers.names[leg[1]], share, markers.names[leg[2]]);
  }
  return "";
}

}  // namespace etude
