#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "engine/formats/trc.h"
#include "io/clips/clip_file.h"

namespace etude {

/// What the user tells about files, by options or in a joint map.
std::optional<UpAxis> ToldUp(const OpenOptions& options);
std::optional<double> ToldUnit(const OpenOptions& options);
bool KeepsFloor(const OpenOptions& options);

/// Returns what the format of a clip with a skeleton tells of its up axis; nullopt for BVH and Acclaim.
std::optional<UpRule> UpRuleOf(ClipFormat format);

/// Returns true for the formats of markers, and of joints read as such.
bool IsOfMarkers(ClipFormat format);

/// Turns every body that the markers show into a clip. `rule` says what is known of the up axis if the user tells none.
Result<ClipFile> FileOfMarkers(ClipFormat format, MarkerMotion markers, const std::string& path,
                               const OpenOptions& options, UpRule rule);

/// Reads a file of markers (C3D, TRC, Motive's CSV, joint CSV); returns nullopt if the file is of another kind.
std::optional<Result<ClipFile>> ReadMarkers(std::string_view bytes, const std::string& path,
                                            const OpenOptions& options);

}  // namespace etude
