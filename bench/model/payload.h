#pragma once

#include <string>
#include <vector>

#include "io/files/json.h"

namespace etude {

/// A file that goes with a problem or its truth, such as a picture.
struct Attachment {
  std::string name;  ///< as the JSON beside it names it: a plain file name
  std::string bytes;
};

/// The part of a world that a method outside the program is given, or the truth about it (docs/outside-methods.md).
struct Payload {
  JsonPtr json;  ///< never null
  std::vector<Attachment> files;
};

Payload PayloadOf(Json json, std::vector<Attachment> files = {});

}  // namespace etude
