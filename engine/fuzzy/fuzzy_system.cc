#include "engine/fuzzy/fuzzy_system.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "engine/base/named.h"
#include "engine/base/names.h"
#include "engine/base/result.h"
#include "engine/base/text.h"
#include "engine/document/fields.h"
#include "engine/document/node.h"
#include "engine/fuzzy/distance.h"
#include "engine/fuzzy/membership.h"

namespace etude {
namespace {

/// The part of a fuzzy system that a file sets per feature: memberships and weights.
struct FeatureSettings {
  Memberships memberships;
  FeatureWeights weights{};  ///< the weights, scaled to sum to 8
};

std::vector<std::string> FeatureNames() { return NamesOf(AllFeatures(), FeatureName); }

std::vector<std::string> TermNames(Feature feature) { return NamesOf(TermsOf(feature)); }

/// Returns the features in a key such as "RH, LH". They share the settings under the key.
Result<std::vector<Feature>> ReadGroup(const Node::Entry& entry) {
  std::vector<Feature> group;
  for (const std::string_view word : SplitAt(entry.key, ',')) {
    const std::string_view name = Trimmed(word);
    const Feature* feature = FindFeature(name);
    if (feature == nullptr) return Fail(entry.place, "{}", UnknownName("feature", name, FeatureNames()));
    group.push_back(*feature);
    if (TermNames(*feature) != TermNames(group.front())) {
      return Fail(entry.place, "the features {} and {} have different terms ({}; {}), so they cannot share a key",
                  FeatureName(group.front()), name, Join(TermNames(group.front())), Join(TermNames(*feature)));
    }
  }
  return group;
}

Result<Universe> ReadUniverse(Fields& fields) {
  constexpr double kMaxNumber = 1e6;  // the same limit as for the numbers of shapes
  const Node* node = fields.Raw("universe");
  const std::vector<double> ends = fields.Numbers("universe", {-kMaxNumber, kMaxNumber});
  if (node != nullptr && fields.ok() && ends.size() == 2 && ends[0] < ends[1]) return Universe{ends[0], ends[1]};
  fields.Complain(node == nullptr ? fields.node().place : node->place,
                  "'universe' must be two increasing numbers, such as [0, 180]");
  return tl::unexpected(fields.Finish().error());
}

/// Reads the settings of all features from a file.
class FeaturesReader {
 public:
  Result<void> ReadFeature(const Node::Entry& entry) {
    // Read the names of the features; each name may occur only once in a file.
    ASSIGN_OR_RETURN(const auto group, ReadGroup(entry));
    for (Feature feature : group) {
      bool& seen = seen_[static_cast<std::size_t>(feature)];
      if (seen) return Fail(entry.place, "found the feature {} twice; allowed: once", FeatureName(feature));
      seen = true;
    }
    // Read the universe, the terms and the weight that these features share.
    Fields fields(entry.value, "the feature " + entry.key);
    ASSIGN_OR_RETURN(const auto universe, ReadUniverse(fields));
    const std::optional<double> weight = fields.OptionalNumber("weight", {0, 1e6});
    if (!weight) fields.Complain(entry.place, fmt::format("{} needs a 'weight' (S of equation 1)", entry.key));
    const Node* terms = fields.Raw("terms");
    if (terms == nullptr) fields.Complain(entry.place, fmt::format("{} needs 'terms'", entry.key));
    RETURN_IF_ERROR(fields.Finish());
    ASSIGN_OR_RETURN(const auto shapes, ReadTerms(entry.key, group.front(), *terms, universe));
    // Give these settings to every feature of the group.
    for (Feature feature : group) {
      const std::size_t k = static_cast<std::size_t>(feature);
      memberships_.universes[k] = universe;
      weights_[k] = *weight;
      std::ranges::copy(shapes, memberships_.shapes.begin() + static_cast<std::ptrdiff_t>(FirstTermOf(feature)));
    }
    return {};
  }

  /// Returns an error if a feature is missing; scales the weights to sum to 8.
  Result<void> Finish(const Place& place) {
    std::vector<std::string> missing;
    for (std::size_t k = 0; k < kFeatureCount; ++k) {
      if (!seen_[k]) missing.emplace_back(FeatureName(AllFeatures()[k]));
    }
    if (!missing.empty()) return Fail(place, "'features' lacks {}; all ten features are needed", Join(missing));
    double sum = 0;
    for (double weight : weights_) sum += weight;
    if (sum == 0) return Fail(place, "all weights are 0; allowed: at least one positive weight");
    constexpr double kRounding = 1e-12;  // a smaller deviation from 8 is kept: written weights must not change
    if (std::abs(sum - kWeightSum) > kRounding) {
      for (double& weight : weights_) weight *= kWeightSum / sum;
    }
    return {};
  }

  FeatureSettings settings() const { return {memberships_, weights_}; }

 private:
  static Result<std::vector<Shape>> ReadTerms(const std::string& name, Feature feature, const Node& node,
                                              const Universe& universe) {
    Fields fields(node, "'terms' of " + name);
    std::vector<Shape> shapes;
    for (const std::string& term : TermNames(feature)) {
      const Node* shape_node = fields.Raw(term);
      if (shape_node == nullptr) continue;  // Finish() reports unknown keys first: a misspelt term is the likely cause
      ASSIGN_OR_RETURN(const auto shape, ReadShape(*shape_node, universe));
      shapes.push_back(shape);
    }
    RETURN_IF_ERROR(fields.Finish());
    if (shapes.size() < TermsOf(feature).size()) {
      return Fail(node.place, "{} needs all its terms: {}", name, Join(TermNames(feature)));
    }
    return shapes;
  }

  Memberships memberships_;
  FeatureWeights weights_{};
  std::array<bool, kFeatureCount> seen_{};
};

/// Returns the lines that WriteFeatures puts below a feature's name.
std::string Written(Feature feature, const FeatureSettings& settings) {
  const std::size_t k = static_cast<std::size_t>(feature);
  const Universe& universe = settings.memberships.universes[k];
  std::string text = fmt::format("    universe: [{}, {}]\n    weight: {}\n    terms:\n", universe.low, universe.high,
                                 settings.weights[k]);
  std::size_t i = FirstTermOf(feature);
  for (const Term& term : TermsOf(feature)) {
    text += fmt::format("      {}: {}\n", term.name, WriteShape(settings.memberships.shapes[i++]));
  }
  return text;
}

/// Reads the mapping under `features`: all ten features of paper A's table 1 with all their terms and no others.
/// Features with equal settings may share a key, for example "RH, LH".
Result<FeatureSettings> ReadFeatures(const Node& node) {
  if (node.kind != Node::Kind::kMapping) {
    return Fail(node.place, "'features' must map each feature to its terms (RH, LH: …), found {}", Describe(node));
  }
  FeaturesReader reader;
  for (const Node::Entry& entry : node.entries) {
    RETURN_IF_ERROR(reader.ReadFeature(entry));
  }
  RETURN_IF_ERROR(reader.Finish(node.place));
  return reader.settings();
}

/// Returns the lines below `features`; features with equal settings share a key.
std::string WriteFeatures(const FeatureSettings& settings) {
  std::vector<std::pair<std::string, std::string>> groups;  // names of features, and the lines below these names
  for (Feature feature : AllFeatures()) {
    const std::string text = Written(feature, settings);
    const auto alike = std::ranges::find(groups, text, &std::pair<std::string, std::string>::second);
    if (alike != groups.end()) {
      alike->first += fmt::format(", {}", FeatureName(feature));
    } else {
      groups.emplace_back(FeatureName(feature), text);
    }
  }
  std::string text;
  for (const auto& [names, below] : groups) text += fmt::format("  {}:\n{}", names, below);
  return text;
}

constexpr std::size_t kMaxRules = 100;
constexpr std::size_t kMaxPoseNameBytes = 40;

/// Returns true if a name needs no quotes in a file or in tables.
bool IsPoseName(const std::string& name) {
  const auto is_letter = [](char c) { return IsLower(c) || IsUpper(c); };
  const auto is_plain = [&](char c) { return is_letter(c) || IsDigit(c) || c == ' ' || c == '-'; };
  return !name.empty() && name.size() <= kMaxPoseNameBytes && std::ranges::all_of(name, is_plain) &&
         is_letter(name.front()) && name.back() != ' ';
}

/// Returns the index in `AllTerms` of an entry such as "RH: up".
Result<std::size_t> ReadTerm(const Node::Entry& entry) {
  const Feature* feature = FindFeature(entry.key);
  if (feature == nullptr) return Fail(entry.place, "{}", UnknownName("feature", entry.key, FeatureNames()));
  const std::vector<std::string> names = TermNames(*feature);
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
  // Check that the premise names terms and that the conclusion names a pose.
  if (premise == nullptr || premise->kind != Node::Kind::kMapping || premise->entries.empty()) {
    return Fail(premise == nullptr ? node.place : premise->place,
                "'if' must map features to terms, such as {{RH: up, LH: up}}, found {}",
                premise == nullptr ? "nothing" : Describe(*premise));
  }
  if (!IsPoseName(pose)) {
    return Fail(fields.Raw("then")->place,
                "{} is not a valid name of a pose; allowed: a letter, then letters, digits, spaces and '-'; at most {} "
                "characters",
                Quote(pose), kMaxPoseNameBytes);
  }
  // Replace the names by indices.
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

/// Reads the list under `rules`, for example `- {if: {RH: up, LH: up}, then: arms up}`. The list may have at most 100
/// rules.
Result<RuleBase> ReadRules(const Node& node) {
  if (node.kind != Node::Kind::kSequence || node.items.size() > kMaxRules) {
    return Fail(node.place, "'rules' must be a list of at most {} rules, found {}", kMaxRules,
                node.kind == Node::Kind::kSequence ? fmt::format("{}", node.items.size()) : Describe(node));
  }
  RuleBase base;
  for (const Node& item : node.items) {
    RETURN_IF_ERROR(ReadRule(item, base));
  }
  return base;
}

/// Returns the text of the key `rules` of a YAML file, without the line `rules:`.
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

constexpr std::size_t kMaxNameBytes = 80;

bool IsPlainName(const std::string& name) {
  const auto is_plain = [](char c) {
    return IsLower(c) || IsUpper(c) || IsDigit(c) || c == '-' || c == '_' || c == '.';
  };
  return name.size() <= kMaxNameBytes && std::ranges::all_of(name, is_plain);
}

/// Returns paper A's system. A test proves that its file can be read.
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
    fields.Complain(
        fields.Raw("system")->place,
        fmt::format("{} is not a valid name; allowed: at most {} characters, each a letter, a digit, '-', '_' or '.'",
                    Quote(name), kMaxNameBytes));
  }
  const Node* features_node = fields.Raw("features");
  if (features_node == nullptr) fields.Complain(document.place, "a fuzzy system needs 'features'");
  const Node* rules_node = fields.Raw("rules");
  RETURN_IF_ERROR(fields.Finish());
  ASSIGN_OR_RETURN(const auto features, ReadFeatures(*features_node));
  ASSIGN_OR_RETURN(const auto rules, rules_node != nullptr ? ReadRules(*rules_node) : RuleBase{});
  // Set every member explicitly: a default would call PaperSystem(), which may be loading this very system.
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

std::vector<double> InferPoses(const RuleBase& base, const Grades& grades) {
  std::vector<double> activations(base.poses.size(), 0.0);
  for (const Rule& rule : base.rules) {
    double weakest = 1;
    for (std::size_t term : rule.terms) weakest = std::min(weakest, grades[term]);
    activations[rule.pose] = std::max(activations[rule.pose], weakest);
  }
  return activations;
}

const std::string* ChoosePose(const RuleBase& base, const Grades& grades) {
  const std::vector<double> activations = InferPoses(base, grades);
  const auto strongest = std::ranges::max_element(activations);
  if (strongest == activations.end() || *strongest == 0) return nullptr;
  return &base.poses[static_cast<std::size_t>(strongest - activations.begin())];
}

}  // namespace etude
