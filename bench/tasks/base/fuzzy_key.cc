#include "bench/tasks/base/fuzzy_key.h"

namespace etude {
namespace {

constexpr std::string_view kBuiltin = "builtin:";

}  // namespace

KeyInfo FuzzyKey() {
  return {kFuzzyKey, TextKind("`builtin:paper`, `builtin:gaussian`, a file"), "builtin:paper",
          "The fuzzy system that poses are graded by: membership functions, weights, rules."};
}

bool IsFuzzyFile(std::string_view reference) { return !reference.starts_with(kBuiltin); }

Result<FuzzySystem> OpenFuzzySystem(const std::string& reference, const Place& asked_at, const FuzzyTextOf& text_of) {
  if (!IsFuzzyFile(reference)) return LoadBuiltinFuzzySystem(reference.substr(kBuiltin.size()), asked_at);
  ASSIGN_OR_RETURN(const auto text, text_of(reference));
  return ReadFuzzySystem(text, reference);
}

}  // namespace etude
