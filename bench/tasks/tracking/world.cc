#include "bench/tasks/tracking/world.h"

#include <algorithm>
#include <cmath>

#include "engine/base/angles.h"
#include "engine/kinematics/body_tree.h"
#include "engine/kinematics/limb_lengths.h"
#include "engine/kinematics/start_angles.h"

namespace etude {
namespace {

constexpr double kFastestJoint = Radians(1200);  // per second

/// The pose at `frame`, between two frames of the clip; a loop goes on from its beginning.
BodyPose PoseAt(const std::vector<BodyPose>& poses, double frame) {
  const auto before = static_cast<std::size_t>(frame);
  const double part = frame - std::floor(frame);
  const BodyPose& a = poses[before % poses.size()];
  const BodyPose& b = poses[(before + 1) % poses.size()];
  BodyPose pose;
  for (std::size_t i = 0; i < kRoleCount; ++i) pose.joints[i] = glm::mix(a.joints[i], b.joints[i], part);
  return pose;
}

/// The window of the clip that is followed, its middle frame at the floor's origin.
std::vector<BodyPose> ChooseWindow(const TrackingOptions& options, const LibraryClip& clip, const WorldKey& key) {
  RandomStream dice(key, "tracking/window");
  const std::vector<BodyPose>& poses = clip.motion.poses;
  const bool loops = clip.move && clip.move->loops;
  const double step = kJudgedRateHz / options.rate_hz;
  const double last = static_cast<double>(poses.size()) - 1;  // frame of the clip
  auto frames = static_cast<std::size_t>(std::lround(options.duration_s * options.rate_hz));
  if (!loops) frames = std::min(frames, static_cast<std::size_t>(last / step) + 1);
  const double latest = loops ? last : last - step * static_cast<double>(frames - 1);
  const auto start = static_cast<double>(dice.IndexBelow(static_cast<std::uint64_t>(latest) + 1));

  std::vector<BodyPose> window;
  for (std::size_t k = 0; k < frames; ++k) window.push_back(PoseAt(poses, start + step * static_cast<double>(k)));
  const FloorMove to_origin = ToOrigin(window[frames / 2]);
  for (BodyPose& pose : window) pose = to_origin.Apply(pose);
  return window;
}

/// The limits of the frame after one with `angles`.
std::vector<AngleRange> WithinReach(const KinematicTree& tree, const std::vector<double>& angles, double step) {
  std::vector<AngleRange> ranges = tree.limits;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    ranges[i] = {std::max(ranges[i].lower, angles[i] - step), std::min(ranges[i].upper, angles[i] + step)};
  }
  return ranges;
}

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
  return MakeTrackingWorld(MakeBodyTree(MeasureLimbLengths(clip.motion.poses)), options, clip, key);
}

Result<TrackingWorld> MakeTrackingWorld(const KinematicTree& body, const TrackingOptions& options,
                                        const LibraryClip& clip, const WorldKey& key) {
  const std::vector<BodyPose> window = ChooseWindow(options, clip, key);
  if (window.size() < kFewestTrackedFrames) {
    return Fail({}, "too few frames in clip {}: {} at {:g} Hz; tracking needs {}", clip.name, window.size(),
                options.rate_hz, kFewestTrackedFrames);
  }
  TrackingWorld world{body, {}, {}, {}};
  RandomStream noise(key, "tracking/target-noise");
  std::vector<AngleRange> ranges = world.tree.limits;
  for (std::size_t k = 0; k < window.size(); ++k) {
    auto state = FindStartState(world.tree, window[k], ranges);
    if (!state) return Fail({}, "frame {} of the window of clip {} gives no pose of the body", k, clip.name);
    ranges = WithinReach(world.tree, state->angles, kFastestJoint / options.rate_hz);
    world.truth.push_back(*std::move(state));
    world.targets.push_back(TargetsMetBy(world.tree, world.truth.back()));
    Disturb(world.targets.back(), options.target_noise, noise);
  }
  world.first_angles = ChooseFirstAngles(options, world.tree, world.truth[0].angles, key);
  return world;
}

}  // namespace etude
