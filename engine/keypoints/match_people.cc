#include "engine/keypoints/match_people.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "engine/base/order_statistics.h"
#include "engine/cameras/triangulation.h"

namespace etude {
namespace {

/// A person followed in one of the cameras.
struct Track : PersonTrack {
  std::size_t camera = 0;
};

/// Nearest point to two lines; nothing of parallel ones.
std::optional<glm::dvec3> MiddleOf(const SightLine& a, const SightLine& b) {
  const double cosine = glm::dot(a.direction_W, b.direction_W);
  const double sine2 = 1 - cosine * cosine;
  constexpr double kParallel = 1e-6;
  if (!(sine2 > kParallel)) return std::nullopt;
  const glm::dvec3 between = b.camera_W - a.camera_W;
  const double along_a = (glm::dot(between, a.direction_W) - cosine * glm::dot(between, b.direction_W)) / sine2;
  const double along_b = (cosine * glm::dot(between, a.direction_W) - glm::dot(between, b.direction_W)) / sine2;
  if (along_a <= 0 || along_b <= 0) return std::nullopt;
  return 0.5 * (a.camera_W + along_a * a.direction_W + b.camera_W + along_b * b.direction_W);
}

class Joiner {
 public:
  Joiner(std::span<const ProjectionMatrix> cameras, std::span<const SeenPeople> people, const MatchOptions& options,
         std::vector<Track> tracks)
      : cameras_(cameras), people_(people), options_(options), tracks_(std::move(tracks)), group_(tracks_.size()) {
    for (std::size_t i = 0; i < group_.size(); ++i) group_[i] = i;
  }

  std::vector<MatchedPerson> Join() {
    std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;
    for (std::size_t a = 0; a < tracks_.size(); ++a) {
      for (std::size_t b = a + 1; b < tracks_.size(); ++b) {
        const double error = ErrorOf(a, b);
        if (!std::isfinite(error)) continue;
        errors_[{a, b}] = error;
        if (error < options_.largest_error) pairs.emplace_back(error, a, b);
      }
    }
    std::ranges::sort(pairs);
    for (const auto& [error, a, b] : pairs) {
      if (group_[a] != group_[b] && MayJoin(group_[a], group_[b])) Unite(group_[a], group_[b]);
    }
    return Persons();
  }

 private:
  /// Of two tracks in different cameras: median over frames and keypoints. Infinite when they share too little.
  double ErrorOf(std::size_t a, std::size_t b) const {
    const Track &one = tracks_[a], &other = tracks_[b];
    if (one.camera == other.camera) return std::numeric_limits<double>::infinity();
    struct Shared {
      std::size_t frame, one, other;
    };
    std::vector<Shared> shared;
    for (const auto& [frame, entry] : one.entries) {
      const auto found = other.entries.find(frame);
      if (found != other.entries.end()) shared.push_back({frame, entry, found->second});
    }
    std::vector<double> errors;
    constexpr std::size_t kMostFrames = 60;
    const std::size_t stride = std::max<std::size_t>(1, shared.size() / kMostFrames);
    for (std::size_t i = 0; i < shared.size(); i += stride) {
      const Shared& at = shared[i];
      AddErrors(one.camera, people_[one.camera][at.frame][at.one], other.camera,
                people_[other.camera][at.frame][at.other], errors);
    }
    constexpr std::size_t kFewest = 8;
    return errors.size() < kFewest ? std::numeric_limits<double>::infinity() : UpperMedian(std::move(errors));
  }

  void AddErrors(std::size_t camera_a, const SeenPerson& a, std::size_t camera_b, const SeenPerson& b,
                 std::vector<double>& errors) const {
    const double height_a = std::max(1.0, HeightPx(a)), height_b = std::max(1.0, HeightPx(b));
    for (std::size_t i = 0; i < kLandmarkCount; ++i) {
      const Keypoint &p = a.keypoints[i], &q = b.keypoints[i];
      if (p.confidence < options_.follow.least_confidence || q.confidence < options_.follow.least_confidence) continue;
      const auto line_a = SightLineOf({cameras_[camera_a], p.pixel}),
                 line_b = SightLineOf({cameras_[camera_b], q.pixel});
      const auto middle = line_a && line_b ? MiddleOf(*line_a, *line_b) : std::nullopt;
      const auto shown_a = middle ? Project(cameras_[camera_a], *middle) : std::nullopt;
      const auto shown_b = middle ? Project(cameras_[camera_b], *middle) : std::nullopt;
      // Rays that meet nowhere in front are no match.
      errors.push_back(shown_a && shown_b
                           ? glm::distance(*shown_a, p.pixel) / height_a + glm::distance(*shown_b, q.pixel) / height_b
                           : std::numeric_limits<double>::max());
    }
  }

  /// No camera sees one person twice at a time, and all that can be compared fits.
  bool MayJoin(std::size_t g, std::size_t h) const {
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t a = 0; a < tracks_.size(); ++a) {
      if (group_[a] != g) continue;
      for (std::size_t b = 0; b < tracks_.size(); ++b) {
        if (group_[b] != h) continue;
        const bool together = tracks_[a].first() <= tracks_[b].last() && tracks_[b].first() <= tracks_[a].last();
        if (tracks_[a].camera == tracks_[b].camera && together) return false;
        const auto error = errors_.find(std::minmax(a, b));
        if (error == errors_.end()) continue;
        sum += std::min(error->second, 1.0);
        ++count;
      }
    }
    return count > 0 && sum / static_cast<double>(count) < options_.largest_error;
  }

  void Unite(std::size_t g, std::size_t h) {
    for (std::size_t& group : group_) {
      if (group == std::max(g, h)) group = std::min(g, h);
    }
  }

  std::vector<MatchedPerson> Persons() const {
    std::vector<MatchedPerson> persons;
    for (std::size_t g = 0; g < tracks_.size(); ++g) {
      if (group_[g] != g) continue;
      MatchedPerson person;
      person.seen.assign(people_.size(), std::vector<std::optional<SeenPerson>>(people_.front().size()));
      std::vector<bool> by(people_.size());
      std::vector<double> errors;
      for (std::size_t t = 0; t < tracks_.size(); ++t) {
        if (group_[t] != g) continue;
        by[tracks_[t].camera] = true;
        for (const auto& [frame, entry] : tracks_[t].entries) {
          const SeenPerson& seen = people_[tracks_[t].camera][frame][entry];
          person.seen[tracks_[t].camera][frame] = seen;
          for (const Keypoint& keypoint : seen.keypoints) person.sightings += keypoint.confidence;
        }
        for (std::size_t u = t + 1; u < tracks_.size(); ++u) {
          const auto error = errors_.find({t, u});
          if (group_[u] == g && error != errors_.end()) errors.push_back(error->second);
        }
      }
      person.error = errors.empty() ? 0 : UpperMedian(std::move(errors));
      person.cameras = static_cast<std::size_t>(std::ranges::count(by, true));
      persons.push_back(std::move(person));
    }
    std::ranges::stable_sort(persons, std::greater{}, &MatchedPerson::sightings);
    return persons;
  }

  const std::span<const ProjectionMatrix> cameras_;
  const std::span<const SeenPeople> people_;
  const MatchOptions& options_;
  const std::vector<Track> tracks_;
  std::vector<std::size_t> group_;  ///< of each track: the number of its first one
  std::map<std::pair<std::size_t, std::size_t>, double> errors_;
};

}  // namespace

std::vector<MatchedPerson> MatchPeople(std::span<const ProjectionMatrix> cameras, std::span<const SeenPeople> people,
                                       const MatchOptions& options) {
  assert(cameras.size() == people.size());
  if (people.empty() || people.front().empty()) return {};
  assert(std::ranges::all_of(people, [&](const SeenPeople& of) { return of.size() == people.front().size(); }));
  std::vector<Track> tracks;
  for (std::size_t camera = 0; camera < people.size(); ++camera) {
    for (PersonTrack& track : FollowPeople(people[camera], options.follow))
      tracks.push_back({std::move(track), camera});
  }
  // A glimpse says nothing over time. In a very short film everything is one.
  const std::size_t shortest = std::min<std::size_t>(5, (people.front().size() + 1) / 2);
  std::erase_if(tracks, [&](const Track& track) { return track.entries.size() < shortest; });
  return Joiner(cameras, people, options, std::move(tracks)).Join();
}

}  // namespace etude
