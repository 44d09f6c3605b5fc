#include "engine/keypoints/guess_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "engine/base/order_statistics.h"
#include "engine/cameras/triangulation.h"
#include "engine/keypoints/correct_people.h"
#include "engine/keypoints/recover_person.h"

namespace etude {
namespace {

/// A hypothesis: how a picture was rotated and mirrored, and whether its keypoints are pixels of the camera's original
/// picture instead of the film, which was scaled or cropped (`PixelFit`).
struct Guess {
  int quarter_turns = 0;
  bool is_mirrored = false;
  bool is_stored = false;

  friend auto operator<=>(const Guess&, const Guess&) = default;
};

PixelFit FitOf(const PictureOfFilm& film, const Guess& guess) {
  PixelFit fit = guess.is_stored ? PixelFit{} : film.fit;
  const Intrinsics& in = film.camera.intrinsics;
  const bool was_turned = film.fit.quarter_turns % 2 != 0;
  const glm::dvec2 upright = was_turned ? glm::dvec2(film.film_px.y, film.film_px.x) : film.film_px;
  fit.size = guess.is_stored ? glm::dvec2(in.width, in.height) : upright;
  fit.quarter_turns = (film.fit.quarter_turns + guess.quarter_turns) % 4;
  fit.is_mirrored = film.fit.is_mirrored != guess.is_mirrored;
  if (fit.quarter_turns == 0 && !fit.is_mirrored) fit.size = glm::dvec2(0);
  return fit;
}

class Guesser {
 public:
  Guesser(std::span<const PictureOfFilm> films, double min_confidence)
      : films_(films), least_confidence_(min_confidence), geometry_(MatricesOf(films)), guesses_(films.size()) {
    // Sample fewer than eighty frames, evenly spaced.
    std::size_t frames = films.empty() ? 0 : films.front().people.size();
    for (const PictureOfFilm& film : films) frames = std::min(frames, film.people.size());
    constexpr std::size_t kMaxFrames = 40;
    const std::size_t stride = std::max<std::size_t>(1, frames / kMaxFrames);
    for (std::size_t frame = 0; frame < frames; frame += stride) sampled_.push_back(frame);
  }

  std::vector<PictureGuess> Run() {
    told_.resize(films_.size());
    ChooseStored();
    for (std::size_t round = 0; round < films_.size(); ++round) {
      if (!TurnWorst()) break;
    }
    std::vector<PictureGuess> found;
    for (std::size_t c = 0; c < films_.size(); ++c) {
      found.push_back({guesses_[c] == Guess{} ? films_[c].fit : FitOf(films_[c], guesses_[c]), told_[c]});
    }
    return found;
  }

  /// Returns the mean of Miss over all pairs of films if `guess` holds for every film.
  double MissOfAll(const Guess& guess) {
    double total = 0;
    for (std::size_t a = 0; a < films_.size(); ++a) {
      for (std::size_t b = a + 1; b < films_.size(); ++b) total += Miss(a, guess, b, guess);
    }
    return total / static_cast<double>(films_.size() * (films_.size() - 1) / 2);
  }

 private:
  /// Returns the people of film `c` in the sampled frames, in undistorted pixels of the rig.
  const SeenPeople& PeopleBy(std::size_t c, const Guess& guess) {
    const auto key = std::pair(c, guess);
    if (const auto known = people_.find(key); known != people_.end()) return known->second;
    const PixelFit fit = FitOf(films_[c], guess);
    SeenPeople people;
    for (const std::size_t frame : sampled_) {
      people.push_back(films_[c].people[frame]);
      for (SeenPerson& person : people.back()) {
        for (Keypoint& keypoint : person.keypoints) keypoint.pixel = fit.ToRig(keypoint.pixel);
      }
    }
    return people_[key] = UndistortPeople(films_[c].camera, std::move(people));
  }

  // Returns the median epipolar distance between two detections, as a share of the person's height; nullopt if the
  // detections have too few keypoints in common.
  std::optional<double> MisfitOf(const EpipolarGeometry& geometry, const SeenPerson& one,
                                 const SeenPerson& other) const {
    std::vector<double> distances;
    for (std::size_t i = 0; i < kLandmarkCount; ++i) {
      const Keypoint &p = one.keypoints[i], &q = other.keypoints[i];
      if (p.confidence < least_confidence_ || q.confidence < least_confidence_) continue;
      distances.push_back(std::abs(geometry.DistancePx(p.pixel, q.pixel)));
    }
    constexpr std::size_t kMinCount = 5;
    if (distances.size() < kMinCount) return std::nullopt;
    return UpperMedian(std::move(distances)) / std::max(1.0, std::max(HeightPx(one), HeightPx(other)));
  }

  /// For each frame and person of film `a`, takes the smallest epipolar distance to a person of film `b` with either
  /// labelling of sides; returns the median of these distances.
  double Miss(std::size_t a, const Guess& guess_a, std::size_t b, const Guess& guess_b) {
    const auto key = std::tuple(a, guess_a, b, guess_b);
    if (const auto known = misses_.find(key); known != misses_.end()) return known->second;
    constexpr double kNothing = 1;
    std::vector<double> misses;
    if (geometry_(a, b)) {
      const SeenPeople &one = PeopleBy(a, guess_a), &other = PeopleBy(b, guess_b);
      for (std::size_t i = 0; i < sampled_.size(); ++i) {
        for (const SeenPerson& p : one[i]) {
          std::optional<double> least;
          for (const SeenPerson& q : other[i]) {
            for (const bool is_swapped : {false, true}) {
              const auto miss = MisfitOf(*geometry_(a, b), is_swapped ? WithSidesSwapped(p) : p, q);
              if (miss && (!least || *miss < *least)) least = miss;
            }
          }
          if (least) misses.push_back(*least);
        }
      }
    }
    return misses_[key] = misses.empty() ? kNothing : UpperMedian(std::move(misses));
  }

  // Returns the median of the distances (`Miss`) between film `c`, interpreted as `guess` says, and each other film.
  double MissOf(std::size_t c, const Guess& guess) {
    std::vector<double> misses;
    for (std::size_t o = 0; o < films_.size(); ++o) {
      if (o != c) misses.push_back(c < o ? Miss(c, guess, o, guesses_[o]) : Miss(o, guesses_[o], c, guess));
    }
    return misses.empty() ? 0 : LowerPercentile(misses, 0.5);
  }

  // Interprets the keypoints of all films as pixels of the rig's original pictures if this lowers MissOfAll by more
  // than 3 %. Does nothing if a file states its picture size or if no film was fitted.
  void ChooseStored() {
    bool is_fitted = false;
    for (const PictureOfFilm& film : films_) {
      if (film.is_sized) return;
      is_fitted = is_fitted || !film.fit.IsNone();
    }
    if (!is_fitted) return;
    const double said = MissOfAll({}), stored = MissOfAll({.is_stored = true});
    constexpr double kBetter = 0.97, kPercent = 100;
    if (!(stored < kBetter * said)) return;
    for (std::size_t c = 0; c < films_.size(); ++c) {
      guesses_[c].is_stored = true;
      if (films_[c].fit.IsNone()) continue;
      told_[c] = fmt::format(
          "Etude reads the keypoints as pixels of the rig's pictures instead of the resized film: then rays to the "
          "same keypoint miss each other by {:.2f} % of the person's height instead of {:.2f} %",
          kPercent * stored, kPercent * said);
    }
  }

  // Applies the correction of one film that leaves the smallest MissOf. Returns false if no correction helps enough.
  bool TurnWorst() {
    constexpr double kOff = 0.003, kBetter = 0.5, kNearly = 1.5, kPercent = 100;
    struct Change {
      double after = 1, before = 1;
      std::size_t camera = 0;
      Guess guess;
    };
    // Over all films, find the two corrections that leave the smallest MissOf.
    std::optional<Change> best, second;
    for (std::size_t c = 0; c < films_.size(); ++c) {
      const double before = MissOf(c, guesses_[c]);
      if (before < kOff) continue;
      for (int turns = 0; turns < 4; ++turns) {
        for (const bool is_mirrored : {false, true}) {
          const Guess guess{turns, is_mirrored, guesses_[c].is_stored};
          if (guess == guesses_[c]) continue;
          const Change change{MissOf(c, guess), before, c, guess};
          if (!(change.after < std::min(kMaxPlausibleMiss, kBetter * before))) continue;
          // Among nearly equal hypotheses, prefer the first: an earlier film, fewer quarter turns, no mirroring.
          if (!best || change.after < 0.999 * best->after) {
            second = best;
            best = change;
          } else if (!second || change.after < second->after) {
            second = change;
          }
        }
      }
    }
    if (!best) return false;
    // Apply the best hypothesis, and describe it for the user.
    guesses_[best->camera] = best->guess;
    const auto words = [](const Guess& guess) {
      std::string text = guess.is_mirrored ? "mirrored" : "";
      if (guess.quarter_turns != 0) {
        text += fmt::format("{}turned by {}° clockwise", text.empty() ? "" : " and ", 90 * guess.quarter_turns);
      }
      return text;
    };
    told_[best->camera] += fmt::format(
        "{}pictures {}: rays to the same keypoint miss each other by {:.2f} % of the person's height instead of {:.2f} "
        "%",
        told_[best->camera].empty() ? "" : "; ", words(best->guess), kPercent * best->after, kPercent * best->before);
    if (second && second->after < kNearly * best->after + 0.001) {
      told_[best->camera] +=
          fmt::format(" (or film {} {}: {:.2f} %)", second->camera + 1, words(second->guess), kPercent * second->after);
    }
    return true;
  }

  std::span<const PictureOfFilm> films_;
  double least_confidence_;
  PairGeometry geometry_;
  std::vector<std::size_t> sampled_;
  std::vector<Guess> guesses_;
  std::vector<std::string> told_;
  std::map<std::pair<std::size_t, Guess>, SeenPeople> people_;
  std::map<std::tuple<std::size_t, Guess, std::size_t, Guess>, double> misses_;
};

}  // namespace

std::vector<ProjectionMatrix> MatricesOf(std::span<const PictureOfFilm> films) {
  std::vector<ProjectionMatrix> matrices;
  for (const PictureOfFilm& film : films) matrices.push_back(MatrixOf(film.camera));
  return matrices;
}

PictureOfFilm Turned(PictureOfFilm film, int turns) {
  film.fit = FitOf(film, {.quarter_turns = turns});
  if (turns % 2 != 0) film.film_px = {film.film_px.y, film.film_px.x};
  return film;
}

double EpipolarDistanceOf(std::span<const PictureOfFilm> films, double min_confidence) {
  return Guesser(films, min_confidence).MissOfAll({});
}

std::vector<PictureGuess> GuessPictures(std::span<const PictureOfFilm> films, double min_confidence) {
  return Guesser(films, min_confidence).Run();
}

}  // namespace etude
