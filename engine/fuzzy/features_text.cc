#include "engine/fuzzy/features_text.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/base/names.h"
#include "engine/document/fields.h"
#include "engine/fuzzy/shape_text.h"

namespace etude {
namespace {

std::vector<std::string> FeatureNames() {
  std::vector<std::string> names;
  for (Feature feature : AllFeatures()) names.emplace_back(FeatureName(feature));
  return names;
}

std::vector<std::string> TermNames(Feature feature) {
  std::vector<std::string> names;
  for (const Term& term : TermsOf(feature)) names.emplace_back(term.name);
  return names;
}

/// The features that "RH, LH" names: they share what stands under it.
Result<std::vector<Feature>> ReadGroup(const Node::Entry& entry) {
  std::vector<Feature> group;
  std::string_view rest = entry.key;
  while (true) {
    const std::size_t comma = rest.find(',');
    std::string_view name = rest.substr(0, comma);
    while (name.starts_with(' ')) name.remove_prefix(1);
    while (name.ends_with(' ')) name.remove_suffix(1);
    const Feature* feature = FindFeature(name);
    if (feature == nullptr) return Fail(entry.place, "{}", UnknownName("feature", name, FeatureNames()));
    group.push_back(*feature);
    if (TermNames(*feature) != TermNames(group.front())) {
      return Fail(entry.place, "{} and {} have other terms ({}; {}), so they cannot stand together",
                  FeatureName(group.front()), name, Join(TermNames(group.front())), Join(TermNames(*feature)));
    }
    if (comma == std::string_view::npos) return group;
    rest.remove_prefix(comma + 1);
  }
}

Result<Universe> ReadUniverse(Fields& fields) {
  constexpr double kLargest = 1e6;  // as of shapes
  const Node* node = fields.Raw("universe");
  const std::vector<double> ends = fields.Numbers("universe", {-kLargest, kLargest});
  if (node != nullptr && fields.ok() && ends.size() == 2 && ends[0] < ends[1]) return Universe{ends[0], ends[1]};
  fields.Complain(node == nullptr ? fields.node().place : node->place,
                  "'universe' must be two rising numbers, such as [0, 180]");
  return tl::unexpected(fields.Finish().error());
}

/// The file's features, put together.
class FeaturesReader {
 public:
  Result<void> ReadFeature(const Node::Entry& entry) {
    ASSIGN_OR_RETURN(const auto group, ReadGroup(entry));
    for (Feature feature : group) {
      bool& seen = seen_[static_cast<std::size_t>(feature)];
      if (seen) return Fail(entry.place, "the feature {} stands here twice", FeatureName(feature));
      seen = true;
    }
    Fields fields(entry.value, "the feature " + entry.key);
    ASSIGN_OR_RETURN(const auto universe, ReadUniverse(fields));
    const std::optional<double> weight = fields.OptionalNumber("weight", {0, 1e6});
    if (!weight) fields.Complain(entry.place, fmt::format("{} needs a 'weight' (S of equation 1)", entry.key));
    const Node* terms = fields.Raw("terms");
    if (terms == nullptr) fields.Complain(entry.place, fmt::format("{} needs 'terms'", entry.key));
    RETURN_IF_ERROR(fields.Finish());
    ASSIGN_OR_RETURN(const auto shapes, ReadTerms(entry.key, group.front(), *terms, universe));
    for (Feature feature : group) {
      const std::size_t k = static_cast<std::size_t>(feature);
      memberships_.universes[k] = universe;
      weights_[k] = *weight;
      std::ranges::copy(shapes, memberships_.shapes.begin() + static_cast<std::ptrdiff_t>(FirstTermOf(feature)));
    }
    return {};
  }

  /// What is still missing, else the weights scaled.
  Result<void> Finish(const Place& place) {
    std::vector<std::string> missing;
    for (std::size_t k = 0; k < kFeatureCount; ++k) {
      if (!seen_[k]) missing.emplace_back(FeatureName(AllFeatures()[k]));
    }
    if (!missing.empty()) return Fail(place, "'features' lacks {}; all ten must be there", Join(missing));
    double sum = 0;
    for (double weight : weights_) sum += weight;
    if (sum == 0) return Fail(place, "all weights are 0; at least one must be positive");
    constexpr double kRounding = 1e-12;  // what is written is read back as it was
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
      if (shape_node == nullptr) continue;  // an unknown key is the likelier cause: told first
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

/// What stands under a feature's name.
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

}  // namespace

Result<FeatureSettings> ReadFeatures(const Node& node) {
  if (node.kind != Node::Kind::kMapping) {
    return Fail(node.place, "'features' must map features to their terms (RH, LH: …), found {}", Describe(node));
  }
  FeaturesReader reader;
  for (const Node::Entry& entry : node.entries) {
    RETURN_IF_ERROR(reader.ReadFeature(entry));
  }
  RETURN_IF_ERROR(reader.Finish(node.place));
  return reader.settings();
}

std::string WriteFeatures(const FeatureSettings& settings) {
  std::vector<std::pair<std::string, std::string>> groups;  // the names, and what stands under them
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

}  // namespace etude
