#pragma once

#include <array>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/result.h"
#include "engine/formats/trc.h"
#include "engine/motion/body.h"

namespace etude {

/// The version of the Brain Imaging Data Structure that the files follow.
inline constexpr std::string_view kBidsVersion = "1.10.0";

/// The files of one motion: for each file, its name relative to the data set's folder, and its content.
using BidsFiles = std::vector<std::pair<std::string, std::string>>;

/// Writes a motion as a Motion-BIDS data set (Jeung et al. 2024) of one person, sub-01. Its files are `_motion.tsv`
/// (positions in metres with six decimals, without a heading), `_channels.tsv`, `_channels.json` (the axes),
/// `_motion.json`, `dataset_description.json` and `README`. The letters and digits of `name` become the task's label.
BidsFiles WriteMotionBids(const BodyMotion& motion, std::string_view name, std::string_view version);

/// The properties that `_motion.json` states.
struct BidsFacts {
  double rate_hz = 0;           ///< the value of SamplingFrequency
  std::string missing = "n/a";  ///< the value of MissingValues: the text of a cell without a value
};

/// Returns the axis that points up. `axes` is a SpatialAxes of Motion-BIDS: one letter each for x, y and z, namely A or
/// P (anterior, posterior), L or R, and S or I (superior, inferior). Returns nothing for other texts, such as "n/a".
std::optional<glm::dvec3> UpOfSpatialAxes(std::string_view axes);

/// Returns the reference frames that `channels_tsv` states for channels of the type POS; empty if it states none.
std::set<std::string, std::less<>> FramesOfBids(std::string_view channels_tsv);

/// Reads the POS channels of a recording: tracked points with the components x, y, z in m, cm, mm, in or ft. A point is
/// not seen in a frame if one of its values is missing or, in files that write 0 for missing values, if all three are
/// 0. A channel of the type LATENCY holds the times of the frames (LayOnClock). Channels of other types are left out,
/// and the remark says so. Fails, with the line, for channels without the required columns, points that lack a
/// component, other units, and if the numbers of channels and columns differ; also returns the errors of GridOfRows.
/// @param files the names of the files `motion_tsv` and `channels_tsv`, for error messages
Result<MarkerMotion> ReadMotionBids(std::string_view motion_tsv, std::string_view channels_tsv, const BidsFacts& facts,
                                    const std::array<std::string, 2>& files);

}  // namespace etude
