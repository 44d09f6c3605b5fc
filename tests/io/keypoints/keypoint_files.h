#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <string>

#include "io/files/files.h"
#include "io/files/temporary_folder.h"
#include "io/keypoints/read_people.h"
#include "tests/support/results.h"

namespace etude::testing {

/// Writes keypoint files into a temporary folder and reads them.
class KeypointFiles : public ::testing::Test {
 protected:
  KeypointFiles() : folder_(*TemporaryFolder::Make("keypoint-files")) {}
  std::filesystem::path Write(const std::string& name, const std::string& text) {
    const std::filesystem::path path = folder_.path() / name;
    EXPECT_TRUE(WriteFileAtomically(path, text));
    return path;
  }
  /// Returns `entry(0)`, `entry(1)`, …, separated by commas.
  static std::string List(int count, const std::function<std::string(int)>& entry) {
    std::string list;
    for (int i = 0; i < count; ++i) list += (i == 0 ? "" : ", ") + entry(i);
    return list;
  }
  /// Returns the numbers of a person who shows only the first keypoint.
  static std::string Triples(std::size_t count, const std::string& first = "10, 20, 0.5") {
    std::string list = first;
    for (std::size_t i = 1; i < count; ++i) list += ", 0, 0, 0";
    return list;
  }
  static std::string OpenPose(std::size_t count, const std::string& first = "10, 20, 0.5") {
    return R"({"version": 1.3, "people": [{"pose_keypoints_2d": [)" + Triples(count, first) + "]}]}";
  }
  std::string Reason(const std::filesystem::path& path, const std::string& layout = "",
                     const FilmOfKeypoints& film = {}) {
    return Refusal(ReadKeypoints(path, layout, film));
  }

  TemporaryFolder folder_;
};

}  // namespace etude::testing
