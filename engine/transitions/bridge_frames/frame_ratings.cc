#include "engine/transitions/bridge_frames/frame_ratings.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/transitions/bridge_frames/bridge_frames.h"

namespace etude {
namespace {

/// Sums over frames of one class, from which the mean squared distance of any frame to them follows at once.
struct Sums {
  int frames = 0;
  Grades grades{}, squares{};

  void Add(const Grades& added) {
    ++frames;
    for (std::size_t t = 0; t < kTermCount; ++t) {
      grades[t] += added[t];
      squares[t] += added[t] * added[t];
    }
  }
};

/// The frames of the same ten tags.
struct PoseClass {
  Sums all;
  std::map<int, Sums> by_clip;
};

/// Σ over the class's frames outside `own` of d², divided by their number: Σ w (a² − 2 a E[x] + E[x²]).
double MeanSquareDistance(const Grades& frame, const Sums& all, const Sums& own, const FeatureWeights& weights) {
  const double others = all.frames - own.frames;
  double sum = 0;
  for (Feature feature : AllFeatures()) {
    const std::size_t first = FirstTermOf(feature);
    double gap = 0;
    for (std::size_t t = first; t < first + TermsOf(feature).size(); ++t) {
      const double mean = (all.grades[t] - own.grades[t]) / others;
      const double mean_square = (all.squares[t] - own.squares[t]) / others;
      gap += frame[t] * (frame[t] - 2 * mean) + mean_square;
    }
    sum += weights[static_cast<std::size_t>(feature)] * gap;
  }
  return std::max(sum, 0.0);
}

}  // namespace

std::vector<std::vector<FrameRating>> RateFrames(std::span<const TaggedClip> clips, const FeatureWeights& weights) {
  std::map<Tags, PoseClass> classes;
  for (std::size_t c = 0; c < clips.size(); ++c) {
    for (int f = 0; f < clips[c].FrameCount(); ++f) {
      PoseClass& pose_class = classes[clips[c].tags[f]];
      pose_class.all.Add(clips[c].grades[f]);
      pose_class.by_clip[static_cast<int>(c)].Add(clips[c].grades[f]);
    }
  }
  std::vector<std::vector<FrameRating>> ratings(clips.size());
  for (std::size_t c = 0; c < clips.size(); ++c) {
    for (int f = 0; f < clips[c].FrameCount(); ++f) {
      const PoseClass& pose_class = classes.at(clips[c].tags[f]);
      FrameRating& rating = ratings[c].emplace_back();
      rating.clips = static_cast<int>(pose_class.by_clip.size());
      rating.frames = pose_class.all.frames;
      if (rating.clips < 2) continue;
      const Sums& own = pose_class.by_clip.at(static_cast<int>(c));
      rating.difference = std::sqrt(MeanSquareDistance(clips[c].grades[f], pose_class.all, own, weights));
    }
  }
  return ratings;
}

}  // namespace etude
