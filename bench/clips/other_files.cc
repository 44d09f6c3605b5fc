#include "bench/clips/other_files.h"

#include <algorithm>
#include <utility>

#include "engine/base/names.h"

namespace etude {

std::string DescribeOtherFile(std::string_view bytes, std::string_view first_word) {
  constexpr std::pair<std::string_view, const char*> kBeginnings[] = {
      {"\x1f\x8b", "a gzip file: unpack it"},
      {"\x80", "a pickled Python object, which is never opened: write its arrays with numpy.savez"},
      {"\x89HDF", "an HDF5 file: write its arrays with numpy.savez"},
      {"MATLAB", "a file of MATLAB: write its arrays with numpy.savez"},
      {"\xff\xfe", "text in UTF-16: save it as UTF-8"},
      {"\xfe\xff", "text in UTF-16: save it as UTF-8"},
      {"version https://git-lfs", "a pointer of Git LFS, not the file: git lfs pull"},
      {"<!DOCTYPE html", "a web page"},
      {"<html", "a web page"},
      {":", "an Acclaim skeleton, whose motions are the .amc files beside it"}};
  if (first_word.empty()) return "an empty file";
  const auto* const known =
      std::ranges::find_if(kBeginnings, [&](const auto& one) { return bytes.starts_with(one.first); });
  if (known != std::end(kBeginnings)) return known->second;
  constexpr std::size_t kLongestHead = 4096;
  if (first_word == "Coordinates" || bytes.substr(0, kLongestHead).find("\nendheader") != std::string_view::npos) {
    return "an OpenSim table (.mot, .sto), whose model is another file: write its markers as TRC there";
  }
  return "a file that begins with " + Quote(std::string(first_word));
}

}  // namespace etude
