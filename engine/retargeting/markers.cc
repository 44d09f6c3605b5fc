#include "engine/retargeting/markers.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

#include "engine/base/gaps.h"
#include "engine/base/names.h"
#include "engine/base/order_statistics.h"
#include "engine/motion/displacements.h"
#include "engine/motion/statistics.h"
#include "engine/retargeting/body_doubts.h"
#include "engine/retargeting/exchanged_sides.h"
#include "engine/retargeting/marker_people.h"
#include "engine/retargeting/marker_repairs.h"
#include "engine/retargeting/marker_sets.h"
#include "engine/retargeting/shown_markers.h"
#include "engine/retargeting/skin_markers.h"
#include "engine/retargeting/skin_names.h"
#include "engine/retargeting/to_body.h"

namespace etude {
namespace {

constexpr double kMaxGap_s = 1;

/// Fills gaps of at most `most` frames by linear interpolation; returns the number of filled frames. `longest` becomes
/// the gap if the gap is longer.
int InterpolateGaps(std::vector<JointPositions>& frames, std::size_t joint, std::size_t most, FrameRange& longest) {
  const auto at = [&](std::size_t frame) -> MarkerPosition& { return frames[frame][joint]; };
  return FillGaps(
      frames.size(), most, [&](std::size_t frame) { return at(frame).has_value(); },
      [&](std::size_t from, std::size_t frame, std::size_t to, double share) {
        at(frame) = *at(from) + share * (*at(to) - *at(from));
        const FrameRange gap{static_cast<int>(from) + 1, static_cast<int>(to) - 1};
        if (gap.last - gap.first > longest.last - longest.first) longest = gap;
      });
}

/// Sets the hip joint centres by the regression of Harrington et al. (2007), "Prediction of the hip joint centre in
/// adults, children, and patients with cerebral palsy", table 6. The table's offsets are in millimetres from the
/// midpoint of the front markers.
void PlaceHips(const std::array<glm::dvec3, 4>& pelvis, JointPositions& places) {
  const glm::dvec3 front = 0.5 * (pelvis[0] + pelvis[1]), back = 0.5 * (pelvis[2] + pelvis[3]);
  const glm::dvec3 right = glm::normalize(pelvis[1] - pelvis[0]);
  glm::dvec3 forward = front - back;
  const double width = 1000 * glm::distance(pelvis[0], pelvis[1]), depth = 1000 * glm::length(forward);
  forward = glm::normalize(forward - glm::dot(forward, right) * right);
  const glm::dvec3 up = glm::cross(right, forward);
  const glm::dvec3 middle = (-0.24 * depth - 9.9) * forward + (-0.30 * width - 10.9) * up;
  const glm::dvec3 side = (0.33 * width + 7.3) * right;
  places[Index(Role::kLeftHip)] = front + 1e-3 * (middle - side);
  places[Index(Role::kRightHip)] = front + 1e-3 * (middle + side);
}

/// Returns the joints' positions in one frame; `scale` multiplies the markers' positions, which are in metres.
JointPositions PositionsOf(const MarkerSet& set, const MarkerColumns& columns, const std::vector<MarkerPosition>& frame,
                           double scale) {
  JointPositions places;
  const auto middle = [&](std::span<const std::string> markers) -> MarkerPosition {
    glm::dvec3 sum(0);
    for (const std::string& marker : markers) {
      const MarkerPosition& one = frame[columns.find(marker)->second];
      if (!one) return std::nullopt;
      sum += *one;
    }
    return scale * sum / static_cast<double>(markers.size());
  };
  // Compute joints from markers, then hips from the pelvis.
  for (const MarkerRule& rule : set.rules) {
    if (HasAll(columns, rule.markers)) places[Index(rule.role)] = middle(rule.markers);
  }
  const auto markers = PelvisOf(set, columns);
  if (markers && !places[Index(Role::kLeftHip)]) {
    std::array<glm::dvec3, 4> pelvis;
    bool is_seen = true;
    for (std::size_t i = 0; i < pelvis.size(); ++i) {
      const MarkerPosition one = middle({&(*markers)[i], 1});
      is_seen = is_seen && one;
      if (one) pelvis[i] = *one;
    }
    if (is_seen) PlaceHips(pelvis, places);
  }
  for (MarkerPosition& place : places) {  // a position is not finite if markers of the pelvis coincide
    if (place && !std::isfinite(place->x + place->y + place->z)) place.reset();
  }
  return places;
}

/// Returns the file's names of the markers that determine a joint; empty if none do.
std::vector<std::string> NamesOf(Role role, const MarkerSet& set, const MarkerColumns& columns,
                                 const MarkerMotion& markers) {
  std::vector<std::string> names = MarkersOfRole(set, columns, role);
  for (std::string& name : names) name = markers.names[columns.find(name)->second];
  return names;
}

/// Returns the wands of thighs and shanks in one frame.
Wands WandsOf(const MarkerSet& set, const MarkerColumns& columns, const std::vector<MarkerPosition>& frame,
              double scale) {
  const auto at = [&](std::size_t wand) -> MarkerPosition {
    const auto found = columns.find(set.wands[wand]);
    if (found == columns.end() || !frame[found->second]) return std::nullopt;
    return scale * *frame[found->second];
  };
  return {.thigh = {at(0), at(1)}, .shank = {at(2), at(3)}};
}

/// Adds the joints that have no markers, by rules of proportion. Y points up.
BodyPose Complete(const JointPositions& places) {
  constexpr double kHeadAbove = 0.3, kHandBeyond = 0.7, kToesBefore = 0.16, kToesBelow = 0.04;
  BodyPose pose;
  for (std::size_t i = 0; i < kRoleCount; ++i) pose.joints[i] = places[i].value_or(glm::dvec3(0));
  const auto lacks = [&](Role role) { return !places[Index(role)]; };
  // Add centres, spine and head.
  if (lacks(Role::kHipCentre)) pose[Role::kHipCentre] = 0.5 * (pose[Role::kLeftHip] + pose[Role::kRightHip]);
  if (lacks(Role::kShoulderCentre)) {
    pose[Role::kShoulderCentre] = 0.5 * (pose[Role::kLeftShoulder] + pose[Role::kRightShoulder]);
  }
  const glm::dvec3 trunk = pose[Role::kShoulderCentre] - pose[Role::kHipCentre];
  if (lacks(Role::kSpine)) pose[Role::kSpine] = pose[Role::kHipCentre] + 0.5 * trunk;
  if (lacks(Role::kHead)) pose[Role::kHead] = pose[Role::kShoulderCentre] + kHeadAbove * trunk;
  // Add hands and toes.
  const glm::dvec3 facing = Facing(pose);
  for (const bool is_left : {true, false}) {
    const auto of = [&](Role role) { return is_left ? role : Mirrored(role); };
    const Role wrist = of(Role::kLeftWrist), ankle = of(Role::kLeftAnkle);
    if (lacks(of(Role::kLeftHand))) {
      pose[of(Role::kLeftHand)] = pose[wrist] + kHandBeyond * (pose[wrist] - pose[of(Role::kLeftElbow)]);
    }
    if (lacks(of(Role::kLeftFoot))) {
      pose[of(Role::kLeftFoot)] = pose[ankle] + kToesBefore * facing - glm::dvec3(0, kToesBelow, 0);
    }
  }
  return pose;
}

/// Returns true if a frame contains every needed joint.
bool IsWhole(const JointPositions& frame) {
  return std::ranges::all_of(kNeededJoints, [&](Role role) { return frame[Index(role)].has_value(); });
}

/// Finds the file's up axis; uses the frames with all needed joints. A foot without a marker is placed at its ankle,
/// and a hand at its wrist, so that no estimated joint is the lowest one.
UpFinding FindUpOf(const std::vector<JointPositions>& frames, double rate_hz, const UpRule& rule) {
  std::vector<BodyPose> poses;
  for (const JointPositions& places : frames) {
    if (!IsWhole(places)) continue;
    BodyPose& pose = poses.emplace_back(Complete(places));
    for (const auto& [tip, joint] :
         {std::pair(Role::kLeftFoot, Role::kLeftAnkle), std::pair(Role::kRightFoot, Role::kRightAnkle),
          std::pair(Role::kLeftHand, Role::kLeftWrist), std::pair(Role::kRightHand, Role::kRightWrist)}) {
      if (!places[Index(tip)]) pose[tip] = pose[joint];
    }
  }
  return FindUp(poses, rate_hz, rule);
}

/// Frames of a file, as [first, second).
using Stretch = std::pair<std::size_t, std::size_t>;

/// Returns all ranges of frames in which every needed joint is known, each as long as possible, in order.
std::vector<Stretch> StretchesOf(const std::vector<JointPositions>& frames) {
  std::vector<Stretch> stretches;
  std::size_t begin = 0;
  for (std::size_t t = 0; t <= frames.size(); ++t) {
    if (t < frames.size() && IsWhole(frames[t])) continue;
    if (t > begin) stretches.emplace_back(begin, t);
    begin = t + 1;
  }
  return stretches;
}

std::vector<BodyPose> PosesOf(const std::vector<JointPositions>& frames, const Stretch& stretch) {
  std::vector<BodyPose> poses;
  for (std::size_t t = stretch.first; t < stretch.second; ++t) poses.push_back(Complete(frames[t]));
  return poses;
}

/// Says which frames the body's motion does not have.
std::string DescribeStretches(const std::vector<Stretch>& stretches, const Stretch& longest, std::size_t frames,
                              bool keeps_others) {
  if (keeps_others && stretches.size() > 1) {
    return fmt::format("the motion has {} parts, because joints are missing between them for over {:g} s",
                       stretches.size(), kMaxGap_s);
  }
  return fmt::format("Etude uses only frames {} to {} of {}, because {}", longest.first + 1, longest.second, frames,
                     stretches.size() > 1 ? fmt::format("joints are missing in other frames for over {:g} s", kMaxGap_s)
                                          : "joints are missing before and after these frames");
}

/// Returns the floor's height: the 5th percentile of the lowest joint's height.
double FloorOf(const std::vector<BodyPose>& poses) {
  std::vector<double> lowest;
  for (const BodyPose& pose : poses) {
    lowest.push_back(std::ranges::min(pose.joints, {}, [](const glm::dvec3& joint) { return joint.y; }).y);
  }
  std::ranges::sort(lowest);
  return lowest[lowest.size() / 20];
}

/// Moves the poses so that the floor is at 0. Does nothing if the user keeps the floor, or if the joints have the names
/// of Etude's own and a known floor near 0.
void StandOnFloor(bool keeps_floor, bool is_own, MarkerBody& body) {
  constexpr double kMaxOwn = 0.5, kMinTold = 0.001;
  const double floor = FloorOf(body.motion.poses);
  if (keeps_floor || (is_own && body.is_floor_known && std::abs(floor) <= kMaxOwn)) return;
  body.floor = floor;
  const auto lower = [floor](std::vector<BodyPose>& poses) {
    for (BodyPose& pose : poses) {
      for (glm::dvec3& joint : pose.joints) joint.y -= floor;
    }
  };
  lower(body.motion.poses);
  for (BodyStretch& other : body.others) lower(other.poses);
  if (std::abs(floor) >= kMinTold) {
    body.changes.push_back(fmt::format("Etude moved the floor from {:.4g} cm to 0", 100 * floor));
  }
}

/// Returns true if the positions are relative to the hips, which then never leave the origin.
bool IsRelativeToHips(const std::vector<BodyPose>& poses) {
  constexpr double kMaxAway = 1e-3;
  return std::ranges::all_of(poses,
                             [](const BodyPose& pose) { return glm::length(pose[Role::kHipCentre]) < kMaxAway; });
}

/// Adds a text about the positions that were interpolated in gaps. It is a doubt if the longest gap of a joint is long
/// enough that the joint may have done something else, unless the caller also gets the positions without interpolation
/// (`keeps_shown`).
void TellFilled(int filled, const FrameRange& longest, const MarkerMotion& markers, bool keeps_shown,
                MarkerBody& body) {
  constexpr double kLong_s = 0.25;
  if (filled == 0) return;
  std::string said = fmt::format("{} positions interpolated in gaps", filled);
  const bool is_long = (longest.last - longest.first + 1) / markers.rate_hz >= kLong_s;
  if (is_long) {
    const double start_s = markers.start_s.value_or(0);
    said += fmt::format(", the longest from {:.2f} to {:.2f} s", start_s + longest.first / markers.rate_hz,
                        start_s + longest.last / markers.rate_hz);
  }
  if (is_long && !keeps_shown) return body.Doubt(said);
  body.changes.push_back(std::move(said));
}

/// Makes the body from the markers' positions times `scale`; nullopt if no frame has all needed joints.
std::optional<MarkerBody> BodyAt(double scale, const MarkerMotion& markers, const MarkerSet& set,
                                 const MarkerColumns& columns, const MarkerOptions& options) {
  // Compute the joints and the joint centres, and fill short gaps.
  std::vector<JointPositions> frames;
  std::vector<Wands> wands;
  frames.reserve(markers.frames.size());
  for (const auto& frame : markers.frames) {
    frames.push_back(PositionsOf(set, columns, frame, scale));
    wands.push_back(WandsOf(set, columns, frame, scale));
  }
  const std::string crossing = DescribeExchangedJoints(frames, markers.rate_hz, [&](Role role) {
    const bool has_rule = std::ranges::find(set.rules, role, &MarkerRule::role) != set.rules.end();
    const std::string names = has_rule ? Join(NamesOf(role, set, columns, markers), " and ") : "";
    return names.empty() ? std::string(RoleName(role)) : names;
  });
  const std::string centres = MoveToJointCentres(set, markers.sizes_m, wands, frames);
  const std::vector<JointPositions> seen = options.keeps_shown ? frames : std::vector<JointPositions>();
  int filled = 0;
  FrameRange longest_gap{0, -1};
  const auto max_gap = static_cast<std::size_t>(kMaxGap_s * markers.rate_hz);
  for (std::size_t joint = 0; joint < kRoleCount; ++joint)
    filled += InterpolateGaps(frames, joint, max_gap, longest_gap);
  // Rotate upright. Files that Etude wrote have Y up; arrays of other layouts only borrow the names of Etude's joints.
  UpRule rule = options.up;
  const bool is_borrowed = !options.layout.empty() && (options.layout != "etude" || options.is_of_camera);
  if (set.is_own && !is_borrowed && rule.evidence == UpEvidence::kPosture) rule = OwnJointsUp();
  const std::string name = set.is_own && is_borrowed ? "layout " + options.layout : set.name;
  MarkerBody body{.name = "", .motion = {.rate_hz = markers.rate_hz, .poses = {}}, .up = {}, .changes = {name}};
  for (const Role role : AllRoles()) body.markers[Index(role)] = NamesOf(role, set, columns, markers);
  body.up = FindUpOf(frames, markers.rate_hz, rule);
  for (JointPositions& places : frames) {
    for (MarkerPosition& place : places) {
      if (place) place = TurnedUp(*place, body.up.axis);
    }
  }
  // The longest range without gaps is the motion.
  const std::vector<Stretch> stretches = StretchesOf(frames);
  if (stretches.empty()) return std::nullopt;
  const Stretch longest = *std::ranges::max_element(stretches, {}, [](const Stretch& s) { return s.second - s.first; });
  body.first_frame = longest.first;
  body.motion.poses = PosesOf(frames, longest);
  const bool has_no_origin = body.up.axis.y < 0 || IsRelativeToHips(body.motion.poses);
  body.is_floor_known = !options.is_of_camera && (options.layout.empty() || !has_no_origin);
  for (const Stretch& stretch : stretches) {
    if (options.keeps_others && stretch != longest) body.others.push_back({stretch.first, PosesOf(frames, stretch)});
  }
  // Describe the corrections.
  TellFilled(filled, longest_gap, markers, options.keeps_shown, body);
  const bool uses_all = options.keeps_shown && !options.keeps_others;  // MarkerBody::shown has all frames
  if (body.motion.poses.size() < frames.size() && !uses_all) {
    body.Doubt(DescribeStretches(stretches, longest, frames.size(), options.keeps_others));
  }
  if (!centres.empty()) body.changes.push_back(centres);
  std::vector<std::string> guessed;
  for (const Role role : AllRoles()) {
    if (body.markers[Index(role)].empty()) guessed.emplace_back(RoleName(role));
  }
  if (!guessed.empty()) body.changes.push_back("placed by rule: " + Join(guessed));
  if (!markers.remark.empty()) body.changes.push_back(markers.remark);
  if (std::string turn = DescribeTurn(body.up); !turn.empty()) body.changes.push_back(std::move(turn));
  body.Doubt(body.up.doubt);
  if (Determines(set, columns, Role::kLeftFoot) && Determines(set, columns, Role::kRightFoot) &&
      PointFeetBackwards(body.motion.poses)) {
    body.Doubt("the feet point backwards: left and right are exchanged, or an axis is mirrored");
  }
  body.Doubt(crossing);
  body.Doubt(DescribeFlatBody(frames));
  StandOnFloor(options.keep_floor, set.is_own, body);
  if (!options.keeps_shown) return body;
  body.shown = AsShown(scale, markers, set, columns, seen, body.up.axis);
  for (const std::string& said : {centres, DescribeTurn(body.up)}) {
    if (!said.empty()) body.shown.notes[0] += "; " + said;
  }
  return body;
}

/// Makes the body in the file's unit. If the body's size is implausible, multiplies the unit by the power of ten that
/// gives a person's size, and states this in the note. Fails if no power of ten gives such a size.
Result<std::optional<MarkerBody>> BodyOf(const MarkerMotion& markers, const MarkerSet& set,
                                         const MarkerColumns& columns, const MarkerOptions& options,
                                         const std::string& file) {
  constexpr double kMinStature = 0.4, kMaxStature = 4, kMinPerson = 1.2, kMaxPerson = 2.3;
  const double told_scale = options.metres_per_unit.value_or(markers.metres_per_unit) / markers.metres_per_unit;
  auto body = BodyAt(told_scale, markers, set, columns, options);
  if (!body) return body;
  if (told_scale != 1) {
    body->changes.push_back(fmt::format("1 unit = {:.4g} cm (given), instead of {:.4g} cm as in the file",
                                        100 * *options.metres_per_unit, 100 * markers.metres_per_unit));
  }
  const double told = MedianStature(body->motion.poses);
  if (told >= kMinStature && told <= kMaxStature) {
    const bool is_odd = !DescribeImpossibleHeight(body->motion.poses).empty();
    if (is_odd) body->Doubt(DescribeLikelyUnit(told, told_scale * markers.metres_per_unit));
    return body;
  }
  // A body that is far too small is measured at a thousand times its size, where rules in metres hardly matter.
  double own = told;
  if (told < kMinStature) {
    if (const auto large = BodyAt(1000 * told_scale, markers, set, columns, options)) {
      own = MedianStature(large->motion.poses) / 1000;
    }
  }
  if (options.metres_per_unit) {
    return Fail({file}, "with the given unit (1 unit = {:.4g} cm), the body is {:.3g} m tall; allowed: {:g} to {:g} m",
                100 * *options.metres_per_unit, own, kMinStature, kMaxStature);
  }
  for (const double scale : {1000.0, 100.0, 10.0, 0.1, 0.01, 0.001}) {
    auto scaled = BodyAt(scale, markers, set, columns, options);
    if (!scaled) continue;
    const double stature = MedianStature(scaled->motion.poses);
    if (stature < kMinPerson || stature > kMaxPerson) continue;
    scaled->changes.push_back(
        fmt::format("with the file's unit, the body would be {:.3g} m tall, so Etude multiplies all lengths by {:g}",
                    stature / scale, scale));
    return scaled;
  }
  return Fail({file}, "the markers show a body {:.3g} m tall; allowed: {:g} to {:g} m; is the unit of the file right?",
              own, kMinStature, kMaxStature);
}

/// Lists the columns of the markers by which the complete people are read.
std::set<std::size_t> UsedColumns(const std::vector<MarkerPerson>& people) {
  std::set<std::size_t> used;
  for (const MarkerPerson& person : people) {
    for (const Role role : AllRoles()) {
      if (!person.IsComplete()) continue;
      for (const std::string& marker : MarkersOfRole(*person.chosen.set(), person.columns, role)) {
        used.insert(person.columns.find(marker)->second);
      }
    }
  }
  return used;
}

}  // namespace

std::string DescribeUnknownMarkers(const MarkerMotion& markers, const MarkerOptions& options) {
  std::string nearest = "", why = "";
  std::size_t fewest = kNeededJoints.size() + 1;
  for (const MarkerPerson& person : FindMarkerPeople(markers, options.set, options.roles)) {
    if (person.IsComplete()) return "";
    const auto compare = [&](const MarkerSet& set) {
      const auto lacks = MissingFrom(set, person.columns);
      if (lacks.size() >= fewest || (!options.set.empty() && set.key != options.set)) return;
      fewest = lacks.size();
      nearest = fmt::format("{} lacks {}", set.name, Join(lacks));
      const bool is_made_of_skin = person.chosen.made && &set == &*person.chosen.made && set.has_skin_limbs;
      why = is_made_of_skin ? "; markers on thighs, shanks and upper arms do not determine joints" : "";
    };
    if (person.chosen.made) compare(*person.chosen.made);
    for (const MarkerSet& set : MarkerSets()) compare(set);
  }
  const std::size_t shown = std::min<std::size_t>(markers.names.size(), 12);
  return fmt::format(
      "the markers ({}{}) belong to no known marker set (nearest: {}{}); allowed: {}, or the joint names of "
      "skeletons{}{}; use a joint map (--joint-map) to state which markers are the joints",
      Join(std::span(markers.names).first(shown)), markers.names.size() > shown ? ", …" : "", nearest, why,
      NamesOfMarkerSets(), markers.remark.empty() ? "" : "; ", markers.remark);
}

Result<std::vector<MarkerBody>> FindMarkerBodies(MarkerMotion markers, const std::string& file,
                                                 const MarkerOptions& options) {
  const std::set<std::size_t> used = UsedColumns(FindMarkerPeople(markers, options.set, options.roles));
  RepairMarkers(markers, used);
  const std::string equal_names = DescribeEqualNames(markers, used);
  // Choose the marker set of each person, and make the body from it.
  std::vector<MarkerBody> bodies;
  const std::vector<MarkerPerson> people = FindMarkerPeople(markers, options.set, options.roles);
  for (const MarkerPerson& person : people) {
    if (!person.IsComplete()) continue;
    if (const std::string wand = DescribeWandAsHip(markers, *person.chosen.set(), person.columns); !wand.empty()) {
      return Fail({file}, "{}", wand);
    }
    ASSIGN_OR_RETURN(auto body, BodyOf(markers, *person.chosen.set(), person.columns, options, file));
    if (!body) continue;
    body->name = person.name;
    if (const MarkerSet* const other = person.chosen.other; other != nullptr) {
      body->changes.front() +=
          fmt::format(" (the file also contains {}; --marker-set {} chooses this set)", other->name, other->key);
    }
    if (!person.remark.empty()) body->changes.push_back(person.remark);
    body->Doubt(equal_names);
    for (const MarkerPerson& other : people) {
      if (&other == &person) continue;
      body->Doubt(DescribeExchangedMarkers(markers, person.columns, other.columns));
    }
    bodies.push_back(std::move(*body));
  }
  // Explain why there is no body.
  if (!bodies.empty()) return bodies;
  const std::string unknown = DescribeUnknownMarkers(markers, options);
  return Fail({file}, "{}", unknown.empty() ? "no frame contains all joints of a body" : unknown);
}

}  // namespace etude
