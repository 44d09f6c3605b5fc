#include "engine/capture/adjust_take.h"

#include <algorithm>
#include <cassert>

#include "engine/base/order_statistics.h"
#include "engine/kinematics/capture_body.h"
#include "engine/kinematics/start_angles.h"

namespace etude {
namespace {

// All offsets are linear in the lengths, so the derivatives of all offsets with respect to one length are the offsets
// of a body with this length 1 and all other lengths 0.
void AddLengths(const LimbLengths& lengths, TakeBody& made) {
  const auto list = ListOf(lengths);
  made.measurable.lengths.assign(list.begin(), list.end());
  for (std::size_t i = 0; i < list.size(); ++i) {
    std::array<double, 10> one{};
    one[i] = 1;
    const CaptureBody unit = PaperBody(LimbLengthsOf(one));
    const int length = static_cast<int>(i);
    for (std::size_t j = 0; j < unit.tree.joints.size(); ++j) {
      const glm::dvec3& offset = unit.tree.joints[j].p_PJ;
      if (offset != glm::dvec3(0)) made.measurable.joint_shares.push_back({static_cast<int>(j), length, offset});
    }
    for (const Role role : AllRoles()) {
      const int point = made.points[Index(role)];
      const glm::dvec3& offset = unit.roles[Index(role)].p_LQ;
      if (point >= 0 && offset != glm::dvec3(0)) made.measurable.point_shares.push_back({point, length, offset});
    }
  }
}

/// Returns one start pose per frame, as the root's pose and joint angles. A frame whose joints give no pose takes the
/// pose of the frame before it; the frames before the first pose take the first pose. Returns an empty list if no frame
/// gives a pose.
std::vector<TreeState> StartOf(const CaptureBody& body, std::span<const OptionalJoints> joints) {
  const BodyPose standing = ToBodyPose(body, StandingState(body.tree));
  std::vector<TreeState> states;
  std::size_t leading = 0;
  for (const OptionalJoints& frame : joints) {
    const auto pose = CompleteJoints(frame, standing);
    const auto state = pose ? FindStartState(body.tree, *pose, body.tree.limits) : std::nullopt;
    if (state) {
      states.insert(states.end(), leading + 1, *state);
      leading = 0;
    } else if (states.empty()) {
      ++leading;
    } else {
      states.push_back(states.back());
    }
  }
  return states;
}

std::vector<BundleMark> MarksOf(const MeasureInputs& pictures, const TakeBody& body, const MarkErrors& errors) {
  std::vector<BundleMark> marks;
  for (std::size_t camera = 0; camera < pictures.cameras.size(); ++camera) {
    for (std::size_t frame = 0; frame < pictures.marks[camera].size(); ++frame) {
      for (const MarkedJoint& joint : MarkedJointsOf(pictures.marks[camera][frame], errors)) {
        const int point = body.points[Index(joint.role)];
        if (point < 0) continue;
        marks.push_back({static_cast<int>(frame), point, pictures.cameras[camera], joint.pixel, joint.information});
      }
    }
  }
  return marks;
}

using enum Role;

/// A length of LimbLengths. It is measured between the joints `a` and `b`, and on the other side of the body between
/// their mirror images.
struct LengthBetween {
  double LimbLengths::*length;
  Role a, b;
};
constexpr std::array<LengthBetween, 8> kBetween = {{{&LimbLengths::foot, kLeftAnkle, kLeftFoot},
                                                    {&LimbLengths::shank, kLeftKnee, kLeftAnkle},
                                                    {&LimbLengths::thigh, kLeftHip, kLeftKnee},
                                                    {&LimbLengths::hip_width, kLeftHip, kRightHip},
                                                    {&LimbLengths::shoulder_width, kLeftShoulder, kRightShoulder},
                                                    {&LimbLengths::upper_arm, kLeftShoulder, kLeftElbow},
                                                    {&LimbLengths::forearm, kLeftElbow, kLeftWrist},
                                                    {&LimbLengths::hand, kLeftWrist, kLeftHand}}};

OptionalJoints PlacedJoints(const JointMeasurements& frame) {
  OptionalJoints joints;
  for (std::size_t i = 0; i < kRoleCount; ++i) {
    if (frame.is_triangulated[i]) joints[i] = frame.joints[i].position;
  }
  return joints;
}

std::optional<double> MedianOf(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  return UpperMedian(std::move(values));
}

std::optional<glm::dvec3> MiddleOf(const OptionalJoints& joints, Role a, Role b) {
  if (!joints[Index(a)] || !joints[Index(b)]) return std::nullopt;
  return 0.5 * (*joints[Index(a)] + *joints[Index(b)]);
}

// Returns the median lengths over all frames and both sides. Lengths that no frame shows keep the default of an adult.
LimbLengths MedianLengths(std::span<const OptionalJoints> frames) {
  LimbLengths lengths;
  const auto set = [&](double LimbLengths::*length, std::vector<double> found) {
    if (const auto median = MedianOf(std::move(found)); median && *median > 0) lengths.*length = *median;
  };
  // Measure the lengths between pairs of joints.
  for (const auto& [length, a, b] : kBetween) {
    std::vector<double> found;
    for (const OptionalJoints& joints : frames) {
      for (const auto& [from, to] : {std::pair(a, b), std::pair(Mirrored(a), Mirrored(b))}) {
        if (joints[Index(from)] && joints[Index(to)]) {
          found.push_back(glm::distance(*joints[Index(from)], *joints[Index(to)]));
        }
      }
    }
    set(length, std::move(found));
  }
  // Measure trunk and neck from the midpoints of hips and shoulders.
  std::vector<double> trunks, necks;
  for (const OptionalJoints& joints : frames) {
    const auto hips = MiddleOf(joints, kLeftHip, kRightHip),
               shoulders = MiddleOf(joints, kLeftShoulder, kRightShoulder);
    if (hips && shoulders) trunks.push_back(glm::distance(*hips, *shoulders));
    if (shoulders && joints[Index(kHead)]) necks.push_back(glm::distance(*shoulders, *joints[Index(kHead)]));
  }
  set(&LimbLengths::trunk, std::move(trunks));
  set(&LimbLengths::neck, std::move(necks));
  return lengths;
}

// Chooses `wanted` frames, evenly spaced among the frames that show the most joints.
std::vector<std::size_t> ChooseFrames(std::span<const OptionalJoints> joints, std::size_t wanted) {
  std::vector<std::size_t> shown;
  for (const OptionalJoints& frame : joints) {
    shown.push_back(
        static_cast<std::size_t>(std::ranges::count_if(frame, [](const auto& j) { return j.has_value(); })));
  }
  std::vector<std::size_t> candidates;
  // Lower the required number of joints until there are enough candidates.
  for (std::size_t min_shown = kRoleCount; min_shown > 0 && candidates.size() < wanted; --min_shown) {
    candidates.clear();
    for (std::size_t k = 0; k < shown.size(); ++k) {
      if (shown[k] >= min_shown) candidates.push_back(k);
    }
  }
  if (candidates.size() <= wanted) return candidates;
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < wanted; ++i) {
    chosen.push_back(candidates[wanted == 1 ? 0 : i * (candidates.size() - 1) / (wanted - 1)]);
  }
  return chosen;
}

}  // namespace

LimbLengths LimbLengthsOf(std::span<const double> lengths) {
  assert(lengths.size() == kLimbLengths.size());
  LimbLengths limbs;
  for (std::size_t i = 0; i < kLimbLengths.size(); ++i) limbs.*kLimbLengths[i].length = lengths[i];
  return limbs;
}

std::array<double, 10> ListOf(const LimbLengths& lengths) {
  std::array<double, 10> list{};
  for (std::size_t i = 0; i < list.size(); ++i) list[i] = lengths.*kLimbLengths[i].length;
  return list;
}

TakeBody MakeTakeBody(const LimbLengths& lengths) {
  TakeBody made;
  made.body = PaperBody(lengths);
  made.measurable.tree = made.body.tree;
  made.points.fill(-1);
  for (const Role role : AllRoles()) {
    if (role == Role::kHipCentre || role == Role::kSpine) continue;
    const TreePoint& place = made.body.roles[Index(role)];
    made.points[Index(role)] = static_cast<int>(made.measurable.points.size());
    made.measurable.points.push_back({place.joint, place.p_LQ});
  }
  AddLengths(lengths, made);
  return made;
}

BundleSmoothness SmoothnessOf(const TakeBody& body, double rate_hz) {
  BundleSmoothness smoothness;
  smoothness.rate_hz = rate_hz;
  using enum Role;
  for (const Role role :
       {kLeftHip, kRightHip, kLeftShoulder, kRightShoulder, kLeftWrist, kRightWrist, kLeftAnkle, kRightAnkle}) {
    smoothness.points.push_back(body.points[Index(role)]);
  }
  return smoothness;
}

AdjustedTake AdjustTake(const AdjustTakeInputs& inputs, const AdjustTakeOptions& options) {
  const TakeBody body = MakeTakeBody(inputs.lengths);
  AdjustedTake take;
  take.body = body.body;
  const std::vector<TreeState> start = StartOf(body.body, inputs.start);
  if (start.empty()) return take;
  const std::vector<BundleMark> marks = MarksOf(inputs.pictures, body, options.marks);
  const BundleSolution solution =
      AdjustBundle({.body = body.measurable, .start = start, .marks = marks}, options.bundle);
  take.is_solved = solution.is_solved;
  take.states = solution.states;
  if (options.bundle.adjusts_lengths) take.body = PaperBody(LimbLengthsOf(solution.lengths));
  return take;
}

std::optional<LimbLengths> MeasureLengths(const MeasureInputs& pictures, std::span<const JointMeasurements> measured,
                                          const MeasureLengthsOptions& options) {
  std::vector<OptionalJoints> placed;
  for (const JointMeasurements& frame : measured) placed.push_back(PlacedJoints(frame));
  const auto chosen = ChooseFrames(placed, static_cast<std::size_t>(options.frames));
  std::vector<OptionalJoints> start;
  std::vector<std::vector<Marks>> marks(pictures.marks.size());
  for (const std::size_t k : chosen) {
    start.push_back(placed[k]);
    for (std::size_t camera = 0; camera < marks.size(); ++camera) marks[camera].push_back(pictures.marks[camera][k]);
  }
  const LimbLengths first = MedianLengths(start);
  if (!IsValid(first)) return std::nullopt;
  AdjustTakeOptions adjust{.marks = options.marks, .bundle = {}};
  adjust.bundle.adjusts_lengths = true;
  const AdjustedTake take =
      AdjustTake({.pictures = {.cameras = pictures.cameras, .marks = marks}, .lengths = first, .start = start}, adjust);
  if (!take.is_solved || !IsValid(take.body.lengths)) return std::nullopt;
  return take.body.lengths;
}

}  // namespace etude
