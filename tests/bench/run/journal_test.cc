#include "bench/run/journal.h"

#include <gmock/gmock.h>

#include <numeric>

#include "bench/results/folder.h"
#include "io/files/files.h"
#include "io/files/temporary_folder.h"
#include "tests/bench/run/prepared.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

class JournalTest : public ::testing::Test {
 protected:
  void SetUp() override {
    auto made = TemporaryFolder::Make("journal-test");
    ASSERT_TRUE(made);
    folder_.emplace(std::move(*made));
  }

  std::string LineOf(std::size_t cell, double error, bool is_measured = true) const {
    FinishedCell finished{plan_.IdentityOf(cell), {.wall_s = 0.25, .cpu_s = 0.125, .peak_mb = 12}, is_measured};
    finished.row.result = CellResult::Ended(Status::kOk, "");
    finished.row.result.Measure("position_error_cm", error);
    finished.row.result.series.push_back({"position_error_cm", "iteration", {3, 2, error}});
    return EncodeCellLine(cell, std::move(finished));
  }

  void WriteTwo() {
    auto journal = Journal::Begin(folder(), head_);
    ASSERT_TRUE(journal);
    ASSERT_TRUE(journal->Append(LineOf(3, 0.1)));
    ASSERT_TRUE(journal->Append(LineOf(0, 0.2)));
  }

  std::string Text() const { return *ReadWholeFile(path()); }
  void Rewrite(const std::string& text) const { ASSERT_TRUE(WriteFileAtomically(path(), text)); }
  const std::filesystem::path& folder() const { return folder_->path(); }
  std::filesystem::path path() const { return folder() / kJournalFile; }
  /// Returns the place after the head, which is stored twice.
  static std::size_t EndOfHead(const std::string& text) { return text.find('\n', text.find('\n') + 1) + 1; }
  Result<JournalContent> Read(CellTable& cells) const {
    cells = CellTable(plan_.cell_count());
    return ReadJournal(folder(), plan_, cells);
  }
  std::string Complaint() const {
    CellTable cells(0);
    return testing::Refusal(Read(cells));
  }

  const std::vector<PreparedScenario> scenarios_ = Prepared(SmallSuite());
  const Plan plan_{scenarios_};
  const JournalHead head_{"manifest digest", "build digest", {1, 1}};
  std::optional<TemporaryFolder> folder_;
};

TEST_F(JournalTest, GivesBackWhatWasAppended) {
  WriteTwo();
  CellTable cells(0);
  ASSERT_OK(content, Read(cells));
  EXPECT_EQ(content->head.manifest, head_.manifest);
  EXPECT_EQ(content->head.build, head_.build);
  EXPECT_EQ(content->head.shard, head_.shard);
  EXPECT_TRUE(content->damaged.empty());
  EXPECT_EQ(content->cells, 2u);
  EXPECT_EQ(content->cells_ok, 2u);
  EXPECT_EQ(std::ranges::count(cells.Done(), true), 2);
  for (const std::size_t cell : {0, 3}) {
    ASSERT_OK(back, cells.Read(cell, plan_));
    EXPECT_EQ(back->row.Id(), plan_.IdentityOf(cell).Id());
    EXPECT_EQ(ValueOf(back->row, "position_error_cm"), cell == 3 ? 0.1 : 0.2);
    EXPECT_EQ(back->row.result.series.front().values.size(), 3u);
    EXPECT_EQ(back->usage.wall_s, 0.25);
  }
}

TEST_F(JournalTest, LosesNothingButATornLastLineWhereverItIsCut) {
  WriteTwo();
  const std::string text = Text();
  const std::size_t head_end = EndOfHead(text), first_end = text.find('\n', head_end) + 1;
  for (std::size_t cut = head_end; cut <= text.size(); ++cut) {
    Rewrite(text.substr(0, cut));
    CellTable cells(0);
    ASSERT_TRUE(Read(cells)) << cut;
    EXPECT_EQ(cells.Has(3), cut >= first_end) << cut;
    EXPECT_EQ(cells.Has(0), cut == text.size()) << cut;
  }
}

TEST_F(JournalTest, GoesOnAfterATornLine) {
  WriteTwo();
  Rewrite(Text() + R"({"cell":5,"stat)");
  {
    auto journal = Journal::Continue(folder());
    ASSERT_TRUE(journal);
    ASSERT_TRUE(journal->Append(LineOf(7, 0.3)));
  }
  CellTable cells(0);
  ASSERT_TRUE(Read(cells));
  EXPECT_TRUE(cells.Has(0) && cells.Has(3) && cells.Has(7));
  EXPECT_FALSE(cells.Has(5));
}

TEST_F(JournalTest, LosesACellAloneByAChangedByteOfItsLine) {
  WriteTwo();
  const std::string text = Text();
  const std::size_t begin = EndOfHead(text), end = text.find('\n', begin);
  for (std::size_t at = begin; at < end; ++at) {
    std::string changed = text;
    changed[at] = static_cast<char>(changed[at] ^ 1);
    Rewrite(changed);
    CellTable cells(0);
    const auto content = Read(cells);
    ASSERT_TRUE(content) << at << ": " << ToString(content.error());
    EXPECT_FALSE(cells.Has(3)) << at;
    EXPECT_TRUE(cells.Has(0)) << at;
    EXPECT_EQ(content->damaged.front(), 3) << at;
  }
}

TEST_F(JournalTest, ASecondLineOfACellCostsItselfAlone) {
  WriteTwo();
  const std::string text = Text();
  const std::size_t begin = EndOfHead(text), end = text.find('\n', begin) + 1;
  Rewrite(text + text.substr(begin, end - begin));
  CellTable cells(0);
  ASSERT_OK(content, Read(cells));
  EXPECT_TRUE(cells.Has(0) && cells.Has(3));
  EXPECT_EQ(content->damaged, std::vector<int>{5});
  EXPECT_EQ(content->cells, 2u);
}

TEST_F(JournalTest, KeepsAnsweredCellsApartUntilTheyAreMeasured) {
  {
    auto journal = Journal::Begin(folder(), head_);
    ASSERT_TRUE(journal);
    for (const std::size_t cell : {5, 1, 4}) ASSERT_TRUE(journal->Append(LineOf(cell, 0.1, false)));
    for (const std::size_t cell : {4, 0}) ASSERT_TRUE(journal->Append(LineOf(cell, 0.2)));
    ASSERT_TRUE(journal->Append(LineOf(1, 0.3, false)));
  }
  CellTable cells(plan_.cell_count()), answered(plan_.cell_count());
  ASSERT_OK(content, ReadJournal(folder(), plan_, cells, &answered));
  EXPECT_EQ(content->cells, 2u);
  EXPECT_EQ(content->answered, 2u);
  EXPECT_EQ(content->damaged, std::vector<int>{8});
  EXPECT_TRUE(cells.Has(4) && cells.Has(0) && !cells.Has(1) && !cells.Has(5));
  EXPECT_EQ(answered.ReadLine(5).value(), LineOf(5, 0.1, false));
  EXPECT_EQ(answered.ReadLine(1).value(), LineOf(1, 0.1, false));
  // The merge does not count an answered cell as done.
  CellTable merged(0);
  ASSERT_OK(read, Read(merged));
  EXPECT_TRUE(read->damaged.empty());
  EXPECT_EQ(std::ranges::count(merged.Done(), true), 2);
}

TEST_F(JournalTest, PassesOverGarbageWithALineEnd) {
  WriteTwo();
  const std::string text = Text();
  Rewrite(text.substr(0, EndOfHead(text)) + std::string("\x00\xff not json\n\n", 13) + text.substr(EndOfHead(text)));
  CellTable cells(0);
  ASSERT_OK(content, Read(cells));
  EXPECT_TRUE(cells.Has(0) && cells.Has(3));
  EXPECT_FALSE(content->damaged.empty());
}

TEST_F(JournalTest, KnowsWhatItBelongsToAsLongAsOneCopyOfItsHeadIsGood) {
  WriteTwo();
  const std::string text = Text();
  const std::size_t line = text.find('\n') + 1;
  for (std::size_t at = 0; at + 1 < 2 * line; ++at) {
    std::string changed = text;
    changed[at] = static_cast<char>(changed[at] ^ 1);
    Rewrite(changed);
    CellTable cells(0);
    const auto content = Read(cells);
    if (at + 1 == line) continue;  // without its line break the first line continues into the second
    ASSERT_TRUE(content) << at << ": " << ToString(content.error());
    EXPECT_EQ(content->head.build, head_.build) << at;
    EXPECT_TRUE(cells.Has(0) && cells.Has(3)) << at;
  }
  std::string changed = text;
  changed[5] = changed[line + 5] = 'x';
  Rewrite(changed);
  EXPECT_THAT(Complaint(), HasSubstr("neither the first line nor a later copy is the header of a journal"));
}

TEST_F(JournalTest, RefusesACellOfAnotherShard) {
  auto journal = Journal::Begin(folder(), {"m", "b", {1, 2}});
  ASSERT_TRUE(journal);
  ASSERT_TRUE(journal->Append(LineOf(0, 1)));  // world 0 belongs to the first shard
  EXPECT_EQ(Complaint(), "accepted");
  ASSERT_TRUE(journal->Append(LineOf(2, 1)));  // world 1 does not
  EXPECT_THAT(Complaint(), HasSubstr("which does not belong to shard 1/2 of this run"));
}

TEST_F(JournalTest, RefusesACellThatThePlanHasNot) {
  WriteTwo();
  auto journal = Journal::Continue(folder());
  ASSERT_TRUE(journal);
  ASSERT_TRUE(journal->Append(EncodeCellLine(plan_.cell_count(), FinishedCell())));
  EXPECT_THAT(Complaint(), HasSubstr("journal.jsonl:5: found cell 12, which does not belong to shard 1/1 of this run"));
}

TEST_F(JournalTest, HEAVY_GivesCellsBackInAnyOrderHoweverLargeItIs) {
  std::vector<std::size_t> order(plan_.cell_count());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::reverse(order);
  FinishedCell large;
  large.row.result.series.push_back({"position_error_cm", "iteration", std::vector<double>(200'000, 0.125)});
  {
    auto journal = Journal::Begin(folder(), head_);
    ASSERT_TRUE(journal);
    for (const std::size_t cell : order) ASSERT_TRUE(journal->Append(EncodeCellLine(cell, large)));
  }
  CellTable cells(0);
  ASSERT_TRUE(Read(cells));
  for (std::size_t cell = 0; cell < plan_.cell_count(); ++cell) {
    ASSERT_OK(back, cells.Read(cell, plan_));
    EXPECT_EQ(back->row.Id(), plan_.IdentityOf(cell).Id());
    EXPECT_EQ(back->row.result.series.front().values.size(), 200'000u);
  }
}

TEST_F(JournalTest, RefusesOneOfAnotherVersionOrWithoutHead) {
  // An earlier version's format: one head without a checksum.
  Rewrite("{\"journal\":1,\"manifest\":\"m\",\"build\":\"b\",\"shard\":\"1/1\"}\n");
  EXPECT_THAT(Complaint(),
              HasSubstr("journal.jsonl:1: neither the first line nor a later copy is the header of a journal"));
  Rewrite("");
  EXPECT_THAT(Complaint(), HasSubstr("is empty"));
}

}  // namespace
}  // namespace etude
