#include "bench/tasks/tracking/world.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "bench/tasks/base/disguise.h"
#include "engine/base/angles.h"
#include "engine/kinematics/body_tree.h"
#include "engine/kinematics/limb_lengths.h"
#include "engine/kinematics/solvers/gauss_newton.h"
#include "engine/kinematics/start_angles.h"

namespace etude {
namespace {

constexpr double kMaxJointSpeed = Radians(1200);  // radians per second

/// Chooses the window of the clip that is followed. Its middle frame is moved to the floor's origin; in a secret world
/// it is moved to a random place.
std::vector<BodyPose> ChooseWindow(const TrackingOptions& options, const LibraryClip& clip, const WorldKey& key,
                                   const std::optional<Disguise>& disguise) {
  RandomStream dice(key, "tracking/window");
  const std::vector<BodyPose>& poses = clip.motion.poses;
  const bool loops = clip.move && clip.move->loops;
  const double step = kJudgedRateHz / options.rate_hz;
  const double last = static_cast<double>(poses.size()) - 1;  // index of the clip's last frame
  // Compute the length of the window, and draw its start.
  auto frames = static_cast<std::size_t>(std::lround(options.duration_s * options.rate_hz));
  if (!loops) frames = std::min(frames, static_cast<std::size_t>(last / step) + 1);
  const double latest = loops ? last : last - step * static_cast<double>(frames - 1);
  const auto start = static_cast<double>(dice.IndexBelow(static_cast<std::uint64_t>(latest) + 1));

  // Sample the clip, with or without a disguise.
  std::vector<BodyPose> window;
  const double end = loops ? std::numeric_limits<double>::infinity() : last;
  for (std::size_t k = 0; k < frames; ++k) {
    const double plain = start + step * static_cast<double>(k);
    window.push_back(PoseOfClip(poses, disguise ? disguise->FrameOf(start, step, k, end) : plain));
  }
  if (disguise) disguise->ApplyTo(window, options.rate_hz);
  // Move the middle frame to the origin, or to a random place in a secret world.
  const FloorMove to_origin = ToOrigin(window[frames / 2]);
  for (BodyPose& pose : window) pose = to_origin.Apply(pose);
  if (!disguise) return window;
  RandomStream place(key, "tracking/place");
  const FloorMove away{.yaw = place.Uniform(-kPi, kPi), .x = place.Uniform(-1, 1), .z = place.Uniform(-1, 1)};
  for (BodyPose& pose : window) pose = away.Apply(pose);
  return window;
}

/// Returns the limits of the angles in the next frame. Each angle may differ from `angles` by at most `step`, radians,
/// and must be within the tree's limits.
std::vector<AngleRange> WithinReach(const KinematicTree& tree, const std::vector<double>& angles, double step) {
  std::vector<AngleRange> ranges = tree.limits;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    ranges[i] = {std::max(ranges[i].lower, angles[i] - step), std::min(ranges[i].upper, angles[i] + step)};
  }
  return ranges;
}

/// Changes the poses of a secret world, but keeps their targets. A program that recovers the disguised motion from its
/// targets then still does not know the angles that no target determines.
class OpenAngles {
 public:
  OpenAngles(const KinematicTree& tree, const WorldKey& key) : tree_(tree), solver_(tree) {
    options_.position_goal = 1e-6;
    options_.axis_goal = 1e-6;
    for (int i = 0; i < tree.dof_count(); ++i) dice_.emplace_back(key, fmt::format("tracking/open-angle/{}", i));
  }

  /// Returns a pose within `ranges` that has the same end effectors as `state`. The search starts from the angles of
  /// `state` plus random changes. If no such pose is found, returns the pose whose end effectors came closest.
  TreeState Slide(const TreeState& state, const std::vector<AngleRange>& ranges, double seconds) {
    IkProblem problem{state, TargetsMetBy(tree_, state), ranges};
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      const double wanted = state.angles[i] + kOpenAngle * dice_[i].At(seconds);
      problem.start.angles[i] = std::clamp(wanted, ranges[i].lower, ranges[i].upper);
    }
    TreeState slid = state;
    slid.angles = solver_.Solve(problem, options_, {.restarts = 0}).angles;
    return slid;
  }

 private:
  // Standard deviation of the change that is drawn. The solver then removes most of the change to meet the targets.
  static constexpr double kOpenAngle = Radians(35);

  const KinematicTree& tree_;
  const GaussNewtonSolver solver_;
  IkOptions options_ = IkBudget(100);
  std::vector<SmoothRandomFunction> dice_;
};

/// Returns the angles at which the first frame starts: the standing pose, or the truth plus noise.
std::vector<double> ChooseFirstAngles(const TrackingOptions& options, const KinematicTree& tree,
                                      const std::vector<double>& truth, const WorldKey& key) {
  std::vector<double> angles = StandingState(tree).angles;
  if (!options.joint_noise_deg) return angles;
  RandomStream dice(key, "tracking/joint-noise");
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const AngleRange& range = tree.limits[i];
    angles[i] = std::clamp(truth[i] + Radians(*options.joint_noise_deg) * dice.Normal(), range.lower, range.upper);
  }
  return angles;
}

}  // namespace

Result<TrackingWorld> MakeTrackingWorld(const TrackingOptions& options, const LibraryClip& clip, const WorldKey& key) {
  std::vector<BodyPose> poses = clip.motion.poses;
  if (!key.suite_seed.IsPlain()) {
    const double scale = Disguise(key).scale();
    for (BodyPose& pose : poses) {
      for (glm::dvec3& joint : pose.joints) joint *= scale;
    }
  }
  return MakeTrackingWorld(MakeBodyTree(MeasureLimbLengths(poses)), options, clip, key);
}

Result<TrackingWorld> MakeTrackingWorld(const KinematicTree& body, const TrackingOptions& options,
                                        const LibraryClip& clip, const WorldKey& key) {
  // Choose the window of the clip.
  std::optional<Disguise> disguise;
  if (!key.suite_seed.IsPlain()) disguise.emplace(key);
  const std::vector<BodyPose> window = ChooseWindow(options, clip, key, disguise);
  if (window.size() < kMinTrackedFrames) {
    return Fail({}, "too few frames in clip {}: {} at {:g} Hz; tracking needs {}", clip.name, window.size(),
                options.rate_hz, kMinTrackedFrames);
  }
  // Fit the body to each frame; from the previous frame, no angle may turn faster than kMaxJointSpeed. The fitted
  // pose determines the targets.
  TrackingWorld world{body, {}, {}, {}};
  RandomStream noise(key, "tracking/target-noise");
  std::optional<OpenAngles> open;
  if (disguise) open.emplace(world.tree, key);
  std::vector<AngleRange> ranges = world.tree.limits;
  for (std::size_t k = 0; k < window.size(); ++k) {
    auto state = FindStartState(world.tree, window[k], ranges);
    if (!state)
      return Fail({}, "frame {} of the window of clip {} cannot be converted to a pose of the body", k, clip.name);
    if (open) state = open->Slide(*state, ranges, static_cast<double>(k) / options.rate_hz);
    ranges = WithinReach(world.tree, state->angles, kMaxJointSpeed / options.rate_hz);
    world.truth.push_back(*std::move(state));
    world.targets.push_back(TargetsMetBy(world.tree, world.truth.back()));
    Disturb(world.targets.back(), options.target_noise, noise);
  }
  world.first_angles = ChooseFirstAngles(options, world.tree, world.truth[0].angles, key);
  return world;
}

}  // namespace etude
