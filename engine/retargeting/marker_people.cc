#include "engine/retargeting/marker_people.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <string_view>
#include <utility>

#include "engine/base/order_statistics.h"

namespace etude {
namespace {

constexpr std::string_view kSeparators = "_.-/ :";
/// So many markers of the same names are not a coincidence. (A person needs at least twelve.)
constexpr std::size_t kMinAlike = 6;

/// Text at the beginning or at the end of markers' names.
struct Affix {
  std::string text;
  bool is_suffix = false;
  auto operator<=>(const Affix&) const = default;
  /// Returns the text without the separators at its ends, unless it consists of separators.
  std::string Name() const {
    const std::size_t first = text.find_first_not_of(kSeparators), last = text.find_last_not_of(kSeparators);
    return first == std::string::npos ? text : text.substr(first, last + 1 - first);
  }
};

/// Lists the ways to split a name into an affix and the rest.
std::vector<std::pair<Affix, std::string>> SplitsOf(const std::string& name) {
  constexpr std::size_t kMaxName = 100;
  std::vector<std::pair<Affix, std::string>> splits;
  if (name.size() > kMaxName) return splits;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (kSeparators.find(name[i]) == std::string_view::npos) continue;
    if (i + 1 < name.size()) splits.push_back({{name.substr(0, i + 1), false}, name.substr(i + 1)});
    if (i > 0) splits.push_back({{name.substr(i), true}, name.substr(0, i)});
  }
  const std::size_t digits = name.find_last_not_of("0123456789") + 1;
  const bool is_number = digits > 0 && digits < name.size();
  if (is_number && kSeparators.find(name[digits - 1]) == std::string_view::npos) {
    splits.push_back({{name.substr(digits), true}, name.substr(0, digits)});
  }
  return splits;
}

/// Finds the people among the columns whose names have the same text before ':'.
class PeopleFinder {
 public:
  PeopleFinder(const MarkerMotion& markers, const std::string& set, const std::map<Role, std::string>& roles)
      : markers_(markers), set_(set), roles_(roles) {}

  /// Returns the people; `prefix` is the common text before ':'.
  std::vector<MarkerPerson> Find(const std::string& prefix, const std::vector<std::size_t>& columns) const {
    std::map<std::size_t, std::string> names;
    for (const std::size_t column : columns) {
      const std::string& name = markers_.names[column];
      names[column] = prefix.empty() ? name : name.substr(prefix.size() + 1);
    }
    const MarkerPerson whole = PersonOf(prefix, names);
    // Split the names in all ways. Of two ways for one marker, take the longer text: "Subject_1_", not "Subject_".
    std::map<Affix, std::map<std::size_t, std::string>> groups;
    for (const auto& [column, name] : names) {
      for (const auto& [affix, core] : SplitsOf(name)) groups[affix][column] = core;
    }
    std::erase_if(groups, [](const auto& group) { return group.second.size() < kMinAlike; });
    std::vector<std::pair<Affix, MarkerPerson>> named;
    for (const auto& [affix, group] : groups) {
      named.emplace_back(affix, PersonOf(prefix.empty() ? affix.Name() : prefix + "_" + affix.Name(), group));
    }
    std::ranges::stable_sort(named, std::greater{}, [](const auto& one) { return one.first.text.size(); });
    std::vector<MarkerPerson> split, others;
    std::map<std::size_t, std::string> rest = names;
    for (auto& [affix, person] : named) {
      const bool is_free =
          std::ranges::all_of(groups[affix], [&](const auto& one) { return rest.contains(one.first); });
      const bool is_person = is_free && person.IsComplete();
      if (is_person) std::erase_if(rest, [&](const auto& one) { return groups[affix].contains(one.first); });
      (is_person ? split : others).push_back(std::move(person));
    }
    // Choose the people; then state whose markers are not used.
    std::vector<MarkerPerson> people = Choose(whole, split, PersonOf(prefix, rest), others);
    if (people.size() == 1) std::ranges::move(split, std::back_inserter(others));
    for (const MarkerPerson& other : others) AddRemark(other, people);
    return people;
  }

  /// Adds a remark to the first complete person whose needed markers have the same names as those of `other` but are
  /// apart from them.
  void AddRemark(const MarkerPerson& other, std::vector<MarkerPerson>& people) const {
    for (MarkerPerson& person : people) {
      if (!person.IsComplete() || !person.remark.empty()) continue;
      const std::vector<std::string> alike = Alike(person, other);
      if (alike.size() < kMinAlike || !LieApart(person, other)) continue;
      person.remark = fmt::format(
          "Etude does not use {} more markers with the same names ({}, …), because they may belong to another person",
          alike.size(), markers_.names[other.columns.at(alike.front())]);
      return;
    }
  }

 private:
  MarkerPerson PersonOf(std::string name, const std::map<std::size_t, std::string>& names) const {
    MarkerPerson person{.name = std::move(name), .columns = {}, .chosen = {}, .remark = ""};
    std::vector<std::string> cores = markers_.names;
    for (const auto& [column, core] : names) {
      person.columns.emplace(MarkerKey(core), column);
      cores[column] = core;
    }
    person.chosen = ChooseSet(person.columns, cores, set_, roles_);
    return person;
  }

  /// Returns the names of the markers that `person` needs and `other` has too.
  static std::vector<std::string> Alike(const MarkerPerson& person, const MarkerPerson& other) {
    const MarkerSet& set = *person.chosen.set();
    std::vector<std::string> needed(set.pelvis.begin(), set.pelvis.end());
    for (const MarkerRule& rule : set.rules) needed.insert(needed.end(), rule.markers.begin(), rule.markers.end());
    std::ranges::sort(needed);
    needed.erase(std::ranges::unique(needed).begin(), needed.end());
    std::erase_if(needed, [&](const std::string& marker) {
      const auto a = person.columns.find(marker), b = other.columns.find(marker);
      return a == person.columns.end() || b == other.columns.end() || a->second == b->second;
    });
    return needed;
  }

  /// Returns true if the markers of the same names are apart from each other in the first frame that shows both.
  /// Markers that a program computed from others of the same person are not apart.
  bool LieApart(const MarkerPerson& person, const MarkerPerson& other) const {
    constexpr double kApart_m = 0.1;
    std::vector<double> distances;
    for (const std::string& marker : Alike(person, other)) {
      const std::size_t a = person.columns.at(marker), b = other.columns.at(marker);
      const auto both = std::ranges::find_if(markers_.frames, [&](const auto& frame) { return frame[a] && frame[b]; });
      if (both != markers_.frames.end()) distances.push_back(glm::distance(*(*both)[a], *(*both)[b]));
    }
    return distances.empty() || Median(distances) > kApart_m;
  }

  /// Chooses between all markers as one person and the people into whom an affix splits them.
  std::vector<MarkerPerson> Choose(const MarkerPerson& whole, std::vector<MarkerPerson> split, MarkerPerson rest,
                                   const std::vector<MarkerPerson>& others) const {
    const auto is_of_split = [&](const auto& role) {
      const std::string key = MarkerKey(role.second);
      return !whole.columns.contains(key) || (!split.empty() && split.front().columns.contains(key));
    };
    if (split.empty() || !std::ranges::all_of(roles_, is_of_split)) return {whole};
    std::ranges::sort(split, {}, &MarkerPerson::name);
    std::vector<MarkerPerson> people;
    const bool is_rest_complete = rest.IsComplete();
    if (is_rest_complete) people.push_back(std::move(rest));
    for (MarkerPerson& person : split) {
      const bool is_new = std::ranges::all_of(people, [&](const MarkerPerson& one) {
        return Alike(one, person).size() >= kMinAlike && LieApart(one, person);
      });
      if (is_new) people.push_back(std::move(person));
    }
    if (people.size() > 1) return people;
    // One person: without the affix if the names are complete with it, unless other markers are named alike.
    const bool is_mixed = std::ranges::any_of(
        others, [&](const MarkerPerson& other) { return Alike(people.front(), other).size() >= kMinAlike; });
    return is_rest_complete || (whole.IsComplete() && !is_mixed) ? std::vector{whole} : people;
  }

  const MarkerMotion& markers_;
  const std::string& set_;
  const std::map<Role, std::string>& roles_;
};

}  // namespace

std::vector<MarkerPerson> FindMarkerPeople(const MarkerMotion& markers, const std::string& set,
                                           const std::map<Role, std::string>& roles) {
  std::map<std::string, std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < markers.names.size(); ++i) {
    if (std::ranges::none_of(markers.frames, [i](const auto& frame) { return frame[i].has_value(); })) continue;
    const std::size_t colon = markers.names[i].rfind(':');
    groups[colon == std::string::npos ? "" : markers.names[i].substr(0, colon)].push_back(i);
  }
  const PeopleFinder finder(markers, set, roles);
  std::vector<MarkerPerson> people;
  for (const auto& [prefix, columns] : groups) {
    std::ranges::move(finder.Find(prefix, columns), std::back_inserter(people));
  }
  // Of several people, each needs a name by which a user can choose the person.
  for (MarkerPerson& person : people) {
    if (people.size() > 1 && person.name.empty()) person.name = "unnamed";
  }
  // State which people lack markers that the complete people have.
  for (std::size_t i = 0; i < people.size(); ++i) {
    if (people[i].IsComplete() || people[i].columns.empty()) continue;
    const MarkerPerson lacking = people[i];
    finder.AddRemark(lacking, people);
  }
  return people;
}

}  // namespace etude
