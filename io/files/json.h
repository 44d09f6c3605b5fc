#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "io/files/file_path.h"

namespace etude {

using Json = nlohmann::ordered_json;

/// Deletes a Json in json.cc. Headers that only pass JSON values therefore do not need nlohmann/json.hpp.
struct DeleteJson {
  DeleteJson() = default;
  DeleteJson(std::default_delete<Json>) {}  // NOLINT: converts from std::make_unique
  void operator()(Json* json) const;
};
using JsonPtr = std::unique_ptr<Json, DeleteJson>;

/// Writes JSON in the form of all of Etude's files: one line, keys in insertion order, numbers with the fewest digits
/// that give the same number when read, invisible characters (IsHidden) escaped as code points. Fails on NaN and
/// infinity with the path to the value; nlohmann would silently write null.
Result<std::string> WriteJson(const Json& json);

/// Describes a value for an error message: by the value's JSON, cut after 40 characters; by "an object"; or by the
/// length of the list.
std::string ShowJson(const Json& json);

/// Returns the depth to which brackets nest. The text need not be valid JSON.
int NestingOf(std::string_view text);

/// Reads one JSON value, nested at most 100 deep. Error messages name `file` and `line`; line 0 means that the whole
/// file is one value. Fails on invalid JSON and on a zero byte.
Result<Json> ReadJson(const std::string& text, const std::string& file, int line = 0);

/// Reads a file of one JSON value. Fails like ReadWholeFile and ReadJson.
Result<Json> ReadJsonFile(const FilePath& path);

/// Reads one CBOR value (RFC 8949), nested at most 100 deep. Fails also on what Json::to_cbor never writes: indefinite
/// lengths and tags.
Result<Json> ReadCbor(std::string_view bytes, const std::string& file);

}  // namespace etude
