#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace etude {

/// A small list of named items. Find starts after the item that it found last, so it takes constant time if names are
/// looked up in the order in which they were added, again and again.
template <typename T>
class CyclicLookup {
 public:
  /// Returns the item with the name `name`; null if there is none.
  T* Find(std::string_view name) {
    for (std::size_t tried = 0; tried < items_.size(); ++tried, ++next_) {
      if (next_ >= items_.size()) next_ = 0;
      if (items_[next_].first == name) return &items_[next_++].second;
    }
    return nullptr;
  }
  const T* Find(std::string_view name) const {
    for (const auto& [own, item] : items_) {
      if (own == name) return &item;
    }
    return nullptr;
  }
  /// Adds an item, whose name must not be in the list yet.
  T& Add(std::string name, T item) { return items_.emplace_back(std::move(name), std::move(item)).second; }

  auto begin() { return items_.begin(); }
  auto end() { return items_.end(); }

 private:
  std::vector<std::pair<std::string, T>> items_;
  std::size_t next_ = 0;
};

}  // namespace etude
