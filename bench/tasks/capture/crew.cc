#include "bench/tasks/capture/crew.h"

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

Crew::Crew(const CaptureWorld& world, const StudioOptions& options, const WorldKey& key,
           std::span<const PersonSource> sources, Renderer& renderer)
    : world_(world),
      sources_(sources),
      shooting_(world, options.camera, key, renderer),
      marking_(sources.size(), Marking(options, world, key)) {
  for (std::size_t camera = 0; camera < world.cameras.size(); ++camera) {
    backgrounds_.push_back(shooting_.ShootStage(camera));
  }
}

Crew::Station::Station(Crew& crew, std::size_t camera) : crew_(crew), camera_(camera) {
  for (const PersonSource& source : crew.sources_) {
    if (source.program != nullptr) source.program->Begin(camera, crew.backgrounds_[camera]);
    finders_.emplace_back(crew.backgrounds_[camera], OptionsOf(source));
  }
}

Mask Crew::Station::Find(std::size_t source, const Picture& picture) {
  const PersonSource& by = crew_.sources_[source];
  if (by.is_truth) return picture.person;
  if (by.program == nullptr) return finders_[source].Find(picture.colour);
  return PersonAmong(by.program->Detect(picture.colour), OptionsOf(by));
}

Marks Crew::Station::Mark(std::size_t source, std::size_t frame, const AnnotatedPicture& picture) {
  Marking& marking = crew_.marking_[source];
  if (crew_.sources_[source].for_silhouettes) return {};
  if (crew_.sources_[source].has_coloured_marks) return marking.ReadColours(frame, picture);
  if (!crew_.sources_[source].has_true_marks) return marking.Mark(camera_, frame, picture);
  return marking.MarkTrueJoints(frame, picture, crew_.world_.cameras[camera_],
                                crew_.shooting_.SeenPose(camera_, frame));
}

Crew::Picture Crew::Station::See(std::size_t frame) {
  View view = crew_.shooting_.Shoot(camera_, frame, Targets::kColourAndLabels);
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
