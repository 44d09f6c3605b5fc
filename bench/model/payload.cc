#include "bench/model/payload.h"

#include <nlohmann/json.hpp>

namespace etude {

Payload PayloadOf(Json json, std::vector<Attachment> files) {
  return {std::make_unique<Json>(std::move(json)), std::move(files)};
}

}  // namespace etude
