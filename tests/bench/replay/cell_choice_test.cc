#include "bench/replay/cell_choice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "bench/replay/replay.h"
#include "bench/run/manifest.h"
#include "bench/run/plan.h"
#include "tests/bench/run/prepared.h"

namespace etude {
namespace {

using ::testing::SizeIs;

/// Returns the share of all samples that contain none of the first `forged` cells, by enumerating the samples.
double ShareThatMisses(std::size_t cells, std::size_t drawn, std::size_t forged) {
  int samples = 0, missing = 0;
  for (unsigned sample = 0; sample < 1U << cells; ++sample) {
    if (static_cast<std::size_t>(std::popcount(sample)) != drawn) continue;
    ++samples;
    missing += (sample & ((1U << forged) - 1)) == 0 ? 1 : 0;
  }
  return static_cast<double>(missing) / samples;
}

TEST(ChanceOfMissing, IsTheShareOfSamplesThatMissWhateverTheirNumbers) {
  for (std::size_t cells = 1; cells <= 9; ++cells) {
    for (std::size_t drawn = 0; drawn <= cells; ++drawn) {
      for (std::size_t forged = 0; forged <= cells; ++forged) {
        EXPECT_NEAR(ChanceOfMissing(cells, drawn, forged), ShareThatMisses(cells, drawn, forged), 1e-12)
            << cells << ' ' << drawn << ' ' << forged;
      }
    }
  }
}

TEST(ChanceOfMissing, OfTheUsualSampleOfManyCellsIsOneInTwentyOne) {
  EXPECT_EQ(std::round(1 / ChanceOfMissing(10'000'000, 59, 500'000)), 21);
  EXPECT_LT(ChanceOfMissing(240, 59, 12), 1.0 / 21) << "of few cells it misses fewer";
}

/// A run of twelve cells of two methods; its first trial is recorded.
class ChosenCells : public ::testing::Test {
 protected:
  void Prepare(const std::string& more) {
    run_.suite = SmallSuite(kSmallScenario + more);
    run_.scenarios = Prepared(run_.suite);
    const Plan plan(run_.scenarios);
    for (std::size_t cell = 0; cell < plan.cell_count(); ++cell) {
      Row row = plan.IdentityOf(cell);
      row.result = CellResult::Ended(cell == 1 ? Status::kTimeout : Status::kOk, "");
      data_.rows.push_back(std::move(row));
    }
  }
  CellChoice Choose(const ReplayOptions& options) {
    auto choice = ChooseCells(options, data_, run_);
    EXPECT_TRUE(choice) << ToString(choice.error());
    return *choice;
  }

  PreparedRun run_;
  RunData data_;
};

TEST_F(ChosenCells, AreTheSameBySeedAndOthersByOthers) {
  Prepare("");
  std::set<std::set<std::size_t>> samples;
  for (std::uint64_t dice = 0; dice < 20; ++dice) {
    const CellChoice choice = Choose({.folder = "", .cells = {}, .sample = 5, .dice = dice, .outside = {}});
    EXPECT_THAT(choice.places, SizeIs(5));
    EXPECT_EQ(choice.places, Choose({.folder = "", .cells = {}, .sample = 5, .dice = dice, .outside = {}}).places);
    samples.insert(choice.places);
  }
  EXPECT_GT(samples.size(), 15u);
  EXPECT_THAT(Choose({.folder = "", .cells = {}, .outside = {}}).places, SizeIs(12)) << "all, unless told otherwise";
}

TEST_F(ChosenCells, MissForgedOnesAsOftenAsIsTold) {
  Prepare("");
  constexpr int kSamples = 4000;
  int missed = 0;
  double told = 0;
  for (int i = 0; i < kSamples; ++i) {
    const CellChoice choice =
        Choose({.folder = "", .cells = {}, .sample = 4, .dice = static_cast<std::uint64_t>(i), .outside = {}});
    missed += choice.places.contains(2) || choice.places.contains(7) || choice.places.contains(11) ? 0 : 1;
    told = ChanceOfMissing(choice.drawable, choice.drawn, 3);
  }
  EXPECT_NEAR(told, 14.0 / 55, 1e-12);
  EXPECT_NEAR(missed, kSamples * told, 4 * std::sqrt(kSamples * told * (1 - told)));
}

TEST_F(ChosenCells, AreDrawnBesideTheRecordedOnesAndNotFromThem) {
  Prepare("video: {compare: [fixed, least-squares], trials: [0]}\n");
  const CellChoice choice =
      Choose({.folder = "", .cells = {}, .sample = 3, .dice = 1, .recorded_too = true, .outside = {}});
  EXPECT_EQ(choice.recorded, 4u);
  EXPECT_EQ(choice.drawable, 8u);
  EXPECT_EQ(choice.drawn, 3u);
  EXPECT_THAT(choice.places, SizeIs(7));
  ASSERT_THAT(choice.methods, SizeIs(2));
  EXPECT_EQ(choice.methods[0].rows, 6u);
  EXPECT_TRUE(choice.methods[0].by_machine.empty());
  EXPECT_EQ(choice.methods[1].by_machine.at("timeout"), 1u);
  const std::vector<MissedForgery> missed = WhatIsMissed(choice);
  ASSERT_THAT(missed, SizeIs(3));
  EXPECT_EQ(missed[0].forged, 1u) << "5 % of 8";
  EXPECT_EQ(missed[1].method, "small/fixed");
  EXPECT_EQ(missed[1].forged, 2u) << "half of the four that are drawn from";
  EXPECT_NEAR(missed[2].chance, 5.0 / 8, 1e-12);
  EXPECT_TRUE(WhatIsMissed(Choose({.folder = "", .cells = {}, .recorded_too = true, .outside = {}})).empty());
}

TEST_F(ChosenCells, LeaveOutWhatOnlyAProgramAnswersAndSaySo) {
  Prepare("  - {name: mine, exec: ['true']}\n");
  const CellChoice choice = Choose({.folder = "", .cells = {}, .without_programs = true, .outside = {}});
  EXPECT_EQ(choice.drawable, 12u);
  EXPECT_THAT(choice.methods[2].why_not, ::testing::HasSubstr("--allow-exec"));
  EXPECT_EQ(choice.methods[2].rows, 6u);
}

TEST_F(ChosenCells, AreRefusedWhereARowIsOfNoMethodOfTheRun) {
  Prepare("");
  data_.rows[3].method = "stranger";
  const auto choice = ChooseCells({.folder = "run", .cells = {}, .outside = {}}, data_, run_);
  EXPECT_THAT(ToString(choice.error()), ::testing::HasSubstr("small/joint_noise_deg=2/001/stranger"));
}

}  // namespace
}  // namespace etude
