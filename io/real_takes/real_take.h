#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"

namespace etude {

/// The distance of some cameras' capture from a reference, over all its markers or joints and all frames.
struct RealDistance {
  std::string cameras;                                ///< "all", "1+4"
  std::optional<double> median_mm = {}, p95_mm = {};  ///< nothing where these cameras gave no motion

  bool operator==(const RealDistance&) const = default;
};

/// A capture of real films beside a reference.
struct RealTake {
  std::string name;
  std::string recovery;   ///< what told where the person is: "keypoints", "marks", "silhouettes"
  std::string reference;  ///< its file's name
  std::vector<std::string> films = {};
  int frames = 0;
  double rate_hz = 0;
  std::vector<RealDistance> distances = {};

  bool operator==(const RealTake&) const = default;
};

/// Returns the values of `RealTake::recovery`.
const std::vector<std::string>& RealRecoveries();

/// Writes a take as JSON; the bytes are the same for the same take.
std::string WriteRealTake(const RealTake& take);
/// Reads what `WriteRealTake` writes. Every error names place, what was found, and what is allowed.
Result<RealTake> ReadRealTake(std::string_view text, const std::string& file);

}  // namespace etude
