// Times the reading, writing and resampling of BVH files, on clips of Debian's assimp-testmodels. assimp's importer
// reads the same bytes in the same run.
#include <assimp/scene.h>
#include <benchmark/benchmark.h>

#include <assimp/Importer.hpp>
#include <fstream>
#include <iterator>
#include <string>

#include "engine/formats/bvh.h"
#include "engine/motion/edit.h"

namespace etude {
namespace {

constexpr const char* kFolder = "/usr/share/assimp/models/BVH/";

std::string Load(const std::string& file) {
  std::ifstream in(kFolder + file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void Finish(benchmark::State& state, std::size_t bytes) {
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(bytes));
}

void Read(benchmark::State& state, const char* file) {
  const std::string bytes = Load(file);
  for (auto _ : state) {
    auto clip = ReadBvh(bytes, file);
    if (!clip) return state.SkipWithError("not read: is assimp-testmodels installed?");
    benchmark::DoNotOptimize(clip->frames.data());
  }
  Finish(state, bytes.size());
}

void ReadWithAssimp(benchmark::State& state, const char* file) {
  const std::string bytes = Load(file);
  for (auto _ : state) {
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, "bvh");
    if (scene == nullptr) return state.SkipWithError(importer.GetErrorString());
    benchmark::DoNotOptimize(scene->mAnimations);
  }
  Finish(state, bytes.size());
}

void Write(benchmark::State& state, const char* file) {
  const auto clip = ReadBvh(Load(file), file);
  if (!clip) return state.SkipWithError("not read: is assimp-testmodels installed?");
  std::size_t bytes = 0;
  for (auto _ : state) {
    const std::string text = WriteBvh(*clip);
    bytes = text.size();
    benchmark::DoNotOptimize(text.data());
  }
  Finish(state, bytes);
}

void ResampleTo(benchmark::State& state, const char* file, double rate_hz) {
  const auto clip = ReadBvh(Load(file), file);
  if (!clip) return state.SkipWithError("not read: is assimp-testmodels installed?");
  for (auto _ : state) {
    const Clip resampled = Resample(*clip, rate_hz);
    benchmark::DoNotOptimize(resampled.frames.data());
  }
}

BENCHMARK_CAPTURE(Read, cmu_2752_frames, "01_01.bvh")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Read, cmu_4511_frames, "01_03.bvh")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(ReadWithAssimp, cmu_2752_frames, "01_01.bvh")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(ReadWithAssimp, cmu_4511_frames, "01_03.bvh")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Write, cmu_2752_frames, "01_01.bvh")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(ResampleTo, cmu_120_to_30_hz, "01_01.bvh", 30.0)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(ResampleTo, cmu_120_to_100_hz, "01_01.bvh", 100.0)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace etude
