#include "bench/tasks/capture/silhouettes.h"

#include "engine/base/angles.h"
#include "engine/keypoints/people.h"
#include "engine/kinematics/start_angles.h"
#include "engine/silhouettes/fit_joints.h"
#include "engine/silhouettes/track_silhouettes.h"
#include "engine/silhouettes/turns.h"
#include "engine/unmarked/recover_unmarked.h"

namespace etude {
namespace {

constexpr double kMaskPixel = 2;  // picture pixels per mask pixel: masks are half size

// Returns the true pose of the first frame, with random errors in every angle and in the root's position.
TreeState NearStart(const SilhouetteBody& body, const BodyPose& pose, const WorldKey& key) {
  constexpr double kNearAngle = Radians(10), kNearPosition = 0.05;  // kNearPosition: metres, along each axis
  RandomStream random(key, "capture/near-start");
  const TreeState truth = FitJoints(body, TargetsOf(pose));
  std::vector<double> by(kRootDofs + truth.angles.size());
  for (std::size_t i = 0; i < by.size(); ++i) {
    const double most = i < 3 ? kNearPosition : kNearAngle;
    by[i] = random.Uniform(-most, most);
  }
  return Moved(body.tree, truth, by);
}

// The limits on movement grow with the time between pictures.
TrackOptions OptionsFor(const SilhouetteInputs& inputs) {
  TrackOptions options;
  options.angle_change *= inputs.picture_every;
  options.position_change_m *= inputs.picture_every;
  return options;
}

std::optional<TreeState> StartOf(const SilhouetteInputs& inputs, const SilhouetteBody& body) {
  if (inputs.start != SilhouetteStart::kNear) return std::nullopt;
  return NearStart(body, inputs.first, inputs.key);
}

// Returns the joints that the marks show, as [camera][picture]. Empty if the marks are not used.
std::vector<std::vector<std::vector<SeenJoint>>> JointsMarked(const SilhouetteInputs& inputs) {
  constexpr double kSigma_px = 4;  // error of a marked joint: marks lie on the body's surface, joints inside it
  std::vector<std::vector<std::vector<SeenJoint>>> joints;
  if (inputs.start != SilhouetteStart::kKeypoints) return joints;
  for (const std::vector<Marks>& of_camera : inputs.marks) {
    auto& pictures = joints.emplace_back();
    for (std::size_t k = 0; k < of_camera.size(); k += static_cast<std::size_t>(inputs.picture_every)) {
      pictures.push_back(SeenJointsOf(PersonOf(of_camera[k]), kSigma_px));
    }
  }
  return joints;
}

// Makes a recovered frame from a pose. It also finds the state of paper B's tree that is near this pose, because the
// recording's BVH file needs such a state.
RecoveredFrame FrameOf(const BodyPose& pose, const KinematicTree& tree, const TreeState& last) {
  return {.fixed = pose, .state = FindStartState(tree, pose, tree.limits).value_or(last), .pose = pose, .errors = {}};
}

}  // namespace

std::vector<std::optional<RecoveredFrame>> FollowSilhouettes(const SilhouetteInputs& inputs,
                                                             std::span<const std::vector<Mask>> masks) {
  std::vector<std::vector<Silhouette>> silhouettes;
  for (const std::vector<Mask>& of_camera : masks) {
    std::vector<Silhouette>& made = silhouettes.emplace_back();
    for (const Mask& mask : of_camera) made.push_back(MakeSilhouette(mask, {.mask_pixel = kMaskPixel}));
  }
  // Track the body over the whole take.
  const SilhouetteBody body = MakeSilhouetteBody(inputs.body.lengths);
  const auto joints = JointsMarked(inputs);
  const SilhouetteTake take{
      .cameras = inputs.cameras, .silhouettes = silhouettes, .start = StartOf(inputs, body), .joints = joints};
  const SilhouetteTrack track = TrackSilhouettes(body, take, OptionsFor(inputs));

  // Make recovered frames from the fits.
  TreeState last = StandingState(inputs.body.tree);
  std::vector<std::optional<RecoveredFrame>> recovered;
  for (const std::optional<SilhouetteFit>& fit : track.frames) {
    recovered.emplace_back();
    if (!fit) continue;
    recovered.back() = FrameOf(ToBodyPose(track.body, fit->state), inputs.body.tree, last);
    last = recovered.back()->state;
  }
  return recovered;
}

LiveSilhouettes::LiveSilhouettes(const SilhouetteInputs& inputs)
    : body_(inputs.body),
      follower_(MakeSilhouetteBody(inputs.body.lengths), inputs.cameras,
                StartOf(inputs, MakeSilhouetteBody(inputs.body.lengths)), OptionsFor(inputs)),
      last_(StandingState(inputs.body.tree)) {}

std::optional<RecoveredFrame> LiveSilhouettes::Next(std::span<const Mask> masks) {
  std::vector<Silhouette> silhouettes;
  for (const Mask& mask : masks) silhouettes.push_back(MakeSilhouette(mask, {.mask_pixel = kMaskPixel}));
  const std::optional<SilhouetteFit> fit = follower_.Next(silhouettes);
  if (!fit) return std::nullopt;
  const RecoveredFrame frame = FrameOf(ToBodyPose(follower_.body(), fit->state), body_.tree, last_);
  last_ = frame.state;
  return frame;
}

}  // namespace etude
