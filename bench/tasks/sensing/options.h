#pragma once

#include <vector>

#include "bench/keys/field_table.h"
#include "bench/tasks/capture/options.h"

namespace etude {

/// The cameras of a condition with `sensor: cameras`.
struct CameraSensing {
  StudioOptions studio;
  std::vector<PersonSource> sources;  ///< the sources of all methods; equal sources are listed once
};

/// Returns the keys of a condition with `sensor: cameras`: `picture_every`, and the keys of a condition of `task:
/// capture` except `duration_s`, `figure` and `moments`.
const FieldTable<StudioOptions>& CameraSensingFields();

/// Returns the key `capture` of a method. The key says how pictures become skeletons; its value is a mapping with the
/// keys of a method of `task: capture`.
template <typename Method, typename Member>
Field<Method> CaptureField(Member member) {
  return {{"capture", MappingKind("a mapping with keys of a method of task capture", CaptureMethodFields().Describe()),
           "(none)", "With `sensor: cameras`: the method that computes skeletons from pictures."},
          [member](Fields& fields, Method& method) {
            if (fields.Raw("capture") == nullptr) return;
            ReadNested(fields, "capture", CaptureMethodFields(), std::invoke(member, method).emplace());
          }};
}

}  // namespace etude
