#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/keys/field_table.h"
#include "bench/tasks/base/task.h"

namespace etude {

/// Reads a task's methods with the keys of `table`. Each method begins as a copy of `start`, which holds the settings
/// that the condition gives to all methods. `finish` completes a method whose keys are valid. Returns the first error
/// of the condition or of a method.
template <typename Method>
Result<std::vector<Method>> ReadMethods(TaskInput& input, const std::string& task, const FieldTable<Method>& table,
                                        const Method& start = {},
                                        const std::function<void(Fields&, Method&)>& finish = {}) {
  if (!input.condition.ok()) return tl::unexpected(input.condition.Finish().error());
  std::vector<Method> methods;
  for (const Node& node : input.methods) {
    Fields fields(node, "a method of task " + task);
    Method method = start;
    method.name = fields.RequiredText("name");
    table.ReadKeys(fields, method);
    RETURN_IF_ERROR(fields.Finish());
    if (table.check) table.check(fields, method);
    if (finish) finish(fields, method);
    RETURN_IF_ERROR(fields.Finish());
    methods.push_back(std::move(method));
  }
  return methods;
}

}  // namespace etude
