#pragma once

#include <string>
#include <vector>

#include "io/files/json.h"

namespace etude {

/// A file that accompanies a problem or its truth, such as a picture.
struct Attachment {
  std::string name;  ///< the plain file name by which the JSON refers to it
  std::string bytes;
};

/// The part of a world that an outside method is given, or the truth about it (docs/outside-methods.md).
struct Payload {
  JsonPtr json;  ///< never null
  std::vector<Attachment> files;
};

Payload PayloadOf(Json json, std::vector<Attachment> files = {});

}  // namespace etude
