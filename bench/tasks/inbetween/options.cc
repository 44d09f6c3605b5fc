#include "bench/tasks/inbetween/options.h"

#include <fmt/format.h>

#include <tuple>

namespace etude {

const FieldTable<InbetweenOptions>& InbetweenConditionFields() {
  using Options = InbetweenOptions;
  using Key = Field<Options>;
  constexpr Range kFrames{1, 10'000};
  // Keys of the files, the windows and the gap, the rate, the orientation and the bone offsets.
  static const FieldTable<Options> table{
      {Key::Texts("truth", &Options::truth, "a list of motion files, patterns, folders",
                  "The true motions. Some of their frames are hidden from the methods. The files need joint rotations.")
           .WhenAbsent("(required)"),
       Key::Texts("training", &Options::training, "a list of motion files, patterns, folders",
                  "The motions for L2P's standard deviations, for the joints' offsets and for fillers that use a "
                  "library (`planted-feet`, `near-gaps`, `nearest-gap`); they must not be among those of `truth`.")
           .WhenAbsent("(required)"),
       Key::Text("people", &Options::people, "a pattern such as '*_{person}'",
                 "Which part of a file's name is the person; verdicts that hold for other files, too, count each "
                 "person once.")
           .WhenAbsent("(each file counts for itself)"),
       Key::Number("window", &Options::window, kFrames, "Length of a window, in frames."),
       Key::Number("offset", &Options::offset, kFrames, "Frames from the beginning of one window to that of the next."),
       Key::Number("training_window", &Options::training_window, kFrames, "Length of a training window, in frames."),
       Key::Number("training_offset", &Options::training_offset, kFrames,
                   "Frames from the beginning of one training window to that of the next."),
       Key::Number("past", &Options::past, {3, 10'000}, "Frames before the gap; methods get all of them."),
       Key::Number("gap", &Options::gap, kFrames, "Number of hidden frames."),
       Key::Number("future", &Options::future, {3, 10'000}, "Frames that a window must have after the gap."),
       Key::Number("given", &Options::given, {1, 10'000}, "Number of frames after the gap that methods get."),
       Key::Number("rate_hz", &Options::rate_hz, {1, 1000}, "The rate to which motions are resampled, Hz.")
           .WhenAbsent("(each file's own)"),
       Key::Name("facing", &Options::facing, {{"x", {1, 0, 0}}, {"y", {0, 1, 0}}, {"z", {0, 0, 1}}},
                 "The axis of the root joint that points forward: each window is turned so that it points to the "
                 "world's X in the last frame before the gap."),
       Key::Name("offsets", &Options::own_offsets, {{"training", false}, {"own", true}},
                 "Whose bone offsets are used: those of the first training file, or each file's own.")},
      [](Fields& fields, Options& options) {
        const auto& [past, gap, future, given] = std::tie(options.past, options.gap, options.future, options.given);
        if (past + gap + future <= options.window && past <= options.training_window && given <= future) return;
        fields.Complain(fields.node().place,
                        fmt::format("past {} + gap {} + future {} must be at most the window of {} frames, past at "
                                    "most the training window of {} frames, and given {} at most future",
                                    past, gap, future, options.window, options.training_window, given));
      }};
  return table;
}

const FieldTable<InbetweenMethod>& InbetweenMethodFields() {
  using Method = InbetweenMethod;
  using Key = Field<Method>;
  static const FieldTable<Method> table = [] {
    NamedValues<const Filler*> values;
    for (const Filler& filler : AllFillers()) values.emplace_back(filler.name, &filler);
    FieldTable<Method> made{{Key::Name("filler", &Method::filler, values, "How the hidden frames are filled in.")
                                 .WhenAbsent("(required, unless `oracle` is given)"),
                             Key::Flags("oracle", {{"frames", &Method::knows_frames}},
                                        "`frames`: the answer is the hidden frames themselves, to show the values of "
                                        "the metrics for the truth.")}};
    for (const Key& key : SettingFields<Method>("filler", AllFillers(), &Method::settings)) made.fields.push_back(key);
    made.check = [](Fields& fields, Method& method) {
      if (method.knows_frames == (method.filler != nullptr))
        fields.Complain(fields.node().place, "a method needs either 'filler' or 'oracle: [frames]'");
    };
    return made;
  }();
  return table;
}

}  // namespace etude
