#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"

namespace etude {

/// The distance between the capture of some cameras and a reference, over all markers or joints of the reference and
/// all frames.
struct RealDistance {
  std::string cameras;                                ///< the cameras used: "all", or numbers such as "1+4"
  std::optional<double> median_mm = {}, p95_mm = {};  ///< millimetres; absent if these cameras gave no motion

  bool operator==(const RealDistance&) const = default;
};

/// A capture of real films, and its distances from a reference.
struct RealTake {
  std::string name;
  std::string recovery;   ///< how the person was found in the films: "keypoints", "marks", "silhouettes"
  std::string reference;  ///< the name of the reference's file
  std::vector<std::string> films = {};
  int frames = 0;
  double rate_hz = 0;
  std::vector<RealDistance> distances = {};

  bool operator==(const RealTake&) const = default;
};

/// Returns the allowed values of `RealTake::recovery`.
const std::vector<std::string>& RealRecoveries();

/// Writes a take as JSON; the same take gives the same bytes.
std::string WriteRealTake(const RealTake& take);
/// Reads the output of `WriteRealTake`. Every error names the place, the value found and the allowed values.
Result<RealTake> ReadRealTake(std::string_view text, const std::string& file);

}  // namespace etude
