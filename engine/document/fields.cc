#include "engine/document/fields.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "engine/base/names.h"
#include "engine/base/text.h"

namespace etude {
namespace {

std::string Allowed(Range range) {
  const bool low = std::isfinite(range.lowest), high = std::isfinite(range.highest);
  if (low && high) return fmt::format("{} to {}", range.lowest, range.highest);
  if (low) return fmt::format("at least {}", range.lowest);
  if (high) return fmt::format("at most {}", range.highest);
  return "any finite number";
}

Result<double> NumberIn(const Node& node, Range range) {
  auto value = AsNumber(node);
  if (!value) return value;
  if (*value < range.lowest || *value > range.highest) {
    return Fail(node.place, "{} is out of range; allowed: {}", node.scalar, Allowed(range));
  }
  return value;
}

/// The largest number up to which a double holds every whole number.
constexpr double kMaxExact = 0x1p53;

/// Returns true if `text` is a whole number that no double holds exactly; `number` is the nearest double.
bool IsRounded(const std::string& text, double number) {
  std::uint64_t whole = 0;
  const char* end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, whole);
  return read.ec == std::errc() && read.ptr == end && number < 0x1p63 && static_cast<std::uint64_t>(number) != whole;
}

}  // namespace

Result<double> AsNumber(const Node& node) {
  if (node.kind != Node::Kind::kScalar) return Fail(node.place, "expected a number, found {}", Describe(node));
  const auto value = ParseFinite(node.scalar);
  if (!value) return Fail(node.place, "expected a number, found {}", Describe(node));
  return *value;
}

Result<std::vector<std::string>> AsTexts(const Node& node) {
  if (node.kind != Node::Kind::kSequence) return Fail(node.place, "expected a list, found {}", Describe(node));
  std::vector<std::string> texts;
  for (const Node& item : node.items) {
    if (item.kind != Node::Kind::kScalar) return Fail(item.place, "expected text, found {}", Describe(item));
    texts.push_back(item.scalar);
  }
  return texts;
}

Fields::Fields(const Node& node, std::string what) : node_(node), what_(std::move(what)) {
  if (node.kind != Node::Kind::kMapping) {
    Complain(node.place, fmt::format("{} must be a mapping (key: value), found {}", what_, Describe(node)));
  }
}

const Node* Fields::Raw(std::string_view key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.emplace_back(key);
  return node_.Find(key);
}

void Fields::Complain(Place place, std::string message) {
  if (!error_) error_ = Error{std::move(place), std::move(message)};
}

const Node* Fields::Scalar(std::string_view key, std::string_view expected) {
  const Node* value = Raw(key);
  if (value == nullptr || value->kind == Node::Kind::kScalar) return value;
  Complain(value->place, fmt::format("'{}' must be {}, found {}", key, expected, Describe(*value)));
  return nullptr;
}

std::optional<double> Fields::OptionalNumber(std::string_view key, Range range) {
  const Node* value = Scalar(key, "a number");
  if (value == nullptr) return std::nullopt;
  auto number = NumberIn(*value, range);
  if (number) return *number;
  Complain(number.error().place, fmt::format("'{}': {}", key, number.error().message));
  return std::nullopt;
}

std::optional<double> Fields::OptionalWhole(std::string_view key, Range range) {
  const std::optional<double> number = OptionalNumber(key, range);
  if (!number) return number;
  const Node& node = *node_.Find(key);
  if (IsRounded(node.scalar, *number)) {
    range.highest = std::min(range.highest, kMaxExact);
    Complain(node.place, fmt::format("'{}': {} is out of range; allowed: {}", key, node.scalar, Allowed(range)));
    return std::nullopt;
  }
  if (*number == std::floor(*number)) return number;
  Complain(node.place, fmt::format("'{}' must be a whole number, found {}", key, *number));
  return std::nullopt;
}

double Fields::Number(std::string_view key, double fallback, Range range) {
  return OptionalNumber(key, range).value_or(fallback);
}

int Fields::Integer(std::string_view key, int fallback, Range range) {
  constexpr double kMaxInt = std::numeric_limits<int>::max();
  range.lowest = std::max(range.lowest, -kMaxInt);
  range.highest = std::min(range.highest, kMaxInt);
  return static_cast<int>(OptionalWhole(key, range).value_or(fallback));
}

bool Fields::Boolean(std::string_view key, bool fallback) {
  const Node* value = Scalar(key, "true or false");
  if (value == nullptr) return fallback;
  if (value->scalar == "true") return true;
  if (value->scalar == "false") return false;
  Complain(value->place, fmt::format("'{}' must be true or false, found {}", key, Describe(*value)));
  return fallback;
}

std::string Fields::Text(std::string_view key, std::string_view fallback) {
  const Node* value = Scalar(key, "text");
  return value == nullptr ? std::string(fallback) : value->scalar;
}

std::string Fields::RequiredText(std::string_view key) {
  const Node* value = Scalar(key, "text");
  if (value != nullptr && !value->scalar.empty()) return value->scalar;
  std::vector<std::string> found;
  for (const Node::Entry& entry : node_.entries) found.push_back(entry.key);
  const std::string nearest = value == nullptr ? NearestName(key, found) : "";
  for (const Node::Entry& entry : node_.entries) {
    if (entry.key == nearest)
      Complain(entry.place, fmt::format("{} needs '{}'; is '{}' a misspelling of it?", what_, key, nearest));
  }
  Complain(value == nullptr ? node_.place : value->place, fmt::format("{} needs '{}'", what_, key));
  return "";
}

std::string Fields::Choice(std::string_view key, const std::vector<std::string>& allowed, std::string_view fallback) {
  const Node* value = Scalar(key, "text");
  if (value == nullptr) return std::string(fallback);
  for (const std::string& name : allowed) {
    if (name == value->scalar) return name;
  }
  Complain(value->place, UnknownName(key, value->scalar, allowed));
  return std::string(fallback);
}

std::vector<std::string> Fields::Texts(std::string_view key) {
  const Node* value = Raw(key);
  if (value == nullptr) return {};
  auto texts = AsTexts(*value);
  if (texts) return *texts;
  Complain(texts.error().place, fmt::format("'{}': {}", key, texts.error().message));
  return {};
}

std::vector<double> Fields::Numbers(std::string_view key, Range range) {
  const Node* value = Raw(key);
  if (value == nullptr) return {};
  if (value->kind != Node::Kind::kSequence) {
    Complain(value->place, fmt::format("'{}' must be a list of numbers, found {}", key, Describe(*value)));
    return {};
  }
  std::vector<double> numbers;
  for (const Node& item : value->items) {
    auto number = NumberIn(item, range);
    if (!number) {
      Complain(number.error().place, fmt::format("'{}': {}", key, number.error().message));
      return {};
    }
    numbers.push_back(*number);
  }
  return numbers;
}

Result<void> Fields::Finish() {
  if (error_) return tl::unexpected(*error_);
  for (const Node::Entry& entry : node_.entries) {
    if (std::find(known_.begin(), known_.end(), entry.key) != known_.end()) continue;
    return Fail(entry.place, "{}", UnknownName("key of " + what_, entry.key, known_));
  }
  return {};
}

}  // namespace etude
