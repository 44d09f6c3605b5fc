#pragma once

#include <cassert>
#include <functional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace [[gnu::visibility("default")]] etude {

/// A numeric setting of a method, named by its key in scenario files. Each method has its own settings, so two methods
/// may have settings with the same name. Values are passed as numbers in the order of the method's settings.
struct NumberSetting {
  std::string key;
  double fallback = 0;
  double lowest = 0, largest = 0;  ///< the allowed range, both ends included
  bool is_whole = false;
  std::string meaning;  ///< one sentence for users
};

/// Declares once which members of a method's options can be set: `Describe` lists them for files and pages, `Apply`
/// makes options from values. A member's default is its value in `Options{}`.
template <typename Options>
class SettingTable {
 public:
  struct Row {
    /// The allowed range of values is `lowest` to `largest`, both included; `meaning` is one sentence, for users.
    template <typename Number>
    Row(std::string key, Number Options::*member, double lowest, double largest, std::string meaning)
        : setting{std::move(key),
                  static_cast<double>(Options().*member),
                  lowest,
                  largest,
                  std::is_same_v<Number, int>,
                  std::move(meaning)},
          set([member](Options& options, double value) { options.*member = static_cast<Number>(value); }) {}

    NumberSetting setting;
    std::function<void(Options&, double)> set;
  };

  SettingTable(std::vector<Row> rows) : rows_(std::move(rows)) {}

  std::vector<NumberSetting> Describe() const {
    std::vector<NumberSetting> settings;
    for (const Row& row : rows_) settings.push_back(row.setting);
    return settings;
  }

  /// Makes options from `values`, one per row in order; an empty list gives the defaults.
  Options Apply(std::span<const double> values) const {
    assert(values.empty() || values.size() == rows_.size());
    Options options;
    for (std::size_t i = 0; i < values.size(); ++i) rows_[i].set(options, values[i]);
    return options;
  }

 private:
  std::vector<Row> rows_;
};

}  // namespace etude
