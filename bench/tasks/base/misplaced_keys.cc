#include "bench/tasks/base/misplaced_keys.h"

#include <fmt/core.h>

#include <algorithm>

#include "engine/base/names.h"

namespace etude {

void RefuseMisplacedKeys(Fields& fields, std::span<const KeyInfo> keys, std::string_view chosen,
                         std::string_view value) {
  const std::string_view by_default = fields.Raw(chosen) == nullptr ? " (the default)" : "";
  for (const KeyInfo& key : keys) {
    const KeyCondition& condition = key.only_with;
    if (condition.key != chosen || std::ranges::find(condition.values, value) != condition.values.end()) continue;
    const Node* misplaced = fields.Raw(key.key);
    if (misplaced == nullptr) continue;
    fields.Complain(misplaced->place, fmt::format("{} '{}'{} has no '{}'; allowed with {}: {}", chosen, value,
                                                  by_default, key.key, chosen, Join(condition.values)));
  }
}

}  // namespace etude
