#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "bench/model/payload.h"
#include "bench/model/recording.h"
#include "bench/model/row.h"
#include "bench/model/summary.h"
#include "bench/model/unit.h"

namespace etude {
namespace {

TEST(CellResult, ThatNobodyFilledIsAFailedOneWithAReason) {
  const CellResult unfilled;
  EXPECT_EQ(unfilled.status, Status::kFailed);
  EXPECT_FALSE(unfilled.reason.empty());
}

TEST(CellResult, KeepsAMissingValueWithItsReasonAndNeverAsZero) {
  CellResult result = CellResult::Ended(Status::kOk, "");
  result.MeasureOr("there", 2.5, "not used");
  result.MeasureOr("missing", std::nullopt, "no frame was seen");
  EXPECT_EQ(result.metrics[0].value, 2.5);
  EXPECT_EQ(result.metrics[0].null_reason, "");
  EXPECT_EQ(result.metrics[1].value, std::nullopt);
  EXPECT_EQ(result.metrics[1].null_reason, "no frame was seen");
}

TEST(Row, IsNamedByItsIdentity) {
  Row row{"ik-weights", "ik", {{"noise", "5"}, {"limits", "tight"}}, 7, "", {}, "ccd", {}};
  EXPECT_EQ(row.Id(), "ik-weights/noise=5,limits=tight/007/ccd");
  EXPECT_EQ(ConditionLabel(row.condition), "noise=5, limits=tight");
  row.condition.clear();
  EXPECT_EQ(row.Id(), "ik-weights/-/007/ccd");
  EXPECT_EQ(ConditionLabel(row.condition), "");
}

TEST(Row, GivesNoValueWhereNoneWasMeasured) {
  Row row;
  row.result.Measure("a", 1);
  row.result.Missing("b", "why");
  EXPECT_EQ(ValueOf(row, "a"), 1);
  EXPECT_EQ(ValueOf(row, "b"), std::nullopt);
  EXPECT_EQ(ValueOf(row, "c"), std::nullopt);
}

TEST(Recording, FindsATrackByName) {
  const Recording recording{{{"truth", {30, {}}}, {"coach", {25, {}}}}, "{}"};
  ASSERT_NE(FindTrack(recording, "coach"), nullptr);
  EXPECT_EQ(FindTrack(recording, "coach")->rate_hz, 25);
  EXPECT_EQ(FindTrack(recording, "learner"), nullptr);
}

TEST(Names, OfAllStatusesDiffer) {
  std::set<std::string_view> names;
  for (std::size_t i = 0; i < kStatuses.size(); ++i) names.insert(StatusName(static_cast<Status>(i)));
  EXPECT_EQ(names.size(), kStatuses.size());
  EXPECT_EQ(ClaimOutcomeName(ClaimOutcome::kMet), "met");
  EXPECT_EQ(ClaimOutcomeName(ClaimOutcome::kUnmet), "unmet");
  EXPECT_EQ(ClaimOutcomeName(ClaimOutcome::kUndecided), "undecided");
}

TEST(FindStatus, FindsEachByItsNameAndNothingElse) {
  for (std::size_t i = 0; i < kStatuses.size(); ++i) {
    const auto status = static_cast<Status>(i);
    EXPECT_EQ(FindStatus(StatusName(status)), status);
  }
  EXPECT_EQ(FindStatus("OK"), std::nullopt);
  EXPECT_EQ(FindStatus(""), std::nullopt);
}

TEST(Payload, OwnsItsJson) {
  Payload payload = PayloadOf({{"angles", {1, 2}}}, {{"left.png", "bytes"}});
  const Payload moved = std::move(payload);
  EXPECT_EQ(moved.json->at("angles").size(), 2u);
  EXPECT_EQ(moved.files[0].name, "left.png");
}

TEST(SamplingUnits, AreCountedInPlainEnglish) {
  EXPECT_EQ(CountUnits(2, SamplingUnit::kRecordedPerson), "2 people");
  EXPECT_EQ(CountUnits(1, SamplingUnit::kWorld), "1 world");
  EXPECT_EQ(CountUnits(12, SamplingUnit::kWorld), "12 worlds");
  EXPECT_EQ(CountUnits(1, SamplingUnit::kPerson), "1 person");
  EXPECT_EQ(CountUnits(0, SamplingUnit::kPerson), "0 people");
  EXPECT_EQ(CountUnits(1, SamplingUnit::kClip), "1 clip");
  EXPECT_EQ(CountUnits(6, SamplingUnit::kClipPair), "6 clips") << "a pair counts its clips";
  EXPECT_EQ(CountUnits(1, SamplingUnit::kLibrary), "1 library");
  EXPECT_EQ(CountUnits(2, SamplingUnit::kLibrary), "2 libraries");
}

}  // namespace
}  // namespace etude
