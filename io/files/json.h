#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "io/files/file_path.h"

namespace etude {

using Json = nlohmann::ordered_json;

/// Deletes where the type is known, so that whoever only passes a value on need not read nlohmann's header.
struct DeleteJson {
  DeleteJson() = default;
  DeleteJson(std::default_delete<Json>) {}  // NOLINT: what std::make_unique made is welcome
  void operator()(Json* json) const;
};
using JsonPtr = std::unique_ptr<Json, DeleteJson>;

/// Writes JSON in the one way in which it leaves Etude: one line, keys in the order given, shortest digits that read
/// back the same, characters that nobody sees (IsHidden) by their numbers. Refuses NaN and infinity, which nlohmann
/// would silently write as null, naming their path.
Result<std::string> WriteJson(const Json& json);

/// Shows a value in a complaint: its JSON, cut after forty characters; a list by its length.
std::string ShowJson(const Json& json);

/// Counts how deep brackets nest, whether or not the rest is JSON.
int NestingOf(std::string_view text);

/// Reads one JSON value, nested at most 100 deep; complains with the file and `line` (0 = a file of one value).
Result<Json> ReadJson(const std::string& text, const std::string& file, int line = 0);

/// Reads a file of one JSON value; fails like ReadWholeFile and ReadJson.
Result<Json> ReadJsonFile(const FilePath& path);

/// Reads one value as CBOR (RFC 8949), nested at most 100 deep. Refused, too, what Json::to_cbor never writes: lengths
/// that are not told beforehand, and tags.
Result<Json> ReadCbor(std::string_view bytes, const std::string& file);

}  // namespace etude
