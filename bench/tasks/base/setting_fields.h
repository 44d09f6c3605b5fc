#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "bench/tasks/base/task.h"
#include "engine/base/number_setting.h"
#include "engine/document/fields.h"

namespace etude {

/// Reads what a method can be set by, where the file says it, into `values`. Complaints stay in `fields`.
template <typename Settings>
void ReadSettings(Fields& fields, std::span<const NumberSetting<Settings>> settings, Settings& values) {
  for (const NumberSetting<Settings>& setting : settings) {
    values.*setting.member = fields.Number(setting.key, values.*setting.member, {setting.lowest, setting.largest});
  }
}

/// The keys of all settings of a registry for the reference page, each once, even where it means
/// something else in some row: `chosen` is the key that chooses a row,
/// and a row has a `name` and `settings`.
template <typename Row, typename Settings>
std::vector<KeyInfo> SettingKeys(const std::string& chosen, std::span<const Row> rows, const Settings& defaults) {
  std::vector<KeyInfo> keys;
  for (const Row& row : rows) {
    for (const NumberSetting<Settings>& setting : row.settings) {
      const auto known = std::ranges::find(keys, setting.key, &KeyInfo::key);
      if (known != keys.end()) {
        known->only_with.values.push_back(row.name);
        if (known->meaning != setting.meaning) known->meaning += fmt::format(" Of {}: {}", row.name, setting.meaning);
        continue;
      }
      keys.push_back({setting.key,
                      fmt::format("{:g}…{:g}", setting.lowest, setting.largest),
                      fmt::format("{:g}", defaults.*setting.member),
                      setting.meaning,
                      {chosen, {row.name}}});
    }
  }
  return keys;
}

}  // namespace etude
