#include "bench/tasks/capture/silhouettes.h"

#include "bench/tasks/capture/film.h"
#include "engine/base/angles.h"
#include "engine/kinematics/start_angles.h"
#include "engine/silhouettes/fit_joints.h"
#include "engine/silhouettes/track_silhouettes.h"
#include "engine/silhouettes/turns.h"

namespace etude {
namespace {

constexpr double kMaskPixel = 2;  // masks are half size

// The pose of the first frame as somebody would tell it who knows every angle to `kNearAngle`.
TreeState NearStart(const SilhouetteBody& body, const BodyPose& pose, const WorldKey& key) {
  constexpr double kNearAngle = Radians(10), kNearPlace = 0.05;  // metres, along each axis
  RandomStream random(key, "capture/near-start");
  const TreeState truth = FitJoints(body, TargetsOf(pose));
  std::vector<double> by(kRootDofs + truth.angles.size());
  for (std::size_t i = 0; i < by.size(); ++i) {
    const double most = i < 3 ? kNearPlace : kNearAngle;
    by[i] = random.Uniform(-most, most);
  }
  return Moved(body.tree, truth, by);
}

std::vector<std::vector<Silhouette>> ReadMasks(std::span<const std::vector<Mask>> masks) {
  std::vector<std::vector<Silhouette>> silhouettes;
  for (const std::vector<Mask>& of_camera : masks) {
    std::vector<Silhouette>& made = silhouettes.emplace_back();
    for (const Mask& mask : of_camera) made.push_back(MakeSilhouette(mask, {.mask_pixel = kMaskPixel}));
  }
  return silhouettes;
}

// Paper B's tree near that pose: what the recording's BVH file shows.
TreeState NearestPaperState(const KinematicTree& tree, const BodyPose& pose, const TreeState& otherwise) {
  return FindStartState(tree, pose, tree.limits).value_or(otherwise);
}

}  // namespace

Result<std::vector<std::optional<RecoveredFrame>>> FollowSilhouettes(const SilhouetteInputs& inputs) {
  const std::size_t frames = inputs.truth.size(), cameras = inputs.cameras.size();
  const std::size_t pictures = cameras * frames;
  if (pictures > kMostSilhouettes) {
    return Fail({}, "silhouettes of {} pictures; at most {} are held in memory, that is a duration_s of {:g}", pictures,
                kMostSilhouettes, static_cast<double>(kMostSilhouettes / cameras) / kJudgedRateHz);
  }
  const std::vector<std::vector<Silhouette>> silhouettes = ReadMasks(inputs.masks);
  const SilhouetteBody body = MakeSilhouetteBody(inputs.body.lengths);
  SilhouetteTake take{.cameras = inputs.cameras, .silhouettes = silhouettes, .start = std::nullopt};
  if (inputs.start == SilhouetteStart::kNear) take.start = NearStart(body, inputs.truth.front(), inputs.key);
  const SilhouetteTrack track = TrackSilhouettes(body, take);

  TreeState last = StandingState(inputs.body.tree);
  std::vector<std::optional<RecoveredFrame>> recovered(frames);
  for (std::size_t k = 0; k < frames; ++k) {
    if (!track.frames[k]) continue;
    const BodyPose pose = ToBodyPose(track.body, track.frames[k]->state);
    last = NearestPaperState(inputs.body.tree, pose, last);
    recovered[k] = RecoveredFrame{.fixed = pose, .state = last, .pose = pose, .errors = {}};
  }
  return recovered;
}

}  // namespace etude
