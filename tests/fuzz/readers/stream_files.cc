#include <fmt/format.h>

#include "engine/formats/joint_csv.h"
#include "engine/formats/trc.h"
#include "engine/streams/format_readers.h"
#include "engine/streams/labels.h"
#include "engine/streams/live_stream.h"
#include "engine/streams/stream_maker.h"
#include "tests/engine/streams/small_files.h"
#include "tests/fuzz/readers/target.h"

namespace etude::fuzz {
namespace {

using testing::WavingMotion;

void MakeEven(const Result<StreamRecording>& recording) {
  if (recording) MakeStream(*recording, kFile);
}

template <StreamFormat kFormat>
void Recording(std::string_view bytes) {
  MakeEven(ReadStreamRecording(bytes, kFile, {.format = kFormat, .rate_hz = {}, .body = {}}));
}

void AnyRecording(std::string_view bytes) { MakeEven(ReadStreamRecording(bytes, kFile)); }

std::vector<std::string> CsvSeeds() { return {WriteJointCsv(WavingMotion(3))}; }
std::vector<std::string> TrcSeeds() { return {WriteTrc(WavingMotion(3), "seed")}; }
std::vector<std::string> KinectV2Seeds() {
  const BodyMotion wave = WavingMotion(3);
  return {testing::KinectV2Text(wave, " "), testing::KinectV2Text(wave, " 2"), testing::KinectV2Text(wave, " 0 0 0 1")};
}
std::vector<std::string> KinectV1Seeds() {
  const std::string rows = testing::KinectV1Text(WavingMotion(3));
  return {rows, testing::KinectV1Text(WavingMotion(3), "2"), testing::WithClock(rows, 1e9, 333333)};
}
std::vector<std::string> NtuSeeds() {
  return {testing::NtuText(WavingMotion(2)), testing::NtuText(WavingMotion(2), 1, 0)};
}
std::vector<std::string> AzureSeeds() {
  return {testing::AzureText(WavingMotion(2)), testing::AzureText(WavingMotion(2), "2")};
}
std::vector<std::string> AllSeeds() {
  std::vector<std::string> all;
  for (const auto& seeds : {CsvSeeds(), TrcSeeds(), KinectV2Seeds(), KinectV1Seeds(), NtuSeeds(), AzureSeeds()}) {
    all.insert(all.end(), seeds.begin(), seeds.end());
  }
  return all;
}

void Live(std::string_view bytes) {
  LiveStream live(kFile, {}, {});
  std::vector<SensedFrame> frames;
  for (std::size_t at = 0; at < bytes.size();) {
    const std::size_t end = std::min(bytes.find('\n', at), bytes.size());
    if (!live.Take(bytes.substr(at, end - at), frames)) return;
    at = end + 1;
  }
  live.Finish(frames);
}

void LabelFile(std::string_view bytes) { ReadLabels(bytes, kFile, "clip"); }

}  // namespace

std::vector<Target> StreamTargets() {
  const std::vector<std::string> words = {"nan", "-1", "1e9", "//", "#", ","};
  return {
      {"stream", AnyRecording, AllSeeds, words},
      {"stream-etude-csv", Recording<StreamFormat::kEtudeCsv>, CsvSeeds, words},
      {"stream-trc", Recording<StreamFormat::kTrc>, TrcSeeds, words},
      {"stream-kinect-v2", Recording<StreamFormat::kKinectV2>, KinectV2Seeds, words},
      {"stream-kinect-v1", Recording<StreamFormat::kKinectV1>, KinectV1Seeds, words},
      {"stream-ntu", Recording<StreamFormat::kNtu>, NtuSeeds, words},
      {"stream-azure-kinect", Recording<StreamFormat::kAzureKinect>, AzureSeeds, {"null", "[]", "1e400"}},
      {"stream-live", Live, AllSeeds, words},
      {"labels",
       LabelFile,
       [] {
         return std::vector<std::string>{"clip,from_s,to_s,move,truth,person\nseq-1,0.5,3.1,arms-open,right,anna\n",
                                         "XQPCTick;Tag\n6600000;G1 lift\n", "s01_e01\nwalk: 252 390\nsit: NaN NaN\n"};
       },
       {"right", "NaN", "XQPCTick;Tag"}},
  };
}

}  // namespace etude::fuzz
