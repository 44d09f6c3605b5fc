#include "bench/keys/field_table.h"

#include "engine/base/names.h"

namespace etude {

void ReadNumber(Fields& fields, const std::string& key, Range range, double& value) {
  value = fields.Number(key, value, range);
}

void ReadNumber(Fields& fields, const std::string& key, Range range, int& value) {
  value = fields.Integer(key, value, range);
}

void ReadNumber(Fields& fields, const std::string& key, Range range, std::optional<double>& value) {
  if (const auto number = fields.OptionalNumber(key, range)) value = number;
}

void ReadNumber(Fields& fields, const std::string& key, Range range, std::optional<std::uint64_t>& value) {
  if (const auto number = fields.OptionalWhole(key, range)) value = static_cast<std::uint64_t>(*number);
}

void ReadNumbers(Fields& fields, const std::string& key, Count count, Range range, std::vector<double>& values) {
  const Node* node = fields.Raw(key);
  if (node == nullptr) return;
  std::vector<double> numbers = fields.Numbers(key, range);
  if (numbers.size() >= count.fewest && numbers.size() <= count.most) {
    values = std::move(numbers);
  } else {
    const std::string wanted = count.fewest == count.most ? fmt::format("{}", count.fewest)
                                                          : fmt::format("{} to {}", count.fewest, count.most);
    fields.Complain(node->place, fmt::format("'{}' has {} numbers; needed: {}", key, numbers.size(), wanted));
  }
}

std::vector<std::string> ReadNames(Fields& fields, const std::string& key, const std::vector<std::string>& known) {
  std::vector<std::string> names = fields.Texts(key);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (std::ranges::find(known, names[i]) != known.end()) continue;
    fields.Complain(fields.Raw(key)->items[i].place, UnknownName(key, names[i], known));
  }
  return names;
}

std::span<const Node> ReadItems(Fields& fields, const std::string& key) {
  const Node* list = fields.Raw(key);
  if (list == nullptr) return {};
  if (list->kind != Node::Kind::kSequence) {
    fields.Complain(list->place, fmt::format("'{}' must be a list, found {}", key, Describe(*list)));
  }
  return list->items;
}

}  // namespace etude
