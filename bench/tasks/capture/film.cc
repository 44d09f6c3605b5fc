#include "bench/tasks/capture/film.h"

#include <algorithm>

#include "bench/recordings/capture_extras.h"
#include "bench/tasks/capture/shooting.h"
#include "engine/base/digest.h"
#include "sim/body/shape.h"
#include "sim/sensors/annotator.h"

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
      : world_(world), options_(options), key_(key), shooting_(world, options.camera, key, renderer) {
    for (std::size_t camera = 0; camera < world.cameras.size(); ++camera) {
      backgrounds_.push_back(shooting_.ShootBackground(camera));
    }
  }

  struct Picture {
    ColourImage colour;
    Mask person;
    Mask shadow;
  };

  Picture Shoot(std::size_t camera, std::size_t frame) {
    View view = shooting_.Shoot(camera, frame, Targets::kColourAndLabels);
    return {
        std::move(view.colour), MaskWhere(view.labels, IsPerformer),
        MaskWhere(view.labels, [](std::uint32_t label) { return label == static_cast<std::uint32_t>(Part::kShadow); })};
  }

  Mask CutOut(const Picture& picture, std::size_t camera, const PersonSource& source) const {
    if (source.is_truth) return picture.person;
    return ExtractPerson(backgrounds_[camera], picture.colour, {.segmenter = source.segmenter, .change = {}});
  }

  // The annotator's marks on this cut-out, read back. Their dice depend on camera and frame alone.
  Marks Mark(const Mask& person, std::size_t camera, std::size_t frame) const {
    if (frame % static_cast<std::size_t>(options_.mark_every) != 0) return {};
    RandomStream random(key_, fmt::format("capture/camera-{}/annotator/{}", camera, frame));
    const BodyPose truth = shooting_.SeenPose(camera, frame);
    AnnotatorOptions annotator;
    annotator.error_px = options_.annotation_error_px;
    return ReadMarks(Annotate(truth, BodyCapsules(truth), world_.cameras[camera], person, annotator, random));
  }

  const std::vector<ColourImage>& backgrounds() const { return backgrounds_; }

 private:
  const CaptureWorld& world_;
  const StudioOptions& options_;
  const WorldKey& key_;
  Shooting shooting_;
  std::vector<ColourImage> backgrounds_;
};

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
  for (const PersonSource& source : sources) {
    Observation& observation = take.observations.emplace_back();
    observation.source = source;
    observation.marks.resize(world.cameras.size());
    if (wants_masks) observation.masks.resize(world.cameras.size());
  }

  for (std::size_t camera = 0; camera < world.cameras.size(); ++camera) {
    for (std::size_t frame = 0; frame < world.truth.size(); ++frame) {
      const Crew::Picture picture = crew.Shoot(camera, frame);
      show(camera, frame, picture.colour);
      for (std::size_t i = 0; i < sources.size(); ++i) {
        Observation& observation = take.observations[i];
        const Mask person = crew.CutOut(picture, camera, sources[i]);
        masks[i].Add(std::span<const std::uint8_t>(person.pixels));
        scores[i].push_back(ScoreMask(person, picture.person, picture.shadow));
        if (wants_masks) observation.masks[camera].push_back(HalveMask(person));
        observation.marks[camera].push_back(crew.Mark(person, camera, frame));
        AddMarks(observation.marks[camera].back(), marks[i]);
      }
    }
  }
  take.pictures_digest = pictures.Hex();
  for (std::size_t i = 0; i < sources.size(); ++i) {
    take.observations[i].score = MeanScore(scores[i]);
    take.observations[i].masks_digest = masks[i].Hex();
    take.observations[i].marks_digest = marks[i].Hex();
  }
  return take;
}

}  // namespace etude
