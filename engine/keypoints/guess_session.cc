#include "engine/keypoints/guess_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <utility>

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
    Reading{"keypoints count v from the picture's bottom",
            [](const glm::dvec2& p, const glm::dvec2& size) { return glm::dvec2(p.x, size.y - p.y); }},
    Reading{"keypoints have x and y exchanged",
            [](const glm::dvec2& p, const glm::dvec2&) { return glm::dvec2(p.y, p.x); }},
    Reading{"keypoints of all films are mirrored",
            [](const glm::dvec2& p, const glm::dvec2& size) { return glm::dvec2(size.x - p.x, p.y); }},
    Reading{"keypoints are relative to a square around the picture",
            [](const glm::dvec2& p, const glm::dvec2& size) { return OfSquare(p, size, 0.5); }},
    Reading{"keypoints are relative to the picture's longer side",
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

class SessionGuesser {
 public:
  SessionGuesser(std::span<const PictureOfFilm> films, std::span<const std::string> names, const glm::dmat3& R_WF,
                 double min_confidence)
      : films_(films.begin(), films.end()), names_(names), R_WF_(R_WF), least_confidence_(min_confidence) {}

  SessionGuess Run() {
    SessionGuess found;
    const double said = MissOfPictures(films_, least_confidence_);
    constexpr double kOff = 0.001, kBetter = 0.5, kPercent = 100;
    // Test all hypotheses. Of the hypotheses that at least halve the distance, keep the best.
    if (said > kOff) {
      least_ = kBetter * std::min(said, MissAsGuessed());
      TryPoses();
      TryExchanges();
      TryReadings();
      if (best_ && least_ < kMaxPlausibleMiss) {
        found.mended = fmt::format("{}: rays miss each other by {:.2f} % of the person's height instead of {:.2f} %",
                                   told_, kPercent * least_, kPercent * said);
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
  /// Corrects each film's pictures by `GuessPictures` alone, and returns their epipolar distance (`MissOfPictures`).
  double MissAsGuessed() const {
    Films guessed = films_;
    const std::vector<PictureGuess> guesses = GuessPictures(films_, least_confidence_);
    for (std::size_t i = 0; i < guessed.size(); ++i) guessed[i].fit = guesses[i].fit;
    return MissOfPictures(guessed, least_confidence_);
  }

  // Keeps `films` as the best hypothesis if they have the smallest distance so far.
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
