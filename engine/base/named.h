#pragma once

#include <cassert>
#include <functional>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace etude {

/// One row of a table that names the values of an enum.
template <typename Value>
struct Named {
  std::string_view name;
  Value value;
};

/// Returns the member `name` of a row; the default `name_of` of FindByName.
struct NameMember {
  template <typename Row>
  constexpr std::string_view operator()(const Row& row) const {
    return row.name;
  }
};

/// Returns a pointer to the first of `rows` (an array, vector or span) with the name `name`, null if there is none.
/// `name_of`, a function or a member, returns the name of a row.
template <typename Rows, typename NameOf = NameMember>
constexpr auto FindByName(const Rows& rows, std::string_view name, NameOf name_of = {}) -> decltype(std::data(rows)) {
  for (const auto& row : rows) {
    if (std::invoke(name_of, row) == name) return &row;
  }
  return nullptr;
}

/// Returns the value with the name `name` in a table of Named rows; nullopt if there is none.
template <typename Rows>
constexpr auto FindValue(const Rows& rows, std::string_view name) -> std::optional<decltype(std::data(rows)->value)> {
  const auto* row = FindByName(rows, name);
  return row != nullptr ? std::optional(row->value) : std::nullopt;
}

/// Returns the value with the name `name`. The table must have such a row.
template <typename Rows>
constexpr auto ValueNamed(const Rows& rows, std::string_view name) {
  const auto* row = FindByName(rows, name);
  assert(row != nullptr);
  return row->value;
}

/// Returns the name of a value. The table must have a row of this value.
template <typename Rows, typename Value>
constexpr std::string_view NameOfValue(const Rows& rows, Value value) {
  for (const auto& row : rows) {
    if (row.value == value) return row.name;
  }
  assert(!"a value without a name");
  return {};
}

/// Returns the names of all rows in their order.
template <typename Rows, typename NameOf = NameMember>
std::vector<std::string> NamesOf(const Rows& rows, NameOf name_of = {}) {
  std::vector<std::string> names;
  for (const auto& row : rows) names.emplace_back(std::invoke(name_of, row));
  return names;
}

}  // namespace etude
