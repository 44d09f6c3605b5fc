#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "bench/tasks/base/task_kinds.h"
#include "engine/document/node.h"
#include "io/clips/clip_library.h"

namespace etude {

inline const WorldKey kSearchWorld{.suite_seed = 1, .scenario = "test", .trial = 0};

inline const ClipLibrary& SearchClips() {
  static const ClipLibrary clips = *LoadClips({"builtin:clap", "builtin:boxing", "builtin:sway"}, {});
  return clips;
}

constexpr char kSearchMethods[] = R"(
- {name: index-first, query: first}
- {name: loop-first, query: first, search: brute-force}
- {name: index-within, query: within}
- {name: loop-within, query: within, search: brute-force}
- {name: index-nearest}
- {name: loop-nearest, search: brute-force}
- {name: index-ten, query: nearest-10}
- {name: loop-ten, query: nearest-10, search: brute-force}
)";
constexpr std::size_t kSearchMethodCount = 8;

inline Result<std::unique_ptr<Task>> MakeSearch(const std::string& condition,
                                                const std::string& methods = kSearchMethods,
                                                const ClipLibrary& clips = SearchClips()) {
  const Node condition_node = *ParseYaml(condition, "test.yaml");
  const Node method_node = *ParseYaml(methods, "methods.yaml");
  Fields fields(condition_node, "a search scenario");
  TaskInput input{fields, method_node.items, clips, {}};
  return MakeSearchTaskKind().make(input);
}

}  // namespace etude
