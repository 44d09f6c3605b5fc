#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "engine/base/result.h"

namespace etude {

/// Puts `bytes` at `path`, whole or not at all: written beside it first, then renamed. Makes the folder
/// it stands in. Fails naming the path and the system's reason.
Result<void> WriteFileAtomically(const std::filesystem::path& path, std::string_view bytes);

/// The name that a file has while it is being written; it is renamed to `path` when it is whole.
std::filesystem::path TemporaryName(const std::filesystem::path& path);

/// Makes a folder and those above it. Fails naming it.
Result<void> MakeFolder(const std::filesystem::path& folder);

/// Gives the finished file its real name; on failure removes it and names the path.
Result<void> RenameFinished(const std::filesystem::path& temporary, const std::filesystem::path& path);

/// Larger files are refused before memory is taken.
constexpr std::uintmax_t kLargestFile = std::uintmax_t{2} << 30;

/// All bytes of a file. Fails naming the path.
Result<std::string> ReadWholeFile(const std::filesystem::path& path);

/// Hands on a file of any size, some of it at a time.
Result<void> ReadInChunks(const std::filesystem::path& path, const std::function<void(std::string_view)>& use);

/// Likewise line by line, without their ends; stops at the first complaint.
Result<void> ForEachLine(const std::filesystem::path& path,
                         const std::function<Result<void>(std::string_view line, const Place& place)>& use);

}  // namespace etude
