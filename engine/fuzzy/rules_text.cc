#include "engine/fuzzy/rules_text.h"

#include <algorithm>

#include "engine/base/names.h"
#include "engine/document/fields.h"

namespace etude {
namespace {

constexpr std::size_t kMostRules = 100;
constexpr std::size_t kLongestPose = 40;

/// Plain enough to be written back, and shown, without quotes.
bool IsPoseName(const std::string& name) {
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == ' ' || c == '-';
  };
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  return !name.empty() && name.size() <= kLongestPose && std::ranges::all_of(name, is_plain) &&
         is_letter(name.front()) && name.back() != ' ';
}

/// The place in `AllTerms` of what "RH: up" names.
Result<std::size_t> ReadTerm(const Node::Entry& entry) {
  const Feature* feature = FindFeature(entry.key);
  if (feature == nullptr) {
    std::vector<std::string> names;
    for (Feature known : AllFeatures()) names.emplace_back(FeatureName(known));
    return Fail(entry.place, "{}", UnknownName("feature", entry.key, names));
  }
  std::vector<std::string> names;
  for (const Term& term : TermsOf(*feature)) names.emplace_back(term.name);
  const std::string wanted = entry.value.kind == Node::Kind::kScalar ? entry.value.scalar : Describe(entry.value);
  const auto found = std::ranges::find(names, wanted);
  if (found == names.end()) return Fail(entry.value.place, "{}", UnknownName("term of " + entry.key, wanted, names));
  return FirstTermOf(*feature) + static_cast<std::size_t>(found - names.begin());
}

Result<void> ReadRule(const Node& node, RuleBase& base) {
  Fields fields(node, "a rule");
  const Node* premise = fields.Raw("if");
  const std::string pose = fields.RequiredText("then");
  RETURN_IF_ERROR(fields.Finish());
  if (premise == nullptr || premise->kind != Node::Kind::kMapping || premise->entries.empty()) {
    return Fail(premise == nullptr ? node.place : premise->place, "'if' must name terms ({{RH: up, LH: up}}), found {}",
                premise == nullptr ? "nothing" : Describe(*premise));
  }
  if (!IsPoseName(pose)) {
    return Fail(fields.Raw("then")->place,
                "{} is no pose's name: at most {} letters, digits, spaces, '-', a letter first", Quote(pose),
                kLongestPose);
  }
  Rule rule;
  for (const Node::Entry& entry : premise->entries) {
    ASSIGN_OR_RETURN(const auto term, ReadTerm(entry));
    rule.terms.push_back(term);
  }
  const auto known = std::ranges::find(base.poses, pose);
  rule.pose = static_cast<std::size_t>(known - base.poses.begin());
  if (known == base.poses.end()) base.poses.push_back(pose);
  base.rules.push_back(std::move(rule));
  return {};
}

}  // namespace

Result<RuleBase> ReadRules(const Node& node) {
  if (node.kind != Node::Kind::kSequence || node.items.size() > kMostRules) {
    return Fail(node.place, "'rules' must be a list of at most {} rules, found {}", kMostRules,
                node.kind == Node::Kind::kSequence ? fmt::format("{}", node.items.size()) : Describe(node));
  }
  RuleBase base;
  for (const Node& item : node.items) {
    RETURN_IF_ERROR(ReadRule(item, base));
  }
  return base;
}

std::string WriteRules(const RuleBase& base) {
  std::string text;
  for (const Rule& rule : base.rules) {
    std::vector<std::string> premise;
    for (std::size_t i : rule.terms) {
      const Term& term = AllTerms()[i];
      premise.push_back(fmt::format("{}: {}", FeatureName(term.feature), term.name));
    }
    text += fmt::format("  - {{if: {{{}}}, then: {}}}\n", Join(premise), base.poses[rule.pose]);
  }
  return text;
}

}  // namespace etude
