#include "bench/tasks/capture/take_cameras.h"

#include <algorithm>

#include "bench/tasks/capture/seated_segmenter.h"
#include "sim/body/shape.h"

namespace etude {
namespace {

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
