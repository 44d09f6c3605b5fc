#include "bench/tasks/plausibility/options.h"

#include "bench/tasks/plausibility/judge.h"

namespace etude {
namespace {

constexpr Range kAnyLimit{0, 1e9};

std::vector<KeyInfo> LimitKeys() {
  std::vector<KeyInfo> keys;
  for (const std::string& id : LimitedMetrics()) {
    keys.push_back({id, NumberKind(kAnyLimit), "(no limit)", "The largest allowed value of this metric."});
  }
  return keys;
}

}  // namespace

std::map<std::string, double> ReadLimits(Fields& fields) {
  std::map<std::string, double> limits;
  for (const std::string& id : LimitedMetrics()) {
    if (const auto limit = fields.OptionalNumber(id, kAnyLimit)) limits[id] = *limit;
  }
  return limits;
}

const FieldTable<PlausibilityOptions>& PlausibilityConditionFields() {
  using Key = Field<PlausibilityOptions>;
  static const FieldTable<PlausibilityOptions> table{
      {Key::Number("floor_m", &PlausibilityOptions::floor_m, {-1000, 1000}, "The height of the floor, in metres.")
           .WhenAbsent(
               "(0; if the clip's lowest joints are more than 60 cm from 0, the height at which the feet rest)"),
       Key::Text("people", &PlausibilityOptions::people, "a pattern such as '{person}_*'",
                 "A pattern that marks the part of a clip's name that identifies the person. Verdicts that are meant "
                 "for other files count each person once.")
           .WhenAbsent("(each clip counts once)"),
       {{"at_most", MappingKind("a mapping", LimitKeys()), "{}",
         "The largest allowed values of metrics. The metric `within_limits` shows which clips keep all these limits."},
        [](Fields& fields, PlausibilityOptions& options) {
          const Node* node = fields.Raw("at_most");
          if (node == nullptr) return;
          Fields limits(*node, "'at_most'");
          options.limits = ReadLimits(limits);
          if (const auto read = limits.Finish(); !read) fields.Complain(read.error().place, read.error().message);
        }}}};
  return table;
}

const FieldTable<PlausibilityMethod>& PlausibilityMethodFields() {
  using Key = Field<PlausibilityMethod>;
  static const FieldTable<PlausibilityMethod> table{
      {Key::Texts("answers", &PlausibilityMethod::answers, "a list of motion files, patterns and folders",
                  "The motions that are judged.")}};
  return table;
}

}  // namespace etude
