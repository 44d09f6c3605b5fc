#include "engine/fuzzy/fuzzy_system.h"

#include <algorithm>

#include "engine/base/named.h"
#include "engine/base/names.h"
#include "engine/document/fields.h"
#include "engine/fuzzy/features_text.h"
#include "engine/fuzzy/rules_text.h"

namespace etude {
namespace {

constexpr std::size_t kLongestName = 80;

bool IsPlainName(const std::string& name) {
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_' ||
           c == '.';
  };
  return name.size() <= kLongestName && std::ranges::all_of(name, is_plain);
}

/// Paper A's own. That its file reads is proven by a test.
const FuzzySystem& PaperSystem() {
  static const FuzzySystem paper = LoadBuiltinFuzzySystem("paper", {}).value();
  return paper;
}

}  // namespace

const Memberships& PaperMemberships() { return PaperSystem().memberships; }
FeatureWeights PaperWeights() { return PaperSystem().weights; }
const RuleBase& PaperRules() { return PaperSystem().rules; }

Result<FuzzySystem> ReadFuzzySystem(std::string_view text, const std::string& file) {
  ASSIGN_OR_RETURN(const auto document, ParseYaml(text, file));
  Fields fields(document, "a fuzzy system");
  const std::string name = fields.RequiredText("system");
  if (fields.ok() && !IsPlainName(name)) {
    fields.Complain(fields.Raw("system")->place,
                    fmt::format("{} is no name: at most {} letters, digits, '-', '_', '.'", Quote(name), kLongestName));
  }
  const Node* features_node = fields.Raw("features");
  if (features_node == nullptr) fields.Complain(document.place, "a fuzzy system needs 'features'");
  const Node* rules_node = fields.Raw("rules");
  RETURN_IF_ERROR(fields.Finish());
  ASSIGN_OR_RETURN(const auto features, ReadFeatures(*features_node));
  ASSIGN_OR_RETURN(const auto rules, rules_node != nullptr ? ReadRules(*rules_node) : RuleBase{});
  // Every member is given, so that no default asks for the paper's system: it is read here itself.
  return FuzzySystem{.name = name, .memberships = features.memberships, .weights = features.weights, .rules = rules};
}

std::string WriteFuzzySystem(const FuzzySystem& system) {
  std::string text =
      fmt::format("system: {}\nfeatures:\n{}", system.name, WriteFeatures({system.memberships, system.weights}));
  if (!system.rules.rules.empty()) text += "rules:\n" + WriteRules(system.rules);
  return text;
}

std::vector<std::string> BuiltinFuzzySystemNames() { return NamesOf(BuiltinFuzzySystemFiles(), StemOf); }

Result<FuzzySystem> LoadBuiltinFuzzySystem(const std::string& name, const Place& place) {
  const EmbeddedText* file = FindByName(BuiltinFuzzySystemFiles(), name, StemOf);
  if (file == nullptr) {
    return Fail(place, "{}", UnknownName("fuzzy system", name, BuiltinFuzzySystemNames()));
  }
  return ReadFuzzySystem(file->text, "scenarios/fuzzy/" + std::string(file->name));
}

}  // namespace etude
