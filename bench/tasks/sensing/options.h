#pragma once

#include <vector>

#include "bench/keys/field_table.h"
#include "bench/tasks/capture/options.h"

namespace etude {

/// The cameras of a condition with `sensor: cameras`.
struct CameraSensing {
  StudioOptions studio;
  std::vector<PersonSource> sources;  ///< of all methods of the scenario, each once
};

/// The keys of a condition with `sensor: cameras`: those of `task: capture` that do not concern its takes, and
/// `picture_every`.
const FieldTable<StudioOptions>& CameraSensingFields();

/// The key `capture` of a method: how pictures become skeletons, with the keys that a method of `task: capture` has.
template <typename Method, typename Member>
Field<Method> CaptureField(Member member) {
  return {{"capture", MappingKind("a mapping, as a method of task capture", CaptureMethodFields().Describe()), "(none)",
           "With `sensor: cameras`: how pictures become skeletons."},
          [member](Fields& fields, Method& method) {
            if (fields.Raw("capture") == nullptr) return;
            ReadNested(fields, "capture", CaptureMethodFields(), std::invoke(member, method).emplace());
          }};
}

}  // namespace etude
