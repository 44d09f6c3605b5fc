#pragma once

#include <cassert>
#include <functional>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace etude {

/// A row of a table that gives the values of an enum their names.
template <typename Value>
struct Named {
  std::string_view name;
  Value value;
};

/// Reads a row's name from its member `name`, which FindByName does unless told otherwise.
struct NameMember {
  template <typename Row>
  constexpr std::string_view operator()(const Row& row) const {
    return row.name;
  }
};

/// The first of `rows` (an array, vector or span) that is called `name`, null when there is none. `name_of`, a function
/// or a member, tells what a row is called. The answer points into the rows.
template <typename Rows, typename NameOf = NameMember>
constexpr auto FindByName(const Rows& rows, std::string_view name, NameOf name_of = {}) -> decltype(std::data(rows)) {
  for (const auto& row : rows) {
    if (std::invoke(name_of, row) == name) return &row;
  }
  return nullptr;
}

/// The value called `name` of a table of Named rows; nothing when there is none.
template <typename Rows>
constexpr auto FindValue(const Rows& rows, std::string_view name) -> std::optional<decltype(std::data(rows)->value)> {
  const auto* row = FindByName(rows, name);
  return row != nullptr ? std::optional(row->value) : std::nullopt;
}

/// The value called `name`, which the table must have.
template <typename Rows>
constexpr auto ValueNamed(const Rows& rows, std::string_view name) {
  const auto* row = FindByName(rows, name);
  assert(row != nullptr);
  return row->value;
}

/// The name of a value, which the table must have.
template <typename Rows, typename Value>
constexpr std::string_view NameOfValue(const Rows& rows, Value value) {
  for (const auto& row : rows) {
    if (row.value == value) return row.name;
  }
  assert(!"a value without a name");
  return {};
}

/// Lists the rows' names in their order.
template <typename Rows, typename NameOf = NameMember>
std::vector<std::string> NamesOf(const Rows& rows, NameOf name_of = {}) {
  std::vector<std::string> names;
  for (const auto& row : rows) names.emplace_back(std::invoke(name_of, row));
  return names;
}

}  // namespace etude
