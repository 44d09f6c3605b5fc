#pragma once

#include <cassert>
#include <cmath>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace etude {

/// A number that a method can be set by, as scenario files name it. A method's settings are its own: two methods may
/// have settings of one name. Values are told as numbers in the order of the method's settings.
struct NumberSetting {
  std::string key;
  double fallback = 0;
  double lowest = 0, largest = 0;  ///< both allowed
  bool is_whole = false;
  std::string meaning;  ///< one sentence, for people
};

/// The members of a method's options that can be set, told once: `Describe` is what files and pages know of them,
/// `Apply` makes options of values. A member's default is that of `Options{}`.
template <typename Options>
class SettingTable {
 public:
  struct Row {
    std::string key;
    std::variant<int Options::*, double Options::*> member;
    double lowest = 0, largest = 0;  ///< both allowed
    std::string meaning;             ///< one sentence, for people
  };

  SettingTable(std::vector<Row> rows) : rows_(std::move(rows)) {}

  std::vector<NumberSetting> Describe() const {
    std::vector<NumberSetting> settings;
    const Options defaults;
    for (const Row& row : rows_) {
      const bool is_whole = std::holds_alternative<int Options::*>(row.member);
      const double fallback =
          std::visit([&](auto member) { return static_cast<double>(defaults.*member); }, row.member);
      settings.push_back({row.key, fallback, row.lowest, row.largest, is_whole, row.meaning});
    }
    return settings;
  }

  /// `values`: one per row, in their order; none at all: the defaults.
  Options Apply(std::span<const double> values) const {
    assert(values.empty() || values.size() == rows_.size());
    Options options;
    for (std::size_t i = 0; i < values.size(); ++i) {
      auto set = [&]<typename Number>(Number Options::*member) { options.*member = static_cast<Number>(values[i]); };
      std::visit(set, rows_[i].member);
    }
    return options;
  }

 private:
  std::vector<Row> rows_;
};

}  // namespace etude
