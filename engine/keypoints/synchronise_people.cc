#include "engine/keypoints/synchronise_people.h"

#include <algorithm>
#include <array>

#include "engine/cameras/triangulation.h"

namespace etude {
namespace {

/// A person of one camera at any time.
class MovingPerson {
 public:
  MovingPerson(const SeenPeople& people, const PersonTrack& track) : people_(people), track_(track) {}

  const PersonTrack& track() const { return track_; }

  /// Returns the person between frames; nothing where a frame next to that time does not show it.
  std::optional<SeenPerson> At(double frame) const {
    if (frame < 0) return std::nullopt;
    const auto at = static_cast<std::size_t>(frame);
    const double share = frame - static_cast<double>(at);
    const SeenPerson *a = at > 0 ? In(at - 1) : nullptr, *b = In(at), *c = In(at + 1), *d = In(at + 2);
    if (b == nullptr || (share > 0 && c == nullptr)) return std::nullopt;
    if (share == 0) return *b;
    SeenPerson between;
    for (std::size_t i = 0; i < kLandmarkCount; ++i) {
      const auto pixel = PixelBetween(PixelOf(a, i), PixelOf(b, i), PixelOf(c, i), PixelOf(d, i), share);
      if (pixel) between.keypoints[i] = {*pixel, std::min(b->keypoints[i].confidence, c->keypoints[i].confidence)};
    }
    return between;
  }

 private:
  const SeenPerson* In(std::size_t frame) const {
    const auto entry = track_.entries.find(frame);
    return entry == track_.entries.end() ? nullptr : &people_[frame][entry->second];
  }

  static SomePixel PixelOf(const SeenPerson* person, std::size_t landmark) {
    if (person == nullptr || !(person->keypoints[landmark].confidence > 0)) return std::nullopt;
    return person->keypoints[landmark].pixel;
  }

  const SeenPeople& people_;
  const PersonTrack& track_;
};

/// People of one camera, whose clock is known or asked.
struct Witness {
  std::vector<MovingPerson> people;
  ClockOffset offset;
};

struct Misfit {
  double squares = 0;   ///< of all distances
  double variance = 0;  ///< the same about the mean of each landmark's, summed up
  int count = 0;

  double mean() const { return squares / count; }
};

/// Computes the misfit of two people, in every so many frames of the first camera's time.
Misfit MisfitOf(const EpipolarGeometry& geometry, const MovingPerson& one, double one_offset, const MovingPerson& other,
                double other_offset, std::size_t frames, const PeopleSyncOptions& options) {
  constexpr std::size_t kMostFrames = 100;  // a longer film says it no better
  const std::size_t stride = std::max<std::size_t>(1, frames / kMostFrames);
  std::array<double, kLandmarkCount> sums{}, squares{};
  std::array<int, kLandmarkCount> counts{};
  for (std::size_t frame = 0; frame < frames; frame += stride) {
    const auto time = static_cast<double>(frame);
    const auto here = one.At(time - one_offset), there = other.At(time - other_offset);
    if (!here || !there) continue;
    for (std::size_t i = 0; i < kLandmarkCount; ++i) {
      const Keypoint &a = here->keypoints[i], &b = there->keypoints[i];
      if (std::min(a.confidence, b.confidence) < options.follow.least_confidence) continue;
      const double most = options.clocks.most_px;
      const double px = std::clamp(geometry.DistancePx(a.pixel, b.pixel), -most, most);
      sums[i] += px;
      squares[i] += px * px;
      ++counts[i];
    }
  }
  Misfit misfit;
  for (std::size_t i = 0; i < kLandmarkCount; ++i) {
    if (counts[i] == 0) continue;
    misfit.squares += squares[i];
    misfit.variance += squares[i] - sums[i] * sums[i] / counts[i];
    misfit.count += counts[i];
  }
  return misfit;
}

/// Everybody of one camera against whoever fits best of another's.
void AddMisfit(const EpipolarGeometry& geometry, const Witness& one, const Witness& other, double offset,
               std::size_t frames, const PeopleSyncOptions& options, Misfit& all) {
  constexpr int kFewest = 30;
  for (const MovingPerson& person : one.people) {
    Misfit best;
    for (const MovingPerson& somebody : other.people) {
      const Misfit pair = MisfitOf(geometry, person, one.offset.frames, somebody, offset, frames, options);
      if (pair.count >= kFewest && (best.count == 0 || pair.mean() < best.mean())) best = pair;
    }
    all.variance += best.variance;
    all.count += best.count;
  }
}

}  // namespace

std::vector<ClockOffset> EstimateOffsets(std::span<const ProjectionMatrix> cameras, std::span<const SeenPeople> people,
                                         const PeopleSyncOptions& options) {
  std::vector<std::vector<PersonTrack>> tracks;
  std::vector<Witness> witnesses;
  for (const SeenPeople& of_camera : people) tracks.push_back(FollowPeople(of_camera, options.follow));
  for (std::size_t camera = 0; camera < people.size(); ++camera) {
    Witness& witness = witnesses.emplace_back();
    for (const PersonTrack& track : tracks[camera]) witness.people.emplace_back(people[camera], track);
  }
  witnesses.front().offset.is_told = true;
  constexpr int kRounds = 2;
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t camera = 1; camera < cameras.size(); ++camera) {
      const auto misfit_at = [&](int offset) -> std::optional<double> {
        Misfit all;
        for (std::size_t other = 0; other < (round == 0 ? camera : cameras.size()); ++other) {
          const auto geometry = EpipolarGeometry::Of(cameras[other], cameras[camera]);
          if (other == camera || !geometry) continue;
          AddMisfit(*geometry, witnesses[other], witnesses[camera], offset, people[0].size(), options, all);
        }
        return all.count > 0 ? std::optional(all.variance / all.count) : std::nullopt;
      };
      witnesses[camera].offset = FindOffset(misfit_at, options.clocks.most_frames);
    }
  }
  std::vector<ClockOffset> offsets;
  for (const Witness& witness : witnesses) offsets.push_back(witness.offset);
  return offsets;
}

SeenPeople PeopleInTime(const SeenPeople& people, double offset, std::size_t frames, const FollowOptions& options) {
  if (offset == 0 && people.size() == frames) return people;
  SeenPeople in_time(frames);
  for (const PersonTrack& track : FollowPeople(people, options)) {
    const MovingPerson person(people, track);
    for (std::size_t frame = 0; frame < frames; ++frame) {
      if (const auto there = person.At(static_cast<double>(frame) - offset)) in_time[frame].push_back(*there);
    }
  }
  return in_time;
}

}  // namespace etude
