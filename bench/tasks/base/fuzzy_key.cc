#include "bench/tasks/base/fuzzy_key.h"

namespace etude {
namespace {

bool IsFuzzyFile(std::string_view reference) { return !reference.starts_with(kBuiltinFuzzySystem); }

}  // namespace

KeyInfo FuzzyKey() {
  return {kFuzzyKey, FileKind("`builtin:paper`, `builtin:gaussian`, or a file", IsFuzzyFile), "builtin:paper",
          "The fuzzy system that grades poses. It consists of membership functions, weights and rules."};
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

}  // namespace etude
