#include "bench/recordings/blind_files.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string_view>

#include "bench/recordings/record_fields.h"
#include "engine/base/names.h"

namespace etude {

constexpr std::string_view kKeyFormat = "etude-blind-key";
constexpr std::string_view kAnswersFormat = "etude-blind-answers";

static void Describe(RecordFields& fields, BlindKey::Metric& metric) {
  fields.Required("id", metric.id, "the metric's id; the list contains only metrics with a direction");
  fields.Required("higher_is_better", metric.higher_is_better, "whether higher values are better");
  fields.Required("left", metric.left, "the metric's value for the film on the left; null if there is none");
  fields.Required("right", metric.right, "the metric's value for the film on the right; null if there is none");
}

static void Describe(RecordFields& fields, BlindKey::Pair& pair) {
  fields.Required("scenario", pair.scenario, "the scenario of the world");
  fields.Required("world", pair.world, "the world's name");
  fields.Required("left", pair.left, "the method whose film is on the left");
  fields.Required("right", pair.right, "the method whose film is on the right");
  fields.List("metrics", pair.metrics, "the metrics of the two films");
}

static void Describe(RecordFields& fields, BlindKey& key) {
  fields.Format(kKeyFormat, 1);
  fields.Required("page", key.page, "digest of the page's content");
  fields.Required("seed", key.seed, "seed of the random numbers that chose worlds, order and sides");
  fields.Required("worlds", key.worlds, "number of worlds from which the pairs were drawn");
  fields.Required("left_out", key.left_out,
                  "number of worlds without a pair, because a method made no transition that can be shown");
  fields.List("pairs", key.pairs, "the pairs in the page's order");
}

static void Describe(RecordFields& fields, BlindAnswers& answers) {
  fields.Format(kAnswersFormat, 1);
  fields.Required("page", answers.page, "digest of the page's content");
  fields.Required("rater", answers.rater, "the name that the rater gave");
  fields.List("preferred", answers.preferred, "the answer to each pair: left, right, same, or empty");
}

std::string WriteBlindKey(const BlindKey& key) { return RecordFields::Write(key) + "\n"; }

namespace {

template <typename Record>
Result<Record> ReadRecord(const std::string& text, const std::string& file) {
  auto read = RecordFields::Read<Record>(text);
  if (!read) return Fail({file}, "{}", read.error().message);
  return read;
}

Result<void> AddAnswers(BlindAnswers answers, const std::string& file, std::vector<BlindAnswers>& all) {
  constexpr std::array<std::string_view, 4> kAllowed = {"left", "right", "same", ""};
  for (std::size_t i = 0; i < answers.preferred.size(); ++i) {
    if (std::ranges::find(kAllowed, answers.preferred[i]) != kAllowed.end()) continue;
    return Fail({file}, "preferred[{}]: '{}'; allowed: left, right, same, or an empty text", i, answers.preferred[i]);
  }
  const std::string rater = ComparedName(answers.rater);
  if (rater.empty())
    return Fail(
        {file},
        "rater: the name is empty; needed: the rater's name, which must be the same in all files of this rater");
  for (const BlindAnswers& other : all) {
    if (ComparedName(other.rater) != rater) continue;
    answers.rater = other.rater;
    if (other.page != answers.page) continue;
    return Fail({file}, "is a second file with answers of '{}' to the page {}; allowed: one file for each rater",
                answers.rater, answers.page);
  }
  all.push_back(std::move(answers));
  return {};
}

}  // namespace

Result<void> AddBlindFile(const std::string& text, const std::string& file, BlindFiles& files) {
  ASSIGN_OR_RETURN(const Json json, ReadJson(text, file));
  if (json.is_object() && json.contains("format") && json["format"] == kKeyFormat) {
    ASSIGN_OR_RETURN(auto key, ReadRecord<BlindKey>(text, file));
    if (std::ranges::find(files.keys, key.page, &BlindKey::page) != files.keys.end()) {
      return Fail({file}, "is a second key for the page {}; allowed: one key", key.page);
    }
    files.keys.push_back(std::move(key));
    return {};
  }
  ASSIGN_OR_RETURN(auto answers, ReadRecord<BlindAnswers>(text, file));
  return AddAnswers(std::move(answers), file, files.answers);
}

Result<void> CheckBlindFiles(const BlindFiles& files) {
  if (files.answers.empty())
    return Fail({}, "no file with answers is given; raters save their answers at the end of the page");
  for (const BlindAnswers& answers : files.answers) {
    const auto key = std::ranges::find(files.keys, answers.page, &BlindKey::page);
    if (key == files.keys.end()) {
      return Fail({},
                  "'{}' answered the page {}, but the key of this page is not given; add the file {}.key.json from the "
                  "run's folder 'blind'",
                  answers.rater, answers.page, answers.page);
    }
    if (answers.preferred.size() == key->pairs.size()) continue;
    return Fail({}, "the number of answers by '{}' to the page {} is {}; needed: {}, one for each pair", answers.rater,
                answers.page, answers.preferred.size(), key->pairs.size());
  }
  return {};
}

}  // namespace etude
