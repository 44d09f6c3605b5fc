// Times searches of a library for frames by fuzzy distance: our index, a loop, the same loop with SIMD vectors, and
// nanoflann's k-d tree, on the same frames and queries in one process. Arguments other than options are the clips of
// the library (bridge_search_data.h). All answers are compared before measuring.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "bench/micro/bridge_search_data.h"
#include "bench/peers/nanoflann_peer.h"
#include "bench/peers/search_peers.h"
#include "engine/transitions/search/frame_matches.h"
#include "engine/transitions/search/grade_index.h"

namespace etude {
namespace {

using Queries = std::vector<Grades>;

struct Searcher {
  std::function<std::optional<Neighbour>(const Grades&)> first;
  std::function<std::vector<Neighbour>(const Grades&)> within;
  std::function<std::vector<Neighbour>(const Grades&, int)> nearest;
};

template <class Index>
Searcher Ask(std::shared_ptr<const Index> index) {
  return {.first = [index](const Grades& query) { return index->First(query, kPaperThreshold); },
          .within = [index](const Grades& query) { return index->Within(query, kPaperThreshold); },
          .nearest = [index](const Grades& query, int k) { return index->Nearest(query, k); }};
}

// The first searcher is ours.
constexpr int kNanoflannLeaves[] = {20, 40, 80, 160};
constexpr const char* kSearcherNames[] = {"index",        "loop",         "vector-loop",  "nanoflann-20",
                                          "nanoflann-40", "nanoflann-80", "nanoflann-160"};

std::vector<Searcher> MakeSearchers(std::span<const Grades> frames) {
  const FeatureWeights weights = PaperWeights();
  std::vector<Searcher> searchers = {Ask(std::make_shared<const GradeIndex>(frames, weights)),
                                     Ask(std::make_shared<const LoopPeer>(frames, weights)),
                                     Ask(std::make_shared<const VectorLoopPeer>(frames, weights))};
  for (int leaf : kNanoflannLeaves) {
    searchers.push_back(Ask(std::make_shared<const NanoflannPeer>(frames, weights, leaf)));
  }
  return searchers;
}

[[noreturn]] void Disagree(std::size_t who, const char* about) {
  std::fprintf(stderr, "%s: another answer of '%s' than the index\n", kSearcherNames[who], about);
  std::exit(1);
}

/// Compares the peers' answers with ours. Distances may differ by rounding, and any of several equally near frames is
/// accepted.
void CompareAnswers(const std::vector<Searcher>& searchers, const Queries& queries) {
  constexpr double kRounding = 1e-12;
  const Searcher& ours = searchers.front();
  for (std::size_t p = 1; p < searchers.size(); ++p) {
    const Searcher& peer = searchers[p];
    for (std::size_t q = 0; q < queries.size(); q += 5) {
      const auto first = ours.first(queries[q]), peers_first = peer.first(queries[q]);
      if (first.has_value() != peers_first.has_value()) Disagree(p, "first");
      if (first && first->frame != peers_first->frame) Disagree(p, "first");
      if (ours.within(queries[q]).size() != peer.within(queries[q]).size()) Disagree(p, "within");
      const auto nearest = ours.nearest(queries[q], 10), peers_nearest = peer.nearest(queries[q], 10);
      if (nearest.size() != peers_nearest.size()) Disagree(p, "nearest");
      for (std::size_t i = 0; i < nearest.size(); ++i) {
        if (std::abs(nearest[i].distance - peers_nearest[i].distance) > kRounding) Disagree(p, "nearest");
      }
    }
  }
}

/// The hardest queries: the one with the most frames within the threshold, and those without any.
struct HardQueries {
  Queries most, none;
};

HardQueries FindHardQueries(const Searcher& ours, const SearchData& data) {
  HardQueries hard;
  std::size_t most = 0;
  for (const Queries* queries : {&data.own, &data.varied, &data.foreign}) {
    for (const Grades& query : *queries) {
      const std::size_t count = ours.within(query).size();
      if (count == 0) hard.none.push_back(query);
      if (count <= most) continue;
      most = count;
      hard.most = {query};
    }
  }
  return hard;
}

struct Measured {
  SearchData data;
  std::vector<Searcher> searchers;
  HardQueries hard;

  explicit Measured(SearchData given) : data(std::move(given)), searchers(MakeSearchers(data.frames)) {
    for (const Queries* queries : {&data.own, &data.varied, &data.foreign}) CompareAnswers(searchers, *queries);
    hard = FindHardQueries(searchers.front(), data);
  }

  const Queries& QueriesOf(std::string_view kind) const {
    if (kind == "own") return data.own;
    if (kind == "varied") return data.varied;
    if (kind == "foreign") return data.foreign;
    return kind == "most" ? hard.most : hard.none;
  }
};
constexpr const char* kQueryKinds[] = {"own", "varied", "foreign", "most", "none"};

/// A library of `count` varied frames, or of the captured frames unchanged.
struct LibraryKind {
  int count = 0;
  bool captured = false;
  std::string Name() const { return captured ? "captured" : std::to_string(count); }
};

/// Makes a library on request and keeps only the last one: all indexes of a million frames take gigabytes.
class Libraries {
 public:
  explicit Libraries(std::vector<SeedClip> seeds) : seeds_(std::move(seeds)) {}
  bool HasCaptures() const { return std::ranges::any_of(seeds_, &SeedClip::captured); }
  const Measured& Of(const LibraryKind& kind) {
    if (!held_ || kind.Name() != held_name_) {
      held_.reset();
      held_ = std::make_unique<Measured>(kind.captured ? MakeCapturedData(seeds_) : MakeSearchData(seeds_, kind.count));
      held_name_ = kind.Name();
    }
    return *held_;
  }

 private:
  std::vector<SeedClip> seeds_;
  std::string held_name_;
  std::unique_ptr<Measured> held_;
};

/// Asks a searcher one query; returns the number of frames found.
using Question = std::size_t (*)(const Searcher&, const Grades&);

/// Times all queries in turn; the reported time is the mean.
void AskAll(benchmark::State& state, const Searcher& searcher, const Queries& queries, Question ask) {
  if (queries.empty()) return state.SkipWithError("there is no such query");
  std::size_t answers = 0;
  while (state.KeepRunningBatch(static_cast<std::int64_t>(queries.size()))) {
    for (const Grades& query : queries) answers += ask(searcher, query);
  }
  state.counters["answers"] = benchmark::Counter(static_cast<double>(answers), benchmark::Counter::kAvgIterations);
}

void RegisterSearches(Libraries& libraries, const LibraryKind& library) {
  const std::map<std::string, Question> questions = {
      {"nearest", [](const Searcher& s, const Grades& query) { return s.nearest(query, 1).size(); }},
      {"nearest10", [](const Searcher& s, const Grades& query) { return s.nearest(query, 10).size(); }},
      {"first", [](const Searcher& s, const Grades& query) { return std::size_t{s.first(query).has_value()}; }},
      {"within", [](const Searcher& s, const Grades& query) { return s.within(query).size(); }},
  };
  for (const auto& [name, ask] : questions) {
    for (const char* kind : kQueryKinds) {
      for (std::size_t i = 0; i < std::size(kSearcherNames); ++i) {
        const auto run = [&libraries, library, kind, i, ask = ask](benchmark::State& state) {
          const Measured& of = libraries.Of(library);
          AskAll(state, of.searchers[i], of.QueriesOf(kind), ask);
        };
        const std::string full_name = name + "/" + library.Name() + "/" + kind + "/" + kSearcherNames[i];
        benchmark::RegisterBenchmark(full_name.c_str(), run)->Unit(benchmark::kMicrosecond)->MinTime(0.1);
      }
    }
  }
}

template <class Index>
void RegisterBuild(Libraries& libraries, const LibraryKind& library, const std::string& name, auto... options) {
  const auto run = [=, &libraries](benchmark::State& state) {
    const std::vector<Grades>& frames = libraries.Of(library).data.frames;
    double bytes = 0;
    for (auto _ : state) {
      const Index index(frames, PaperWeights(), options...);
      bytes = static_cast<double>(index.Bytes());
    }
    state.counters["bytes_per_frame"] = bytes / static_cast<double>(frames.size());
  };
  const std::string full_name = "build/" + library.Name() + "/" + name;
  benchmark::RegisterBenchmark(full_name.c_str(), run)->Unit(benchmark::kMillisecond)->MinTime(0.2);
}

/// Times FindMatches: the matches of every frame in every other clip, and the matrix of shares.
void FindAllMatches(benchmark::State& state, const std::vector<std::vector<Grades>>& clips) {
  std::vector<MatchClip> match_clips;
  double frames = 0;
  for (const std::vector<Grades>& clip : clips) {
    match_clips.push_back({.grades = clip});
    frames += static_cast<double>(clip.size());
  }
  double shares = 0;
  SearchWork work;
  for (auto _ : state) {
    work = {};
    const MatchTable table = FindMatches(match_clips, {}, &work);
    shares = 0;
    for (int a = 0; a < table.ClipCount(); ++a) {
      for (int b = 0; b < table.ClipCount(); ++b) shares += table.Share(a, b);
    }
  }
  const double count = static_cast<double>(clips.size());
  state.counters["frames"] = frames;
  state.counters["clips"] = count;
  state.counters["distances"] = static_cast<double>(work.distances);
  state.counters["boxes"] = static_cast<double>(work.boxes);
  state.counters["share"] = shares / (count * (count - 1));
}

/// Times the same matches by one index per clip, which is queried for every frame of the other clips.
template <class Index>
void FindPointsByIndex(benchmark::State& state, const std::vector<std::vector<Grades>>& clips, auto... options) {
  double found = 0;
  for (auto _ : state) {
    found = 0;
    for (const std::vector<Grades>& to : clips) {
      const Index index(std::span<const Grades>(to).first(to.size() - 1), PaperWeights(), options...);
      for (const std::vector<Grades>& from : clips) {
        if (&from == &to) continue;
        for (const Grades& frame : from) {
          if (!index.First(frame, kPaperThreshold)) continue;
          benchmark::DoNotOptimize(index.Nearest(frame, 1));
          ++found;
        }
      }
    }
  }
  const double count = static_cast<double>(clips.size());
  state.counters["share"] = found / (count * (count - 1) * static_cast<double>(clips[0].size()));
}

void RegisterMatches(Libraries& libraries, const LibraryKind& library) {
  constexpr std::size_t kClipLength = 1000;
  const std::string name = "matches/" + library.Name() + "/";
  const auto add = [&](const std::string& variant, auto run) {
    benchmark::RegisterBenchmark((name + variant).c_str(), [=, &libraries](benchmark::State& state) {
      run(state, libraries.Of(library).data);
    })->Unit(benchmark::kMillisecond);
  };
  add("1000-each/index", [](benchmark::State& state, const SearchData& data) {
    FindAllMatches(state, ClipsOfLength(data.frames, kClipLength));
  });
  add("as-they-are/index", [](benchmark::State& state, const SearchData& data) { FindAllMatches(state, data.clips); });
  add("1000-each/loop", [](benchmark::State& state, const SearchData& data) {
    FindPointsByIndex<LoopPeer>(state, ClipsOfLength(data.frames, kClipLength));
  });
  add("1000-each/nanoflann-10", [](benchmark::State& state, const SearchData& data) {
    FindPointsByIndex<NanoflannPeer>(state, ClipsOfLength(data.frames, kClipLength), 10);
  });
}

void RegisterAll(Libraries& libraries) {
  for (const LibraryKind& library : {LibraryKind{1000}, {10'000}, {100'000}, {1'000'000}, {.captured = true}}) {
    if (library.captured && !libraries.HasCaptures()) continue;
    RegisterBuild<GradeIndex>(libraries, library, "index");
    for (int leaf : kNanoflannLeaves) {
      RegisterBuild<NanoflannPeer>(libraries, library, "nanoflann-" + std::to_string(leaf), leaf);
    }
    RegisterSearches(libraries, library);
    if (library.count == 10'000 || library.count == 100'000) RegisterMatches(libraries, library);
  }
}

}  // namespace
}  // namespace etude

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  std::vector<etude::SeedClip> seeds = etude::LoadSeeds({argv + 1, argv + argc});
  benchmark::AddCustomContext("frames of the seeds", etude::DescribeSeeds(seeds));
  etude::Libraries libraries(std::move(seeds));
  etude::RegisterAll(libraries);
  benchmark::RunSpecifiedBenchmarks();
}
