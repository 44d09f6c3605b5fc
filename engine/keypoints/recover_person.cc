#include "engine/keypoints/recover_person.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "engine/base/order_statistics.h"
#include "engine/capture/fit_pose.h"
#include "engine/capture/measure_joints.h"
#include "engine/kinematics/capture_body.h"
#include "engine/kinematics/limb_lengths.h"
#include "engine/motion/rest_body.h"

namespace etude {
namespace {

constexpr std::ptrdiff_t kMinJoints = 8;
constexpr double kUnseen = 0.01;  // weight of a joint that was completed, not seen
constexpr int kRootSteps = 3;     // twenty steps would bring the joints only one percent nearer to their targets

std::optional<double> MedianDistance(std::span<const RoleVectors> frames, Role a, Role b) {
  std::vector<double> lengths;
  for (const RoleVectors& joints : frames) {
    const auto &p = joints[Index(a)], &q = joints[Index(b)];
    if (p && q) lengths.push_back(glm::distance(*p, *q));
  }
  if (lengths.empty()) return std::nullopt;
  return UpperMedian(std::move(lengths));
}

std::optional<double> MedianBone(std::span<const RoleVectors> frames, const Bone& bone) {
  // No landmark shows the spine, so it divides the trunk in a fixed ratio.
  const bool is_below = bone.child == Role::kSpine, is_above = bone.parent == Role::kSpine;
  if (!is_below && !is_above) return MedianDistance(frames, bone.parent, bone.child);
  const auto trunk = MedianDistance(frames, Role::kHipCentre, Role::kShoulderCentre);
  if (!trunk) return std::nullopt;
  return (is_below ? kSpineShare : 1 - kSpineShare) * *trunk;
}

PoseTargets TargetsOf(const RoleVectors& joints, const BodyPose& completed) {
  PoseTargets wanted{.places = completed, .weights = {}};
  for (std::size_t i = 0; i < kRoleCount; ++i) wanted.weights[i] = joints[i] ? 1 : kUnseen;
  // If hips and shoulders appear nearer to each other than the trunk is long, the trunk could bend in any direction.
  // The target of the spine keeps the trunk nearly straight.
  if (joints[Index(Role::kHipCentre)] && joints[Index(Role::kShoulderCentre)]) wanted.weights[Index(Role::kSpine)] = 1;
  return wanted;
}

/// Alternates between moving the root by the weighted mean offset of all joints and fitting the angles. The tree's root
/// is the left toe; without these steps the toe's error would shift the whole body.
TreeState MoveRoot(const CaptureBody& body, const PoseFitter& fitter, const PoseTargets& wanted, TreeState state) {
  for (int step = 0; step < kRootSteps; ++step) {
    const BodyPose pose = ToBodyPose(body, state);
    glm::dvec3 sum(0);
    double weights = 0;
    for (std::size_t i = 0; i < kRoleCount; ++i) {
      sum += wanted.weights[i] * (wanted.places.joints[i] - pose.joints[i]);
      weights += wanted.weights[i];
    }
    state.root_position += sum / weights;
    state = fitter.Improve(wanted, state);
  }
  return state;
}

/// Gives each frame without a state the last state before this frame; a frame before the first state gets the first
/// state. Precondition: at least one frame has a state.
std::vector<TreeState> HoldStates(std::span<const std::optional<TreeState>> states) {
  const auto first = std::ranges::find_if(states, [](const auto& state) { return state.has_value(); });
  assert(first != states.end());
  std::vector<TreeState> held;
  for (const auto& state : states) held.push_back(state ? *state : held.empty() ? **first : held.back());
  return held;
}

}  // namespace

void NameHead(CaptureBody& body) {
  const auto head = std::ranges::find(body.skeleton, "head_end", &CaptureBody::ClipJoint::name);
  if (head == body.skeleton.end()) return;
  CaptureBody::ClipJoint end = *head;
  end.parent = static_cast<int>(head - body.skeleton.begin());
  end.offset = glm::dvec3(0);
  head->name = "head";
  head->is_end = false;
  body.skeleton.push_back(end);
}

Result<CaptureBody> BodyOfBones(const std::array<double, kRoleCount>& lengths) {
  BodyPose straight;  // only the lengths of its bones are used
  for (const Bone& bone : AllBones()) {
    straight[bone.child] = straight[bone.parent] + glm::dvec3(0, lengths[Index(bone.child)], 0);
  }
  ASSIGN_OR_RETURN(CaptureBody body, FittedBody(RestBodyOf({&straight, 1})));
  NameHead(body);
  return body;
}

Result<CaptureBody> MedianBody(std::span<const LandmarkPositions> frames) {
  std::vector<RoleVectors> joints;
  for (const LandmarkPositions& landmarks : frames) joints.push_back(JointsOf(landmarks));
  std::array<double, kRoleCount> lengths{};
  for (const Bone& bone : AllBones()) {
    const auto length = MedianBone(joints, bone);
    if (!length) return Fail({}, "no frame shows both {} and {}", RoleName(bone.child), RoleName(bone.parent));
    lengths[Index(bone.child)] = *length;
  }
  return BodyOfBones(lengths);
}

std::vector<std::optional<TreeState>> FitPerson(const CaptureBody& body, std::span<const LandmarkPositions> frames) {
  const PoseFitter fitter(body);
  BodyPose like = ToBodyPose(body, StandingState(body.tree));
  std::vector<std::optional<TreeState>> states;
  std::optional<PoseFit> last;
  for (const LandmarkPositions& landmarks : frames) {
    const RoleVectors joints = JointsOf(landmarks);
    states.emplace_back();
    if (std::ranges::count_if(joints, [](const auto& joint) { return joint.has_value(); }) < kMinJoints) continue;
    const std::optional<BodyPose> completed = CompleteJoints(joints, like);
    if (!completed) continue;
    const PoseTargets wanted = TargetsOf(joints, *completed);
    std::optional<PoseFit> pointed = fitter.Fit(wanted, last);
    if (!pointed) continue;
    last = std::move(pointed);
    states.back() = MoveRoot(body, fitter, wanted, last->state);
    like = ToBodyPose(body, *states.back());
  }
  return states;
}

SeenPeople UndistortPeople(const Camera& camera, SeenPeople people) {
  for (auto& frame : people) {
    for (SeenPerson& person : frame) {
      for (Keypoint& keypoint : person.keypoints) {
        if (keypoint.confidence <= 0) continue;
        const auto pixel = UndistortPixel(camera, keypoint.pixel);
        keypoint = pixel ? Keypoint{*pixel, keypoint.confidence} : Keypoint{};
      }
    }
  }
  return people;
}

RecoverPersonOptions DefaultRecovery(double rate_hz, double longer_side_px) {
  constexpr double kOutlierShare = 0.03;  // of the picture's longer side
  constexpr double kMaxAbsence_s = 0.5, kMaxReturn_s = 3;
  RecoverPersonOptions options{.rate_hz = rate_hz, .match = {}, .triangulate = {}};
  options.match.follow.max_absence = std::max(1, static_cast<int>(std::lround(kMaxAbsence_s * rate_hz)));
  options.match.follow.max_return = static_cast<int>(std::lround(kMaxReturn_s * rate_hz));
  options.triangulate.robust.outlier_px = kOutlierShare * longer_side_px;
  return options;
}

Result<RecoveredPerson> LocatePerson(std::span<const ProjectionMatrix> cameras, std::span<const SeenPeople> people,
                                     const RecoverPersonOptions& options) {
  assert(cameras.size() >= 2 && cameras.size() == people.size());
  RecoveredPerson person;
  person.people = MatchPeople(cameras, people, options.match);
  // Only people whom at least two cameras saw can be triangulated.
  std::vector<std::size_t> in_space;
  for (std::size_t i = 0; i < person.people.size(); ++i) {
    if (person.people[i].cameras >= 2) in_space.push_back(i);
  }
  if (in_space.empty()) {
    return Fail({},
                "no two cameras see the same person at the same place; are the films synchronised, and does each film "
                "belong to its camera of the rig?");
  }
  if (options.person >= in_space.size()) {
    return Fail({}, "there is no person {}; number of people seen by two or more cameras: {}", options.person + 1,
                in_space.size());
  }
  // Mend the keypoints if requested, then triangulate.
  MatchedPerson& wanted = person.people[in_space[options.person]];
  TriangulateOptions triangulate = options.triangulate;
  if (options.corrects) {
    const double least = triangulate.min_confidence;
    person.corrections = CorrectPerson(cameras, people, least, wanted);
    triangulate.robust.outlier_px =
        OutlierLimit(cameras, wanted, least, options.min_outlier_px, triangulate.robust.outlier_px);
  }
  person.outlier_px = triangulate.robust.outlier_px;
  person.landmarks = TriangulatePerson(cameras, wanted, triangulate, &person.report);
  return person;
}

Result<RecoveredPerson> FitLocated(RecoveredPerson person, const RecoverPersonOptions& options) {
  InterpolatePoints(person.landmarks, static_cast<std::size_t>(std::lround(options.max_gap_s * options.rate_hz)));
  if (options.cutoff_hz > 0) SmoothPoints(person.landmarks, options.rate_hz, options.cutoff_hz);
  ASSIGN_OR_RETURN(const CaptureBody body, MedianBody(person.landmarks));
  person.body = body;
  const auto states = FitPerson(body, person.landmarks);
  for (const auto& state : states) person.is_held.push_back(!state);
  if (std::ranges::count(person.is_held, false) == 0) return Fail({}, "no frame shows enough joints of the person");
  person.states = HoldStates(states);
  person.motion.rate_hz = options.rate_hz;
  ShowStates(person);
  return person;
}

void ShowStates(RecoveredPerson& person) {
  person.clip = ToClip(person.body, person.states, person.motion.rate_hz, "capture");
  person.motion.poses.clear();
  for (const TreeState& state : person.states) person.motion.poses.push_back(ToBodyPose(person.body, state));
}

Result<RecoveredPerson> RecoverPerson(std::span<const ProjectionMatrix> cameras, std::span<const SeenPeople> people,
                                      const RecoverPersonOptions& options) {
  ASSIGN_OR_RETURN(RecoveredPerson person, LocatePerson(cameras, people, options));
  return FitLocated(std::move(person), options);
}

}  // namespace etude
