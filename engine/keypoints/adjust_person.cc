#include "engine/keypoints/adjust_person.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "engine/base/order_statistics.h"
#include "engine/bundle_adjustment/adjust_bundle.h"
#include "engine/bundle_adjustment/measurable_body.h"
#include "engine/keypoints/keypoint_noise.h"

namespace etude {
namespace {

using enum Landmark;

constexpr double kMinErrorPx = 0.1;

/// A joint and its keypoint in one picture.
struct SeenAt {
  Role role;
  Keypoint keypoint;
};

/// Returns the pixel of the midpoint of two landmarks: the projection of the landmarks' midpoint in space, shifted by
/// the mean offset of the two keypoints from the projected landmarks. (The midpoint of the two pixels is another point,
/// because of perspective.)
Keypoint MiddleOf(const ProjectionMatrix& camera, const SeenPerson& seen, const LandmarkPositions& places, Landmark a,
                  Landmark b) {
  const glm::dvec3 &p = *places[Index(a)], &q = *places[Index(b)];
  const auto middle = Project(camera, 0.5 * (p + q)), at_p = Project(camera, p), at_q = Project(camera, q);
  if (!middle || !at_p || !at_q) return {};
  const glm::dvec2 off = 0.5 * (seen[a].pixel - *at_p + seen[b].pixel - *at_q);
  return {*middle + off, std::min(seen[a].confidence, seen[b].confidence)};
}

/// Returns the joints that the landmarks show directly, by the rules of `JointsOf`.
std::vector<SeenAt> JointsIn(const ProjectionMatrix& camera, const SeenPerson& seen, const LandmarkPositions& places) {
  std::vector<SeenAt> joints;
  for (const auto& [landmark, role] : kJointLandmarks) joints.push_back({role, seen[landmark]});
  const bool has_ears = places[Index(kLeftEar)] && places[Index(kRightEar)];
  joints.push_back({Role::kHead, places[Index(kHead)] ? seen[kHead]
                                 : has_ears           ? MiddleOf(camera, seen, places, kLeftEar, kRightEar)
                                                      : seen[kNose]});
  return joints;
}

using BoneLengths = std::array<double, kRoleCount>;

/// Sets up the bundle adjustment of a person's body and smooth motion.
class Adjuster {
 public:
  Adjuster(std::span<const ProjectionMatrix> cameras, const MatchedPerson& seen, const AdjustPersonOptions& options,
           RecoveredPerson& person)
      : cameras_(cameras), seen_(seen), options_(options), person_(person) {
    for (const LandmarkPositions& places : person.landmarks) joints_.push_back(JointsOf(places));
  }

  bool Run() {
    if (!MakeBody()) return false;
    AddMarks();
    BundleOptions bundle;
    bundle.adjusts_lengths = true;
    BundleSmoothness& smooth = bundle.smoothness.emplace();
    smooth.rate_hz = options_.rate_hz;
    smooth.acceleration = options_.acceleration;
    // Put no acceleration penalty on angles: the angles of this body may pass through full turns and singular
    // orientations, and the penalty on points is sufficient.
    smooth.angle_acceleration = std::numeric_limits<double>::infinity();
    smooth.points.resize(measurable_.points.size());
    smooth.accelerations.resize(measurable_.points.size());
    for (const Role role : AllRoles()) {
      if (points_[Index(role)] < 0) continue;
      const auto point = static_cast<std::size_t>(points_[Index(role)]);
      smooth.points[point] = static_cast<int>(point);
      smooth.accelerations[point] = AccelerationOf(role);
    }
    const std::vector<TreeState> start = SmoothStart();
    const BundleSolution solution = AdjustBundle({.body = measurable_, .start = start, .marks = marks_}, bundle);
    return solution.is_solved && Take(solution);
  }

 private:
  /// Returns start poses fitted to smoothed points. From noisy points, the solver would need many steps and might reach
  /// another minimum.
  std::vector<TreeState> SmoothStart() const {
    constexpr double kCalmHz = 3;
    std::vector<LandmarkPositions> points = person_.landmarks;
    SmoothPoints(points, options_.rate_hz, kCalmHz);
    std::vector<TreeState> start = person_.states;
    const auto calm = FitPerson(person_.body, points);
    for (std::size_t k = 0; k < start.size(); ++k) {
      if (calm[k]) start[k] = *calm[k];
    }
    return start;
  }

  /// Computes the second differences of a joint's position between frames that are `lag` frames apart. Leaves out the
  /// largest 5 % of the differences. Returns the mean square of the others, per axis, in m². Returns nullopt for fewer
  /// than ten differences.
  std::optional<double> SquareOver(Role role, std::size_t lag) const {
    std::vector<double> squares;
    for (std::size_t k = lag; k + lag < joints_.size(); ++k) {
      const auto &before = joints_[k - lag][Index(role)], &now = joints_[k][Index(role)],
                 &after = joints_[k + lag][Index(role)];
      if (!before || !now || !after) continue;
      const glm::dvec3 second = *before - 2.0 * *now + *after;
      squares.push_back(glm::dot(second, second) / 3);
    }
    constexpr std::size_t kMinCount = 10;
    if (squares.size() < kMinCount) return std::nullopt;
    std::ranges::sort(squares);
    squares.resize(squares.size() - squares.size() / 20);
    return std::accumulate(squares.begin(), squares.end(), 0.0) / static_cast<double>(squares.size());
  }

  /// Estimates the prior's standard deviation for a joint's acceleration from the mean squares of second differences
  /// at lag 1 and at a longer lag. Noise contributes equally to both mean squares; the contribution of the
  /// acceleration grows with the fourth power of the lag.
  double AccelerationOf(Role role) const {
    constexpr double kSeconds = 0.1, kBursts = 1.5;  // kBursts: in bursts, accelerations exceed their root mean square
    const double lag = std::max(2.0, std::round(kSeconds * options_.rate_hz));
    const auto one = SquareOver(role, 1), several = SquareOver(role, static_cast<std::size_t>(lag));
    if (!one || !several) return options_.acceleration;
    const double square = std::max(0.0, *several - *one) / (lag * lag * lag * lag - 1);
    return std::max(options_.acceleration, kBursts * std::sqrt(square) * options_.rate_hz * options_.rate_hz);
  }

  /// Makes the body with its adjustable bone lengths. Each bone has a length of its own, with three exceptions: the
  /// two bones of the trunk have one length in all, the bones from the hip centre to both hips have the same length,
  /// and so have the bones from the shoulder centre to both shoulders. (No landmark shows the joint between two such
  /// bones.)
  bool MakeBody() {
    const KinematicTree& tree = person_.body.tree;
    measurable_.tree = tree;
    points_.fill(-1);
    for (const Role role : AllRoles()) {
      // No landmark shows the spine; the hip centre is midway between the hips.
      if (role == Role::kSpine || role == Role::kHipCentre) continue;
      points_[Index(role)] = static_cast<int>(measurable_.points.size());
      measurable_.points.push_back({person_.body.roles[Index(role)].joint, person_.body.roles[Index(role)].p_LQ});
    }
    // Lengthen each bone in turn by a metre: the change of every offset is the offset's derivative with respect to the
    // bone's length.
    for (const Bone& bone : AllBones()) {
      using enum Role;
      if (bone.child == kShoulderCentre || bone.child == kRightShoulder || bone.child == kRightHip) continue;
      BoneLengths one = person_.body.bones;
      const double length =
          bone.child == Role::kSpine ? one[Index(Role::kSpine)] / kSpineShare : one[Index(bone.child)];
      AddTo(one, bone.child, 1);
      const auto longer = BodyOfBones(one);
      if (!longer || longer->tree.joints.size() != tree.joints.size()) return false;
      AddShares(*longer);
      bones_.push_back(bone.child);
      measurable_.lengths.push_back(length);
    }
    KeepTrunkStraight();
    return true;
  }

  static void AddTo(BoneLengths& bones, Role child, double metres) {
    using enum Role;
    bones[Index(child)] += (child == kSpine ? kSpineShare : 1) * metres;
    if (child == kSpine) bones[Index(kShoulderCentre)] += (1 - kSpineShare) * metres;
    if (child == kLeftShoulder || child == kLeftHip) bones[Index(Mirrored(child))] += metres;
  }

  /// Adds the derivatives of all offsets with respect to one length. Offsets are linear in the lengths, so a derivative
  /// equals the change of the offset when the bone grows by a metre.
  void AddShares(const CaptureBody& longer) {
    const int length = static_cast<int>(bones_.size());
    for (std::size_t j = 0; j < measurable_.tree.joints.size(); ++j) {
      const glm::dvec3 more = longer.tree.joints[j].p_PJ - measurable_.tree.joints[j].p_PJ;
      if (more != glm::dvec3(0)) measurable_.joint_shares.push_back({static_cast<int>(j), length, more});
    }
    for (const Role role : AllRoles()) {
      const int point = points_[Index(role)];
      if (point < 0) continue;
      const glm::dvec3 more = longer.roles[Index(role)].p_LQ - measurable_.points[static_cast<std::size_t>(point)].p_LQ;
      if (more != glm::dvec3(0)) measurable_.point_shares.push_back({point, length, more});
    }
  }

  /// Locks the spine's bending angles. No landmark shows how the trunk bends, so a longer, bent trunk would fit noise.
  void KeepTrunkStraight() {
    const TreeJoint& spine =
        measurable_.tree.joints[static_cast<std::size_t>(person_.body.roles[Index(Role::kShoulderCentre)].joint)];
    for (int dof = spine.first_dof; dof < spine.first_dof + std::min(2, spine.dof_count); ++dof) {
      measurable_.tree.limits[static_cast<std::size_t>(dof)] = {0, 0};
    }
  }

  // Adds a mark for each keypoint. If fewer than two cameras see a joint, further marks hold the joint near its start
  // position (HoldUnseen).
  void AddMarks() {
    const double error = KeypointErrorPx(cameras_, seen_, options_.min_confidence, person_.outlier_px);
    std::vector<std::array<int, kRoleCount>> views(person_.states.size());
    std::array<bool, kRoleCount> is_ever_seen{};
    for (std::size_t frame = 0; frame < person_.states.size(); ++frame) {
      views[frame].fill(0);
      for (std::size_t c = 0; c < cameras_.size(); ++c) {
        if (frame >= seen_.seen[c].size() || !seen_.seen[c][frame]) continue;
        for (const auto& [role, keypoint] : JointsIn(cameras_[c], *seen_.seen[c][frame], person_.landmarks[frame])) {
          if (keypoint.confidence < options_.min_confidence) continue;
          ++views[frame][Index(role)];
          is_ever_seen[Index(role)] = true;
          AddMark(frame, role, c, keypoint.pixel, error / std::sqrt(std::min(1.0, keypoint.confidence)));
        }
      }
    }
    for (std::size_t frame = 0; frame < person_.states.size(); ++frame) {
      for (const Role role : AllRoles()) {
        if (points_[Index(role)] < 0 || role == Role::kShoulderCentre || views[frame][Index(role)] >= 2) continue;
        HoldUnseen(frame, role, is_ever_seen[Index(role)] ? std::nullopt : std::optional(error));
      }
    }
    if (options_.outlines != nullptr) AddOutlines(error);
  }

  /// Adds the motion from silhouettes: a mark at the projection of each joint, in every camera and frame. The
  /// standard deviation of a joint's marks in a camera is the larger of `min_px` and the median distance, in the
  /// picture, from the joint's projection in the motion from keypoints, times the square root of the frame rate.
  /// (Errors of neighbouring frames are correlated, so the marks of one second count as one.)
  void AddOutlines(double min_px) {
    const auto alike = std::sqrt(std::max(1.0, options_.rate_hz));
    const std::size_t frames = std::min(person_.states.size(), options_.outlines->poses.size());
    for (std::size_t c = 0; c < cameras_.size(); ++c) {
      for (const Role role : AllRoles()) {
        if (points_[Index(role)] < 0 || role == Role::kShoulderCentre) continue;
        std::vector<std::pair<std::size_t, glm::dvec2>> shown;
        std::vector<double> off;
        for (std::size_t k = 0; k < frames; ++k) {
          const auto theirs = Project(cameras_[c], options_.outlines->poses[k][role]);
          const auto own = Project(cameras_[c], person_.motion.poses[k][role]);
          if (!theirs || !own) continue;
          shown.emplace_back(k, *theirs);
          off.push_back(glm::distance(*theirs, *own));
        }
        if (off.empty()) continue;
        const double sigma = alike * std::max(min_px, UpperMedian(std::move(off)));
        for (const auto& [k, pixel] : shown) AddMark(k, role, c, pixel, sigma);
      }
    }
  }

  void AddMark(std::size_t frame, Role role, std::size_t camera, const glm::dvec2& pixel, double sigma_px) {
    marks_.push_back({static_cast<int>(frame), points_[Index(role)], cameras_[camera], pixel,
                      glm::dmat2(1 / (sigma_px * sigma_px))});
  }

  /// Adds marks for a joint that fewer than two cameras see. The marks keep the joint near its position in the
  /// single-frame fit. Their standard deviation is twice `error_px` if it is given; otherwise it is a tenth of the
  /// person's height in the picture, at least one pixel.
  void HoldUnseen(std::size_t frame, Role role, const std::optional<double>& error_px) {
    constexpr double kShareOfHeight = 0.1, kComposed = 2;
    const BodyPose& pose = person_.motion.poses[frame];
    for (std::size_t c = 0; c < cameras_.size(); ++c) {
      const auto top = Project(cameras_[c], pose[Role::kHead]), foot = Project(cameras_[c], pose[Role::kLeftAnkle]),
                 pixel = Project(cameras_[c], pose[role]);
      if (!top || !foot || !pixel) continue;
      const double held = std::max(1.0, kShareOfHeight * glm::distance(*top, *foot));
      AddMark(frame, role, c, *pixel, error_px ? kComposed * *error_px : held);
    }
  }

  // Writes the solution to the person; returns false if a length is not positive.
  bool Take(const BundleSolution& solution) {
    BoneLengths bones{};
    for (std::size_t i = 0; i < bones_.size(); ++i) AddTo(bones, bones_[i], solution.lengths[i]);
    auto body = BodyOfBones(bones);
    if (!body || std::ranges::any_of(solution.lengths, [](double length) { return !(length > 0); })) return false;
    person_.body = std::move(*body);
    person_.states = solution.states;
    ShowStates(person_);
    return true;
  }

  std::span<const ProjectionMatrix> cameras_;
  const MatchedPerson& seen_;
  const AdjustPersonOptions& options_;
  RecoveredPerson& person_;
  MeasurableBody measurable_;
  std::array<int, kRoleCount> points_{};
  std::vector<Role> bones_;          ///< for each adjustable length, the child role of its bone
  std::vector<RoleVectors> joints_;  ///< the joints that landmarks show in each frame
  std::vector<BundleMark> marks_;
};

}  // namespace

double KeypointErrorPx(std::span<const ProjectionMatrix> cameras, const MatchedPerson& seen, double min_confidence,
                       double outlier_px) {
  std::vector<double> squares;  // one estimate of the variance per point (KeypointVarianceOf)
  for (const auto& [frame, landmark, by, point] :
       TriangulateLandmarks(cameras, seen, {.min_confidence = min_confidence, .robust = {outlier_px}})) {
    squares.push_back(KeypointVarianceOf(point));
  }
  if (squares.empty()) return kMinErrorPx;
  return std::max(kMinErrorPx, std::sqrt(UpperMedian(std::move(squares))));
}

bool AdjustPerson(std::span<const ProjectionMatrix> cameras, const MatchedPerson& seen,
                  const AdjustPersonOptions& options, RecoveredPerson& person) {
  assert(cameras.size() == seen.seen.size() && person.states.size() == person.motion.poses.size());
  return Adjuster(cameras, seen, options, person).Run();
}

}  // namespace etude
