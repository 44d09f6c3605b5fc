#include "engine/keypoints/synchronise_people.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>

#include "engine/cameras/triangulation.h"
#include "engine/keypoints/moving_person.h"

namespace etude {
namespace {

/// The frames [begin, end) of the first camera's time.
struct FrameSpan {
  std::size_t begin = 0, end = 0;
};

struct Misfit {
  double squares = 0;   ///< sum of the squared distances (EpipolarGeometry::DistancePx, clamped), pixels²
  double variance = 0;  ///< sum of squared deviations of the distances from each landmark's mean, pixels²
  int count = 0;

  double mean() const { return squares / count; }
};

/// Computes the misfit of two people over fewer than 200 frames, evenly spaced in the first camera's time.
Misfit MisfitOf(const EpipolarGeometry& geometry, const MovingPerson& one, double one_offset, const MovingPerson& other,
                double other_offset, FrameSpan frames, const PeopleSyncOptions& options) {
  constexpr std::size_t kMaxFrames = 100;  // with twice as many frames or more, frames are skipped
  const std::size_t stride = std::max<std::size_t>(1, (frames.end - frames.begin) / kMaxFrames);
  std::array<double, kLandmarkCount> sums{}, squares{};
  std::array<int, kLandmarkCount> counts{};
  for (std::size_t frame = frames.begin; frame < frames.end; frame += stride) {
    const auto time = static_cast<double>(frame);
    const auto here = one.At(time - one_offset), there = other.At(time - other_offset);
    if (!here || !there) continue;
    for (std::size_t i = 0; i < kLandmarkCount; ++i) {
      const Keypoint &a = here->keypoints[i], &b = there->keypoints[i];
      if (std::min(a.confidence, b.confidence) < options.follow.min_confidence) continue;
      const double most = options.clocks.max_px;
      const double px = std::clamp(geometry.DistancePx(a.pixel, b.pixel), -most, most);
      sums[i] += px;
      squares[i] += px * px;
      ++counts[i];
    }
  }
  // Sum over the landmarks. The variance ignores a constant offset of a landmark, because such an offset does not show
  // that the clocks differ.
  Misfit misfit;
  for (std::size_t i = 0; i < kLandmarkCount; ++i) {
    if (counts[i] == 0) continue;
    misfit.squares += squares[i];
    misfit.variance += squares[i] - sums[i] * sums[i] / counts[i];
    misfit.count += counts[i];
  }
  return misfit;
}

/// The films of a rig, their tracked people, and the offsets of their clocks that are known so far.
class OffsetFinder {
 public:
  using Films = std::vector<std::size_t>;

  OffsetFinder(std::span<const ProjectionMatrix> cameras, std::span<const SeenPeople> people,
               const PeopleSyncOptions& options)
      : options_(options), geometry_(cameras), offsets_(people.size()) {
    for (const SeenPeople& of_camera : people) tracks_.push_back(FollowPeople(of_camera, options.follow));
    for (std::size_t film = 0; film < people.size(); ++film) {
      auto& of_film = people_.emplace_back();
      for (const PersonTrack& track : tracks_[film]) of_film.emplace_back(people[film], track);
      all_.end = std::max(all_.end, people[film].size());
    }
  }

  /// Returns the offset of a film, in frames of the first camera, at which it fits the films `others` best. Searches
  /// max_frames around `from`; the misfits at whole frames, and thus around whole `from`, are the exact ones
  /// (FindOffset).
  ClockOffset OffsetAgainst(std::size_t film, const Films& others, double from, FrameSpan frames) const {
    const auto misfit_at = [&](int offset) { return MisfitAt(film, from + offset, others, frames); };
    ClockOffset found = FindOffset(misfit_at, options_.clocks.max_frames);
    found.frames += from;
    return found;
  }

  /// Compares each person of each film in `others` with the best-fitting person of `film`, whose offset is `offset`.
  /// Returns the mean misfit, squared pixels; nullopt if there are too few pairs of keypoints.
  std::optional<double> MisfitAt(std::size_t film, double offset, const Films& others, FrameSpan frames) const {
    constexpr int kMinCount = 30;
    Misfit all;
    for (const std::size_t other : others) {
      const auto& geometry = geometry_(other, film);
      for (const MovingPerson& person : people_[other]) {
        Misfit best;
        for (const MovingPerson& somebody : people_[film]) {
          if (!geometry) break;
          const Misfit pair = MisfitOf(*geometry, person, At(other), somebody, offset, frames, options_);
          if (pair.count >= kMinCount && (best.count == 0 || pair.mean() < best.mean())) best = pair;
        }
        all.variance += best.variance;
        all.count += best.count;
      }
    }
    return all.count > 0 ? std::optional(all.variance / all.count) : std::nullopt;
  }

  /// Returns the offsets of all films. The films that agree with each other determine them: the two films that show
  /// their offset most clearly come first, then one film at a time, while the keypoints show its offset against all
  /// films before it. So a film whose clock is out of range does not change the offsets of the other films.
  std::vector<ClockOffset> Find() {
    MeasurePairs();
    Films agreeing = JoinFilms();
    // Estimate each offset once more, against all films that agree.
    for (std::size_t i = 1; i < agreeing.size(); ++i) {
      const ClockOffset again =
          OffsetAgainst(agreeing[i], Without(agreeing, agreeing[i]), std::round(At(agreeing[i])), all_);
      if (again.is_told) offsets_[agreeing[i]] = again;
    }
    if (!agreeing.empty()) offsets_[agreeing.front()].misfit = offsets_[agreeing[1]].misfit;
    // The first film's offset is 0 by definition; if it does not agree, the first agreeing film's is.
    std::ranges::sort(agreeing);
    const double first = agreeing.empty() ? 0 : At(agreeing.front());
    for (const std::size_t film : agreeing) offsets_[film].frames -= first;
    for (std::size_t film = 0; film < offsets_.size() && !agreeing.empty(); ++film) {
      if (offsets_[film].is_told) continue;
      offsets_[film] = OffsetAgainst(film, agreeing, 0, all_);
      offsets_[film].is_told = false;
      offsets_[film].frames = 0;
    }
    return offsets_;
  }

 private:
  double At(std::size_t film) const { return offsets_[film].frames; }

  static Films Without(const Films& films, std::size_t left_out) {
    Films others = films;
    std::erase(others, left_out);
    return others;
  }

  const ClockOffset& Pair(std::size_t one, std::size_t other) const { return pairs_[one * offsets_.size() + other]; }

  /// Finds the offset of each film against each other film alone.
  void MeasurePairs() {
    const std::size_t count = offsets_.size();
    pairs_.resize(count * count);
    for (std::size_t one = 0; one < count; ++one) {
      for (std::size_t other = one + 1; other < count; ++other) {
        const ClockOffset found = OffsetAgainst(other, {one}, 0, all_);
        pairs_[one * count + other] = pairs_[other * count + one] = found;
        pairs_[other * count + one].frames *= -1;
      }
    }
  }

  /// Returns the film outside of `joined` that shows its offset against one of the joined films most clearly, and this
  /// joined film. Without joined films, returns the clearest pair. Films in `refused` are left out.
  std::optional<std::pair<std::size_t, std::size_t>> Clearest(const Films& joined, const Films& refused) const {
    const auto is_in = [](const Films& films, std::size_t film) { return std::ranges::count(films, film) > 0; };
    std::optional<std::pair<std::size_t, std::size_t>> best;
    for (std::size_t film = 0; film < offsets_.size(); ++film) {
      if (is_in(joined, film) || is_in(refused, film)) continue;
      for (std::size_t other = 0; other < offsets_.size(); ++other) {
        const bool is_allowed = joined.empty() ? other < film : is_in(joined, other);
        if (!is_allowed || !Pair(other, film).is_told) continue;
        if (!best || Pair(other, film).explained > Pair(best->second, best->first).explained) best = {film, other};
      }
    }
    return best;
  }

  /// Sets the offsets of the films that agree, relative to the first of the returned films.
  Films JoinFilms() {
    Films joined, refused;
    while (const auto next = Clearest(joined, refused)) {
      const auto [film, other] = *next;
      if (joined.empty()) {
        joined.push_back(other);
        offsets_[other].is_told = true;
      }
      const ClockOffset found = OffsetAgainst(film, joined, std::round(At(other) + Pair(other, film).frames), all_);
      if (!found.is_told || !AgreesWithMost(film, found.frames, joined)) {
        refused.push_back(film);
        continue;
      }
      offsets_[film] = found;
      joined.push_back(film);
    }
    return joined.size() > 1 ? joined : Films{};
  }

  /// Returns true if the film's offset against most of the joined films, each alone, is the offset against all of them.
  bool AgreesWithMost(std::size_t film, double offset, const Films& joined) const {
    constexpr double kMaxApart = 2;  // frames; more than the error of one pair
    int told = 0, agree = 0;
    for (const std::size_t other : joined) {
      const ClockOffset& pair = Pair(other, film);
      if (!pair.is_told) continue;
      ++told;
      if (std::abs(At(other) + pair.frames - offset) <= kMaxApart) ++agree;
    }
    return 2 * agree > told;
  }

  PeopleSyncOptions options_;
  PairGeometry geometry_;
  std::vector<std::vector<PersonTrack>> tracks_;
  std::vector<std::vector<MovingPerson>> people_;
  FrameSpan all_;
  std::vector<ClockOffset> offsets_, pairs_;
};

/// Returns the drift of a film against other films; nullopt if the keypoints show none.
std::optional<ClockDrift> DriftOf(const OffsetFinder& finder, std::size_t film, const OffsetFinder::Films& others,
                                  std::size_t frames) {
  const ClockOffset whole = finder.OffsetAgainst(film, others, 0, {0, frames});
  // Estimate the offset in each quarter of the film. A drift changes it from quarter to quarter in one direction. All
  // misfits are taken at the same fraction of a frame, so that interpolation reduces their noise alike.
  constexpr std::size_t kParts = 4;
  std::array<double, kParts> offsets{};
  double constant = 0, changing = 0;  // mean misfits of the quarters, squared pixels
  for (std::size_t part = 0; part < kParts; ++part) {
    const FrameSpan span{part * frames / kParts, (part + 1) * frames / kParts};
    const auto unchanged = finder.MisfitAt(film, whole.frames, others, span);
    const ClockOffset found = finder.OffsetAgainst(film, others, whole.frames, span);
    if (!unchanged || !found.is_told) return std::nullopt;
    offsets[part] = found.frames;
    constant += *unchanged / kParts;
    changing += found.misfit / kParts;
  }
  const ClockDrift drift{film, 0.5 * (offsets[2] + offsets[3] - offsets[0] - offsets[1]), std::sqrt(constant),
                         std::sqrt(changing)};
  constexpr double kMinFrames = 0.5, kMaxMisfit = 0.9;
  const bool is_steady = std::ranges::is_sorted(offsets) || std::ranges::is_sorted(offsets, std::greater());
  if (!is_steady || std::abs(drift.frames) < kMinFrames || changing > kMaxMisfit * constant) return std::nullopt;
  return drift;
}

}  // namespace

std::vector<ClockOffset> EstimateOffsets(std::span<const ProjectionMatrix> cameras, std::span<const SeenPeople> people,
                                         const PeopleSyncOptions& options) {
  return OffsetFinder(cameras, people, options).Find();
}

std::vector<ClockDrift> FindDrifts(std::span<const ProjectionMatrix> cameras, std::span<const SeenPeople> people,
                                   const PeopleSyncOptions& options) {
  std::size_t frames = people.empty() ? 0 : people.front().size();
  for (const SeenPeople& of_camera : people) frames = std::min(frames, of_camera.size());
  // Far from the right offset, the few frames of a quarter may fit by chance.
  PeopleSyncOptions near = options;
  near.clocks.max_frames = std::clamp(static_cast<int>(frames / 16), 1, options.clocks.max_frames);
  const OffsetFinder finder(cameras, people, near);
  std::vector<std::size_t> steady(people.size());
  std::iota(steady.begin(), steady.end(), 0);
  // Find the film that drifts most against all others, leave it out, and search again.
  std::vector<ClockDrift> drifts;
  while (steady.size() > 1) {
    std::optional<ClockDrift> most;
    for (std::size_t i = 0; i < steady.size(); ++i) {
      if (steady.size() == 2 && i == 0) continue;  // of two films, the first one's clock is taken as right
      std::vector<std::size_t> others = steady;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
      const auto drift = DriftOf(finder, steady[i], others, frames);
      if (drift && (!most || std::abs(drift->frames) > std::abs(most->frames))) most = drift;
    }
    if (!most) break;
    drifts.push_back(*most);
    std::erase(steady, most->film);
  }
  return drifts;
}

SeenPeople PeopleInTime(const SeenPeople& people, const FilmClock& clock, std::size_t frames,
                        const FollowOptions& options) {
  if (clock == FilmClock{} && people.size() == frames) return people;
  std::vector<double> at;
  for (std::size_t frame = 0; frame < frames; ++frame) at.push_back(clock.FrameAt(static_cast<double>(frame)));
  return PeopleAt(people, at, options);
}

SeenPeople PeopleAt(const SeenPeople& people, std::span<const double> frames, const FollowOptions& options) {
  SeenPeople in_time(frames.size());
  for (const PersonTrack& track : FollowPeople(people, options)) {
    const MovingPerson person(people, track);
    for (std::size_t i = 0; i < frames.size(); ++i) {
      if (const auto there = person.At(frames[i])) in_time[i].push_back(*there);
    }
  }
  return in_time;
}

SeenPeople PeopleInTime(const SeenPeople& people, double offset, std::size_t frames, const FollowOptions& options) {
  return PeopleInTime(people, FilmClock{offset, 0}, frames, options);
}

}  // namespace etude
