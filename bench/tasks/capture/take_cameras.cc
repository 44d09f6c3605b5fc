#include "bench/tasks/capture/take_cameras.h"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/tasks/base/answer_fields.h"
#include "bench/tasks/capture/coco.h"
#include "io/images/image_files.h"
#include "sim/body/shape.h"

namespace etude {
namespace {

Result<Mask> ReadDetected(const Json& answer, const ColourImage& picture) {
  AnswerFields fields(answer);
  const Json* mask = fields.Raw("mask");
  RETURN_IF_ERROR(fields.Finish());
  if (mask == nullptr) return Fail({}, "mask: it is missing");
  return ReadCocoMask(*mask, "mask", picture.width, picture.height);
}

template <typename Belongs>
Mask MaskWhere(const LabelImage& labels, Belongs belongs) {
  Mask mask(labels.width, labels.height);
  std::transform(labels.pixels.begin(), labels.pixels.end(), mask.pixels.begin(), belongs);
  return mask;
}

PersonOptions OptionsOf(const PersonSource& source) {
  return {.segmenter = source.segmenter, .change = {}, .pieces = source.pieces};
}

}  // namespace

void SeatedSegmenter::Begin(std::size_t camera, const ColourImage& background) {
  camera_ = camera + 1;
  frame_ = 0;
  const std::string name = fmt::format("camera-{}-background.ppm", camera_);
  Json session = {{"seat", "segmenter"}, {"camera", camera_}, {"background", name}};
  if (goes_on_) goes_on_ = program_.Begin(PayloadOf(std::move(session), {{name, EncodePpm(background)}}));
}

Mask SeatedSegmenter::Detect(const ColourImage& picture) {
  Mask changed(picture.width, picture.height);
  if (!goes_on_) return changed;
  const std::string name = fmt::format("camera-{}-{:04}.ppm", camera_, frame_++);
  const JsonPtr answer = program_.Step(PayloadOf({{"picture", name}}, {{name, EncodePpm(picture)}}));
  goes_on_ = answer != nullptr;
  if (!goes_on_) return changed;
  Result<Mask> detected = ReadDetected(*answer, picture);
  if (detected) return std::move(*detected);
  complaint_ = Fail({}, "of {}: {}", name, detected.error().message);
  goes_on_ = false;
  return changed;
}

TakeCameras::TakeCameras(const CaptureWorld& world, const StudioOptions& options, const WorldKey& key,
                         std::span<const PersonSource> sources, Renderer& renderer)
    : world_(world),
      sources_(sources),
      shooting_(world, options.camera, key, renderer),
      marking_(sources.size(), Marking(options, world, key)) {
  for (std::size_t camera = 0; camera < world.cameras.size(); ++camera) {
    backgrounds_.push_back(shooting_.ShootStage(camera));
  }
}

TakeCameras::Feed::Feed(TakeCameras& cameras, std::size_t camera) : cameras_(cameras), camera_(camera) {
  for (const PersonSource& source : cameras.sources_) {
    if (source.program != nullptr) source.program->Begin(camera, cameras.backgrounds_[camera]);
    finders_.emplace_back(cameras.backgrounds_[camera], OptionsOf(source));
  }
}

Mask TakeCameras::Feed::Find(std::size_t source, const Picture& picture) {
  const PersonSource& by = cameras_.sources_[source];
  if (by.is_truth) return picture.person;
  if (by.program == nullptr) return finders_[source].Find(picture.colour);
  return PersonAmong(by.program->Detect(picture.colour), OptionsOf(by));
}

Marks TakeCameras::Feed::Mark(std::size_t source, std::size_t frame, const AnnotatedPicture& picture) {
  Marking& marking = cameras_.marking_[source];
  if (cameras_.sources_[source].for_silhouettes && !cameras_.sources_[source].has_keypoints) return {};
  if (cameras_.sources_[source].has_coloured_marks) return marking.ReadColours(frame, picture);
  if (!cameras_.sources_[source].has_true_marks) return marking.Mark(camera_, frame, picture);
  return marking.MarkTrueJoints(frame, picture, cameras_.world_.cameras[camera_],
                                cameras_.shooting_.SeenPose(camera_, frame));
}

TakeCameras::Picture TakeCameras::Feed::Next(std::size_t frame) {
  View view = cameras_.shooting_.Shoot(camera_, frame, Targets::kColourAndLabels);
  const auto is_shadow = [](std::uint32_t label) { return label == static_cast<std::uint32_t>(Part::kShadow); };
  Picture picture{.colour = std::move(view.colour),
                  .person = MaskWhere(view.labels, IsPerformer),
                  .shadow = MaskWhere(view.labels, is_shadow),
                  .found = {},
                  .marks = {}};
  for (std::size_t i = 0; i < finders_.size(); ++i) {
    picture.found.push_back(Find(i, picture));
    picture.marks.push_back(Mark(i, frame, {view.labels, picture.colour, picture.found.back()}));
  }
  return picture;
}

}  // namespace etude
