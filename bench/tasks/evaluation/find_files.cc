#include "bench/tasks/evaluation/find_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "bench/tasks/evaluation/options.h"
#include "engine/base/csv.h"
#include "engine/base/names.h"
#include "engine/base/text.h"
#include "engine/base/utf8.h"
#include "io/clips/references.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPerson = "{person}";

/// The extensions of motion files. A folder stands for its files with one of these extensions.
constexpr std::string_view kEndings[] = {".bvh", ".glb", ".gltf", ".fbx", ".amc", ".npz", ".npy",
                                         ".c3d", ".trc", ".csv",  ".mot", ".vrm", ".vrma"};

constexpr std::string_view kBidsEnding = "_motion.tsv", kBidsHead = "dataset_description.json";

/// Returns true if a file has the extension of a motion file, in any case, and is not hidden.
bool IsMotionFile(const fs::path& path) {
  const bool is_known = std::ranges::find(kEndings, InLowerCase(path.extension().string())) != std::end(kEndings);
  return (is_known || path.string().ends_with(kBidsEnding)) && !path.filename().string().starts_with('.');
}

/// Returns the number of motion files in and below a folder.
std::size_t CountMotionFiles(const fs::path& folder) {
  std::size_t count = 0;
  std::error_code error;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    count += IsMotionFile(entry->path()) ? 1 : 0;
  }
  return count;
}

/// Lists the motion files of a folder, sorted. For a BIDS data set, lists the recordings of all people. Adds folders
/// inside with motion files to `left_out`.
std::vector<std::string> FilesIn(const std::string& folder, std::vector<LeftOutFile>& left_out) {
  std::vector<std::string> files;
  std::error_code error;
  if (fs::exists(fs::path(folder) / kBidsHead, error)) {
    for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
      if (entry->path().string().ends_with(kBidsEnding)) files.push_back(entry->path().string());
    }
    std::ranges::sort(files);
    return files;
  }
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const fs::path& path = entry->path();
    if (IsMotionFile(path)) files.push_back(path.string());
    if (!entry->is_directory(error) || path.filename().string().starts_with('.')) continue;
    if (const std::size_t count = CountMotionFiles(path); count > 0) {
      left_out.emplace_back(path.string(), fmt::format("a folder in a folder, with {} motion file{}; name it, too",
                                                       count, count == 1 ? "" : "s"));
    }
  }
  std::ranges::sort(left_out);
  std::ranges::sort(files);
  return files;
}

/// Fails if a file that a folder or pattern stands for is a link or lies in a linked folder, because the sender of the
/// answers may have linked it to the truth. A file that the scenario names itself may be a link.
Result<void> RefuseLinks(const std::string& reference, std::span<const std::string> files, const Place& place) {
  if (files.size() == 1 && files.front() == reference) return {};
  const fs::path pattern = Split(reference).path;
  const auto first = std::find_if(pattern.begin(), pattern.end(), [](const fs::path& part) {
    return part.string().find_first_of("*?[") != std::string::npos;
  });
  // Check only the last parts of each path, which the search found: from the pattern's first wildcard on or, for a
  // folder, only the file name.
  const auto found_parts = std::max<std::ptrdiff_t>(std::distance(first, pattern.end()), 1);
  std::error_code error;
  for (const std::string& file : files) {
    fs::path path = Split(file).path;
    for (std::ptrdiff_t i = 0; i < found_parts; ++i, path = path.parent_path()) {
      if (!fs::is_symlink(fs::symlink_status(path, error))) continue;
      return Fail(
          place,
          "'{}' is a link in a folder or in the result of a pattern; list the link itself, or replace it by a file",
          path.string());
    }
  }
  return {};
}

}  // namespace

std::string NameOfReference(const std::string& reference) {
  if (reference.starts_with(kBuiltinPrefix)) return reference.substr(kBuiltinPrefix.size());
  const SplitReference split = Split(reference);
  std::string stem = fs::path(split.path).stem().string();
  // In a BIDS data set, the tracking system distinguishes truth and answers, so it is not part of the name.
  if (const std::size_t at = stem.find("_tracksys-"); at != std::string::npos && split.path.ends_with(kBidsEnding)) {
    stem.erase(at, stem.find('_', at + 1) - at);
    stem.resize(stem.rfind('_'));
  }
  return split.animation ? stem + "#" + *split.animation : stem;
}

Result<std::vector<std::string>> ExpandFiles(const std::vector<std::string>& references, Links links,
                                             const Place& place, std::vector<LeftOutFile>& left_out) {
  std::vector<std::string> files;
  for (const std::string& reference : references) {
    std::error_code none;
    if (fs::is_directory(reference, none) && reference.find('#') == std::string::npos) {
      const std::vector<std::string> inside = FilesIn(reference, left_out);
      for (const std::string& file : inside) {
        if (!CheckUtf8(file, "")) return Fail(place, "{} has a name that is not UTF-8 text", Quote(file));
      }
      if (links == Links::kRefused) RETURN_IF_ERROR(RefuseLinks(reference, inside, place));
      if (inside.empty()) return Fail(place, "folder '{}' contains no motion file (.bvh, .npz, …)", reference);
      files.insert(files.end(), inside.begin(), inside.end());
    } else {
      ASSIGN_OR_RETURN(const auto expanded, ExpandReference(reference, place, kMaxPairs));
      if (links == Links::kRefused) RETURN_IF_ERROR(RefuseLinks(reference, expanded, place));
      files.insert(files.end(), expanded.begin(), expanded.end());
    }
    if (files.size() > kMaxPairs) return Fail(place, "more than {} files", kMaxPairs);
  }
  return files;
}

namespace {

/// Returns the references by their names. Fails if two references have the same name.
Result<std::map<std::string, std::string>> ByName(const std::vector<std::string>& references, const Place& place) {
  std::map<std::string, std::string> named;
  for (const std::string& reference : references) {
    const auto [known, is_new] = named.emplace(NameOfReference(reference), reference);
    if (is_new) continue;
    return Fail(place, "'{}' and '{}' have the same name; use the key 'pairs' to state which files form a pair",
                known->second, reference);
  }
  return named;
}

struct PairColumns {
  std::size_t truth = 0;
  std::optional<std::size_t> name;
  std::vector<std::size_t> answers;  ///< the CSV column of each method's answers
};

Result<PairColumns> ReadHeading(const std::vector<std::string>& heading, std::span<const EvaluationMethod> methods,
                                const Place& place) {
  std::vector<std::string> known = {"truth", "name"};
  for (const EvaluationMethod& method : methods) known.push_back(method.name);
  PairColumns columns;
  const auto column_of = [&](const std::string& name) -> std::optional<std::size_t> {
    const auto found = std::ranges::find(heading, name);
    return found == heading.end() ? std::nullopt : std::optional<std::size_t>(found - heading.begin());
  };
  for (const std::string& cell : heading) {
    if (std::ranges::find(known, cell) == known.end()) return Fail(place, "{}", UnknownName("column", cell, known));
    if (std::ranges::count(heading, cell) > 1) return Fail(place, "two columns {}", Quote(cell));
  }
  const auto truth = column_of("truth");
  if (!truth) return Fail(place, "has no column 'truth'; found the columns {}", Join(heading));
  columns.truth = *truth;
  columns.name = column_of("name");
  for (const EvaluationMethod& method : methods) {
    const auto answers = column_of(method.name);
    if (!answers) return Fail(place, "has no column for method {}", Quote(method.name));
    columns.answers.push_back(*answers);
  }
  return columns;
}

/// Reads the pairs of a CSV file.
Result<std::vector<JudgedFiles>> ReadPairs(const std::string& text, const std::string& file,
                                           std::span<const EvaluationMethod> methods) {
  RETURN_IF_ERROR(CheckUtf8(text, file));
  ASSIGN_OR_RETURN(const auto rows, ReadCsv(text, file));
  std::vector<JudgedFiles> pairs;
  std::optional<PairColumns> columns;
  for (const auto& [cells, line] : rows) {
    const Place place{file, line, 0};
    if (!columns) {
      ASSIGN_OR_RETURN(columns, ReadHeading(cells, methods, place));
      continue;
    }
    const std::size_t width = rows.front().cells.size();
    if (cells.size() != width) return Fail(place, "found {} cells, but the heading has {}", cells.size(), width);
    JudgedFiles pair{.name = "", .unit = "", .truth = cells[columns->truth], .answers = {}};
    if (pair.truth.empty()) return Fail(place, "no truth");
    pair.name = columns->name ? cells[*columns->name] : NameOfReference(pair.truth);
    for (const std::size_t column : columns->answers) pair.answers.push_back(cells[column]);
    pairs.push_back(std::move(pair));
    if (pairs.size() > kMaxPairs) return Fail(place, "more than {} pairs", kMaxPairs);
  }
  if (pairs.empty()) return Fail({file}, "lists no pair");
  std::ranges::stable_sort(pairs, {}, &JudgedFiles::name);
  const auto twice = std::ranges::adjacent_find(pairs, {}, &JudgedFiles::name);
  if (twice != pairs.end()) {
    return Fail({file}, "two pairs have the name {}; add a column 'name' with unique names", Quote(twice->name));
  }
  return pairs;
}

/// Fails if an answer is the file of its truth under another name, such as a link.
Result<void> RefuseTruths(const JudgedFiles& files, const Place& place) {
  const SplitReference truth = Split(files.truth);
  for (const std::string& reference : files.answers) {
    const SplitReference answer = Split(reference);
    std::error_code none;
    if (reference == files.truth || answer.animation != truth.animation || answer.path == truth.path ||
        !fs::equivalent(answer.path, truth.path, none))
      continue;
    return Fail(place, "'{}' is the same file as the truth '{}'", reference, files.truth);
  }
  return {};
}

/// Returns true if the references are a single file, neither a folder nor a pattern.
bool NamesOneFile(const std::vector<std::string>& references) {
  std::error_code none;
  return references.size() == 1 && references.front().find_first_of("*?[") == std::string::npos &&
         !fs::is_directory(references.front(), none);
}

/// Pairs truths and answers whose files have the same name. `nodes` are the mappings of the methods.
Result<FoundFiles> PairByName(const EvaluationOptions& options, std::span<const EvaluationMethod> methods,
                              std::span<const Node> nodes, const Place& place) {
  FoundFiles found;
  ASSIGN_OR_RETURN(const auto truth_files, ExpandFiles(options.truth, Links::kAllowed, place, found.left_out));
  ASSIGN_OR_RETURN(const auto truths, ByName(truth_files, place));
  for (const auto& [name, truth] : truths) {
    found.worlds.push_back({.name = name, .unit = "", .truth = truth, .answers = {}});
  }
  for (std::size_t m = 0; m < methods.size(); ++m) {
    const EvaluationMethod& method = methods[m];
    if (method.is_control) {
      for (JudgedFiles& world : found.worlds) world.answers.push_back(world.truth);
      continue;
    }
    if (method.answers.empty()) return Fail(nodes[m].place, "method {} has no 'answers'", Quote(method.name));
    const Place& of_answers = nodes[m].Find("answers")->place;
    ASSIGN_OR_RETURN(const auto files, ExpandFiles(method.answers, Links::kRefused, of_answers, found.left_out));
    // A single truth and a single answer are a pair, whatever their names, if the scenario names these two files
    // itself.
    const bool are_named = NamesOneFile(options.truth) && NamesOneFile(method.answers);
    if (are_named && truths.size() == 1 && files.size() == 1) {
      found.worlds.front().answers.push_back(files.front());
      continue;
    }
    ASSIGN_OR_RETURN(auto answers, ByName(files, of_answers));
    std::size_t with_answer = 0;
    for (JudgedFiles& world : found.worlds) {
      const auto answer = answers.find(world.name);
      world.answers.push_back(answer == answers.end() ? "" : answer->second);
      if (answer == answers.end()) continue;
      answers.erase(answer);
      ++with_answer;
    }
    if (with_answer == 0) {
      return Fail(of_answers,
                  "none of the {} answers of method {} has the name of a truth (the first answer is '{}', the first "
                  "truth is '{}'); use the key 'pairs' to state which files form a pair",
                  files.size(), Quote(method.name), files.front(), truth_files.front());
    }
    for (const auto& [name, file] : answers) found.left_out.emplace_back(file, "no truth is named " + Quote(name));
  }
  return found;
}

/// Returns true if a text matches a pattern in which '*' stands for any text.
bool Matches(std::string_view pattern, std::string_view text) {
  // `star` is the position of the last star; `retry` is the position at which the text after the star may begin next.
  std::size_t p = 0, t = 0, star = std::string_view::npos, retry = 0;
  while (t < text.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      retry = t;
    } else if (p < pattern.size() && pattern[p] == text[t]) {
      ++p;
      ++t;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      t = ++retry;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

}  // namespace

std::optional<std::string> PersonIn(std::string_view pattern, std::string_view name) {
  const std::size_t at = pattern.find(kPerson);
  if (at == std::string_view::npos) return std::nullopt;
  const std::string_view before = pattern.substr(0, at), behind = pattern.substr(at + kPerson.size());
  for (std::size_t begin = 0; begin < name.size(); ++begin) {
    if (!Matches(before, name.substr(0, begin))) continue;
    for (std::size_t end = begin + 1; end <= name.size(); ++end) {
      if (Matches(behind, name.substr(end))) return std::string(name.substr(begin, end - begin));
    }
  }
  return std::nullopt;
}

Result<void> FindPeople(const std::string& people, const Place& place, std::vector<JudgedFiles>& worlds) {
  std::map<std::string, std::string> spellings;  // the first spelling of each person's name, by ComparedName
  for (JudgedFiles& world : worlds) {
    const auto person = PersonIn(people, world.name);
    if (!person) {
      return Fail(place, "the pattern {} does not match the name {}; allowed: a pattern with {}, such as {}_*",
                  Quote(people), Quote(world.name), kPerson, kPerson);
    }
    world.unit = spellings.emplace(ComparedName(*person), *person).first->second;
  }
  return {};
}

Result<FoundFiles> FindEvaluatedFiles(const Node& condition, std::span<const Node> methods,
                                      const std::map<std::string, std::string>& texts) {
  // Read the keys that name files. The task will read and check all keys later.
  EvaluationOptions options;
  Fields fields(condition, "a scenario of task evaluation");
  EvaluationConditionFields().Read(fields, options);
  if (!fields.ok()) return tl::unexpected(fields.Finish().error());
  RETURN_IF_ERROR(CheckFiles(condition, options));
  std::vector<EvaluationMethod> read;
  for (const Node& node : methods) {
    Fields method(node, "a method of task evaluation");
    EvaluationMethod& one = read.emplace_back();
    one.name = method.RequiredText("name");
    EvaluationMethodFields().ReadKeys(method, one);
    RETURN_IF_ERROR(method.Finish());
    const Node* answers = node.Find("answers");
    if (answers != nullptr && !options.pairs.empty())
      return Fail(answers->place, "'answers' and 'pairs' are not allowed together");
  }
  // Make the pairs.
  FoundFiles found;
  if (options.pairs.empty()) {
    const Node* truth = condition.Find("truth");
    ASSIGN_OR_RETURN(found, PairByName(options, read, methods, truth->place));
  } else {
    ASSIGN_OR_RETURN(found.worlds, ReadPairs(texts.at("pairs"), options.pairs, read));
  }
  for (const JudgedFiles& world : found.worlds) RETURN_IF_ERROR(RefuseTruths(world, condition.place));
  if (!options.people.empty()) {
    RETURN_IF_ERROR(FindPeople(options.people, condition.Find("people")->place, found.worlds));
  }
  return found;
}

}  // namespace etude
