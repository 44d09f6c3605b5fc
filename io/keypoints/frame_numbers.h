#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "io/files/json.h"
#include "io/keypoints/read_people.h"

namespace etude {

/// Returns true if name `a` sorts before `b`, with numbers compared by value: frame 9 comes before frame 10.
bool NaturallyBefore(std::string_view a, std::string_view b);

/// Returns true if the names differ and each has a number where they begin to differ, so that NaturallyBefore puts them
/// in the order of these numbers.
bool AreNumbered(std::span<const std::string> names);

/// Returns the number of a frame: `id` itself, or the last number in a file's name.
std::optional<long> FrameNumber(const Json& id);

/// Puts numbered frames in order and returns them as a film. A frame without a number shows nobody.
/// - If the film's number of frames is unknown, numbers count from 0 or, if none is 0, from 1.
/// - If all numbers are below the film's number of frames, they count from 0, or from 1 if none is 0 and `of.from_one`
///   is true; if the last one equals it, from 1.
/// - If the numbers are higher, and all numbers from the first to the last, or every n-th of them, are as many as the
///   film's frames, the first number belongs to the film's first frame. Fails for other numbers. `told` says if the
///   first number is an assumption.
Result<PeopleOfFilm> FilmOfNumbers(std::map<long, std::vector<SeenPerson>> numbered, const FilmOfKeypoints& of,
                                   const Place& place);

/// Moves the frames of a film to the positions that their times state, in any unit, and `told` says so. The times count
/// from the film's start if they then lie within it; otherwise the first time is the first frame. Does nothing if the
/// times do not ascend or are too uneven.
void LayByTimes(const std::vector<double>& times, const FilmOfKeypoints& of, PeopleOfFilm& film);

/// Moves the frames of a film, one per file name, to the positions that the numbers at the ends of the names state.
/// Inserts a frame without people for each missing number, and `told` says so. Numbers up to the film's number of
/// frames are numbers of its frames, from 0, or from 1 if that is the first or if the last equals the number of frames.
/// Other numbers count from the first one, in their median step. Leaves the frames as they are if the names do not
/// begin with the same text, if the numbers do not ascend or differ by fractions of their median step, if the film has
/// as many frames as there are names, if frames are missing only at the end, or if the last position would be at least
/// `of.frames` plus ten times the number of names.
void LayByNames(std::span<const std::string> names, const FilmOfKeypoints& of, PeopleOfFilm& film);

}  // namespace etude
