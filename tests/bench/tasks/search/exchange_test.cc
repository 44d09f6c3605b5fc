#include "bench/tasks/search/exchange.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "tests/bench/tasks/base/cell_values.h"
#include "tests/bench/tasks/base/exchange_checks.h"
#include "tests/bench/tasks/search/search_fixture.h"

namespace etude {
namespace {

using testing::HasSubstr;

std::unique_ptr<Task> MakeSearchTask(const std::string& condition = "{frames: 300, queries: 6, query: nearest-10}") {
  return std::move(*MakeSearch(condition, "[]"));
}

TEST(SearchExchange, TheFileTheTermsAndTheQueriesAreEnoughToFindTheTruth) {
  const auto task = MakeSearchTask("{frames: 300, queries: 6}");
  const auto world = task->MakeWorld(kSearchWorld, false);
  const auto setting = task->Setting();
  const Json &told = *setting->json, queries = (*world->MakeProblem()->json)["queries"];
  ASSERT_EQ(setting->files.size(), 1u);
  EXPECT_EQ(setting->files[0].name, told["file"].get<std::string>());
  EXPECT_EQ(told["query"], "nearest");
  ASSERT_EQ(told["terms"].size(), 24u);
  std::vector<double> library(300 * 24);
  ASSERT_EQ(setting->files[0].bytes.size(), library.size() * sizeof(double));
  std::memcpy(library.data(), setting->files[0].bytes.data(), setting->files[0].bytes.size());
  Json found = Json::array();
  for (const Json& query : queries) {
    int nearest = -1;
    double least = INFINITY;
    for (int frame = 0; frame < 300; ++frame) {
      double square = 0;
      for (std::size_t t = 0; t < 24; ++t) {
        const double gap = library[static_cast<std::size_t>(frame) * 24 + t] - query[t].get<double>();
        square += told["terms"][t]["weight"].get<double>() * gap * gap;
      }
      if (square < least) nearest = frame;
      least = std::min(least, square);
    }
    found.push_back({nearest});
  }
  const auto cell = world->Judge({{"found", found}});
  ASSERT_TRUE(cell) << ToString(cell.error());
  EXPECT_EQ(cell->status, Status::kOk) << cell->reason;
}

TEST(SearchExchange, TheTruthIsAPerfectAnswerOfAllQuestions) {
  for (const std::string question : {"first", "within", "nearest", "nearest-10"}) {
    const auto task = MakeSearchTask("{frames: 300, queries: 6, query: " + question + "}");
    const auto world = task->MakeWorld(kSearchWorld, false);
    const auto cell = world->Judge(*world->MakeTruth()->json);
    ASSERT_TRUE(cell) << ToString(cell.error());
    EXPECT_EQ(cell->status, Status::kOk) << cell->reason;
    EXPECT_EQ(ValueOf(*cell, "search_agreement"), 1);
    EXPECT_EQ(ValueOf(*cell, "distances_per_query"), std::nullopt) << "it did not say";
    EXPECT_EQ(ValueOf(*cell, "boxes_per_query"), std::nullopt);
  }
}

// The control: nearly right is not right.
TEST(SearchExchange, OneFrameExchangedIsOneQueryWrong) {
  const auto task = MakeSearchTask();
  const auto world = task->MakeWorld(kSearchWorld, false);
  Json answer = *world->MakeTruth()->json;
  std::swap(answer["found"][2][3], answer["found"][2][4]);
  const auto cell = world->Judge(answer);
  ASSERT_TRUE(cell);
  EXPECT_EQ(cell->status, Status::kUnsolved);
  EXPECT_THAT(cell->reason, HasSubstr("1 of 6 queries not answered as by a loop over all frames, the first of them "
                                      "query 2"));
  EXPECT_NEAR(*ValueOf(*cell, "search_agreement"), 5.0 / 6, 1e-12);
}

TEST(SearchExchange, RefusesWhatIsNoAnswerNamingThePlaceInIt) {
  const auto task = MakeSearchTask();
  const auto world = task->MakeWorld(kSearchWorld, false);
  const Json good = *world->MakeTruth()->json;
  const auto complaint = [&](auto change) { return ComplaintAfter(*world, good, change); };
  EXPECT_EQ(complaint([](Json&) {}), "no complaint");
  EXPECT_EQ(complaint([](Json& a) { a["found"][1] = Json::array(); }), "no complaint") << "wrong, but an answer";
  EXPECT_THAT(complaint([](Json& a) { a = 3; }), HasSubstr("not an object"));
  EXPECT_THAT(complaint([](Json& a) { a.erase("found"); }), HasSubstr("found"));
  EXPECT_THAT(complaint([](Json& a) { a["found"].erase(2); }), HasSubstr("found"));
  EXPECT_THAT(complaint([](Json& a) { a["found"][2] = 7; }), HasSubstr("found[2]: 7 is not a list"));
  EXPECT_THAT(complaint([](Json& a) { a["found"][2][0] = 300; }), HasSubstr("found[2][0]"));
  EXPECT_THAT(complaint([](Json& a) { a["found"][2][0] = 0.5; }), HasSubstr("found[2][0]: 0.5 is not a whole number"));
  EXPECT_THAT(complaint([](Json& a) { a["found"][2][1] = a["found"][2][0]; }), HasSubstr("stands there twice"));
  EXPECT_THAT(complaint([](Json& a) { a["fuond"] = 1; }), HasSubstr("did you mean 'found'"));
}

TEST(SearchExchange, ScoresOrRefusesWhateverIsSaid) {
  const auto task = MakeSearchTask();
  const auto world = task->MakeWorld(kSearchWorld, false);
  const Json good = *world->MakeTruth()->json;
  const Judgements judged = JudgeMutations(*world, {good}, 300, RandomStream(kSearchWorld, "mutations"));
  EXPECT_GT(judged.refused, 50);
  EXPECT_LT(judged.refused, 300);
}

TEST(SearchExchange, CreditsNoAnswerWithNoAgreement) {
  const auto task = MakeSearchTask();
  EXPECT_EQ(task->ValueOfFailure("search_agreement"), 0);
  EXPECT_EQ(task->ValueOfFailure("matches_per_query"), std::nullopt);
}

}  // namespace
}  // namespace etude
