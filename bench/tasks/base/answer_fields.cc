#include "bench/tasks/base/answer_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/base/names.h"

namespace etude {
namespace {

const Json& EmptyList() {
  static const Json list = Json::array();
  return list;
}

bool IsIn(double value, const Range& range) { return range.lowest <= value && value <= range.highest; }

std::string ShowRange(const Range& range) { return fmt::format("{:g}…{:g}", range.lowest, range.highest); }

/// Returns the reason why the value is not a number in the range; nothing if it is such a number.
std::optional<std::string> NumberComplaint(const Json& json, const Range& range) {
  if (!json.is_number() || !std::isfinite(json.get<double>())) {
    return fmt::format("{} is not a finite number", ShowJson(json));
  }
  if (!IsIn(json.get<double>(), range)) return fmt::format("{}; allowed: {}", ShowJson(json), ShowRange(range));
  return std::nullopt;
}

std::optional<std::string> IntegerComplaint(const Json& json, int lowest, int highest) {
  // Accept 3.0 as an integer, because some languages write no other form.
  if (!json.is_number() || json.get<double>() != std::floor(json.get<double>())) {
    return fmt::format("{} is not a whole number", ShowJson(json));
  }
  if (highest < lowest) return fmt::format("{} is not allowed here", ShowJson(json));
  if (!IsIn(json.get<double>(), {static_cast<double>(lowest), static_cast<double>(highest)})) {
    return fmt::format("{}; allowed: {}…{}", ShowJson(json), lowest, highest);
  }
  return std::nullopt;
}

}  // namespace

AnswerFields::AnswerFields(const Json& json, std::string path) : json_(json), path_(std::move(path)) {
  if (!json.is_object()) Complain("", fmt::format("{} is not an object", ShowJson(json)));
}

bool AnswerFields::Has(std::string_view key) { return Find(key) != nullptr; }

const Json* AnswerFields::Raw(std::string_view key) { return Find(key); }

int AnswerFields::Integer(std::string_view key, int lowest, int highest) {
  const Json* value = Require(key);
  if (value == nullptr) return lowest;
  if (const auto complaint = IntegerComplaint(*value, lowest, highest)) {
    Complain(key, *complaint);
    return lowest;
  }
  return value->get<int>();
}

std::optional<int> AnswerFields::NullableInteger(std::string_view key, int lowest, int highest) {
  const Json* value = Require(key);
  if (value == nullptr || value->is_null()) return std::nullopt;
  return Integer(key, lowest, highest);
}

double AnswerFields::Number(std::string_view key, Range range) {
  const Json* value = Require(key);
  if (value == nullptr) return range.lowest;
  if (const auto complaint = NumberComplaint(*value, range)) {
    Complain(key, *complaint);
    return range.lowest;
  }
  return value->get<double>();
}

bool AnswerFields::Boolean(std::string_view key, bool fallback) {
  const Json* value = Find(key);
  if (value == nullptr) return fallback;
  if (!value->is_boolean()) {
    Complain(key, fmt::format("{}; allowed: true, false", ShowJson(*value)));
    return fallback;
  }
  return value->get<bool>();
}

std::string AnswerFields::Text(std::string_view key, std::size_t longest) {
  const Json* value = Require(key);
  if (value == nullptr) return "";
  if (!value->is_string() || value->get_ref<const std::string&>().empty()) {
    Complain(key, fmt::format("{} is not a text", ShowJson(*value)));
    return "";
  }
  const std::string& text = value->get_ref<const std::string&>();
  if (text.size() > longest) Complain(key, fmt::format("found {} bytes; allowed: at most {}", text.size(), longest));
  return text;
}

std::string AnswerFields::Choice(std::string_view key, const std::vector<std::string>& allowed,
                                 std::string_view fallback) {
  const Json* value = Find(key);
  return value == nullptr ? std::string(fallback) : OneOf(key, *value, allowed);
}

std::string AnswerFields::RequiredChoice(std::string_view key, const std::vector<std::string>& allowed) {
  const Json* value = Require(key);
  return value == nullptr ? "" : OneOf(key, *value, allowed);
}

std::string AnswerFields::OneOf(std::string_view key, const Json& value, const std::vector<std::string>& allowed) {
  for (const std::string& name : allowed) {
    if (value.is_string() && value.get_ref<const std::string&>() == name) return name;
  }
  Complain(key, fmt::format("{}; allowed: {}", ShowJson(value), Join(allowed)));
  return "";
}

const Json& AnswerFields::List(std::string_view key, std::size_t fewest, std::size_t most) {
  const Json* value = fewest > 0 ? Require(key) : Find(key);
  if (value == nullptr) return EmptyList();
  if (!value->is_array()) {
    Complain(key, fmt::format("{} is not a list", ShowJson(*value)));
    return EmptyList();
  }
  if (value->size() < fewest || value->size() > most) {
    Complain(key, fewest == most ? fmt::format("{} entries, not {}", value->size(), most)
                                 : fmt::format("found {} entries; allowed: {}…{}", value->size(), fewest, most));
    return EmptyList();
  }
  return *value;
}

std::string AnswerFields::PathOf(std::string_view key) const {
  return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
}

std::string AnswerFields::PathOf(std::string_view key, std::size_t index) const {
  return fmt::format("{}[{}]", PathOf(key), index);
}

void AnswerFields::Note(const Error& error) {
  if (!error_) error_ = error;
}

Result<void> AnswerFields::Finish() {
  if (error_) return tl::unexpected(*error_);
  for (const auto& item : json_.items()) {
    const bool is_known = std::find(known_.begin(), known_.end(), item.key()) != known_.end();
    if (is_known) continue;
    Complain("", UnknownName("key", item.key().substr(0, 40), known_));
    return tl::unexpected(*error_);
  }
  return {};
}

const Json* AnswerFields::Find(std::string_view key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.emplace_back(key);
  if (!json_.is_object()) return nullptr;
  const auto found = json_.find(std::string(key));
  return found == json_.end() ? nullptr : &*found;
}

const Json* AnswerFields::Require(std::string_view key) {
  const Json* value = Find(key);
  if (value == nullptr) Complain(key, "it is missing");
  return value;
}

void AnswerFields::Complain(std::string_view key, const std::string& message) {
  const std::string where = key.empty() ? (path_.empty() ? "the answer" : path_) : PathOf(key);
  if (!error_) error_ = Error{{}, fmt::format("{}: {}", where, message)};
}

Result<int> ReadInteger(const Json& json, const std::string& path, int lowest, int highest) {
  if (const auto complaint = IntegerComplaint(json, lowest, highest)) return Fail({}, "{}: {}", path, *complaint);
  return json.get<int>();
}

Result<std::vector<double>> ReadNumbers(const Json& json, const std::string& path, std::size_t count, Range range) {
  if (!json.is_array()) return Fail({}, "{}: {} is not a list of {} numbers", path, ShowJson(json), count);
  if (json.size() != count) return Fail({}, "{}: {} numbers, not {}", path, json.size(), count);
  std::vector<double> numbers;
  numbers.reserve(count);
  for (const Json& number : json) {
    if (const auto complaint = NumberComplaint(number, range)) {
      return Fail({}, "{}[{}]: {}", path, numbers.size(), *complaint);
    }
    numbers.push_back(number.get<double>());
  }
  return numbers;
}

}  // namespace etude
