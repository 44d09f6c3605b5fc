#include "engine/keypoints/guess_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <optional>
#include <utility>

#include "engine/base/order_statistics.h"
#include "engine/cameras/triangulation.h"
#include "engine/keypoints/mend_people.h"
#include "engine/keypoints/recover_person.h"

namespace etude {
namespace {

/// A hypothesis: how a picture was rotated and mirrored, and whether its keypoints are in the rig's own pixels.
struct Guess {
  int quarter_turns = 0;
  bool is_mirrored = false;
  bool is_stored = false;

  bool IsAsSaid() const { return quarter_turns == 0 && !is_mirrored; }
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
      : films_(films), least_confidence_(min_confidence), geometry_(films.size()), guesses_(films.size()) {
    // Sample at most forty frames.
    std::size_t frames = films.empty() ? 0 : films.front().people.size();
    for (const PictureOfFilm& film : films) frames = std::min(frames, film.people.size());
    constexpr std::size_t kMaxFrames = 40;
    const std::size_t stride = std::max<std::size_t>(1, frames / kMaxFrames);
    for (std::size_t frame = 0; frame < frames; frame += stride) sampled_.push_back(frame);
    // Compute the epipolar geometry of every pair of cameras.
    for (std::size_t a = 0; a < films.size(); ++a) {
      for (std::size_t b = 0; b < films.size(); ++b) {
        geometry_[a].push_back(a == b ? std::nullopt
                                      : EpipolarGeometry::Of(MatrixOf(films[a].camera), MatrixOf(films[b].camera)));
      }
    }
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

  /// Returns the mean distance over all pairs of films if `guess` holds for all of them.
  double MissOfAll(const Guess& guess) {
    double total = 0;
    for (std::size_t a = 0; a < films_.size(); ++a) {
      for (std::size_t b = a + 1; b < films_.size(); ++b) total += Miss(a, guess, b, guess);
    }
    return total / static_cast<double>(films_.size() * (films_.size() - 1) / 2);
  }

 private:
  /// Returns the people of the sampled frames in the rig's pixels, undistorted.
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

  // Returns the median epipolar distance of two people as a share of the height; nullopt if they share too few
  // keypoints.
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

  /// Returns the median, over frames and people, of the smallest distance to any person and labelling in the other
  /// film.
  double Miss(std::size_t a, const Guess& guess_a, std::size_t b, const Guess& guess_b) {
    const auto key = std::tuple(a, guess_a, b, guess_b);
    if (const auto known = misses_.find(key); known != misses_.end()) return known->second;
    constexpr double kNothing = 1;
    std::vector<double> misses;
    if (geometry_[a][b]) {
      const SeenPeople &one = PeopleBy(a, guess_a), &other = PeopleBy(b, guess_b);
      for (std::size_t i = 0; i < sampled_.size(); ++i) {
        for (const SeenPerson& p : one[i]) {
          std::optional<double> least;
          for (const SeenPerson& q : other[i]) {
            for (const bool is_swapped : {false, true}) {
              const auto miss = MisfitOf(*geometry_[a][b], is_swapped ? WithSidesSwapped(p) : p, q);
              if (miss && (!least || *miss < *least)) least = miss;
            }
          }
          if (least) misses.push_back(*least);
        }
      }
    }
    return misses_[key] = misses.empty() ? kNothing : UpperMedian(std::move(misses));
  }

  // Returns the median distance of one film to all others under a hypothesis.
  double MissOf(std::size_t c, const Guess& guess) {
    std::vector<double> misses;
    for (std::size_t o = 0; o < films_.size(); ++o) {
      if (o != c) misses.push_back(c < o ? Miss(c, guess, o, guesses_[o]) : Miss(o, guesses_[o], c, guess));
    }
    return misses.empty() ? 0 : LowerPercentile(misses, 0.5);
  }

  // Interprets the keypoints of all films as pixels of the rig's pictures, without the films' fit to the rig, if the
  // rays then miss each other by less.
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
          "keypoints read as pixels of the rig's pictures, not of the fitted film: rays miss by {:.2f} % of the height "
          "instead of {:.2f} %",
          kPercent * stored, kPercent * said);
    }
  }

  // Corrects the film with the largest gain; returns false if there is none.
  bool TurnWorst() {
    constexpr double kOff = 0.003, kBetter = 0.5, kNearly = 1.5, kPercent = 100;
    struct Change {
      double after = 1, before = 1;
      std::size_t camera = 0;
      Guess guess;
    };
    // Find the two best hypotheses over all films.
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
          // Among nearly equal hypotheses the first, with the smallest change, is preferred.
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
    // Apply the best one and explain it.
    guesses_[best->camera] = best->guess;
    const auto words = [](const Guess& guess) {
      std::string text = guess.is_mirrored ? "mirrored" : "";
      if (guess.quarter_turns != 0) {
        text += fmt::format("{}turned by {}° clockwise", text.empty() ? "" : " and ", 90 * guess.quarter_turns);
      }
      return text;
    };
    told_[best->camera] += fmt::format("{}pictures {}: rays miss by {:.2f} % of the height instead of {:.2f} %",
                                       told_[best->camera].empty() ? "" : "; ", words(best->guess),
                                       kPercent * best->after, kPercent * best->before);
    if (second && second->after < kNearly * best->after + 0.001) {
      told_[best->camera] +=
          fmt::format(" (or film {} {}: {:.2f} %)", second->camera + 1, words(second->guess), kPercent * second->after);
    }
    return true;
  }

  std::span<const PictureOfFilm> films_;
  double least_confidence_;
  std::vector<std::vector<std::optional<EpipolarGeometry>>> geometry_;
  std::vector<std::size_t> sampled_;
  std::vector<Guess> guesses_;
  std::vector<std::string> told_;
  std::map<std::pair<std::size_t, Guess>, SeenPeople> people_;
  std::map<std::tuple<std::size_t, Guess, std::size_t, Guess>, double> misses_;
};

}  // namespace

double MissOfPictures(std::span<const PictureOfFilm> films, double min_confidence) {
  return Guesser(films, min_confidence).MissOfAll({});
}

std::vector<PictureGuess> GuessPictures(std::span<const PictureOfFilm> films, double min_confidence) {
  return Guesser(films, min_confidence).Run();
}

namespace {

using Films = std::vector<PictureOfFilm>;

constexpr std::size_t kMaxFilms = 8;  // with more films, exchanges are not tried

/// A map from a file's pixel to a pixel of the film, whose size is given.
struct Reading {
  std::string_view told;
  glm::dvec2 (*pixel)(const glm::dvec2& p, const glm::dvec2& size);
};

/// Converts a pixel whose coordinates were interpreted relative to the picture but are relative to a square around it.
/// `padded` is the share of the square's padding that comes before the picture.
glm::dvec2 OfSquare(const glm::dvec2& p, const glm::dvec2& size, double padded) {
  const double side = std::max(size.x, size.y);
  return p * side / size - padded * (side - size);
}

constexpr std::array kReadings = {
    Reading{"keypoints count v from the picture's bottom",
            [](const glm::dvec2& p, const glm::dvec2& size) { return glm::dvec2(p.x, size.y - p.y); }},
    Reading{"keypoints have x and y exchanged",
            [](const glm::dvec2& p, const glm::dvec2&) { return glm::dvec2(p.y, p.x); }},
    Reading{"keypoints of all films are mirrored",
            [](const glm::dvec2& p, const glm::dvec2& size) { return glm::dvec2(size.x - p.x, p.y); }},
    Reading{"keypoints are shares of a square about the picture",
            [](const glm::dvec2& p, const glm::dvec2& size) { return OfSquare(p, size, 0.5); }},
    Reading{"keypoints are shares of the picture's longer side",
            [](const glm::dvec2& p, const glm::dvec2& size) { return OfSquare(p, size, 0); }}};

/// Reinterprets the pose that the rig's file gives for a camera: p_C = R_CF p_F + t.
Camera WithPose(Camera camera, const glm::dmat3& R_WF, bool is_inverse, bool is_opengl) {
  glm::dmat3 R_CF = camera.R_CW * R_WF;
  glm::dvec3 t = -(camera.R_CW * camera.p_WC);
  if (is_inverse) {
    R_CF = glm::transpose(R_CF);
    t = -(R_CF * t);
  }
  if (is_opengl) {
    const glm::dmat3 turn(1, 0, 0, 0, -1, 0, 0, 0, -1);
    R_CF = turn * R_CF;
    t = turn * t;
  }
  camera.R_CW = R_CF * glm::transpose(R_WF);
  camera.p_WC = -(glm::transpose(camera.R_CW) * t);
  return camera;
}

bool AreAlike(const PictureOfFilm& a, const PictureOfFilm& b) {
  const Intrinsics &p = a.camera.intrinsics, &q = b.camera.intrinsics;
  return p.width == q.width && p.height == q.height && a.fit == b.fit && a.film_px == b.film_px;
}

class SessionGuesser {
 public:
  SessionGuesser(std::span<const PictureOfFilm> films, std::span<const std::string> names, const glm::dmat3& R_WF,
                 double min_confidence)
      : films_(films.begin(), films.end()), names_(names), R_WF_(R_WF), least_confidence_(min_confidence) {}

  SessionGuess Run() {
    SessionGuess found;
    const double said = MissOfPictures(films_, least_confidence_);
    constexpr double kOff = 0.001, kBetter = 0.5, kPercent = 100;
    // Test all hypotheses and keep the best one that halves the distance.
    if (said > kOff) {
      least_ = kBetter * std::min(said, MissAsGuessed());
      TryPoses();
      TryExchanges();
      TryReadings();
      if (best_ && least_ < kMaxPlausibleMiss) {
        found.mended = fmt::format("{}: rays miss by {:.2f} % of the height instead of {:.2f} %", told_,
                                   kPercent * least_, kPercent * said);
        films_ = std::move(*best_);
      }
    }
    for (PictureOfFilm& film : films_) {
      found.cameras.push_back(film.camera);
      found.people.push_back(std::move(film.people));
    }
    return found;
  }

 private:
  /// Returns the distance that remains if each film's pictures are corrected by `GuessPictures` alone.
  double MissAsGuessed() const {
    Films guessed = films_;
    const std::vector<PictureGuess> guesses = GuessPictures(films_, least_confidence_);
    for (std::size_t i = 0; i < guessed.size(); ++i) guessed[i].fit = guesses[i].fit;
    return MissOfPictures(guessed, least_confidence_);
  }

  // Keeps these films as the best hypothesis if they reduce the distance.
  void Try(Films films, std::string told) {
    const double miss = MissOfPictures(films, least_confidence_);
    if (!(miss < least_)) return;
    least_ = miss;
    best_ = std::move(films);
    told_ = std::move(told);
  }

  void TryPoses() {
    for (const auto& [is_inverse, is_opengl, told] :
         {std::tuple(true, false, "the rig's poses transform from its cameras to the world"),
          {false, true, "the rig's cameras look along -z, y up"},
          {true, true,
           "the rig's poses transform from its cameras to the world, and the cameras look along -z, y up"}}) {
      Films films = films_;
      for (PictureOfFilm& film : films) film.camera = WithPose(film.camera, R_WF_, is_inverse, is_opengl);
      Try(std::move(films), told);
    }
  }

  void TryExchanges() {
    if (films_.size() > kMaxFilms) return;
    for (std::size_t a = 0; a < films_.size(); ++a) {
      for (std::size_t b = a + 1; b < films_.size(); ++b) {
        if (!AreAlike(films_[a], films_[b])) continue;
        Films films = films_;
        std::swap(films[a].camera, films[b].camera);
        Try(std::move(films), fmt::format("films or keypoints of {} and {} are exchanged", names_[a], names_[b]));
      }
    }
  }

  void TryReadings() {
    for (const Reading& reading : kReadings) {
      TryPixels(std::string(reading.told),
                [&](const PictureOfFilm& film, const glm::dvec2& pixel) { return reading.pixel(pixel, film.film_px); });
    }
    for (const double scale : {0.25, 1.0 / 3, 0.375, 0.5, 2.0 / 3, 0.75, 4.0 / 3, 1.5, 2.0, 8.0 / 3, 3.0, 4.0}) {
      const auto told = fmt::format("keypoints are of pictures {:.4g} times as large", 1 / scale);
      TryPixels(told, [&](const PictureOfFilm&, const glm::dvec2& pixel) { return scale * pixel; });
    }
  }

  void TryPixels(std::string told, const std::function<glm::dvec2(const PictureOfFilm&, const glm::dvec2&)>& read) {
    Films films = films_;
    for (PictureOfFilm& film : films) {
      for (auto& frame : film.people) {
        for (SeenPerson& person : frame) {
          for (Keypoint& keypoint : person.keypoints) keypoint.pixel = read(film, keypoint.pixel);
        }
      }
    }
    Try(std::move(films), std::move(told));
  }

  Films films_;
  std::span<const std::string> names_;
  const glm::dmat3& R_WF_;
  double least_confidence_;
  double least_ = 0;
  std::optional<Films> best_;
  std::string told_;
};

}  // namespace

SessionGuess GuessSession(std::span<const PictureOfFilm> films, std::span<const std::string> names,
                          const glm::dmat3& R_WF, double min_confidence) {
  return SessionGuesser(films, names, R_WF, min_confidence).Run();
}

}  // namespace etude
