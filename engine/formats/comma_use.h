#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"

namespace etude {

/// Decides whether commas in a table's numbers are decimal commas ("0,291") or separate thousands ("1,891").
class CommaUse {
 public:
  /// Adds a number's text, which is part of the text `line_text`, and the index of its column of numbers, from 0.
  void Add(std::string_view number, std::size_t column, std::string_view line_text, int line);
  /// Fails, naming the first number with a comma, if all commas may separate thousands and one of these holds: other
  /// numbers have decimal points, or a column also contains whole numbers of at most three digits without a comma.
  Result<void> Check(const std::string& file) const;

 private:
  struct First {
    std::string number;
    std::size_t column = 0;
    int line = 0, character = 0;
  };
  struct Column {
    bool has_comma = false, has_short = false;
  };
  std::optional<First> first_;
  std::string pointed_;  ///< the first number with a decimal point and no comma
  bool has_decimal_comma_ = false;
  std::vector<Column> columns_;
};

}  // namespace etude
