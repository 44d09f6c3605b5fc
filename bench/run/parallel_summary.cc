#include "bench/run/parallel_summary.h"

#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <utility>

#include "bench/results/summary_json.h"
#include "io/process/forked_copy.h"

namespace etude {
namespace {

constexpr std::uint64_t kComplaint = ~std::uint64_t{0};

/// A forked copy of this process, and the part of its output that is not parsed yet. The output is a sequence of
/// results, each written as its number, its length and its text.
struct Copy {
  ForkedCopy process;
  std::string said = {};
};

bool Say(int file, std::uint64_t number, std::string_view text) {
  const std::array<std::uint64_t, 2> head = {number, text.size()};
  return SendAll(file, {reinterpret_cast<const char*>(head.data()), sizeof head}) && SendAll(file, text);
}

int Work(std::size_t first, std::size_t count, std::size_t step, int output,
         const std::function<Result<std::string>(std::size_t)>& work) {
  for (std::size_t i = first; i < count; i += step) {
    const auto text = work(i);
    if (!text) Say(output, kComplaint, ToString(text.error()));
    if (!text || !Say(output, i, *text)) return 1;
  }
  return 0;
}

/// Moves the complete results in a copy's output to `answers`. Adds the number of these results to `taken`.
Result<void> Take(Copy& copy, std::vector<std::string>& answers, std::size_t& taken) {
  std::size_t at = 0;
  std::array<std::uint64_t, 2> head{};
  while (copy.said.size() - at >= sizeof head) {
    std::memcpy(head.data(), copy.said.data() + at, sizeof head);
    if (copy.said.size() - at - sizeof head < head[1]) break;
    std::string text = copy.said.substr(at + sizeof head, head[1]);
    at += sizeof head + head[1];
    if (head[0] == kComplaint) return Fail({}, "{}", text);
    answers[head[0]] = std::move(text);
    ++taken;
  }
  copy.said.erase(0, at);
  return {};
}

class Copies {
 public:
  Result<void> Start(std::size_t count, std::size_t jobs, const std::function<Result<std::string>(std::size_t)>& work) {
    for (std::size_t first = 0; first < jobs; ++first) {
      ASSIGN_OR_RETURN(auto copy,
                       ForkedCopy::Start([&](int output) { return Work(first, count, jobs, output, work); }));
      copies_.push_back({std::move(copy)});
    }
    return {};
  }

  Result<void> Listen(std::vector<std::string>& answers, const OnProgress& on_progress) {
    std::size_t taken = 0;
    while (!copies_.empty()) {
      std::vector<pollfd> watched;
      for (const Copy& copy : copies_) watched.push_back({copy.process.socket(), POLLIN, 0});
      ::poll(watched.data(), watched.size(), -1);
      for (std::size_t i = copies_.size(); i-- > 0;) {
        if (watched[i].revents == 0) continue;
        std::array<char, 1 << 16> chunk;
        const ssize_t count = ::read(copies_[i].process.socket(), chunk.data(), chunk.size());
        if (count < 0 && errno == EINTR) continue;
        if (count > 0) {
          copies_[i].said.append(chunk.data(), static_cast<std::size_t>(count));
          RETURN_IF_ERROR(Take(copies_[i], answers, taken));
          if (on_progress) on_progress(taken, answers.size());
          continue;
        }
        const int status = copies_[i].process.Wait();
        const bool went_well = WIFEXITED(status) && WEXITSTATUS(status) == 0;
        copies_.erase(copies_.begin() + static_cast<std::ptrdiff_t>(i));
        if (!went_well) return Fail({}, "a process ended before it had computed its part of the summary");
      }
    }
    if (taken < answers.size()) return Fail({}, "a process ended before it had computed its part of the summary");
    return {};
  }

 private:
  std::vector<Copy> copies_;
};

/// Encodes the findings of a method as two summaries. The first has the comparisons without failures, the second has
/// the comparisons with failures counted. If there is no comparison with failures counted, a comparison of zero pairs
/// is written in its place. A real comparison with failures counted never has zero pairs.
Result<std::string> EncodeFindings(const ConditionFindings& findings) {
  ScenarioSummary both;
  ConditionSummary& without = both.conditions.emplace_back(findings.summary);
  ConditionSummary with;
  const auto add = [](const std::vector<Question>& questions, std::vector<Comparison>& plain,
                      std::vector<Comparison>& failures) {
    for (const Question& question : questions) {
      plain.push_back(question.comparison);
      failures.push_back(question.with_failures.value_or(Comparison()));
    }
  };
  add(findings.against_baselines, without.comparisons, with.comparisons);
  add(findings.against_rivals, without.rivals, with.rivals);
  both.conditions.push_back(std::move(with));
  return WriteJson(EncodeSummaries({both}));
}

Result<ConditionFindings> DecodeFindings(const std::string& text) {
  const Place place{"a condition's findings", 0, 0};
  ASSIGN_OR_RETURN(const auto json, ReadJson(text, place.file));
  ASSIGN_OR_RETURN(auto both, DecodeSummaries(json, place));
  ConditionSummary &without = both.front().conditions.at(0), &with = both.front().conditions.at(1);
  const auto take = [](std::vector<Comparison>& plain, std::vector<Comparison>& failures) {
    std::vector<Question> questions;
    for (std::size_t i = 0; i < plain.size(); ++i) {
      questions.push_back({std::move(plain[i]), std::nullopt});
      if (failures[i].pairs > 0) questions.back().with_failures = std::move(failures[i]);
    }
    plain.clear();
    return questions;
  };
  ConditionFindings findings;
  findings.against_baselines = take(without.comparisons, with.comparisons);
  findings.against_rivals = take(without.rivals, with.rivals);
  findings.summary = std::move(without);
  return findings;
}

}  // namespace

Result<std::vector<std::string>> RunForked(std::size_t count, int jobs,
                                           const std::function<Result<std::string>(std::size_t)>& work,
                                           const OnProgress& on_progress) {
  std::vector<std::string> answers(count);
  Copies copies;
  RETURN_IF_ERROR(copies.Start(count, std::min<std::size_t>(static_cast<std::size_t>(jobs), count), work));
  RETURN_IF_ERROR(copies.Listen(answers, on_progress));
  return answers;
}

Result<ScenarioSummary> SummariseInParallel(const Study& study, const ScenarioTable& table, std::uint64_t seed,
                                            int jobs, const OnProgress& on_progress) {
  constexpr std::size_t kMinRowsToShare = 20'000;  // for fewer rows, forking takes longer than the summary
  const auto conditions = table.conditions();
  const std::size_t methods = study.methods.size(), parts = conditions.size() * methods;
  const auto measure = [&](std::size_t part) {
    return MeasureMethod(study, conditions[part / methods], part % methods, seed);
  };
  // Compute the statistics of every method under every condition, in this process or in forked copies of it.
  std::vector<std::string> texts;
  const bool is_shared = parts * static_cast<std::size_t>(study.trials) >= kMinRowsToShare && parts > 1 && jobs > 1;
  if (is_shared) {
    ASSIGN_OR_RETURN(texts,
                     RunForked(
                         parts, jobs, [&](std::size_t part) { return EncodeFindings(measure(part)); }, on_progress));
  }
  std::vector<ConditionFindings> findings;
  for (std::size_t part = 0; part < parts; ++part) {
    ASSIGN_OR_RETURN(auto own, is_shared ? DecodeFindings(texts[part]) : Result<ConditionFindings>(measure(part)));
    if (part % methods == 0) {
      findings.push_back(std::move(own));
    } else {
      Append(std::move(own), findings.back());
    }
    if (!is_shared && on_progress) on_progress(part + 1, parts);
  }
  return JudgeFindings(study, table, std::move(findings), seed);
}

}  // namespace etude
