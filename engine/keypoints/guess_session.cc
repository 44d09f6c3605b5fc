#include "engine/keypoints/guess_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "engine/cameras/triangulation.h"
#include "engine/keypoints/recover_person.h"

namespace etude {
namespace {

using Films = std::vector<PictureOfFilm>;

constexpr std::size_t kMaxFilms = 8;  // with more films, exchanges of two films are not tried

/// A possible mistake in how keypoints were stored. `told` describes it for users. `pixel` maps a pixel of the file to
/// the correct pixel of a film whose pictures have the size `size`.
struct Reading {
  std::string_view told;
  glm::dvec2 (*pixel)(const glm::dvec2& p, const glm::dvec2& size);
};

/// Corrects a pixel whose coordinates are relative to a square around the picture but were read as relative to the
/// picture. `padded` is the share of the square's padding that comes before the picture.
glm::dvec2 OfSquare(const glm::dvec2& p, const glm::dvec2& size, double padded) {
  const double side = std::max(size.x, size.y);
  return p * side / size - padded * (side - size);
}

constexpr std::array kReadings = {
    Reading{"keypoints have their origin at the bottom of the picture",
            [](const glm::dvec2& p, const glm::dvec2& size) { return glm::dvec2(p.x, size.y - p.y); }},
    Reading{"keypoints have x and y exchanged",
            [](const glm::dvec2& p, const glm::dvec2&) { return glm::dvec2(p.y, p.x); }},
    Reading{"keypoints of all films are mirrored",
            [](const glm::dvec2& p, const glm::dvec2& size) { return glm::dvec2(size.x - p.x, p.y); }},
    Reading{"keypoint coordinates are fractions of the side of a square around the picture",
            [](const glm::dvec2& p, const glm::dvec2& size) { return OfSquare(p, size, 0.5); }},
    Reading{"keypoint coordinates are fractions of the longer side of the picture",
            [](const glm::dvec2& p, const glm::dvec2& size) { return OfSquare(p, size, 0); }}};

/// Returns the camera with the pose p_C = R_CF p_F + t of the rig's file read in another way: if `is_inverse`, as the
/// map from the camera to the file's world; if `is_opengl`, as the pose of a camera that looks along −z.
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

void MapPixels(PictureOfFilm& film, const std::function<glm::dvec2(const glm::dvec2&)>& map) {
  for (auto& frame : film.people) {
    for (SeenPerson& person : frame) {
      for (Keypoint& keypoint : person.keypoints) keypoint.pixel = map(keypoint.pixel);
    }
  }
}

/// Returns the share of people whose shoulders are above their ankles in the cameras' world, Y up, as far as one
/// picture shows this.
double UprightShare(const Films& films) {
  using enum Landmark;
  int upright = 0, people = 0;
  for (const PictureOfFilm& film : films) {
    const glm::dvec3 up_C = film.camera.R_CW * glm::dvec3(0, 1, 0);
    for (const auto& frame : film.people) {
      for (const SeenPerson& person : frame) {
        const auto middle = [&](Landmark a, Landmark b) {
          return 0.5 * (film.fit.ToRig(person[a].pixel) + film.fit.ToRig(person[b].pixel));
        };
        const bool shows_all = std::min({person[kLeftShoulder].confidence, person[kRightShoulder].confidence,
                                         person[kLeftAnkle].confidence, person[kRightAnkle].confidence}) > 0;
        if (!shows_all) continue;
        ++people;
        const glm::dvec2 body = middle(kLeftShoulder, kRightShoulder) - middle(kLeftAnkle, kRightAnkle);
        upright += glm::dot(body, glm::dvec2(up_C)) > 0;
      }
    }
  }
  return people == 0 ? 0.5 : static_cast<double>(upright) / people;
}

/// Keypoints that are scaled about the middle of the pictures, then shifted: the logarithms of the scales of x and y,
/// and the shifts as shares of the picture's size.
using FreeFit = glm::dvec4;

glm::dvec2 Fitted(const FreeFit& fit, const glm::dvec2& p, const glm::dvec2& size) {
  return glm::exp(glm::dvec2(fit)) * (p - 0.5 * size) + (0.5 + glm::dvec2(fit.z, fit.w)) * size;
}

Films Fitted(Films films, const FreeFit& fit) {
  for (PictureOfFilm& film : films) {
    MapPixels(film, [&](const glm::dvec2& p) { return Fitted(fit, p, film.film_px); });
  }
  return films;
}

/// Finds the scale and shift of all films that minimise the squared distances to epipolar lines, as shares of the
/// person's height (Levenberg–Marquardt). Only frames in which every film shows one person are used.
class FreeFitter {
 public:
  FreeFitter(const Films& films, double min_confidence)
      : least_confidence_(min_confidence), geometry_(MatricesOf(films)) {
    constexpr std::size_t kFrames = 16;
    films_ = films;
    for (PictureOfFilm& film : films_) film.people.clear();
    for (std::size_t i = 0; i < kFrames; ++i) {
      const std::size_t frame = i * films.front().people.size() / kFrames;
      const auto shows_one = [&](const PictureOfFilm& film) {
        return frame < film.people.size() && film.people[frame].size() == 1;
      };
      if (!std::ranges::all_of(films, shows_one)) continue;
      for (std::size_t c = 0; c < films.size(); ++c) films_[c].people.push_back(films[c].people[frame]);
    }
  }

  FreeFit From(FreeFit fit) const {
    std::vector<double> now = Distances(fit);
    constexpr int kSteps = 40;
    double damping = 1e-3;
    for (int step = 0; step < kSteps && !now.empty(); ++step) {
      // The normal equations, with derivatives by differences.
      constexpr double kDifference = 1e-6;
      std::array<std::vector<double>, 4> changed;
      for (int k = 0; k < 4; ++k) {
        FreeFit there = fit;
        there[k] += kDifference;
        changed[k] = Distances(there);
      }
      glm::dmat4 normal(0);
      glm::dvec4 gradient(0);
      for (std::size_t i = 0; i < now.size(); ++i) {
        glm::dvec4 row;
        for (int k = 0; k < 4; ++k) row[k] = (changed[k][i] - now[i]) / kDifference;
        normal += glm::outerProduct(row, row);
        gradient += row * now[i];
      }
      for (int k = 0; k < 4; ++k) normal[k][k] *= 1 + damping;
      const FreeFit next = fit - glm::inverse(normal) * gradient;
      std::vector<double> then = Distances(next);
      const bool is_better = SquaresOf(then) < SquaresOf(now);  // false for NaN
      damping *= is_better ? 0.2 : 5;
      if (!is_better) continue;
      fit = next;
      now = std::move(then);
    }
    return fit;
  }

 private:
  static double SquaresOf(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value * value;
    return sum;
  }

  std::vector<double> Distances(const FreeFit& fit) const {
    std::vector<SeenPeople> seen;
    for (PictureOfFilm& film : Fitted(films_, fit)) {
      MapPixels(film, [&](const glm::dvec2& p) { return film.fit.ToRig(p); });
      seen.push_back(UndistortPeople(film.camera, std::move(film.people)));
    }
    std::vector<double> distances;
    for (std::size_t a = 0; a < seen.size(); ++a) {
      for (std::size_t b = a + 1; b < seen.size(); ++b) {
        if (!geometry_(a, b)) continue;
        for (std::size_t frame = 0; frame < seen[a].size(); ++frame) {
          const SeenPerson &one = seen[a][frame][0], &other = seen[b][frame][0];
          const double height = std::max({1.0, HeightPx(one), HeightPx(other)});
          for (std::size_t i = 0; i < kLandmarkCount; ++i) {
            const Keypoint &p = one.keypoints[i], &q = other.keypoints[i];
            if (std::min(p.confidence, q.confidence) < least_confidence_) continue;
            distances.push_back(geometry_(a, b)->DistancePx(p.pixel, q.pixel) / height);
          }
        }
      }
    }
    return distances;
  }

  Films films_;
  double least_confidence_;
  PairGeometry geometry_;
};

class SessionGuesser {
 public:
  SessionGuesser(std::span<const PictureOfFilm> films, std::span<const std::string> names, const glm::dmat3& R_WF,
                 double min_confidence)
      : films_(films.begin(), films.end()), names_(names), R_WF_(R_WF), least_confidence_(min_confidence) {}

  SessionGuess Run() {
    SessionGuess found;
    const double said = EpipolarDistanceOf(films_, least_confidence_);
    constexpr double kOff = 0.001, kBetter = 0.5, kPercent = 100;
    // Test all hypotheses. Of the hypotheses that at least halve the distance, keep the best.
    if (said > kOff) {
      const double guessed = std::min(said, MissAsGuessed());
      least_ = kBetter * guessed;
      TryTurns(said);
      TryPoses();
      TryExchanges();
      TryReadings();
      const bool is_mended = best_ && least_ < kMaxPlausibleMiss;
      found.doubt = DoubtOfScale(is_mended ? least_ : guessed, is_mended);
      if (is_mended && found.doubt.empty()) {
        found.turns = turns_;
        found.mended = fmt::format(
            "{}: rays to the same keypoint miss each other by {:.2f} % of the person's height instead of {:.2f} %",
            told_, kPercent * least_, kPercent * said);
        films_ = std::move(*best_);
      }
    }
    for (PictureOfFilm& film : films_) {
      found.cameras.push_back(film.camera);
      found.fits.push_back(film.fit);
      found.people.push_back(std::move(film.people));
    }
    return found;
  }

 private:
  /// Corrects each film's pictures by `GuessPictures` alone, and returns their epipolar distance
  /// (`EpipolarDistanceOf`).
  double MissAsGuessed() const {
    Films guessed = films_;
    const std::vector<PictureGuess> guesses = GuessPictures(films_, least_confidence_);
    for (std::size_t i = 0; i < guessed.size(); ++i) guessed[i].fit = guesses[i].fit;
    return EpipolarDistanceOf(guessed, least_confidence_);
  }

  // Keeps `films` as the best hypothesis if they have the smallest distance so far.
  void Try(Films films, std::string told, int turns = 0, bool is_size = false) {
    const double miss = EpipolarDistanceOf(films, least_confidence_);
    if (!(miss < least_)) return;
    least_ = miss;
    best_ = std::move(films);
    told_ = std::move(told);
    turns_ = turns;
    is_size_ = is_size;
  }

  /// Tries to turn the keypoints of all films alike.
  void TryTurns(double said) {
    const int declared = films_.front().fit.quarter_turns;
    for (int turns = 1; turns < 4; ++turns) {
      Films films;
      for (const PictureOfFilm& film : films_) films.push_back(Turned(film, turns));
      constexpr double kMostly = 0.9, kStillBetter = 0.9;
      // An upright person is evidence, too: seen from afar, pictures that are turned by 180° show a mirrored body.
      if (turns == 2 && !best_ && UprightShare(films_) < 1 - kMostly && UprightShare(films) > kMostly) {
        least_ = std::max(least_, kStillBetter * said);
      }
      const int all = (declared + turns) % 4;
      Try(std::move(films),
          all == 0        ? "keypoints belong to the rig's pictures, which the films show rotated"
          : declared == 0 ? fmt::format("keypoints of all films are turned by {}° clockwise", 90 * all)
                          : fmt::format("pictures of all films are turned by {}° clockwise", 90 * all),
          turns);
    }
  }

  /// Returns the doubt that another scale and shift of all films fit much better than `miss`; "" if they do not.
  std::string DoubtOfScale(double miss, bool is_mended) const {
    constexpr double kOff = 0.03, kNoise = 0.0005, kPercent = 100;
    if (is_mended ? !is_size_ || miss < kNoise : miss < kOff) return "";
    const auto [fit, least] = FitFreely();
    if (!(least < (is_mended ? 0.5 : 0.25) * miss - kNoise)) return "";
    const glm::dvec2 size = films_.front().film_px, scale = glm::exp(glm::dvec2(fit)),
                     origin = Fitted(fit, glm::dvec2(0), size);
    return fmt::format(
        "keypoints of all films would fit the rig best if they were scaled by {:.3f} and {:.3f}, then shifted by "
        "{:+.0f} and {:+.0f} px: rays to the same keypoint would miss each other by {:.2f} % of the person's height "
        "instead of {:.2f} %. Were the pictures resized or cropped? Etude did not correct this",
        scale.x, scale.y, std::round(origin.x) + 0.0, std::round(origin.y) + 0.0, kPercent * least, kPercent * miss);
  }

  /// Searches the scale and shift that fit the rig best, from several sizes of the pictures; returns them with their
  /// EpipolarDistanceOf.
  std::pair<FreeFit, double> FitFreely() const {
    std::pair<FreeFit, double> best{FreeFit(0), EpipolarDistanceOf(films_, least_confidence_)};
    const FreeFitter fitter(films_, least_confidence_);
    for (const double scale : {0.25, 0.5, 1.0, 1.4, 2.0, 4.0}) {
      const double log = std::log(scale), corner = 0.5 * (scale - 1);  // scaled about the corner
      const FreeFit fit = fitter.From({log, log, corner, corner});
      const double miss = EpipolarDistanceOf(Fitted(films_, fit), least_confidence_);
      if (miss < best.second) best = {fit, miss};
    }
    return best;
  }

  void TryPoses() {
    for (const auto& [is_inverse, is_opengl, told] :
         {std::tuple(true, false, "the poses in the rig file are from camera to world"),
          {false, true, "the rig's cameras look along -z, with y up"},
          {true, true,
           "the poses in the rig file are from camera to world, and the cameras look along -z, with y up"}}) {
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
        Try(std::move(films),
            fmt::format("the films or the keypoints of {} and {} are exchanged", names_[a], names_[b]));
      }
    }
  }

  void TryReadings() {
    for (const Reading& reading : kReadings) {
      TryPixels(std::string(reading.told),
                [&](const PictureOfFilm& film, const glm::dvec2& pixel) { return reading.pixel(pixel, film.film_px); });
    }
    for (const double scale : {0.25, 1.0 / 3, 0.375, 0.5, 2.0 / 3, 0.75, 4.0 / 3, 1.5, 2.0, 8.0 / 3, 3.0, 4.0}) {
      const auto told = fmt::format("keypoints belong to pictures {:.4g} times as large", 1 / scale);
      TryPixels(
          told, [&](const PictureOfFilm&, const glm::dvec2& pixel) { return scale * pixel; }, true);
    }
  }

  void TryPixels(std::string told, const std::function<glm::dvec2(const PictureOfFilm&, const glm::dvec2&)>& read,
                 bool is_size = false) {
    Films films = films_;
    for (PictureOfFilm& film : films) {
      MapPixels(film, [&](const glm::dvec2& pixel) { return read(film, pixel); });
    }
    Try(std::move(films), std::move(told), 0, is_size);
  }

  Films films_;
  std::span<const std::string> names_;
  const glm::dmat3& R_WF_;
  double least_confidence_;
  double least_ = 0;
  int turns_ = 0;
  bool is_size_ = false;  ///< true if the best hypothesis is another size of the pictures
  std::optional<Films> best_;
  std::string told_;
};

}  // namespace

SessionGuess GuessSession(std::span<const PictureOfFilm> films, std::span<const std::string> names,
                          const glm::dmat3& R_WF, double min_confidence) {
  return SessionGuesser(films, names, R_WF, min_confidence).Run();
}

}  // namespace etude
