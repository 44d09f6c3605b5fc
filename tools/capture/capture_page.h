#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/drawing/film.h"

namespace etude {

/// A curve over the frames of a take; frames without a value are gaps.
struct TakeCurve {
  std::string name;
  std::vector<std::optional<double>> values;
};

/// Returns the values of all frames that have a value.
std::vector<double> KnownOf(const std::vector<std::optional<double>>& values);

/// One camera of a captured take.
struct CapturedCamera {
  std::string name;
  TakeCurve residual;  ///< the difference that `CameraResiduals` describes, in each frame
  /// Share of the camera's keypoints that disagreed with other cameras; absent if there are no keypoints.
  std::optional<double> left_out;
};

/// The differences between each camera's picture and the recovered motion, by one measure.
struct CameraResiduals {
  std::string caption;  ///< the caption of the curves
  std::string unit;     ///< the unit of the curves
  std::vector<CapturedCamera> cameras;
};

/// The content of the page of `etude capture`.
struct CapturePage {
  std::string title;
  std::string verdict;  ///< the result in one or two sentences
  double rate_hz = 30;
  std::string mp4;                         ///< the bytes of the overlay film; "" if it is too large for a page
  std::string film;                        ///< the path of the overlay film, "" = none is written
  Picture still;                           ///< picture of the middle frame
  std::vector<std::string> told;           ///< findings, repairs and doubts, one line each
  std::vector<CameraResiduals> residuals;  ///< one entry for keypoints, one for silhouettes, or both
  std::vector<TakeCurve> feet_cm;          ///< heights above the floor, cm
  std::string limbs;                       ///< a sentence that says where the limb lengths come from
  std::vector<std::pair<std::string, double>> lengths_cm;  ///< names and values of the limb lengths, cm
  /// For each joint: median and 95th percentile, mm, of the distance between the joint and the point to which the joint
  /// was fitted; may be empty.
  std::vector<std::pair<std::string, std::array<double, 2>>> fit;
  std::string version, command;
};

/// Writes one HTML page in the style of a run's page. The page needs no other file, and its Content-Security-Policy
/// forbids network access.
std::string WriteCapturePage(const CapturePage& page);

}  // namespace etude
