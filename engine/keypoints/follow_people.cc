#include "engine/keypoints/follow_people.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include "engine/base/order_statistics.h"

namespace etude {
namespace {

/// How far the keypoints of two sightings by one camera are apart, as a share of the person's height.
double StepBetween(const SeenPerson& a, const SeenPerson& b, double least_confidence) {
  std::vector<double> steps;
  for (std::size_t i = 0; i < kLandmarkCount; ++i) {
    const Keypoint &p = a.keypoints[i], &q = b.keypoints[i];
    if (p.confidence >= least_confidence && q.confidence >= least_confidence) {
      steps.push_back(glm::distance(p.pixel, q.pixel));
    }
  }
  constexpr std::size_t kFewest = 3;
  if (steps.size() < kFewest) return std::numeric_limits<double>::infinity();
  return UpperMedian(std::move(steps)) / std::max(1.0, HeightPx(a));
}

class Follower {
 public:
  Follower(const SeenPeople& people, const FollowOptions& options) : people_(people), options_(options) {}

  std::vector<PersonTrack> Follow() {
    std::vector<PersonTrack> tracks;
    for (std::size_t frame = 0; frame < people_.size(); ++frame) {
      std::vector<bool> taken(people_[frame].size()), extended(tracks.size());
      for (const auto& [step, track, person] : Candidates(tracks, frame)) {
        if (taken[person] || extended[track]) continue;
        tracks[track].entries[frame] = person;
        taken[person] = extended[track] = true;
      }
      for (std::size_t person = 0; person < taken.size(); ++person) {
        if (!taken[person]) tracks.push_back({{{frame, person}}});
      }
    }
    return tracks;
  }

 private:
  using Candidate = std::tuple<double, std::size_t, std::size_t>;  ///< step, track, person

  /// The nearest first; without those that have a rival nearly as near.
  std::vector<Candidate> Candidates(const std::vector<PersonTrack>& tracks, std::size_t frame) const {
    std::vector<Candidate> all;
    for (std::size_t t = 0; t < tracks.size(); ++t) {
      const std::size_t last = tracks[t].last();
      if (frame - last > static_cast<std::size_t>(options_.longest_absence)) continue;
      const SeenPerson& before = people_[last][tracks[t].entries.rbegin()->second];
      for (std::size_t p = 0; p < people_[frame].size(); ++p) {
        const double step = StepBetween(before, people_[frame][p], options_.least_confidence);
        if (step < options_.longest_step) all.emplace_back(step, t, p);
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

}  // namespace

std::vector<PersonTrack> FollowPeople(const SeenPeople& people, const FollowOptions& options) {
  return Follower(people, options).Follow();
}

}  // namespace etude
