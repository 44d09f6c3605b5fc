#include "engine/document/node.h"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <optional>
#include <sstream>

#include "engine/base/utf8.h"

namespace etude {
namespace {

constexpr int kMaxNesting = 32;
constexpr int kMaxValues = 10'000;  // yaml-cpp's time grows with the square of the number of values

/// Estimates how deeply a text is nested: the depth of its brackets, or the length of its longest run of list markers,
/// whichever is larger. Deep nesting is a danger, because yaml-cpp's parser is recursive. The estimate may be too high.
/// Nesting by indentation is left to yaml-cpp's own guard.
int EstimateNesting(std::string_view text) {
  int deepest = 0;
  int brackets = 0;
  for (std::size_t i = 0; i < text.size();) {
    std::size_t end = text.find('\n', i);
    if (end == std::string_view::npos) end = text.size();
    const std::string_view line = text.substr(i, end - i);
    int markers = 0;  // each marker of "- - - x" or "? ? ? x" opens a level
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      const bool marker = (line[k] == '-' || line[k] == '?') && line[k + 1] == ' ';
      if (line[k] != ' ' && !marker) break;
      if (marker) ++markers;
    }
    // Brackets stay open across lines.
    for (char c : line) {
      if (c == '[' || c == '{') ++brackets;
      if ((c == ']' || c == '}') && brackets > 0) --brackets;
      deepest = std::max(deepest, brackets);
    }
    deepest = std::max(deepest, markers);
    i = end + 1;
  }
  return deepest;
}

/// Refuses control characters (C0 except tabs and line ends, delete, C1), because texts of a document reach terminals
/// and web pages.
Result<void> CheckControls(std::string_view text, const Place& place) {
  for (std::size_t at = 0; at < text.size(); ++at) {
    const auto byte = static_cast<unsigned char>(text[at]);
    const bool is_c1 = byte == 0xc2 && at + 1 < text.size() && static_cast<unsigned char>(text[at + 1]) < 0xa0;
    if ((byte >= ' ' && byte != 0x7f && !is_c1) || byte == '\n' || byte == '\t') continue;
    return Fail(place, "found the control character U+{:04X}; allowed: text, tabs and line ends",
                is_c1 ? static_cast<unsigned char>(text[at + 1]) : byte);
  }
  return {};
}

// Refuses a carriage return without a line feed. yaml-cpp 0.8 ends a line at such a carriage return; older versions
// treat it as text.
Result<void> CheckLineEnds(std::string_view text, const std::string& file) {
  int line = 1;
  std::size_t start = 0;  // start of the current line
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] == '\n') {
      ++line;
      start = at + 1;
    }
    if (text[at] == '\r' && text.substr(at + 1, 1) != "\n") {
      return Fail({file, line, static_cast<int>(at - start) + 1},
                  "found a carriage return without a line feed; allowed: lines that end in \\n or \\r\\n");
    }
  }
  return {};
}

// Converts yaml-cpp's tree to nodes with positions.
class Builder {
 public:
  explicit Builder(std::string file) : file_(std::move(file)) {}

  Result<Node> Build(const YAML::Node& yaml, int depth) {
    Node node;
    node.place = At(yaml.Mark());
    if (depth > kMaxNesting) return Fail(node.place, "nested more than {} levels deep", kMaxNesting);
    switch (yaml.Type()) {
      case YAML::NodeType::Scalar:
        node.kind = Node::Kind::kScalar;
        node.scalar = yaml.Scalar();
        RETURN_IF_ERROR(CheckControls(node.scalar, node.place));
        break;
      case YAML::NodeType::Sequence:
        node.kind = Node::Kind::kSequence;
        for (const auto& child : yaml) {
          auto item = Build(child, depth + 1);
          if (!item) return item;
          node.items.push_back(std::move(*item));
        }
        break;
      case YAML::NodeType::Map:
        node.kind = Node::Kind::kMapping;
        // Keys must be unique plain texts.
        for (const auto& pair : yaml) {
          const Place key_place = At(pair.first.Mark());
          if (!pair.first.IsScalar()) return Fail(key_place, "a key must be plain text");
          const std::string key = pair.first.Scalar();
          RETURN_IF_ERROR(CheckControls(key, key_place));
          if (node.Find(key) != nullptr) return Fail(key_place, "the key '{}' appears twice here", key);
          auto value = Build(pair.second, depth + 1);
          if (!value) return value;
          // For an empty value, yaml-cpp reports the position of the next token.
          if (value->kind == Node::Kind::kNull) value->place = key_place;
          node.entries.push_back({key, key_place, std::move(*value)});
        }
        break;
      default:
        break;
    }
    return node;
  }

  Place At(const YAML::Mark& mark) const {
    if (mark.is_null()) return {file_, 0, 0};
    return {file_, mark.line + 1, mark.column + 1};
  }

 private:
  std::string file_;
};

/// Checks the event stream of a document before the document is loaded. An alias (`*name`) repeats a whole subtree, so
/// a few lines can expand to gigabytes. Loading expands aliases silently, so they must be found first.
class DocumentCheck : public YAML::EventHandler {
 public:
  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override { ++values; }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    if (alias.is_null()) alias = mark;
  }
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t, const std::string&) override { ++values; }
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {
    ++values;
  }
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {
    ++values;
  }
  void OnMapEnd() override {}

  YAML::Mark alias = YAML::Mark::null_mark();
  int values = 0;
};

/// Returns the reason why a text has more than one document. YAML also ends a document before a line that is indented
/// less than the document's first line.
Error WhySecondDocument(std::string_view text, const std::string& file) {
  std::optional<std::size_t> first;  // the indentation of the first line
  int first_line = 0;
  for (int number = 1; !text.empty(); ++number) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    const std::size_t indent = line.find_first_not_of(' ');
    if (indent == std::string_view::npos || line[indent] == '#' || line[indent] == '\r') continue;
    const bool is_mark = line.starts_with("---") || line.starts_with("...") || line.starts_with('%');
    if (is_mark && !first) continue;
    if (is_mark) break;
    if (!first) first_line = number;
    if (!first) first = indent;
    if (indent < *first) {
      return {{file, number, 0},
              fmt::format("is indented less than the first line, which is line {}; allowed: the same indentation",
                          first_line)};
    }
  }
  return {{file, 0, 0}, "found more than one YAML document (---); allowed: one"};
}

}  // namespace

const Node* Node::Find(std::string_view key) const {
  for (const Entry& entry : entries) {
    if (entry.key == key) return &entry.value;
  }
  return nullptr;
}

Result<Node> ParseYaml(std::string_view text, const std::string& file, std::size_t max_bytes) {
  const Place whole{file, 0, 0};
  if (text.size() > max_bytes) {
    return Fail(whole, "found {} bytes of YAML; allowed: at most {}", text.size(), max_bytes);
  }
  if (auto utf8 = CheckUtf8(text, file); !utf8) return tl::unexpected(utf8.error());
  RETURN_IF_ERROR(CheckLineEnds(text, file));
  if (EstimateNesting(text) > kMaxNesting) return Fail(whole, "nested more than {} levels deep", kMaxNesting);
  Builder builder(file);
  try {
    // Check the events first, then load.
    std::istringstream events{std::string(text)};
    DocumentCheck survey;
    YAML::Parser parser(events);
    parser.HandleNextDocument(survey);
    if (!survey.alias.is_null())
      return Fail(builder.At(survey.alias), "aliases (*name) are not supported; write the value itself");
    if (survey.values > kMaxValues)
      return Fail(whole, "found {} values; allowed: at most {}", survey.values, kMaxValues);
    if (parser.HandleNextDocument(survey)) return tl::unexpected(WhySecondDocument(text, file));
    return builder.Build(YAML::Load(std::string(text)), 0);
  } catch (const YAML::Exception& error) {
    return Fail(builder.At(error.mark), "not valid YAML: {}", error.msg);
  }
}

std::size_t CountValues(const Node& node) {
  std::size_t count = 1;
  for (const Node& item : node.items) count += CountValues(item);
  for (const Node::Entry& entry : node.entries) count += CountValues(entry.value);
  return count;
}

std::string Describe(const Node& node) {
  switch (node.kind) {
    case Node::Kind::kScalar:
      return fmt::format("'{}'", node.scalar.substr(0, 60));
    case Node::Kind::kSequence:
      return "a list";
    case Node::Kind::kMapping:
      return "a mapping";
    case Node::Kind::kNull:
      break;
  }
  return "nothing";
}

}  // namespace etude
