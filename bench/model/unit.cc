#include "bench/model/unit.h"

#include <fmt/core.h>

namespace etude {

std::string_view SamplingUnitName(SamplingUnit unit) { return NameOfValue(kSamplingUnits, unit); }

std::string CountUnits(int count, SamplingUnit unit) {
  switch (unit) {
    case SamplingUnit::kWorld:
      return fmt::format("{} world{}", count, count == 1 ? "" : "s");
    case SamplingUnit::kPerson:
    case SamplingUnit::kRecordedPerson:
      return fmt::format("{} {}", count, count == 1 ? "person" : "people");
    case SamplingUnit::kLibrary:
      return fmt::format("{} librar{}", count, count == 1 ? "y" : "ies");
    case SamplingUnit::kClip:
    case SamplingUnit::kClipPair:
      break;
  }
  return fmt::format("{} clip{}", count, count == 1 ? "" : "s");
}

}  // namespace etude
