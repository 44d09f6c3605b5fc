#include "bench/tasks/capture/film.h"

#include <algorithm>

#include "bench/recordings/capture_extras.h"
#include "bench/tasks/capture/marking.h"
#include "bench/tasks/capture/shooting.h"
#include "engine/base/digest.h"
#include "engine/vision/person_finder.h"
#include "sim/body/shape.h"

namespace etude {
namespace {

void AddPicture(const ColourImage& picture, Digest& digest) {
  static_assert(sizeof(Rgb8) == 3, "a picture's bytes are its colours");
  digest.Add(std::span(reinterpret_cast<const std::uint8_t*>(picture.pixels.data()), 3 * picture.pixels.size()));
}

void AddMarks(const Marks& marks, Digest& digest) {
  for (const auto& stroke : marks.strokes) {
    digest.Add(static_cast<std::int64_t>(stroke.has_value()));
    if (stroke) digest.Add(stroke->a.x).Add(stroke->a.y).Add(stroke->b.x).Add(stroke->b.y);
  }
  for (const auto& effector : marks.effectors) {
    digest.Add(static_cast<std::int64_t>(effector.has_value()));
    if (effector) digest.Add(effector->x).Add(effector->y);
  }
}

template <typename Belongs>
Mask MaskWhere(const LabelImage& labels, Belongs belongs) {
  Mask mask(labels.width, labels.height);
  std::transform(labels.pixels.begin(), labels.pixels.end(), mask.pixels.begin(), belongs);
  return mask;
}

// The camera crew: everything that all pictures of a take share.
class Crew {
 public:
  Crew(const CaptureWorld& world, const StudioOptions& options, const WorldKey& key, Renderer& renderer)
      : cameras_(world.cameras), shooting_(world, options.camera, key, renderer) {
    for (std::size_t camera = 0; camera < world.cameras.size(); ++camera) {
      backgrounds_.push_back(shooting_.ShootStage(camera));
    }
  }

  struct Picture {
    ColourImage colour;
    LabelImage labels;
    Mask person;
    Mask shadow;
  };

  Picture Shoot(std::size_t camera, std::size_t frame) {
    View view = shooting_.Shoot(camera, frame, Targets::kColourAndLabels);
    Mask person = MaskWhere(view.labels, IsPerformer);
    Mask shadow =
        MaskWhere(view.labels, [](std::uint32_t l) { return l == static_cast<std::uint32_t>(Part::kShadow); });
    return {std::move(view.colour), std::move(view.labels), std::move(person), std::move(shadow)};
  }

  const Camera& CameraOf(std::size_t camera) const { return cameras_[camera]; }
  BodyPose SeenPose(std::size_t camera, std::size_t frame) const { return shooting_.SeenPose(camera, frame); }

  const std::vector<ColourImage>& backgrounds() const { return backgrounds_; }

 private:
  const std::vector<Camera>& cameras_;
  Shooting shooting_;
  std::vector<ColourImage> backgrounds_;
};

Marks Mark(Marking& marking, const PersonSource& source, const Crew& crew, std::size_t camera, std::size_t frame,
           const AnnotatedPicture& picture) {
  if (source.for_silhouettes) return {};
  if (!source.has_true_marks) return marking.Mark(camera, frame, picture);
  return marking.MarkTrueJoints(frame, picture, crew.CameraOf(camera), crew.SeenPose(camera, frame));
}

}  // namespace

Take Film(const CaptureWorld& world, const StudioOptions& options, const WorldKey& key,
          std::span<const PersonSource> sources, bool wants_masks, Renderer& renderer, const PictureSink& sink) {
  Crew crew(world, options, key, renderer);
  Digest pictures;
  const auto show = [&](std::size_t camera, std::optional<std::size_t> frame, const ColourImage& picture) {
    AddPicture(picture, pictures);
    if (sink) sink(camera, frame, picture);
  };
  for (std::size_t camera = 0; camera < world.cameras.size(); ++camera) {
    show(camera, std::nullopt, crew.backgrounds()[camera]);
  }
  Take take;
  std::vector<Digest> masks(sources.size()), marks(sources.size());
  std::vector<std::vector<MaskScore>> scores(sources.size());
  const bool are_few = world.cameras.size() * world.truth.size() <= kMostSilhouettes;
  const auto keeps_masks = [&](const PersonSource& source) {
    return wants_masks || (source.for_silhouettes && are_few);
  };
  std::vector<Marking> marking(sources.size(), Marking(options, world, key));
  for (const PersonSource& source : sources) {
    Observation& observation = take.observations.emplace_back();
    observation.source = source;
    observation.marks.resize(world.cameras.size());
    if (keeps_masks(source)) observation.masks.resize(world.cameras.size());
  }

  for (std::size_t camera = 0; camera < world.cameras.size(); ++camera) {
    std::vector<PersonFinder> finders;
    for (const PersonSource& source : sources) {
      finders.emplace_back(crew.backgrounds()[camera],
                           PersonOptions{.segmenter = source.segmenter, .change = {}, .pieces = source.pieces});
    }
    for (std::size_t frame = 0; frame < world.truth.size(); ++frame) {
      const Crew::Picture picture = crew.Shoot(camera, frame);
      show(camera, frame, picture.colour);
      if (wants_masks && frame == world.truth.size() / 2) take.stills.push_back(picture.colour);
      for (std::size_t i = 0; i < sources.size(); ++i) {
        Observation& observation = take.observations[i];
        const Mask person = sources[i].is_truth ? picture.person : finders[i].Find(picture.colour);
        masks[i].Add(std::span<const std::uint8_t>(person.pixels));
        scores[i].push_back(ScoreMask(person, picture.person, picture.shadow));
        if (keeps_masks(sources[i])) observation.masks[camera].push_back(HalveMask(person));
        observation.marks[camera].push_back(
            Mark(marking[i], sources[i], crew, camera, frame, {picture.labels, picture.colour, person}));
        AddMarks(observation.marks[camera].back(), marks[i]);
      }
    }
  }
  take.pictures_digest = pictures.Hex();
  for (std::size_t i = 0; i < sources.size(); ++i) {
    take.observations[i].score = MeanScore(scores[i]);
    take.observations[i].masks_digest = masks[i].Hex();
    take.observations[i].marks_digest = marks[i].Hex();
    take.observations[i].annotator_distance_px = AnnotatorDistancePx(marking[i].joints());
    take.observations[i].annotator_overlap = AnnotatorOverlap(marking[i].limbs());
  }
  return take;
}

}  // namespace etude
