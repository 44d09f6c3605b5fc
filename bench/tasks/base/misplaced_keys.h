#pragma once

#include <span>
#include <string_view>

#include "bench/tasks/base/task.h"

namespace etude {

/// Complains in `fields` of keys that go with other values of the key `chosen` than `value` (KeyInfo::only_with): there
/// they would mean nothing, which is a mistake worth telling.
void RefuseMisplacedKeys(Fields& fields, std::span<const KeyInfo> keys, std::string_view chosen,
                         std::string_view value);

}  // namespace etude
