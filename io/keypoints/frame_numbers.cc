#include "io/keypoints/frame_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "engine/base/order_statistics.h"
#include "engine/base/text.h"
#include "engine/formats/row_clock.h"

namespace etude {
namespace {

/// Returns the last number of a name, without the ending after a point, as [begin, end); both are 0 without a number.
std::pair<std::size_t, std::size_t> LastNumberIn(std::string_view name) {
  const std::size_t dot = name.find_last_of('.');
  if (dot != std::string_view::npos && dot > 0) name = name.substr(0, dot);
  const std::size_t end = name.find_last_of("0123456789") + 1;
  return {name.substr(0, end).find_last_not_of("0123456789") + 1, end};
}

/// Moves the i-th frame to `indices[i]`; indices ascend. `count` is the number of frames afterwards. Adds a note if
/// frames are missing.
void MoveFrames(std::span<const std::size_t> indices, std::size_t count, PeopleOfFilm& film) {
  SeenPeople frames(count);
  for (std::size_t i = 0; i < indices.size(); ++i) frames[indices[i]] = std::move(film.frames[i]);
  if (count > indices.size()) {
    film.Tell(fmt::format(
        "by the frame numbers or times, {} of {} frames are missing; Etude assumes that these frames show nobody",
        count - indices.size(), count));
  }
  film.frames = std::move(frames);
}

constexpr std::size_t kMaxSpread = 10;  // maximum number of frames per entry of a list

}  // namespace

bool NaturallyBefore(std::string_view x, std::string_view y) {
  std::size_t i = 0, j = 0;
  while (i < x.size() && j < y.size()) {
    if (IsDigit(x[i]) && IsDigit(y[j])) {
      // Compare two numbers without their leading zeros.
      std::size_t end_x = i, end_y = j;
      while (end_x < x.size() && IsDigit(x[end_x])) ++end_x;
      while (end_y < y.size() && IsDigit(y[end_y])) ++end_y;
      std::string_view m = x.substr(i, end_x - i), n = y.substr(j, end_y - j);
      while (m.size() > 1 && m.front() == '0') m.remove_prefix(1);
      while (n.size() > 1 && n.front() == '0') n.remove_prefix(1);
      if (m != n) return m.size() != n.size() ? m.size() < n.size() : m < n;
      i = end_x;
      j = end_y;
    } else {
      if (x[i] != y[j]) return x[i] < y[j];
      ++i;
      ++j;
    }
  }
  // The numbers are equal up to leading zeros. The name with the shorter remainder comes first; if the remainders have
  // equal lengths, the characters decide.
  return x.size() - i != y.size() - j ? x.size() - i < y.size() - j : x < y;
}

bool AreNumbered(std::span<const std::string> names) {
  if (names.empty()) return false;
  // Find where the names begin to differ, and go back to the start of the number there.
  std::size_t same = names.front().size();
  for (const std::string& name : names) {
    const auto [a, b] = std::ranges::mismatch(name, names.front());
    same = std::min(same, static_cast<std::size_t>(a - name.begin()));
  }
  while (same > 0 && IsDigit(names.front()[same - 1])) --same;
  const auto has_number = [&](const std::string& name) { return same < name.size() && IsDigit(name[same]); };
  if (!std::ranges::all_of(names, has_number)) return false;
  std::vector<std::string> sorted(names.begin(), names.end());
  std::ranges::sort(sorted);
  return std::ranges::adjacent_find(sorted) == sorted.end();
}

std::optional<long> FrameNumber(const Json& id) {
  if (id.is_number_integer()) return id.get<long>();
  if (!id.is_string()) return std::nullopt;
  const std::string text = id.get<std::string>();
  const auto [begin, end] = LastNumberIn(text);
  return ParseNumber<long>(std::string_view(text).substr(begin, end - begin));
}

Result<PeopleOfFilm> FilmOfNumbers(std::map<long, std::vector<SeenPerson>> numbered, const FilmOfKeypoints& of,
                                   const Place& place) {
  constexpr long kMaxFrames = 1'000'000;
  PeopleOfFilm film;
  if (numbered.empty()) return Fail(place, "no frame");
  const long lowest = numbered.begin()->first, highest = numbered.rbegin()->first;
  if (lowest < 0 || highest > kMaxFrames)
    return Fail(place, "frames {} to {}; allowed: 0 to {}", lowest, highest, kMaxFrames);
  const auto frames = static_cast<long>(of.frames);
  // If the film's length is not known, the frame numbers give it.
  long first = frames > 0 ? 0 : std::min(lowest, 1L), step = 1;
  film.is_from_one = frames > 0 && lowest > 0 && highest == frames;
  film.is_base_open = frames > 0 && lowest > 0 && highest < frames;
  if (film.is_from_one || (film.is_base_open && of.from_one)) first = 1;
  if (frames > 0 && highest - first >= frames) {
    // The numbers are those of a longer film, from which all frames or every n-th frame were cut.
    for (const auto& [number, people] : numbered) step = number == lowest ? 0 : std::gcd(step, number - lowest);
    first = lowest;
    if (highest - lowest + 1 == frames) step = 1;
    if (step == 0 || (highest - lowest) / step + 1 != frames) {
      return Fail(place,
                  "frame numbers go from {} to {}, but the film has {} frames; allowed: numbers from 0 or 1 up to the "
                  "number of frames, or evenly spaced numbers from the first frame to the last frame",
                  lowest, highest, frames);
    }
    film.Tell(
        fmt::format("frame numbers go from {} to {}, and the film has {} frames; Etude assumes that number {} is the "
                    "film's first frame",
                    lowest, highest, frames, lowest));
  } else if (film.is_base_open) {
    film.Tell(fmt::format(
        "frame numbers go from {} to {}, and the film has {} frames; Etude assumes that the numbers count from {}",
        lowest, highest, frames, of.from_one ? "1, as in another film" : "0"));
  }
  film.frames.resize(static_cast<std::size_t>(frames > 0 ? frames : highest - first + 1));
  for (auto& [number, people] : numbered) {
    film.frames[static_cast<std::size_t>((number - first) / step)] = std::move(people);
  }
  return film;
}

void LayByTimes(const std::vector<double>& times, const FilmOfKeypoints& of, PeopleOfFilm& film) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < times.size(); ++i) {
    steps.push_back(times[i] - times[i - 1]);
    if (!(steps.back() > 0)) return;
  }
  if (steps.empty()) return;
  // Scale the times so that the median step between frames is 1/30 s.
  const double usual = UpperMedian(std::move(steps)) * kJudgedRateHz;
  std::vector<double> scaled;
  for (const double time : times) scaled.push_back((time - times.front()) / usual);
  const auto grid = GridOfRows(scaled, {}, std::nullopt, 1, "");
  if (!grid || !*grid || (*grid)->frames.size() > kMaxSpread * times.size()) return;
  std::vector<std::size_t> indices;
  for (const double time : scaled) {
    const double index = std::round(time * (*grid)->rate_hz);
    // The times are too uneven if two frames would get the same index.
    if (!indices.empty() && static_cast<std::size_t>(index) <= indices.back()) return;
    indices.push_back(static_cast<std::size_t>(index));
  }
  std::size_t count = indices.back() + 1;
  // If the times count from the film's start, the frames before and after them are missing as well. OpenCV's clock
  // shows the time of the next frame, so the last frame may be the film's number of frames.
  const double before = std::round(times.front() / usual * (*grid)->rate_hz);
  if (before >= 0 && before + static_cast<double>(indices.back()) <= static_cast<double>(of.frames)) {
    auto shift = static_cast<std::size_t>(before);
    if (shift > 0 && shift + indices.back() == of.frames) --shift;
    if (shift + indices.back() < of.frames) {
      for (std::size_t& index : indices) index += shift;
      count = of.frames;
    }
  }
  MoveFrames(indices, count, film);
}

void LayByNames(std::span<const std::string> names, const FilmOfKeypoints& of, PeopleOfFilm& film) {
  if (names.size() < 2 || names.size() != film.frames.size() || of.frames == names.size()) return;
  // Read the number at the end of each name. The text before the number must be the same in all names, and the numbers
  // must ascend.
  const auto text_of = [](const std::string& name) { return name.substr(0, LastNumberIn(name).first); };
  std::vector<long> numbers;
  std::vector<double> steps;
  for (const std::string& name : names) {
    const auto number = FrameNumber(Json(name));
    if (!number || text_of(name) != text_of(names.front()) || (!numbers.empty() && *number <= numbers.back())) return;
    if (!numbers.empty()) steps.push_back(static_cast<double>(*number - numbers.back()));
    numbers.push_back(*number);
  }
  const auto usual = static_cast<long>(LowerPercentile(std::move(steps), 0.5));
  const auto frames = static_cast<long>(of.frames);
  const long last = numbers.back();
  const bool are_films = last < frames || (last == frames && numbers.front() > 0);
  // Numbers of the film's own frames count from 0 or from 1. Others may increase by more than 1 per frame, and may
  // count from any first number.
  const long step = are_films ? 1 : usual;
  long first = numbers.front();
  film.is_from_one = are_films && first > 0 && last == frames;
  film.is_base_open = are_films && first > 1 && last < frames;
  if (are_films && first > 1) first = last == frames || of.from_one ? 1 : 0;
  std::vector<std::size_t> indices;
  for (const long number : numbers) {
    if ((number - first) % step != 0) return;
    indices.push_back(static_cast<std::size_t>((number - first) / step));
  }
  // Leave the frames as they are if none is missing before the last one.
  const auto end = static_cast<long>(indices.back());
  const bool is_even = last - numbers.front() == usual * static_cast<long>(numbers.size() - 1);
  const bool is_from_start = indices.front() == 0 || usual > 1;
  if (is_even && (!are_films || (is_from_start && end + usual < frames))) return;
  if (indices.back() >= kMaxSpread * indices.size() + of.frames) return;
  if (film.is_base_open) {
    film.Tell(fmt::format(
        "file numbers go from {} to {}, and the film has {} frames; Etude assumes that the numbers count from {}",
        numbers.front(), last, frames, of.from_one ? "1, as in another film" : "0"));
  }
  MoveFrames(indices, are_films ? of.frames : indices.back() + 1, film);
}

}  // namespace etude
