#pragma once

#include <string>
#include <vector>

#include "bench/keys/field_table.h"
#include "engine/base/settings.h"

namespace etude {

/// What the methods of a registry (solvers, choices, joins) can be set by, as fields that go with the key `chooser`. A
/// row of the registry has a `name` and `settings`; the values are read into a vector of doubles, which `member` gives:
/// all settings of the method that was chosen, in its order, as soon as one is written. Two methods may have settings
/// of one name.
template <typename Options, typename Registry, typename Member>
std::vector<Field<Options>> SettingFields(const std::string& chooser, const Registry& registry, Member member) {
  std::vector<Field<Options>> fields;
  for (const auto& method : registry) {
    const std::vector<NumberSetting>& settings = method.settings;
    for (std::size_t i = 0; i < settings.size(); ++i) {
      const NumberSetting& setting = settings[i];
      const Range range{setting.lowest, setting.largest};
      fields.push_back({{setting.key,
                         NumberKind(range, setting.is_whole),
                         NumberText(setting.fallback),
                         setting.meaning,
                         {chooser, {method.name}}},
                        [=](Fields& mapping, Options& options) {
                          const auto written = setting.is_whole ? mapping.OptionalWhole(setting.key, range)
                                                                : mapping.OptionalNumber(setting.key, range);
                          if (!written) return;
                          std::vector<double>& values = std::invoke(member, options);
                          if (values.empty()) {
                            for (const NumberSetting& each : settings) values.push_back(each.fallback);
                          }
                          values[i] = *written;
                        }});
    }
  }
  return fields;
}

}  // namespace etude
