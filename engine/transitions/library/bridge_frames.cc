#include "engine/transitions/library/bridge_frames.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/base/directions.h"

namespace etude {
namespace {

using enum Role;

/// Returns the neck's unit direction relative to the trunk's axes (left, up, front). A head that turns together with
/// the whole body therefore counts as still.
glm::dvec3 NeckInTrunk(const BodyPose& pose) {
  const glm::dvec3 none(0);
  const glm::dvec3 up = UnitOr(pose[kShoulderCentre] - pose[kHipCentre], none);
  const glm::dvec3 across = pose[kLeftShoulder] - pose[kRightShoulder];
  const glm::dvec3 left = UnitOr(across - glm::dot(across, up) * up, none);
  const glm::dvec3 neck = UnitOr(pose[kHead] - pose[kShoulderCentre], none);
  return {glm::dot(neck, left), glm::dot(neck, up), glm::dot(neck, glm::cross(left, up))};
}

/// Keeps, of all frames with the same ten tags, those with the smallest FrameRating::difference; if differences are
/// equal, the earlier frames.
std::vector<int> KeepMostAlike(const std::vector<int>& frames, const TaggedClip& clip,
                               const std::vector<FrameRating>& ratings, int most_per_class) {
  std::map<Tags, std::vector<int>> classes;
  for (int frame : frames) classes[clip.tags[frame]].push_back(frame);
  std::vector<int> kept;
  for (auto& [tags, members] : classes) {
    std::stable_sort(members.begin(), members.end(),
                     [&](int a, int b) { return ratings[a].difference < ratings[b].difference; });
    const std::size_t count = std::min(members.size(), static_cast<std::size_t>(most_per_class));
    kept.insert(kept.end(), members.begin(), members.begin() + static_cast<std::ptrdiff_t>(count));
  }
  std::sort(kept.begin(), kept.end());
  return kept;
}

/// Sums over the frames of one class. These sums give the mean squared distance of any frame to the class in constant
/// time.
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

/// A class: all frames with the same ten tags.
struct PoseClass {
  Sums all;
  std::map<int, Sums> by_clip;
};

/// Returns the mean of d² from `frame` to the frames of a class that are not in `own`: Σ w (a² − 2 a E[x] + E[x²]),
/// where a is a grade of `frame`, and x the same grade of those frames.
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

std::vector<bool> FindQuietHeads(const BodyMotion& motion, const HeadRule& rule) {
  const int count = static_cast<int>(motion.poses.size());
  std::vector<glm::dvec3> necks;
  necks.reserve(motion.poses.size());
  for (const BodyPose& pose : motion.poses) necks.push_back(NeckInTrunk(pose));
  std::vector<bool> quiet(motion.poses.size());
  for (int f = 0; f < count; ++f) {
    const int before = std::max(f - 1, 0), after = std::min(f + 1, count - 1);
    const double seconds = (after - before) / motion.rate_hz;
    const double turned = AngleBetween(necks[before], necks[after]);
    const double bend = AngleBetween(necks[f], {0, 1, 0});
    quiet[f] = bend <= rule.max_bend && turned <= rule.max_turn_speed * seconds;
  }
  return quiet;
}

std::vector<TaggedClip> TagClips(std::span<const BodyMotion> clips, double standing_hip_height, const TagRules& rules) {
  std::vector<TaggedClip> tagged;
  tagged.reserve(clips.size());
  for (const BodyMotion& motion : clips) {
    TaggedClip& clip = tagged.emplace_back();
    clip.rate_hz = motion.rate_hz;
    for (const BodyPose& pose : motion.poses) {
      clip.grades.push_back(Fuzzify(ComputeFeatures(pose, standing_hip_height), rules.memberships));
      clip.tags.push_back(ChooseTags(clip.grades.back()));
    }
  }
  const std::vector<std::vector<FrameRating>> ratings = RateFrames(tagged, rules.weights);
  for (std::size_t c = 0; c < clips.size(); ++c) {
    const std::vector<bool> quiet = FindQuietHeads(clips[c], rules.head);
    std::vector<int>& frames = tagged[c].bridge_frames;
    for (int f = 0; f < tagged[c].FrameCount(); ++f) {
      if (quiet[f] && ratings[c][f].clips >= rules.min_clips) frames.push_back(f);
    }
    if (rules.most_per_class > 0) frames = KeepMostAlike(frames, tagged[c], ratings[c], rules.most_per_class);
  }
  return tagged;
}

std::vector<std::vector<FrameRating>> RateFrames(std::span<const TaggedClip> clips, const FeatureWeights& weights) {
  // Sum up the grades of each class (frames with the same tags), in total and by clip.
  std::map<Tags, PoseClass> classes;
  for (std::size_t c = 0; c < clips.size(); ++c) {
    for (int f = 0; f < clips[c].FrameCount(); ++f) {
      PoseClass& pose_class = classes[clips[c].tags[f]];
      pose_class.all.Add(clips[c].grades[f]);
      pose_class.by_clip[static_cast<int>(c)].Add(clips[c].grades[f]);
    }
  }
  // Compare each frame with the frames of its class in the other clips.
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
