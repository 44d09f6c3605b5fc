#include "engine/keypoints/match_people.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "engine/base/order_statistics.h"
#include "engine/cameras/triangulation.h"
#include "engine/keypoints/correct_people.h"

namespace etude {
namespace {

/// Returns the median distance between two detections' keypoints of the same landmarks in one camera, as a share of the
/// person's height; infinity if the detections have fewer than three landmarks in common.
double StepBetween(const SeenPerson& a, const SeenPerson& b, double min_confidence) {
  std::vector<double> steps;
  for (std::size_t i = 0; i < kLandmarkCount; ++i) {
    const Keypoint &p = a.keypoints[i], &q = b.keypoints[i];
    if (p.confidence >= min_confidence && q.confidence >= min_confidence) {
      steps.push_back(glm::distance(p.pixel, q.pixel));
    }
  }
  constexpr std::size_t kMinCount = 3;
  if (steps.size() < kMinCount) return std::numeric_limits<double>::infinity();
  return UpperMedian(std::move(steps)) / std::max(1.0, HeightPx(a));
}

class Follower {
 public:
  Follower(const SeenPeople& people, const FollowOptions& options) : people_(people), options_(options) {}

  std::vector<PersonTrack> Follow() {
    std::vector<PersonTrack> tracks;
    for (std::size_t frame = 0; frame < people_.size(); ++frame) {
      // Extend each track by its nearest candidate, unless another candidate is nearly as near; then those tracks whose
      // person was absent for longer, by the candidates that are left.
      std::vector<bool> taken(people_[frame].size()), extended(tracks.size());
      const auto last = static_cast<std::size_t>(options_.max_absence);
      for (const auto& [from, to] : {std::pair(std::size_t{0}, last), {last + 1, std::max(last, MaxReturn())}}) {
        for (const auto& [step, track, person] : Candidates(tracks, frame, from, to, taken)) {
          if (taken[person] || extended[track]) continue;
          tracks[track].entries[frame] = person;
          taken[person] = extended[track] = true;
        }
      }
      // Every person who continues no track begins a new one.
      for (std::size_t person = 0; person < taken.size(); ++person) {
        if (!taken[person]) tracks.push_back({{{frame, person}}});
      }
    }
    return tracks;
  }

 private:
  using Candidate = std::tuple<double, std::size_t, std::size_t>;  ///< step, track, person

  std::size_t MaxReturn() const { return static_cast<std::size_t>(options_.max_return); }

  /// Returns the possible extensions of the tracks that were last seen `from` to `to` frames ago, by people who are not
  /// `taken`, by ascending step. Extensions with a competing candidate that is nearly as near are left out.
  std::vector<Candidate> Candidates(const std::vector<PersonTrack>& tracks, std::size_t frame, std::size_t from,
                                    std::size_t to, const std::vector<bool>& taken) const {
    std::vector<Candidate> all;
    for (std::size_t t = 0; t < tracks.size(); ++t) {
      const std::size_t last = tracks[t].last();
      if (frame - last < from || frame - last > to) continue;
      const SeenPerson& before = people_[last][tracks[t].entries.rbegin()->second];
      for (std::size_t p = 0; p < people_[frame].size(); ++p) {
        if (taken[p]) continue;
        const double step = StepBetween(before, people_[frame][p], options_.min_confidence);
        if (step < options_.max_step) all.emplace_back(step, t, p);
      }
    }
    std::ranges::sort(all);
    constexpr double kNearlyAsNear = 1.5;
    std::vector<Candidate> clear;
    for (const Candidate& one : all) {
      const bool has_rival = std::ranges::any_of(all, [&](const Candidate& other) {
        const bool shares = (std::get<1>(one) == std::get<1>(other)) != (std::get<2>(one) == std::get<2>(other));
        return shares && std::get<0>(other) < kNearlyAsNear * std::get<0>(one);
      });
      if (!has_rival) clear.push_back(one);
    }
    return clear;
  }

  const SeenPeople& people_;
  const FollowOptions& options_;
};

/// A person tracked in one of the cameras.
struct Track : PersonTrack {
  std::size_t camera = 0;
};

/// Returns the midpoint of the shortest segment between two rays; nullopt if the rays are parallel or the midpoint lies
/// behind a camera.
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

class PersonMatcher {
 public:
  PersonMatcher(std::span<const ProjectionMatrix> cameras, std::span<const SeenPeople> people,
                const MatchOptions& options, std::vector<Track> tracks)
      : cameras_(cameras), people_(people), options_(options), tracks_(std::move(tracks)), group_(tracks_.size()) {
    for (std::size_t i = 0; i < group_.size(); ++i) group_[i] = i;
  }

  std::vector<MatchedPerson> Join() {
    // Compute the error of every pair of tracks in different cameras.
    std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;
    for (std::size_t a = 0; a < tracks_.size(); ++a) {
      for (std::size_t b = a + 1; b < tracks_.size(); ++b) {
        const double error = ErrorOf(a, b);
        if (!std::isfinite(error)) continue;
        errors_[{a, b}] = error;
        if (error < options_.max_error) pairs.emplace_back(error, a, b);
      }
    }
    // Join groups of tracks, beginning with the pair of the smallest error.
    std::ranges::sort(pairs);
    for (const auto& [error, a, b] : pairs) {
      if (group_[a] != group_[b] && MayJoin(group_[a], group_[b])) Unite(group_[a], group_[b]);
    }
    return Persons();
  }

 private:
  /// Returns the error of two tracks in different cameras, as a share of the person's height: the median, over frames
  /// and keypoints, of how far the two rays of a keypoint miss each other. The error is infinite if the tracks have too
  /// few keypoints in common.
  double ErrorOf(std::size_t a, std::size_t b) const {
    const Track &one = tracks_[a], &other = tracks_[b];
    if (one.camera == other.camera) return std::numeric_limits<double>::infinity();
    // List the frames that both tracks contain.
    struct Shared {
      std::size_t frame, one, other;
    };
    std::vector<Shared> shared;
    for (const auto& [frame, entry] : one.entries) {
      const auto found = other.entries.find(frame);
      if (found != other.entries.end()) shared.push_back({frame, entry, found->second});
    }
    // Compute the median error over fewer than twice kMaxFrames of these frames, evenly spaced.
    constexpr std::size_t kMaxFrames = 60;
    const std::size_t stride = std::max<std::size_t>(1, shared.size() / kMaxFrames);
    const auto error_of = [&](bool is_swapped) {
      std::vector<double> errors;
      for (std::size_t i = 0; i < shared.size(); i += stride) {
        const Shared& at = shared[i];
        const SeenPerson& first = people_[one.camera][at.frame][at.one];
        AddErrors(one.camera, is_swapped ? WithSidesSwapped(first) : first, other.camera,
                  people_[other.camera][at.frame][at.other], errors);
      }
      constexpr std::size_t kMinCount = 8;
      return errors.size() < kMinCount ? std::numeric_limits<double>::infinity() : UpperMedian(std::move(errors));
    };
    const double error = error_of(false);
    // If the labels as detected do not match, also compare with left and right exchanged.
    if (!options_.may_be_swapped || !(error >= options_.max_error)) return error;
    return std::min(error, error_of(true));
  }

  void AddErrors(std::size_t camera_a, const SeenPerson& a, std::size_t camera_b, const SeenPerson& b,
                 std::vector<double>& errors) const {
    const double height_a = std::max(1.0, HeightPx(a)), height_b = std::max(1.0, HeightPx(b));
    for (std::size_t i = 0; i < kLandmarkCount; ++i) {
      const Keypoint &p = a.keypoints[i], &q = b.keypoints[i];
      if (p.confidence < options_.follow.min_confidence || q.confidence < options_.follow.min_confidence) continue;
      const auto line_a = SightLineOf({cameras_[camera_a], p.pixel}),
                 line_b = SightLineOf({cameras_[camera_b], q.pixel});
      const auto middle = line_a && line_b ? MiddleOf(*line_a, *line_b) : std::nullopt;
      const auto shown_a = middle ? Project(cameras_[camera_a], *middle) : std::nullopt;
      const auto shown_b = middle ? Project(cameras_[camera_b], *middle) : std::nullopt;
      // Rays whose nearest points lie behind a camera do not match.
      errors.push_back(shown_a && shown_b
                           ? glm::distance(*shown_a, p.pixel) / height_a + glm::distance(*shown_b, q.pixel) / height_b
                           : std::numeric_limits<double>::max());
    }
  }

  /// Returns true if two groups may be one person: no two tracks of one camera overlap in time, and the mean error of
  /// the pairs that can be compared is below the limit.
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
    return count > 0 && sum / static_cast<double>(count) < options_.max_error;
  }

  void Unite(std::size_t g, std::size_t h) {
    for (std::size_t& group : group_) {
      if (group == std::max(g, h)) group = std::min(g, h);
    }
  }

  std::vector<MatchedPerson> Persons() const {
    std::vector<MatchedPerson> persons;
    // Make one person of each group.
    for (std::size_t g = 0; g < tracks_.size(); ++g) {
      if (group_[g] != g) continue;
      MatchedPerson person;
      person.seen.assign(people_.size(), std::vector<std::optional<SeenPerson>>(people_.front().size()));
      std::vector<bool> by(people_.size());
      std::vector<double> errors;
      // Collect the person's detections in all cameras, and the errors of the pairs of tracks.
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
  std::vector<std::size_t> group_;  ///< for each track: the index of the first track of its group
  std::map<std::pair<std::size_t, std::size_t>, double> errors_;
};

}  // namespace

std::vector<PersonTrack> FollowPeople(const SeenPeople& people, const FollowOptions& options) {
  return Follower(people, options).Follow();
}

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
  // A track of a few frames cannot be compared over time. In a very short film, half of the frames are enough.
  const std::size_t shortest = std::min<std::size_t>(5, (people.front().size() + 1) / 2);
  std::erase_if(tracks, [&](const Track& track) { return track.entries.size() < shortest; });
  return PersonMatcher(cameras, people, options, std::move(tracks)).Join();
}

}  // namespace etude
