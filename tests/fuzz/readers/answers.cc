#include <nlohmann/json.hpp>

#include "bench/outside/conformance.h"
#include "bench/outside/messages.h"
#include "io/clips/clip_library.h"
#include "tests/fuzz/readers/target.h"

namespace etude::fuzz {
namespace {

/// Reads a program's output line by line, in any state of the protocol.
void Lines(std::string_view bytes) {
  const std::string line(bytes);
  ReadHello(line);
  ReadReady(line);
  ReadAnswer(line, "1");
  ReadStepAnswer(line, "1", 2);
  QuestionAnsweredBy(line);
  for (const char c : Printable(line.substr(0, 80))) {
    Require(c >= 0x20 && c < 0x7f, "unprintable bytes of an answer are shown as they are");
  }
}

std::vector<std::string> LineSeeds() {
  return {R"({"type":"hello","protocol":1,"name":"a","version":"1"})", R"({"type":"ready"})",
          R"({"type":"answer","id":"1","answer":{}})", R"({"type":"answer","id":"1","step":2,"answer":{"a":[1]}})",
          R"({"type":"no_answer","id":"1","reason":"why"})"};
}

const SpecimenProblem& ProblemOf(const char* task) {
  static std::map<std::string, std::vector<Specimen>> specimens;
  auto& made = specimens[task];
  if (made.empty()) made = std::move(MakeSpecimens(task, "").value());
  return made.front().problems.front();
}

template <const char* kTask>
void Answer(std::string_view bytes) {
  const auto json = ReadJson(std::string(bytes), "");
  if (json && json->is_object()) ProblemOf(kTask).world->Judge(*json);
}

/// Good answers: the truth, which most tasks accept, and the problem, which has the same vocabulary.
template <const char* kTask>
std::vector<std::string> AnswerSeeds() {
  const SpecimenProblem& problem = ProblemOf(kTask);
  return {problem.world->MakeTruth().value().json->dump(), problem.problem.json->dump()};
}

constexpr char kTransition[] = "transition", kDetection[] = "detection", kIk[] = "ik", kTracking[] = "tracking",
               kPoseDistance[] = "pose-distance";

template <const char* kTask>
Target AnswerTarget(const std::vector<std::string>& words) {
  return {std::string("answer-") + kTask, Answer<kTask>, AnswerSeeds<kTask>, words};
}

}  // namespace

std::vector<Target> AnswerTargets() {
  return {
      {"protocol", Lines, LineSeeds, {"\"step\"", "null", "1e999", "\\u0000", "[[[[[[[["}},
      AnswerTarget<kTransition>({"\"leave_frame\":", "\"enter_frame\":", "\"through\":", "\"between\":", "\"join_s\":",
                                 "\"unsolved\":", "\"matched\":"}),
      AnswerTarget<kDetection>({"\"detections\":", "\"from_s\":", "\"move\":"}),
      AnswerTarget<kIk>({"\"angles_deg\":", "\"iterations\":", "1e9"}),
      AnswerTarget<kTracking>({"\"angles_deg\":", "\"iterations\":", "1e9"}),
      AnswerTarget<kPoseDistance>({"\"distances\":", "\"alike\":"}),
  };
}

}  // namespace etude::fuzz
