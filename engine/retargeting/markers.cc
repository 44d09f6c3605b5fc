#include "engine/retargeting/markers.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>

#include "engine/base/names.h"
#include "engine/base/order_statistics.h"
#include "engine/motion/statistics.h"
#include "engine/retargeting/marker_sets.h"

namespace etude {
namespace {

using MarkerPosition = std::optional<glm::dvec3>;
using JointPositions = std::array<MarkerPosition, kRoleCount>;

constexpr double kMaxGap_s = 1;

/// The joints without which there is no body.
constexpr std::array kNeeded = {Role::kLeftShoulder, Role::kLeftElbow,  Role::kLeftWrist, Role::kRightShoulder,
                                Role::kRightElbow,   Role::kRightWrist, Role::kLeftHip,   Role::kLeftKnee,
                                Role::kLeftAnkle,    Role::kRightHip,   Role::kRightKnee, Role::kRightAnkle};

std::string LowerCase(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return lower;
}

/// Returns true if a position is all zeros, which some programs write for a gap.
bool IsZero(const MarkerPosition& place) { return place && *place == glm::dvec3(0); }

/// Removes positions that are all zeros, for markers that are elsewhere in other frames (the root of a root-relative
/// pose is always at zero). Returns their count.
int LeaveZerosOut(MarkerMotion& markers) {
  int zeros = 0;
  for (std::size_t marker = 0; marker < markers.names.size(); ++marker) {
    const auto is_zero = [&](const auto& frame) { return IsZero(frame[marker]); };
    const auto is_elsewhere = [&](const auto& frame) { return frame[marker] && !is_zero(frame); };
    if (std::ranges::none_of(markers.frames, is_zero) || std::ranges::none_of(markers.frames, is_elsewhere)) continue;
    for (auto& frame : markers.frames) {
      if (!is_zero(frame)) continue;
      frame[marker].reset();
      ++zeros;
    }
  }
  return zeros;
}

/// The columns of one person's markers, by their names in lower case without prefix.
using Columns = std::map<std::string, std::size_t, std::less<>>;

std::map<std::string, Columns> PeopleOf(const MarkerMotion& markers) {
  std::map<std::string, Columns> people;
  for (std::size_t i = 0; i < markers.names.size(); ++i) {
    const std::string& name = markers.names[i];
    const std::size_t colon = name.rfind(':');
    const std::string prefix = colon == std::string::npos ? "" : name.substr(0, colon);
    people[prefix].emplace(LowerCase(name.substr(colon == std::string::npos ? 0 : colon + 1)), i);  // the first counts
  }
  return people;
}

bool HasAll(const Columns& columns, std::span<const std::string> markers) {
  return std::ranges::all_of(markers, [&](const std::string& marker) { return columns.contains(marker); });
}

bool HasPelvis(const MarkerSet& set, const Columns& columns) {
  return !set.pelvis.front().empty() && HasAll(columns, set.pelvis);
}

bool Determines(const MarkerSet& set, const Columns& columns, Role role) {
  if ((role == Role::kLeftHip || role == Role::kRightHip) && HasPelvis(set, columns)) return true;
  return std::ranges::any_of(
      set.rules, [&](const MarkerRule& rule) { return rule.role == role && HasAll(columns, rule.markers); });
}

std::vector<std::string> MissingFrom(const MarkerSet& set, const Columns& columns) {
  std::vector<std::string> lacks;
  for (const Role role : kNeeded) {
    if (!Determines(set, columns, role)) lacks.emplace_back(RoleName(role));
  }
  return lacks;
}

/// Interpolates linearly between two points.
glm::dvec3 Interpolate(const glm::dvec3& a, const glm::dvec3& b, double part) { return a + part * (b - a); }

/// Fills gaps of at most `most` frames linearly; returns the number of frames filled.
int BridgeGaps(std::vector<JointPositions>& frames, std::size_t joint, std::size_t most) {
  int filled = 0;
  std::optional<std::size_t> last;
  for (std::size_t t = 0; t < frames.size(); ++t) {
    if (!frames[t][joint]) continue;
    if (last && t - *last > 1 && t - *last <= most + 1) {
      for (std::size_t k = *last + 1; k < t; ++k, ++filled) {
        frames[k][joint] = Interpolate(*frames[*last][joint], *frames[t][joint],
                                       static_cast<double>(k - *last) / static_cast<double>(t - *last));
      }
    }
    last = t;
  }
  return filled;
}

/// Sets the hip joint centres by Harrington et al. (2007), "Prediction of the hip joint centre in adults, children, and
/// patients with cerebral palsy", table 6: millimetres, relative to the midpoint of the front markers.
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

/// Returns the component of `across` perpendicular to the line from `from` to `to`, normalised.
glm::dvec3 PerpendicularTo(const glm::dvec3& across, const glm::dvec3& from, const glm::dvec3& to) {
  const glm::dvec3 along = glm::normalize(to - from);
  return glm::normalize(across - glm::dot(across, along) * along);
}

/// Moves Plug-in Gait's markers from the skin to the joint centres.
void MoveIntoLimbs(JointPositions& places) {
  constexpr double kHalfKnee = 0.05, kHalfAnkle = 0.035, kShoulderDepth = 0.045;
  // Knees and ankles: inward, perpendicular to the limb.
  const auto at = [&](Role role) -> MarkerPosition& { return places[Index(role)]; };
  if (at(Role::kLeftHip) && at(Role::kRightHip)) {
    const glm::dvec3 to_right = *at(Role::kRightHip) - *at(Role::kLeftHip);
    for (const bool is_left : {true, false}) {
      const auto of = [&](Role role) -> MarkerPosition& { return at(is_left ? role : Mirrored(role)); };
      const glm::dvec3 inward = is_left ? to_right : -to_right;
      MarkerPosition &hip = of(Role::kLeftHip), &knee = of(Role::kLeftKnee), &ankle = of(Role::kLeftAnkle);
      if (knee) *knee += kHalfKnee * PerpendicularTo(inward, *hip, *knee);
      if (knee && ankle) *ankle += kHalfAnkle * PerpendicularTo(inward, *knee, *ankle);
    }
  }
  // Shoulders: down along the trunk.
  const MarkerPosition &neck = at(Role::kShoulderCentre), &spine = at(Role::kSpine);
  if (!neck || !spine) return;
  for (const Role shoulder : {Role::kLeftShoulder, Role::kRightShoulder}) {
    if (at(shoulder)) *at(shoulder) += kShoulderDepth * glm::normalize(*spine - *neck);
  }
}

/// Returns the joints' positions in one frame; `scale` is the length of the file's unit in metres.
JointPositions PositionsOf(const MarkerSet& set, const Columns& columns, const std::vector<MarkerPosition>& frame,
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
  // Joints from markers, then hips from the pelvis.
  for (const MarkerRule& rule : set.rules) {
    if (HasAll(columns, rule.markers)) places[Index(rule.role)] = middle(rule.markers);
  }
  if (HasPelvis(set, columns) && !places[Index(Role::kLeftHip)]) {
    std::array<glm::dvec3, 4> pelvis;
    bool is_seen = true;
    for (std::size_t i = 0; i < pelvis.size(); ++i) {
      const MarkerPosition one = middle({&set.pelvis[i], 1});
      is_seen = is_seen && one;
      if (one) pelvis[i] = *one;
    }
    if (is_seen) PlaceHips(pelvis, places);
  }
  if (set.is_gait) MoveIntoLimbs(places);
  for (MarkerPosition& place : places) {  // coinciding markers have no direction
    if (place && !std::isfinite(place->x + place->y + place->z)) place.reset();
  }
  return places;
}

/// Completes the joints without markers by rules of proportion. Y points up.
BodyPose Complete(const JointPositions& places) {
  constexpr double kHeadAbove = 0.3, kHandBeyond = 0.7, kToesBefore = 0.16, kToesBelow = 0.04;
  BodyPose pose;
  for (std::size_t i = 0; i < kRoleCount; ++i) pose.joints[i] = places[i].value_or(glm::dvec3(0));
  const auto lacks = [&](Role role) { return !places[Index(role)]; };
  // Centres, spine and head.
  if (lacks(Role::kHipCentre)) pose[Role::kHipCentre] = 0.5 * (pose[Role::kLeftHip] + pose[Role::kRightHip]);
  if (lacks(Role::kShoulderCentre)) {
    pose[Role::kShoulderCentre] = 0.5 * (pose[Role::kLeftShoulder] + pose[Role::kRightShoulder]);
  }
  const glm::dvec3 trunk = pose[Role::kShoulderCentre] - pose[Role::kHipCentre];
  if (lacks(Role::kSpine)) pose[Role::kSpine] = pose[Role::kHipCentre] + 0.5 * trunk;
  if (lacks(Role::kHead)) pose[Role::kHead] = pose[Role::kShoulderCentre] + kHeadAbove * trunk;
  // Hands and toes.
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

/// Returns the axis, with its sign, along which shoulders are farthest from ankles.
glm::dvec3 FindUp(const std::vector<JointPositions>& frames) {
  glm::dvec3 sum(0);
  for (const JointPositions& places : frames) {
    const MarkerPosition &shoulder = places[Index(Role::kLeftShoulder)], &ankle = places[Index(Role::kLeftAnkle)];
    if (shoulder && ankle) sum += *shoulder - *ankle;
  }
  glm::dvec3 up(0);
  int axis = 1;
  for (int i = 0; i < 3; ++i) {
    if (std::abs(sum[i]) > std::abs(sum[axis])) axis = i;
  }
  up[axis] = sum[axis] < 0 ? -1 : 1;
  return up;
}

/// Rotates a position so that `up` becomes Y.
glm::dvec3 TurnedUpright(const glm::dvec3& up, const glm::dvec3& p) {
  if (up.z != 0) return {p.x, up.z * p.z, -up.z * p.y};
  if (up.x != 0) return {-up.x * p.y, up.x * p.x, p.z};
  return up.y < 0 ? glm::dvec3(p.x, -p.y, -p.z) : p;
}

void TurnUpright(const glm::dvec3& up, std::vector<JointPositions>& frames) {
  for (JointPositions& places : frames) {
    for (MarkerPosition& place : places) {
      if (place) *place = TurnedUpright(up, *place);
    }
  }
}

/// Returns MarkerBody::shown. `up` is the direction that becomes Y.
MarkerMotion AsShown(double scale, const MarkerMotion& markers, const MarkerSet& set, const Columns& columns,
                     const glm::dvec3& up) {
  MarkerMotion shown{.rate_hz = markers.rate_hz, .names = {}, .frames = {}, .remark = set.name};
  if (scale != 1) shown.remark += fmt::format("; taken for {:g} times the file's unit, by the body's stature", scale);
  if (!markers.remark.empty()) shown.remark += "; " + markers.remark;
  std::vector<Role> roles;
  for (const Role role : AllRoles()) {
    if (Determines(set, columns, role)) roles.push_back(role);
  }
  for (const Role role : roles) shown.names.emplace_back(RoleName(role));
  std::vector<std::size_t> others;
  for (const auto& [name, column] : columns) {
    if (FindRole(name)) continue;
    shown.names.push_back(name);
    others.push_back(column);
  }
  for (const auto& frame : markers.frames) {
    const JointPositions places = PositionsOf(set, columns, frame, scale);
    std::vector<MarkerPosition>& row = shown.frames.emplace_back();
    for (const Role role : roles) row.push_back(places[Index(role)]);
    for (const std::size_t column : others) row.push_back(frame[column]);
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (row[i]) row[i] = TurnedUpright(up, (i < roles.size() ? 1 : scale) * *row[i]);
    }
  }
  return shown;
}

/// Returns the longest range of frames in which every needed joint is known: its first frame and the frame after its
/// last.
std::pair<std::size_t, std::size_t> LongestStretch(const std::vector<JointPositions>& frames) {
  std::pair<std::size_t, std::size_t> best{0, 0};
  std::size_t begin = 0;
  for (std::size_t t = 0; t <= frames.size(); ++t) {
    const bool is_whole = t < frames.size() &&
                          std::ranges::all_of(kNeeded, [&](Role role) { return frames[t][Index(role)].has_value(); });
    if (is_whole) continue;
    if (t - begin > best.second - best.first) best = {begin, t};
    begin = t + 1;
  }
  return best;
}

/// Shifts the poses so that the floor is at 0. The floor is the 5th percentile of the lowest joint's height.
void StandOnFloor(std::vector<BodyPose>& poses) {
  std::vector<double> lowest;
  for (const BodyPose& pose : poses) {
    lowest.push_back(std::ranges::min(pose.joints, {}, [](const glm::dvec3& joint) { return joint.y; }).y);
  }
  std::ranges::sort(lowest);
  const double floor = lowest[lowest.size() / 20];
  for (BodyPose& pose : poses) {
    for (glm::dvec3& joint : pose.joints) joint.y -= floor;
  }
}

// Makes the body for one length of the file's unit; nullopt if no frame has all needed joints.
std::optional<MarkerBody> BodyAt(double scale, const MarkerMotion& markers, const MarkerSet& set,
                                 const Columns& columns, char up) {
  // Compute the joints, fill short gaps, and rotate upright.
  std::vector<JointPositions> frames;
  frames.reserve(markers.frames.size());
  for (const auto& frame : markers.frames) frames.push_back(PositionsOf(set, columns, frame, scale));
  int filled = 0;
  const auto max_gap = static_cast<std::size_t>(kMaxGap_s * markers.rate_hz);
  for (std::size_t joint = 0; joint < kRoleCount; ++joint) filled += BridgeGaps(frames, joint, max_gap);
  const glm::dvec3 upward = up == 'Z' ? glm::dvec3(0, 0, 1) : up == 'Y' ? glm::dvec3(0, 1, 0) : FindUp(frames);
  TurnUpright(upward, frames);
  // Keep the longest complete range.
  const auto [begin, end] = LongestStretch(frames);
  if (begin == end) return std::nullopt;
  MarkerBody body{.name = "", .motion = {.rate_hz = markers.rate_hz, .poses = {}}, .note = set.name};
  for (std::size_t t = begin; t < end; ++t) body.motion.poses.push_back(Complete(frames[t]));
  StandOnFloor(body.motion.poses);
  // Describe the corrections.
  if (filled > 0) body.note += fmt::format(", {} places bridged over gaps", filled);
  if (end - begin < frames.size()) {
    body.note += fmt::format(", frames {} to {} of {} (elsewhere joints are lost for over {:g} s)", begin + 1, end,
                             frames.size(), kMaxGap_s);
  }
  std::vector<std::string> guessed;
  for (const Role role : AllRoles()) {
    if (!Determines(set, columns, role)) guessed.emplace_back(RoleName(role));
  }
  if (!guessed.empty()) body.note += ", placed by rule: " + Join(guessed);
  if (!markers.remark.empty()) body.note += "; " + markers.remark;
  body.shown = AsShown(scale, markers, set, columns, upward);
  return body;
}

double MiddleStature(const BodyMotion& motion) {
  std::vector<double> statures;
  for (const BodyPose& pose : motion.poses) statures.push_back(Stature(pose));
  return LowerPercentile(std::move(statures), 0.5);
}

/// Makes the body in the file's unit or, if its size is implausible, in the power of ten of it that gives a person,
/// which the note states. Fails if none does.
Result<std::optional<MarkerBody>> BodyOf(const MarkerMotion& markers, const MarkerSet& set, const Columns& columns,
                                         char up, const std::string& file) {
  constexpr double kMinStature = 0.4, kMaxStature = 4, kMinPerson = 1.2, kMaxPerson = 2.3;
  auto body = BodyAt(1, markers, set, columns, up);
  if (!body) return body;
  const double told = MiddleStature(body->motion);
  if (told >= kMinStature && told <= kMaxStature) return body;
  for (const double scale : {1000.0, 100.0, 10.0, 0.1, 0.01, 0.001}) {
    auto scaled = BodyAt(scale, markers, set, columns, up);
    if (!scaled) continue;
    const double stature = MiddleStature(scaled->motion);
    if (stature < kMinPerson || stature > kMaxPerson) continue;
    scaled->note +=
        fmt::format("; in the file's unit the body is {:.3g} m tall: taken for {:g} times that", told, scale);
    return scaled;
  }
  return Fail({file}, "its markers show a body {:.3g} m tall; allowed: {:g} to {:g} m; is their unit another?", told,
              kMinStature, kMaxStature);
}

}  // namespace

Result<std::vector<MarkerBody>> FindMarkerBodies(MarkerMotion markers, const std::string& file, char up) {
  if (const int zeros = LeaveZerosOut(markers); zeros > 0) {
    markers.remark += fmt::format("{}{} places at 0, 0, 0 taken for gaps", markers.remark.empty() ? "" : "; ", zeros);
  }
  // For each person, choose the set that determines the most joints.
  std::vector<MarkerBody> bodies;
  std::string nearest = "";
  std::size_t fewest = kNeeded.size() + 1;
  for (const auto& [prefix, columns] : PeopleOf(markers)) {
    const MarkerSet* best = nullptr;
    std::size_t most = 0;
    for (const MarkerSet& set : MarkerSets()) {
      const auto lacks = MissingFrom(set, columns);
      const auto told = static_cast<std::size_t>(std::ranges::count_if(
          AllRoles(), [&, &columns = columns](Role role) { return Determines(set, columns, role); }));
      if (lacks.empty() && told > most) {
        best = &set;
        most = told;
      }
      if (lacks.size() < fewest) {
        fewest = lacks.size();
        nearest = fmt::format("{} lacks {}", set.name, Join(lacks));
      }
    }
    if (best == nullptr) continue;
    ASSIGN_OR_RETURN(auto body, BodyOf(markers, *best, columns, up, file));
    if (!body) continue;
    body->name = prefix;
    bodies.push_back(std::move(*body));
  }
  // Explain why there is no body.
  if (!bodies.empty()) return bodies;
  if (fewest == 0) return Fail({file}, "no frame shows all joints of a body at once");
  std::vector<std::string> names(markers.names.begin(),
                                 markers.names.begin() + std::min<std::size_t>(markers.names.size(), 12));
  return Fail(
      {file},
      "its markers ({}{}) are of no set known here: {}; known: Etude's joints, OpenPose BODY_25, HALPE_26, COCO, "
      "Motive's and HumanIK's bones, OpenCap's augmented markers, Plug-in Gait",
      Join(names), markers.names.size() > names.size() ? ", …" : "", nearest);
}

}  // namespace etude
