#include "bench/tasks/capture/recording.h"

#include "bench/recordings/capture_extras.h"
#include "engine/base/base64.h"
#include "engine/formats/bvh.h"
#include "engine/motion/from_body.h"
#include "sim/camera/jpeg.h"

namespace etude {
namespace {

CaptureExtras DescribeStage(const CaptureWorld& world) {
  CaptureExtras extras;
  extras.texture_seed = world.room.texture_seed;
  extras.casts_shadows = world.room.casts_shadows;
  extras.stage_seed = world.stage_options.seed;
  extras.scene = world.stage_options.scene;
  extras.wears_everyday = world.stage_options.wardrobe == Wardrobe::kEveryday;
  extras.wears_coded = world.stage_options.wardrobe == Wardrobe::kCoded;
  extras.colours = world.colours;
  extras.brightness = world.brightness;
  return extras;
}

std::vector<CaptureExtras::Mark> StrokesOf(const Marks& marks) {
  std::vector<CaptureExtras::Mark> strokes;
  for (std::size_t i = 0; i < kStrokeCount; ++i) {
    if (const auto& stroke = marks.strokes[i]) strokes.push_back({stroke->a, stroke->b, StrokeMarks()[i].first_half});
  }
  return strokes;
}

}  // namespace

Recording MakeRecording(const CaptureWorld& world, const Take& take, const Observation& observation,
                        const CaptureBody& body, const std::vector<RecoveredFrame>& frames, const std::string& name,
                        std::span<const double> moments) {
  Track truth{"truth", {kJudgedRateHz, world.truth}}, recovered{"recovered", {kJudgedRateHz, {}}};
  for (const RecoveredFrame& frame : frames) recovered.motion.poses.push_back(frame.pose);
  CaptureExtras extras = DescribeStage(world);
  for (std::size_t i = 0; i < world.cameras.size(); ++i) {
    constexpr int kStillQuality = 85;
    const std::string still = EncodeJpeg(take.stills[i], kStillQuality);
    extras.views.push_back({world.cameras[i], observation.masks[i], Base64(still)});
  }
  for (const double number : moments) {
    const auto frame = static_cast<std::size_t>(number) - 1;
    if (frame >= frames.size()) continue;
    CaptureExtras::Moment& moment = extras.moments.emplace_back();
    moment = {frame, frames[frame].fixed, {}};
    for (const std::vector<Marks>& marks : observation.marks) moment.marks.push_back(StrokesOf(marks[frame]));
  }
  extras.bvh = WriteBvh(ToClip(body, frames, kJudgedRateHz, name));
  return {{std::move(truth), std::move(recovered)}, WriteCaptureExtras(extras)};
}

Recording MakeRecording(const CaptureWorld& world, const std::vector<BodyPose>& poses) {
  const BodyMotion found{kJudgedRateHz, poses};
  CaptureExtras extras = DescribeStage(world);
  for (const Camera& camera : world.cameras) {
    const Mask nothing(camera.intrinsics.width / 2, camera.intrinsics.height / 2);
    extras.views.push_back({camera, std::vector<Mask>(poses.size(), nothing)});
  }
  extras.bvh = WriteBvh(ToClip(found, "recovered"));
  return {{{"truth", {kJudgedRateHz, world.truth}}, {"recovered", found}}, WriteCaptureExtras(extras)};
}

}  // namespace etude
