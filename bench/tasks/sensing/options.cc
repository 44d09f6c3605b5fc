#include "bench/tasks/sensing/options.h"

#include "bench/tasks/base/sensor_key.h"

namespace etude {

const FieldTable<StudioOptions>& CameraSensingFields() {
  static const FieldTable<StudioOptions> table = [] {
    using Key = Field<StudioOptions>;
    FieldTable<StudioOptions> made{FieldsOf<StudioOptions>(CaptureConditionFields(), std::identity(), Keep::kOthers,
                                                           {"duration_s", "figure", "moments"}),
                                   CaptureConditionFields().check};
    made.fields.push_back(Key::Number("picture_every", &StudioOptions::picture_every, {1, 30},
                                      "The cameras take a picture of every n-th frame at 30 Hz. In the frames between, "
                                      "the last skeleton is repeated."));
    for (Key& field : made.fields) {
      if (field.info.only_with.key.empty()) field = field.With(kSensorKey, {kCameraSensor});
    }
    return made;
  }();
  return table;
}

}  // namespace etude
