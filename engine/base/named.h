#pragma once

#include <iterator>
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

/// What a row is called unless said otherwise: its member `name`.
struct NameMember {
  template <typename Row>
  constexpr std::string_view operator()(const Row& row) const {
    return row.name;
  }
};

/// The first of `rows` (an array, vector or span) that is called `name`, null when there is none. `name_of` tells what
/// a row is called. The answer points into the rows.
template <typename Rows, typename NameOf = NameMember>
constexpr auto FindByName(const Rows& rows, std::string_view name, NameOf name_of = {}) -> decltype(std::data(rows)) {
  for (const auto& row : rows) {
    if (name_of(row) == name) return &row;
  }
  return nullptr;
}

/// What the rows are called, in their order.
template <typename Rows, typename NameOf = NameMember>
std::vector<std::string> NamesOf(const Rows& rows, NameOf name_of = {}) {
  std::vector<std::string> names;
  for (const auto& row : rows) names.emplace_back(name_of(row));
  return names;
}

}  // namespace etude
