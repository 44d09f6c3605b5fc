#include <nlohmann/json.hpp>

#include "bench/gate/baseline_file.h"
#include "bench/recordings/capture_extras.h"
#include "bench/replay/pack.h"
#include "bench/results/folder.h"
#include "bench/results/row_json.h"
#include "bench/results/seal.h"
#include "bench/run/journal.h"
#include "bench/run/manifest.h"
#include "io/files/files.h"
#include "tests/fuzz/readers/folder.h"
#include "tests/fuzz/readers/target.h"

namespace etude::fuzz {
namespace {

constexpr std::string_view kScenario = R"(
scenario: small
question: Does it read?
task: ik
trials: 3
sweep: {joint_noise_deg: [2, 5]}
methods:
  - {name: fixed, solver: ccd, weights: fixed}
  - {name: least-squares, solver: damped-least-squares}
)";

SuiteSetup SmallSuite() {
  SuiteSetup suite{
      .suite = "small", .sources = {{"small.yaml", std::string(kScenario)}}, .scenarios = {}, .scored = {}};
  suite.scenarios.push_back(
      {.file = "small.yaml", .name = "small", .trials = 3, .clips = {}, .joint_map = "", .digest = "d"});
  return suite;
}

const std::vector<PreparedScenario>& SmallScenarios() {
  static const std::vector<PreparedScenario> scenarios = std::move(PrepareAll(SmallSuite()).value());
  return scenarios;
}
const Plan& SmallPlan() {
  static const Plan plan(SmallScenarios());
  return plan;
}

/// Returns a cell's row with one of the possible statuses.
Row SomeRow(std::size_t cell) {
  Row row = SmallPlan().IdentityOf(cell);
  row.result = CellResult::Ended(cell % 3 == 2 ? Status::kCrashed : Status::kOk, cell % 3 == 2 ? "signal 11" : "");
  row.result.Measure("position_error_cm", 0.1 * static_cast<double>(cell));
  row.result.Missing("hidden_angle_error_deg", "no truth");
  row.result.digests = {{"world", "0123456789abcdef"}};
  row.result.series.push_back({"position_error_cm", "iteration", {3, 2, 1}});
  return row;
}

/// A whole run in a folder, with rows as text or as columns; one of its files gets other bytes.
class RunFolder {
 public:
  explicit RunFolder(bool as_columns) {
    Study study{.scenario = "small", .task = "ik", .trials = 3};
    study.methods = {{"fixed", "fixed", false}, {"least-squares", "fixed", false}};
    study.conditions = {{{"joint_noise_deg", "2"}}, {{"joint_noise_deg", "5"}}};
    auto writer = std::move(ResultWriter::Begin(folder_.path(), {&study, 1}, as_columns ? 0 : 100).value());
    for (std::size_t cell = 0; cell < SmallPlan().cell_count(); ++cell) {
      Required(writer.Add(SomeRow(cell), {}), "a row of the seed");
    }
    ScenarioSummary summary{.name = "small"};
    Required(writer.Finish({summary}), "the seed");
    folder_.With("manifest.json", MakeManifest(SmallSuite(), SmallScenarios(), "0")->dump());
    folder_.With("host.json", R"({"command_line":"c","host":"h","wall_seconds":1})");
    Required(SealRun(folder_.path()), "the seed");
  }

  std::string Text(const char* file) const { return ReadWholeFile(folder_.path() / file).value(); }
  /// Reads everything that a report reads.
  void Read(const char* file, std::string_view bytes) const {
    folder_.With(file, bytes);
    const auto run = LoadRun(folder_.path(), Sealing::kIgnored);
    if (!run) return;
    ForEachRow(*run, [](const Row& row, std::size_t) { row.Id(); });
    if (run->source == nullptr) return;
    for (std::size_t row = 0; row < run->source->size(); ++row) run->source->SeriesOf(row);
  }

 private:
  Folder folder_;
};

constexpr char kManifest[] = "manifest.json", kCells[] = "cells.jsonl", kSummary[] = "summary.json",
               kSeries[] = "series/small.jsonl", kIndex[] = "columns/small/index.json",
               kKinds[] = "columns/small/kind.npy", kSealed[] = "seal.json";

template <const char* kPart, bool kAsColumns = false>
void RunPart(std::string_view bytes) {
  static const RunFolder folder(kAsColumns);
  folder.Read(kPart, bytes);
}
template <const char* kPart, bool kAsColumns = false>
std::vector<std::string> RunPartSeeds() {
  return {RunFolder(kAsColumns).Text(kPart)};
}

void Seal(std::string_view bytes) {
  static const Folder folder;
  folder.With(kSealed, bytes);
  CheckSeal(folder.path());
}

void Manifest(std::string_view bytes) {
  static const Folder folder;
  const auto suite = ReadManifest(folder.With(kManifest, bytes));
  if (suite) EncodeSetup(*suite);
}

std::string LineOf(std::size_t cell) {
  FinishedCell finished{SomeRow(cell), {.wall_s = 0.25, .cpu_s = 0.125, .peak_mb = 12}};
  return EncodeCellLine(cell, std::move(finished));
}

void JournalFile(std::string_view bytes) {
  static const Folder folder;
  folder.With(kJournalFile, bytes);
  CellTable cells(SmallPlan().cell_count());
  const auto content = ReadJournal(folder.path(), SmallPlan(), cells);
  if (!content) return;
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    if (cells.Has(cell)) cells.Read(cell, SmallPlan());
  }
}

std::string JournalSeed() {
  const Folder folder;
  {
    auto journal = std::move(Journal::Begin(folder.path(), {"manifest", "build", {1, 1}}).value());
    Required(journal.Append(LineOf(3)), "a seed"), Required(journal.Append(LineOf(0)), "a seed");
  }
  return ReadWholeFile(folder.path() / kJournalFile).value();
}

/// The checksum is corrected first, because lines with a wrong one are refused at once.
void CellLine(std::string_view bytes) {
  if (bytes.size() < 2 || bytes.back() != '}') return;
  const std::string line = WithSum(std::string(bytes));
  if (ReadCellLineHead(line)) DecodeCellLine(line, SmallPlan().IdentityOf(0), {kFile});
}

std::string CellLineSeed() {
  const std::string line = LineOf(1);
  return line.substr(0, line.rfind(",\"sum\"")) + "}";
}

void Baseline(std::string_view bytes) {
  const auto snapshot = ReadBaseline(std::string(bytes), kFile, BaselineSeal::kMayBreak);  // mutations break the seal
  if (!snapshot) return;
  const auto text = WriteBaseline(*snapshot);
  Required(ReadBaseline(Required(text, "a baseline that was read cannot be written"), kFile),
           "a baseline that was written is not read");
}

std::string BaselineSeed() {
  Snapshot snapshot{.suite = "small", .program_version = "0", .scenarios = {}};
  SnapshotScenario& scenario = snapshot.scenarios.emplace_back();
  scenario.name = "small";
  scenario.trials = 2;
  scenario.worlds = {{"-", "0123456789abcdef"}};
  scenario.methods = {{"ccd", "0123456789abcdef"}};
  scenario.metrics = {{"position_error_cm", 1}};
  scenario.cells = {{"-", "ccd", "ou", {{"position_error_cm", {0.1, std::nullopt}}}}};
  return WriteBaseline(snapshot).value();
}

void PackFile(std::string_view bytes) {
  static const Folder folder;
  auto pack = ReadPack(bytes, kFile);
  if (pack) UnpackMotions(*pack, kFile, folder.path());
}

std::string PackSeed() {
  const Json clips{{"clips", {{{"file", 0}, {"animation", ""}}, {{"source", "builtin:clap"}}}},
                   {"files", {{{"name", "a.bvh"}, {"bytes", Json::binary({'H', 'I'})}}}}};
  const Json pack{{"etude_pack", 3},
                  {"etude", "0"},
                  {"setup", EncodeSetup(SmallSuite())},
                  {"row", EncodeRow(SomeRow(0))},
                  {"motions", {{"clips", clips}, {"libraries", Json::object()}}}};
  const std::vector<std::uint8_t> bytes = Json::to_cbor(pack);
  return {bytes.begin(), bytes.end()};
}

void RecordingLine(std::string_view bytes) {
  const auto json = ReadJson(std::string(bytes), kFile);
  if (!json) return;
  const auto recording = DecodeRecording(*json, {kFile});
  if (recording) Required(EncodeRecording(*recording), "a recording that was read cannot be written");
}

std::string RecordingSeed() {
  BodyPose pose;
  pose[Role::kHead] = {0.1, 1.7, -0.3};
  return EncodeRecording({{{"truth", {30, {pose, pose}}}}, R"({"from":"clap"})"}).value().dump();
}

void Extras(std::string_view bytes) {
  const auto extras = ReadCaptureExtras(bytes);
  if (extras) Required(ReadCaptureExtras(WriteCaptureExtras(*extras)), "extras that were written are not read");
}

std::string ExtrasSeed() {
  CaptureExtras extras{.brightness = {1, 1.01}};
  Mask mask(8, 4);
  extras.views.push_back({LookAt({}, {2, 1.5, 3}, {0, 1, 0}), {mask, mask}});
  extras.moments.push_back({1, {}, {{{{1, 2}, {3, 4}, {5, 6, 7}}}}});
  return WriteCaptureExtras(extras);
}

template <std::string (*kSeed)()>
std::vector<std::string> Only() {
  return {kSeed()};
}

}  // namespace

std::vector<Target> RunTargets() {
  const std::vector<std::string> json = {"null", "true", "-1", "4294967296", "1e308", "[]", "{}", "\"\\ud800\""};
  return {
      {"manifest", Manifest, RunPartSeeds<kManifest>, json},
      {"run-manifest", RunPart<kManifest>, RunPartSeeds<kManifest>, json},
      {"run-cells", RunPart<kCells>, RunPartSeeds<kCells>, json},
      {"run-summary", RunPart<kSummary>, RunPartSeeds<kSummary>, json},
      {"run-series", RunPart<kSeries>, RunPartSeeds<kSeries>, json},
      {"run-columns", RunPart<kIndex, true>, RunPartSeeds<kIndex, true>, json},
      {"run-column", RunPart<kKinds, true>, RunPartSeeds<kKinds, true>},
      {"seal", Seal, RunPartSeeds<kSealed>, json},
      {"journal", JournalFile, Only<JournalSeed>, json},
      {"cell-line", CellLine, Only<CellLineSeed>, json},
      {"baseline", Baseline, Only<BaselineSeed>, json},
      {"pack", PackFile, Only<PackSeed>, {"\x9b\xff\xff\xff\xff\xff\xff\xff\xff", "\x7f", "\x5f", ".."}},
      {"recording", RecordingLine, Only<RecordingSeed>, json},
      {"capture-extras", Extras, Only<ExtrasSeed>, json},
  };
}

}  // namespace etude::fuzz
