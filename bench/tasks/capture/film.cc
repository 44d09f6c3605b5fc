#include "bench/tasks/capture/film.h"

#include "bench/recordings/capture_extras.h"
#include "engine/base/digest.h"

namespace etude {
namespace {

void AddPicture(const ColourImage& picture, Digest& digest) {
  static_assert(sizeof(Rgb8) == 3, "a picture is written as bytes of its colours");
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

}  // namespace

Take Film(const CaptureWorld& world, const StudioOptions& options, const WorldKey& key,
          std::span<const PersonSource> sources, bool wants_masks, Renderer& renderer, const PictureSink& sink) {
  TakeCameras cameras(world, options, key, sources, renderer);
  // Add every picture to the digest, and pass it on.
  Digest pictures;
  const auto show = [&](std::size_t camera, std::optional<std::size_t> frame, const ColourImage& picture) {
    AddPicture(picture, pictures);
    if (sink) sink(camera, frame, picture);
  };
  for (std::size_t camera = 0; camera < world.cameras.size(); ++camera) {
    show(camera, std::nullopt, cameras.backgrounds()[camera]);
  }
  // Prepare one observation for each PersonSource.
  Take take;
  std::vector<Digest> masks(sources.size()), marks(sources.size());
  std::vector<std::vector<MaskScore>> scores(sources.size());
  const bool are_few = world.cameras.size() * options.PicturesOf(world.truth.size()) <= kMaxSilhouettePictures;
  const auto keeps_masks = [&](const PersonSource& source) {
    return wants_masks || (source.for_silhouettes && are_few);
  };
  for (const PersonSource& source : sources) {
    Observation& observation = take.observations.emplace_back();
    observation.source = source;
    observation.marks.resize(world.cameras.size());
    if (keeps_masks(source)) observation.masks.resize(world.cameras.size());
  }

  // Shoot frame by frame. Each PersonSource adds its mask, the mask's score and its marks.
  for (std::size_t camera = 0; camera < world.cameras.size(); ++camera) {
    TakeCameras::Feed feed = cameras.FeedOf(camera);
    for (std::size_t frame = 0; frame < world.truth.size(); ++frame) {
      if (!options.IsPictured(frame)) {
        for (Observation& observation : take.observations) observation.marks[camera].emplace_back();
        continue;
      }
      const TakeCameras::Picture picture = feed.Next(frame);
      show(camera, frame, picture.colour);
      if (wants_masks && frame == world.truth.size() / 2) take.stills.push_back(picture.colour);
      for (std::size_t i = 0; i < sources.size(); ++i) {
        Observation& observation = take.observations[i];
        const Mask& person = picture.found[i];
        masks[i].Add(std::span<const std::uint8_t>(person.pixels));
        scores[i].push_back(ScoreMask(person, picture.person, picture.shadow));
        if (keeps_masks(sources[i])) observation.masks[camera].push_back(HalveMask(person));
        observation.marks[camera].push_back(picture.marks[i]);
        AddMarks(picture.marks[i], marks[i]);
      }
    }
  }
  // Sum up the scores and digests.
  take.pictures_digest = pictures.Hex();
  for (std::size_t i = 0; i < sources.size(); ++i) {
    take.observations[i].score = MeanScore(scores[i]);
    take.observations[i].masks_digest = masks[i].Hex();
    take.observations[i].marks_digest = marks[i].Hex();
    take.observations[i].annotator_distance_px = AnnotatorDistancePx(cameras.marking()[i].joints());
    take.observations[i].annotator_overlap = AnnotatorOverlap(cameras.marking()[i].limbs());
  }
  return take;
}

}  // namespace etude
