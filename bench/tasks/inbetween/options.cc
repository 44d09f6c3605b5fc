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
      {Key::Texts("truth", &Options::truth, "a list of motion files, patterns and folders",
                  "The true motions. Some frames of these motions are hidden from the methods. The files need joint "
                  "rotations.")
           .WhenAbsent("(required)"),
       Key::Texts("training", &Options::training, "a list of motion files, patterns and folders",
                  "The motions from which Etude computes the standard deviations for L2P and the joints' offsets. "
                  "Fillers with a library (`planted-feet`, `near-gaps`, `nearest-gap`) also use these motions. No "
                  "motion may be in both `training` and `truth`.")
           .WhenAbsent("(required)"),
       Key::Text("people", &Options::people, "a pattern such as '*_{person}'",
                 "A pattern that marks the part of a file's name that identifies the person. Verdicts that are meant "
                 "for other files count each person once.")
           .WhenAbsent("(each file counts once)"),
       Key::Number("window", &Options::window, kFrames, "Length of a window, in frames."),
       Key::Number("offset", &Options::offset, kFrames,
                   "Number of frames from the beginning of one window to the beginning of the next window."),
       Key::Number("training_window", &Options::training_window, kFrames, "Length of a training window, in frames."),
       Key::Number(
           "training_offset", &Options::training_offset, kFrames,
           "Number of frames from the beginning of one training window to the beginning of the next training window."),
       Key::Number("past", &Options::past, {3, 10'000},
                   "Number of frames before the gap. Methods get all these frames."),
       Key::Number("gap", &Options::gap, kFrames, "Number of hidden frames."),
       Key::Number("future", &Options::future, {3, 10'000}, "Number of frames that a window must have after the gap."),
       Key::Number("given", &Options::given, {1, 10'000}, "Number of frames after the gap that methods get."),
       Key::Number("rate_hz", &Options::rate_hz, {1, 1000}, "The frame rate to which motions are resampled, in Hz.")
           .WhenAbsent("(each file's own)"),
       Key::Name("facing", &Options::facing, {{"x", {1, 0, 0}}, {"y", {0, 1, 0}}, {"z", {0, 0, 1}}},
                 "The axis of the root joint that points forward. Each window is turned so that this axis points to "
                 "the world's X in the last frame before the gap."),
       Key::Name("offsets", &Options::own_offsets, {{"training", false}, {"own", true}},
                 "The bone offsets that are used. training: the offsets of the first training file; own: the offsets "
                 "of each file.")},
      [](Fields& fields, Options& options) {
        const auto& [past, gap, future, given] = std::tie(options.past, options.gap, options.future, options.given);
        if (past + gap + future <= options.window && past <= options.training_window && given <= future) return;
        fields.Complain(fields.node().place,
                        fmt::format("past ({}) + gap ({}) + future ({}) must not exceed window ({}), past must not "
                                    "exceed training_window ({}), and given ({}) must not exceed future",
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
    FieldTable<Method> made{{Key::Name("filler", &Method::filler, values, "The method that fills in the hidden frames.")
                                 .WhenAbsent("(required without `oracle`)"),
                             Key::Flags("oracle", {{"frames", &Method::knows_frames}},
                                        "frames: the answer contains the true hidden frames, which shows the values of "
                                        "the metrics for the truth.")}};
    for (const Key& key : SettingFields<Method>("filler", AllFillers(), &Method::settings)) made.fields.push_back(key);
    made.check = [](Fields& fields, Method& method) {
      if (method.knows_frames == (method.filler != nullptr))
        fields.Complain(fields.node().place, "a method needs exactly one of 'filler' and 'oracle: [frames]'");
    };
    return made;
  }();
  return table;
}

}  // namespace etude
