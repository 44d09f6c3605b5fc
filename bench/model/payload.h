#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "io/files/json.h"

namespace etude {

/// A file that accompanies a problem or its truth, such as a picture.
struct Attachment {
  std::string name;  ///< the plain file name by which the JSON refers to it
  std::string bytes;
};

/// A function that receives files one by one, because all of them together might not fit into memory. It may fail.
using AttachmentSink = std::function<Result<void>(const Attachment&)>;

/// The data that an outside method receives about a world, or the world's truth (docs/outside-methods.md).
struct Payload {
  JsonPtr json;  ///< never null
  std::vector<Attachment> files;
};

Payload PayloadOf(Json json, std::vector<Attachment> files = {});

}  // namespace etude
