#include <algorithm>

#include "engine/cameras/triangulation.h"
#include "engine/keypoints/moving_person.h"
#include "engine/keypoints/plane_search.h"
#include "engine/keypoints/synchronise_people.h"

namespace etude {
namespace {

/// The people of one camera, and its clock.
struct ClockedFilm {
  std::vector<MovingPerson> people;
  FilmClock clock;
};

class ClockFinder {
 public:
  ClockFinder(std::span<const ProjectionMatrix> cameras, std::vector<ClockedFilm> films, std::size_t frames,
              double min_confidence)
      : films_(std::move(films)), geometry_(cameras), frames_(frames), least_confidence_(min_confidence) {}

  std::vector<FoundClock> Find(int max_frames) {
    std::vector<FoundClock> found(films_.size());
    for (std::size_t c = 0; c < films_.size(); ++c) found[c].clock = found[c].nearest = films_[c].clock;
    constexpr int kRounds = 2;
    constexpr double kHalf = 0.5;
    for (int round = 0; round < kRounds; ++round) {
      for (std::size_t c = 1; c < films_.size(); ++c) {
        // In the first pass, compare the film only with the films before it, whose clocks are already found.
        const std::size_t others = round == 0 ? c : films_.size();
        const FilmClock given = films_[c].clock;
        const auto before = LossOf(c, given, others);
        if (!before) continue;
        const auto [clock, after] = Search(c, given, *before, round == 0 ? max_frames : 0, others);
        found[c].nearest = clock;
        if (!(after < kHalf * *before) || after == *before) continue;
        films_[c].clock = found[c].clock = clock;
        if (!found[c].is_mended) found[c].before = *before;
        found[c].after = after;
        found[c].is_mended = true;
      }
    }
    return found;
  }

 private:
  /// Returns the mean loss over keypoints: each person is compared with the best-fitting person in each of the first
  /// `others` cameras. Returns nullopt if there are too few pairs of keypoints.
  std::optional<double> LossOf(std::size_t c, const FilmClock& clock, std::size_t others) const {
    constexpr std::size_t kMaxFrames = 60;
    const std::size_t stride = std::max<std::size_t>(1, frames_ / kMaxFrames);
    double sum = 0;
    std::size_t count = 0;
    // Sum the losses over fewer than 120 frames, the other cameras, and the people.
    for (std::size_t frame = 0; frame < frames_; frame += stride) {
      const auto time = static_cast<double>(frame);
      const std::vector<SeenPerson> here = PeopleAt(films_[c], clock, time);
      for (std::size_t o = 0; !here.empty() && o < others; ++o) {
        if (o == c || !geometry_(o, c)) continue;
        const std::vector<SeenPerson> there = PeopleAt(films_[o], films_[o].clock, time);
        for (const SeenPerson& person : here) {
          // Compare with the person in the other camera who has the lowest mean loss.
          std::pair<double, std::size_t> best{0, 0};
          for (const SeenPerson& somebody : there) {
            const auto pair = PairLoss(*geometry_(o, c), somebody, person);
            if (pair.second > 0 && (best.second == 0 || pair.first * static_cast<double>(best.second) <
                                                            best.first * static_cast<double>(pair.second))) {
              best = pair;
            }
          }
          sum += best.first;
          count += best.second;
        }
      }
    }
    constexpr std::size_t kMinCount = 60;
    return count < kMinCount ? std::nullopt : std::optional(sum / static_cast<double>(count));
  }

  static std::vector<SeenPerson> PeopleAt(const ClockedFilm& film, const FilmClock& clock, double time) {
    std::vector<SeenPerson> people;
    for (const MovingPerson& person : film.people) {
      if (auto at = person.At(clock.FrameAt(time))) people.push_back(std::move(*at));
    }
    return people;
  }

  std::pair<double, std::size_t> PairLoss(const EpipolarGeometry& geometry, const SeenPerson& a,
                                          const SeenPerson& b) const {
    constexpr double kMinPx = 1.5, kShare = 0.01;
    const double scale = std::max(kMinPx, kShare * HeightPx(b));
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < kLandmarkCount; ++i) {
      const Keypoint &p = a.keypoints[i], &q = b.keypoints[i];
      if (std::min(p.confidence, q.confidence) < least_confidence_) continue;
      const double px = geometry.DistancePx(p.pixel, q.pixel);
      sum += px * px / (px * px + scale * scale);
      ++count;
    }
    return {sum, count};
  }

  std::pair<FilmClock, double> Search(std::size_t c, const FilmClock& given, double before, int max_frames,
                                      std::size_t others) const {
    const double middle = 0.5 * static_cast<double>(frames_);
    const auto moved = [&](double shift, double stretch) {  // `stretch`: drift over half of the film, frames
      const double drift = stretch / std::max(1.0, middle);
      return FilmClock{given.offset + shift - stretch, given.drift + drift};
    };
    PlaneSearch least([&](double shift, double stretch) { return LossOf(c, moved(shift, stretch), others); }, before);
    // Grid search: offsets first, then drifts near the best offset.
    for (int s = -max_frames; s <= max_frames; ++s) least.Try(s, 0);
    const double coarse = least.x();
    constexpr double kMaxStretch = 3;
    for (double t = -kMaxStretch; max_frames > 0 && t <= kMaxStretch; t += 1) {
      for (double s = -2; s <= 2; s += 1) least.Try(coarse + s, t);
    }
    least.Refine();
    return {moved(least.x(), least.y()), least.loss()};
  }

  std::vector<ClockedFilm> films_;
  PairGeometry geometry_;
  std::size_t frames_;
  double least_confidence_;
};

}  // namespace

std::vector<FoundClock> FindClocks(std::span<const ProjectionMatrix> cameras, std::span<const SeenPeople> people,
                                   std::span<const FilmClock> given, int max_frames, const FollowOptions& options) {
  std::vector<std::vector<PersonTrack>> tracks;
  for (const SeenPeople& of_camera : people) tracks.push_back(FollowPeople(of_camera, options));
  std::vector<ClockedFilm> films(people.size());
  for (std::size_t c = 0; c < people.size(); ++c) {
    films[c].clock = given[c];
    for (const PersonTrack& track : tracks[c]) films[c].people.emplace_back(people[c], track);
  }
  const std::size_t frames = people.empty() ? 0 : people.front().size();
  return ClockFinder(cameras, std::move(films), frames, options.min_confidence).Find(max_frames);
}

}  // namespace etude
