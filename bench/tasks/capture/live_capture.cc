#include "bench/tasks/capture/live_capture.h"

#include <cassert>

#include "bench/recordings/capture_extras.h"
#include "bench/tasks/capture/nearest_poses.h"
#include "bench/tasks/capture/run.h"
#include "engine/capture/calibrate_cameras.h"
#include "engine/capture/measure_frames.h"

namespace etude {

LiveCapture::LiveCapture(const StudioOptions& options, const CaptureMethod& method, const FilmedPerson& booking,
                         const WorldKey& key)
    : options_(options),
      method_(method),
      key_(key),
      sources_{PersonSourceOf(method)},
      stages_(options_, MakeStudio(options, booking, key), key, sources_, /*keeps_masks=*/false) {
  assert(method.causal);
}

Result<std::unique_ptr<LiveCapture>> LiveCapture::Begin(const StudioOptions& options, const CaptureMethod& method,
                                                        const FilmedPerson& booking, const WorldKey& key) {
  std::unique_ptr<LiveCapture> capture(new LiveCapture(options, method, booking, key));
  RETURN_IF_ERROR(capture->Prepare());
  return capture;
}

Result<void> LiveCapture::Prepare() {
  ASSIGN_OR_RETURN(cameras_, stages_.GetCameras(method_));
  ASSIGN_OR_RETURN(body_, stages_.GetKnownBody(method_));
  ASSIGN_OR_RETURN(renderer_, stages_.GetRenderer());
  return {};
}

std::optional<RecoveredFrame> LiveCapture::Next() {
  const std::size_t frame = frame_++;
  assert(frame < stages_.world().truth.size());
  if (!take_) {
    take_.emplace(stages_.world(), options_, key_, sources_, *renderer_);
    for (std::size_t camera = 0; camera < cameras_->matrices.size(); ++camera) feeds_.push_back(take_->FeedOf(camera));
  }
  if (options_.IsPictured(frame)) latest_ = Recover(frame);
  return latest_;
}

std::optional<RecoveredFrame> LiveCapture::Recover(std::size_t frame) {
  std::vector<TakeCameras::Picture> pictures;
  for (TakeCameras::Feed& feed : feeds_) pictures.push_back(feed.Next(frame));
  if (method_.recovery == Recovery::kIk) return stages_.marked()[frame] ? RecoverByMarks(frame, pictures) : latest_;
  if (!silhouettes_) {
    silhouettes_.emplace(SilhouetteInputs{.first = stages_.world().truth.front(),
                                          .key = key_,
                                          .body = *body_,
                                          .cameras = cameras_->matrices,
                                          .start = method_.start,
                                          .picture_every = options_.picture_every});
  }
  std::vector<Mask> masks;
  for (const TakeCameras::Picture& picture : pictures) masks.push_back(HalveMask(picture.found.front()));
  return silhouettes_->Next(masks);
}

std::optional<RecoveredFrame> LiveCapture::RecoverByMarks(std::size_t frame,
                                                          const std::vector<TakeCameras::Picture>& pictures) {
  if (!marks_) marks_.emplace(*body_, RecoverOptionsOf(method_), LiveGapOptions(options_));
  const BodyPose& truth = stages_.world().truth[frame];
  std::vector<std::vector<Marks>> marks;
  for (std::size_t camera = 0; camera < pictures.size(); ++camera) {
    const Marks& drawn = pictures[camera].marks.front();
    marks.push_back({cameras_->lenses.empty() ? drawn : UndistortMarks(cameras_->lenses[camera], drawn)});
  }
  if (method_.outliers == OutlierRule::kReject) marks = AgreeingMarks(cameras_->matrices, marks);
  const std::vector<KnownMeasurement> told = {KnownMeasurementOf(truth, method_.oracle)};
  KnownAngles known;
  if (method_.oracle.start || method_.oracle.ik) {
    const TreeState nearest = FindNearestPoses(*body_, {&truth, 1}).front();
    if (method_.oracle.start) known.start = nearest;
    if (method_.oracle.ik) known.pose = nearest;
  }
  const MeasureInputs inputs{.cameras = cameras_->matrices, .marks = marks, .known = told};
  return marks_->Next(MeasureFrames(inputs).front(), known);
}

}  // namespace etude
