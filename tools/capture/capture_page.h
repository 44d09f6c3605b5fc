#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/drawing/film.h"

namespace etude {

/// A line over the frames of a take; frames without a value are gaps.
struct TakeCurve {
  std::string name;
  std::vector<std::optional<double>> values;
};

/// One camera of a captured take.
struct CapturedCamera {
  std::string name;
  TakeCurve residual;              ///< how far what it shows is from what was found, as `CameraResiduals` says
  std::optional<double> left_out;  ///< share of keypoints that disagreed with the other cameras', where there are any
};

/// The distances of what the cameras show from what was found, by one kind of measure.
struct CameraResiduals {
  std::string caption;  ///< of the curves
  std::string unit;     ///< theirs
  std::vector<CapturedCamera> cameras;
};

/// The findings of `etude capture`, for people to read.
struct CapturePage {
  std::string title;
  std::string verdict;  ///< a sentence or two
  double rate_hz = 30;
  std::string mp4;                         ///< the overlay film's bytes, or "" where it is too heavy for a page
  std::string film;                        ///< where it is written, "" = nowhere
  Picture still;                           ///< the frame in the middle
  std::vector<std::string> told;           ///< what was found out, mended or is doubtful, a line each
  std::vector<CameraResiduals> residuals;  ///< of keypoints, of outlines, or of both
  std::vector<TakeCurve> feet_cm;          ///< heights above the floor
  std::string limbs;                       ///< a sentence: where their lengths come from
  std::vector<std::pair<std::string, double>> lengths_cm;          ///< of limbs
  std::vector<std::pair<std::string, std::array<double, 2>>> fit;  ///< of joints, if any: median and 95 %, mm
  std::string version, command;
};

/// Writes one HTML page that holds all it needs and forbids itself the network, in the manner of a run's page.
std::string WriteCapturePage(const CapturePage& page);

}  // namespace etude
