#include <CLI/CLI.hpp>
#include <memory>

#include "cli/coach_command.h"
#include "cli/common_arguments.h"
#include "cli/validators.h"
#include "engine/coaching/policy.h"
#include "engine/recognition/filters.h"
#include "engine/recognition/recognisers.h"
#include "engine/streams/recording.h"
#include "engine/transitions/choices/choice.h"
#include "engine/transitions/joins/join.h"

namespace etude {
namespace {

constexpr const char* kCoachExamples =
    "\nA device's skeletons go in line by line, what to show comes out line by line: JSON, a head that tells the "
    "song,\n"
    "its moves and their key poses, then an object for each frame (docs/coach.md tells all keys). The coach waits for "
    "a\n"
    "clap, dances, judges every performance, and by --policy interrupts: it shakes its head, waves or is puzzled, "
    "shows\n"
    "the move slowly, and goes back to it. It is the program that scenarios of `task: coach` judge.\n\n"
    "Rows are what `etude clip convert` writes as CSV, or a Kinect's (docs/streams.md). Music is yours to play: a\n"
    "frame's \"music\" says from where, and when to stop; a line '#music 12.34' in the stream tells the coach where "
    "it\n"
    "really is, so that moves are slowed and hurried to stay with it.\n\n"
    "Try:\n"
    "  etude coach warm_up --stream take.csv --brief          what would the coach have said to this recording?\n"
    "  my_sensor | etude coach groove --stream - | my_stage   live\n"
    "  etude coach my_song.yaml --beats my_song.txt --click clicks.wav --stream - --policy after-n\n"
    "  etude teach clap.csv jump.csv -o mine.yaml && etude coach groove --moves mine.yaml --recogniser dtw --stream -\n"
    "  etude clip convert builtin:warm_up me.csv && etude coach warm_up --now --brief --stream me.csv";

}  // namespace

void DefineCoach(CLI::App& app, Action& action) {
  auto options = std::make_shared<CoachCommandOptions>();
  CLI::App* command = app.add_subcommand("coach", "Coach a dance live: skeletons in, what to show out");
  command->add_option("song", options->song, "A song: a built-in one (etude list clips), or a file (.yaml)")
      ->required();
  command->add_option("--stream", options->stream, "A file of skeleton rows; -: standard input, as they come")
      ->required();
  command->add_option("--moves", options->moves,
                      "A moves file (etude teach): what the song's moves look like when they are right");
  command->add_option("--beats", options->beats, "When the music's beats sound: a text file, seconds, one a line");
  command->add_option("--click", options->click, "Write a click for every beat, too (.wav)");
  command->add_option("--recogniser", options->recogniser, "How performances are recognised")
      ->check(CLI::IsMember(RecogniserNames()))
      ->capture_default_str();
  command
      ->add_option("--right-from", options->right_from,
                   "From which evidence on a performance is right (default: the recogniser's own)")
      ->check(NumberWithin(0.001, 1, "evidence"));
  command->add_option("--policy", options->policy, "When the coach interrupts")
      ->check(CLI::IsMember(LivePolicyNames()))
      ->capture_default_str();
  command->add_option("--choice", options->choice, "Where clips are left and entered")
      ->check(CLI::IsMember(ChoiceNames()))
      ->capture_default_str();
  command->add_option("--join", options->join, "How they are put together there")
      ->check(CLI::IsMember(JoinNames()))
      ->capture_default_str();
  command->add_option("--filter", options->filter, "Smooths the skeletons")
      ->check(CLI::IsMember(FilterNames()))
      ->capture_default_str();
  command->add_flag("--mirror", options->mirror, "Players dance as in a mirror: the coach's left is their right");
  command->add_flag("--now", options->now, "Dance at once, without a clap");
  command->add_flag("--brief", options->brief, "Leave out frames in which nothing was decided, and bodies");
  command->add_flag("--timing", options->timing, "Tell at the end how long frames took");
  command->add_option("--format", options->format, "Of the stream (default: told by content)")
      ->check(CLI::IsMember(StreamFormatNames()));
  command->add_option("--rate", options->rate_hz, "Of a stream without a clock, Hz (default: 30)")
      ->check(NumberWithin(1, 1000, "rate in Hz"));
  command->add_flag("--reflect", options->reflect, "The stream's X axis runs the other way");
  AddOverwrite(*command, options->overwrite);
  command->footer(kCoachExamples);
  command->callback([=, &action] { action = [=] { return CoachCommand(*options); }; });
}

}  // namespace etude
