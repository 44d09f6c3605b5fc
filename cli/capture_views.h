#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/clips/convert.h"
#include "cli/capture_command.h"
#include "engine/base/result.h"
#include "engine/cameras/rig_file.h"
#include "engine/keypoints/agreement.h"
#include "engine/keypoints/pixel_fit.h"
#include "engine/motion/body.h"
#include "engine/motion/clip.h"
#include "reports/films/decoder.h"

namespace etude {

/// One camera's part of a session.
struct FilmedView {
  std::filesystem::path path;
  FilmFacts facts;
  NamedCamera camera;
  PixelFit fit;  ///< from the rig's pixels to the film's
};

/// The films with their cameras of the rig. Fails for fewer than two, for cameras that are missing or named twice,
/// sizes that `--fit` does not explain, and films of different rates, or of different lengths without `--sync`.
Result<std::vector<FilmedView>> OpenFilms(const CaptureCommandOptions& options);

/// Writes a clip, and the same as twenty joints, in the format that the file's name tells.
Result<void> WriteMotion(const std::string& path, Clip clip, const BodyMotion& motion);

constexpr char kLost = '!';

/// Some cameras' column of a table: how near what they tell comes to a reference.
struct ComparedColumn {
  std::string heading;  ///< the cameras, and `kLost` where they gave no motion
  std::vector<MarkerAgreement> markers;
  MarkerAgreement all;
};
ComparedColumn CompareColumn(std::string heading, const MarkerMotion& markers, const MarkerMotion& reference);

/// Medians, a row for each marker of the first column, one for all, and their 95th percentile. `words` say what it is.
/// Then the file of `--distances`, if there shall be one.
Result<void> TellColumns(const std::string& words, const std::vector<ComparedColumn>& columns,
                         const std::vector<FilmedView>& views, const CaptureCommandOptions& options);

/// Two of the films, and what a column of theirs is called.
struct CameraPair {
  std::size_t first = 0, second = 0;
  std::string heading;
};
/// Every two of more than two films: of two there is nothing to compare.
std::vector<CameraPair> PairsOf(std::size_t films);

/// What `etude capture` does with films and keypoints or marks, and with films alone: the motion of the only person who
/// moves in them, by nothing but outlines. `reference`: what to compare it with.
Result<bool> CaptureKeypoints(const CaptureCommandOptions& options, const std::vector<FilmedView>& views,
                              const std::optional<MarkerMotion>& reference);
Result<bool> CaptureUnmarked(const CaptureCommandOptions& options, const std::vector<FilmedView>& views,
                             const std::optional<MarkerMotion>& reference);

}  // namespace etude
