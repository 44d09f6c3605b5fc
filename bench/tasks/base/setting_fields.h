#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "bench/tasks/base/task.h"
#include "engine/base/settings.h"
#include "engine/document/fields.h"

namespace etude {

/// Reads what a method can be set by, where the file says it: one value per setting. Complaints stay in `fields`.
inline std::vector<double> ReadSettings(Fields& fields, std::span<const NumberSetting> settings) {
  std::vector<double> values;
  for (const NumberSetting& setting : settings) {
    values.push_back(fields.Number(setting.key, setting.fallback, {setting.lowest, setting.largest}));
  }
  return values;
}

/// The keys of all settings of a registry for the reference page, each once, even where it means
/// something else in some row: `chosen` is the key that chooses a row,
/// and a row has a `name` and `settings`.
template <typename Row>
std::vector<KeyInfo> SettingKeys(const std::string& chosen, std::span<const Row> rows) {
  std::vector<KeyInfo> keys;
  for (const Row& row : rows) {
    for (const NumberSetting& setting : row.settings) {
      const auto known = std::ranges::find(keys, setting.key, &KeyInfo::key);
      if (known != keys.end()) {
        known->only_with.values.push_back(row.name);
        if (known->meaning != setting.meaning) known->meaning += fmt::format(" Of {}: {}", row.name, setting.meaning);
        continue;
      }
      keys.push_back({setting.key,
                      fmt::format("{:g}…{:g}", setting.lowest, setting.largest),
                      fmt::format("{:g}", setting.fallback),
                      setting.meaning,
                      {chosen, {row.name}}});
    }
  }
  return keys;
}

}  // namespace etude
