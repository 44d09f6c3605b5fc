#include "bench/model/cell_result.h"

namespace etude {

std::string_view StatusName(Status status) {
  switch (status) {
    case Status::kOk:
      return "ok";
    case Status::kUnsolved:
      return "unsolved";
    case Status::kFailed:
      return "failed";
    case Status::kTimeout:
      return "timeout";
    case Status::kCrashed:
      return "crashed";
    case Status::kOutOfMemory:
      return "out_of_memory";
    case Status::kBadOutput:
      return "bad_output";
    case Status::kSkipped:
      return "skipped";
  }
  return "failed";
}

std::optional<Status> FindStatus(std::string_view name) {
  for (int i = 0; i < kStatusCount; ++i) {
    if (StatusName(static_cast<Status>(i)) == name) return static_cast<Status>(i);
  }
  return std::nullopt;
}

}  // namespace etude
