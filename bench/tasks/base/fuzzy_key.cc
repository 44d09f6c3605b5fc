#include "bench/tasks/base/fuzzy_key.h"

namespace etude {
namespace {

constexpr std::string_view kBuiltin = "builtin:";

bool IsFuzzyFile(std::string_view reference) { return !reference.starts_with(kBuiltin); }

}  // namespace

KeyInfo FuzzyKey() {
  return {kFuzzyKey, FileKind("`builtin:paper`, `builtin:gaussian`, a file", IsFuzzyFile), "builtin:paper",
          "The fuzzy system that poses are graded by: membership functions, weights, rules."};
}

Result<FuzzySystem> FuzzySystemOf(const TaskInput& input) {
  const Node* named = input.condition.node().Find(kFuzzyKey);
  if (named == nullptr) return FuzzySystem{};
  if (named->kind != Node::Kind::kScalar || named->scalar.empty()) {
    return Fail(named->place, "'{}' must be builtin:NAME or a file, found {}", kFuzzyKey, Describe(*named));
  }
  return OpenFuzzySystem(named->scalar, named->place,
                         [&](const std::string&) -> Result<std::string> { return input.texts.at(kFuzzyKey); });
}

Result<FuzzySystem> OpenFuzzySystem(const std::string& reference, const Place& asked_at, const FuzzyTextOf& text_of) {
  if (!IsFuzzyFile(reference)) return LoadBuiltinFuzzySystem(reference.substr(kBuiltin.size()), asked_at);
  ASSIGN_OR_RETURN(const auto text, text_of(reference));
  return ReadFuzzySystem(text, reference);
}

}  // namespace etude
