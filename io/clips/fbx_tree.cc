#include "io/clips/fbx_tree.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <iterator>
#include <optional>

#include "engine/base/text.h"

namespace etude {
namespace {

bool IsText(std::string_view bytes) { return bytes.starts_with("; FBX"); }

// --- Binary files

template <typename Number>
Number NumberAt(std::string_view bytes, std::size_t at) {
  Number number{};
  if (at <= bytes.size() && bytes.size() - at >= sizeof number) std::memcpy(&number, bytes.data() + at, sizeof number);
  return number;
}

/// Reads the nodes of one level. Stops at the null record, or at a record whose end lies outside `range`.
std::vector<FbxNode> BinaryNodesIn(std::string_view bytes, FbxRange range) {
  constexpr std::size_t kVersionAt = 23;
  constexpr std::uint32_t kLongOffsets = 7500;
  const bool is_long = NumberAt<std::uint32_t>(bytes, kVersionAt) >= kLongOffsets;
  const std::size_t word = is_long ? 8 : 4, head = 3 * word + 1;
  const auto offset_at = [&](std::size_t at) -> std::uint64_t {
    return is_long ? NumberAt<std::uint64_t>(bytes, at) : NumberAt<std::uint32_t>(bytes, at);
  };
  std::vector<FbxNode> nodes;
  for (std::size_t at = range.begin; range.end - at >= head;) {
    const std::uint64_t end = offset_at(at), length = offset_at(at + 2 * word);
    const std::size_t name_at = at + head, values_at = name_at + static_cast<unsigned char>(bytes[at + head - 1]);
    if (end <= at || end > range.end || values_at > end || length > end - values_at) break;
    const auto begin = static_cast<std::size_t>(values_at + length), stop = static_cast<std::size_t>(end);
    nodes.push_back({bytes.substr(name_at, values_at - name_at), {values_at, begin}, {begin, stop}});
    at = stop;
  }
  return nodes;
}

std::vector<FbxValue> BinaryValuesIn(std::string_view bytes, FbxRange range) {
  constexpr std::string_view kTypes = "CYIFDL";
  constexpr std::array<std::size_t, kTypes.size()> kSizes = {1, 2, 4, 4, 8, 8};
  std::vector<FbxValue> values;
  for (std::size_t at = range.begin; at < range.end;) {
    const char type = bytes[at++];
    if (type == 'S') {
      const std::size_t length = NumberAt<std::uint32_t>(bytes, at);
      at += sizeof(std::uint32_t);
      if (at > range.end || length > range.end - at) break;
      values.push_back({{at, at + length}, type, true, bytes.substr(at, length)});
      at += length;
    } else {
      const std::size_t known = kTypes.find(type);
      if (known == std::string_view::npos || range.end - at < kSizes[known]) break;
      values.push_back({{at, at + kSizes[known]}, type});
      at += kSizes[known];
    }
  }
  return values;
}

// --- Text files

/// Returns the position after the character, quoted text or comment that begins at `at`.
std::size_t AfterToken(std::string_view text, std::size_t at, std::size_t end) {
  if (text[at] == '"') return std::min(end, text.find('"', at + 1)) + (text.find('"', at + 1) < end ? 1 : 0);
  if (text[at] == ';') return std::min(end, text.find('\n', at));
  return at + 1;
}

bool IsBlank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

/// Returns the end of the values that begin at `at`: a brace, or a line break with no comma beside it.
std::size_t EndOfTextValues(std::string_view text, std::size_t at, std::size_t end) {
  bool is_after_comma = false;
  for (; at < end && text[at] != '{' && text[at] != '}'; at = AfterToken(text, at, end)) {
    if (text[at] == '\n') {
      const std::size_t next = text.find_first_not_of(" \t\r\n", at);
      if (!is_after_comma && (next >= end || text[next] != ',')) return at;
    }
    if (!IsBlank(text[at])) is_after_comma = text[at] == ',';
  }
  return at;
}

/// Returns the position of the brace that closes the body that begins at `at`.
std::size_t EndOfTextBody(std::string_view text, std::size_t at, std::size_t end) {
  for (int depth = 0; at < end; at = AfterToken(text, at, end)) {
    if (text[at] == '{') ++depth;
    if (text[at] == '}' && depth-- == 0) return at;
  }
  return end;
}

std::vector<FbxNode> TextNodesIn(std::string_view text, FbxRange range) {
  std::vector<FbxNode> nodes;
  for (std::size_t at = range.begin, start = at; at < range.end;) {
    if (text[at] != ':') {
      // A name begins after the last blank, comment or quoted text.
      const std::size_t next = AfterToken(text, at, range.end);
      if (IsBlank(text[at]) || next > at + 1 || text[at] == ';') start = next;
      at = next;
      continue;
    }
    const FbxRange values{at + 1, EndOfTextValues(text, at + 1, range.end)};
    FbxNode node{text.substr(start, at - start), values, {values.end, values.end}};
    at = values.end;
    if (at < range.end && text[at] == '{') {
      node.children = {at + 1, EndOfTextBody(text, at + 1, range.end)};
      at = std::min(range.end, node.children.end + 1);
    }
    nodes.push_back(node);
    start = at;
  }
  return nodes;
}

std::vector<FbxValue> TextValuesIn(std::string_view text, FbxRange range) {
  std::vector<FbxValue> values;
  for (std::size_t at = range.begin; at < range.end;) {
    std::size_t end = at;
    while (end < range.end && text[end] != ',' && text[end] != ';') end = AfterToken(text, end, range.end);
    std::size_t begin = at;
    while (begin < end && IsBlank(text[begin])) ++begin;
    std::size_t last = end;
    while (last > begin && IsBlank(text[last - 1])) --last;
    const std::string_view here = text.substr(begin, last - begin);
    if (here.starts_with('*')) break;
    const bool is_text = here.starts_with('"');
    if (!here.empty()) {
      const std::string_view inner = is_text && here.size() > 1 ? here.substr(1, here.size() - 2) : here.substr(0, 0);
      values.push_back({{begin, last}, 0, is_text, inner});
    }
    at = end < range.end && text[end] == ';' ? AfterToken(text, end, range.end) : end + 1;
  }
  return values;
}

std::vector<FbxNode> NodesIn(std::string_view bytes, FbxRange range) {
  return IsText(bytes) ? TextNodesIn(bytes, range) : BinaryNodesIn(bytes, range);
}

/// Calls `use` with the number in its own type.
template <typename Use>
auto WithNumber(std::string_view bytes, const FbxValue& value, Use use) {
  switch (value.type) {
    case 'C':
      return use(NumberAt<std::int8_t>(bytes, value.range.begin));
    case 'Y':
      return use(NumberAt<std::int16_t>(bytes, value.range.begin));
    case 'I':
      return use(NumberAt<std::int32_t>(bytes, value.range.begin));
    case 'L':
      return use(NumberAt<std::int64_t>(bytes, value.range.begin));
    case 'F':
      return use(NumberAt<float>(bytes, value.range.begin));
    default:
      return use(NumberAt<double>(bytes, value.range.begin));
  }
}

}  // namespace

std::vector<FbxNode> FbxTopNodes(std::string_view bytes) {
  constexpr std::size_t kHeadBytes = 27;
  if (IsText(bytes)) return TextNodesIn(bytes, {0, bytes.size()});
  return bytes.size() < kHeadBytes ? std::vector<FbxNode>{} : BinaryNodesIn(bytes, {kHeadBytes, bytes.size()});
}

std::vector<FbxNode> FbxChildren(std::string_view bytes, const FbxNode& node) { return NodesIn(bytes, node.children); }

std::vector<FbxValue> FbxValues(std::string_view bytes, const FbxNode& node) {
  return IsText(bytes) ? TextValuesIn(bytes, node.values) : BinaryValuesIn(bytes, node.values);
}

double FbxNumber(std::string_view bytes, const FbxValue& value) {
  if (value.is_text) return 0;
  if (value.type != 0) return WithNumber(bytes, value, [](auto number) { return static_cast<double>(number); });
  return ParseFinite(bytes.substr(value.range.begin, value.range.end - value.range.begin)).value_or(0);
}

std::int64_t FbxInteger(std::string_view bytes, const FbxValue& value) {
  if (value.type == 'L') return NumberAt<std::int64_t>(bytes, value.range.begin);
  const std::string_view digits = bytes.substr(value.range.begin, value.range.end - value.range.begin);
  if (const auto whole = ParseNumber<std::int64_t>(digits); value.type == 0 && whole) return *whole;
  constexpr double kMaxExact = 9.0e15;
  const double number = FbxNumber(bytes, value);
  return number > -kMaxExact && number < kMaxExact ? static_cast<std::int64_t>(number) : 0;
}

std::vector<FbxProperty> FbxProperties(std::string_view bytes, const FbxNode& node) {
  constexpr std::size_t kTexts = 4;  // the name, two types, and flags
  std::vector<FbxProperty> properties;
  for (const FbxNode& table : FbxChildren(bytes, node)) {
    if (table.name != "Properties70") continue;
    for (const FbxNode& entry : FbxChildren(bytes, table)) {
      const std::vector<FbxValue> values = FbxValues(bytes, entry);
      if (values.size() <= kTexts || !values.front().is_text) continue;
      properties.push_back({values.front().text, {}});
      std::copy_if(values.begin() + kTexts, values.end(), std::back_inserter(properties.back().numbers),
                   [](const FbxValue& value) { return !value.is_text; });
    }
  }
  return properties;
}

std::vector<FbxProperty> FbxTemplate(std::string_view bytes, const FbxNode& definitions, std::string_view name) {
  for (const FbxNode& type : FbxChildren(bytes, definitions)) {
    for (const FbxNode& preset : FbxChildren(bytes, type)) {
      if (preset.name != "PropertyTemplate") continue;
      const std::vector<FbxValue> values = FbxValues(bytes, preset);
      if (!values.empty() && values.front().text == name) return FbxProperties(bytes, preset);
    }
  }
  return {};
}

double FbxNumberOf(std::string_view bytes, const std::vector<FbxProperty>& properties, std::string_view name,
                   double otherwise) {
  const auto found = std::ranges::find(properties, name, &FbxProperty::name);
  return found == properties.end() || found->numbers.empty() ? otherwise : FbxNumber(bytes, found->numbers.front());
}

std::vector<FbxLink> FbxLinks(std::string_view bytes, const FbxNode& connections) {
  std::vector<FbxLink> links;
  for (const FbxNode& node : FbxChildren(bytes, connections)) {
    const std::vector<FbxValue> values = FbxValues(bytes, node);
    if (values.size() < 3 || (values[0].text != "OO" && values[0].text != "OP")) continue;
    links.push_back({FbxInteger(bytes, values[1]), FbxInteger(bytes, values[2]),
                     values[0].text == "OP" && values.size() > 3 ? values[3].text : "", values[2]});
  }
  return links;
}

std::optional<FbxArray> FbxArrayOf(std::string_view bytes, const FbxNode& node) {
  constexpr std::size_t kHead = 1 + 3 * sizeof(std::uint32_t);
  const auto [begin, end] = node.values;
  if (IsText(bytes) || end - begin < kHead) return std::nullopt;
  const auto word = [&](std::size_t i) {
    return NumberAt<std::uint32_t>(bytes, begin + 1 + i * sizeof(std::uint32_t));
  };
  FbxArray array{bytes[begin], word(0), word(1) != 0, bytes.substr(begin + kHead, word(2))};
  const bool is_whole = word(2) <= end - begin - kHead;
  return is_whole && std::string_view("bilfd").find(array.type) != std::string_view::npos ? std::optional(array)
                                                                                          : std::nullopt;
}

std::string_view FbxNameOf(const std::vector<FbxValue>& values) {
  if (values.size() < 2 || !values[1].is_text) return "";
  const std::string_view text = values[1].text;
  if (values[1].type != 0) return text.substr(0, text.find('\0'));
  const std::size_t colons = text.find("::");
  return colons == std::string_view::npos ? text : text.substr(colons + 2);
}

void FbxEdits::Set(const FbxValue& value, std::int64_t number) {
  if (value.is_text) return;
  std::string written = std::to_string(number);
  if (value.type != 0) {
    WithNumber(bytes_, value, [&](auto old) {
      const auto fitting = static_cast<decltype(old)>(number);
      written.assign(sizeof fitting, '\0');
      std::memcpy(written.data(), &fitting, sizeof fitting);
    });
  }
  edits_.emplace_back(value.range, std::move(written));
}

std::string FbxEdits::Apply() {
  std::ranges::sort(edits_, {}, [](const auto& edit) { return edit.first.begin; });
  std::string changed;
  if (edits_.empty()) return changed;
  std::size_t copied = 0;
  for (const auto& [range, written] : edits_) {
    if (range.begin < copied) continue;
    changed += bytes_.substr(copied, range.begin - copied);
    changed += written;
    copied = range.end;
  }
  return changed += bytes_.substr(copied);
}

}  // namespace etude
