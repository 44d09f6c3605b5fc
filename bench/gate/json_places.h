#pragma once

#include <map>
#include <string>
#include <vector>

#include "engine/base/result.h"

namespace etude {

/// Where the entries of a JSON document stand, which a JSON library forgets when it has read it.
struct JsonPlaces {
  /// Of every list in the outermost object: the line of each entry, from 1.
  std::map<std::string, std::vector<int>> lines;
};

/// Walks over a document that is valid JSON (ReadJson). Fails, with the line, on a key that stands twice in one object:
/// a JSON library would keep one of the two and not tell.
Result<JsonPlaces> FindJsonPlaces(const std::string& text, const std::string& file);

}  // namespace etude
