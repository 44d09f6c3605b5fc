#include "bench/tasks/inbetween/options.h"

#include <fmt/format.h>

#include <tuple>

namespace etude {

const FieldTable<InbetweenOptions>& InbetweenConditionFields() {
  using Options = InbetweenOptions;
  using Key = Field<Options>;
  constexpr Range kFrames{1, 10'000};
  // The keys, each with its range and its sentence for the reference.
  static const FieldTable<Options> table{
      {Key::Texts("truth", &Options::truth, "a list of motion files, patterns, folders",
                  "The motions of which frames are hidden; they need rotations of joints.")
           .WhenAbsent("(none: it must stand)"),
       Key::Texts(
           "training", &Options::training, "a list of motion files, patterns, folders",
           "The motions that give L2P's deviations, the joints' offsets and what `nearest-gap` takes; none of `truth`.")
           .WhenAbsent("(none: it must stand)"),
       Key::Text("people", &Options::people, "a pattern such as '*_{person}'",
                 "Which part of a file's name is the person: what claims beyond these files count.")
           .WhenAbsent("(each file counts for itself)"),
       Key::Number("window", &Options::window, kFrames, "Frames of a window that is judged."),
       Key::Number("offset", &Options::offset, kFrames, "Frames from one window's first to the next one's."),
       Key::Number("training_window", &Options::training_window, kFrames, "Frames of a training window."),
       Key::Number("training_offset", &Options::training_offset, kFrames, "The same from one to the next."),
       Key::Number("past", &Options::past, {3, 10'000}, "Frames before the gap, all given."),
       Key::Number("gap", &Options::gap, kFrames, "Hidden frames."),
       Key::Number("future", &Options::future, {3, 10'000}, "Frames that a window must have behind the gap."),
       Key::Number("given", &Options::given, {1, 10'000}, "How many of them are given."),
       Key::Number("rate_hz", &Options::rate_hz, {1, 1000}, "The rate to which motions are sampled.")
           .WhenAbsent("(each file's own)"),
       Key::Name("facing", &Options::facing, {{"x", {1, 0, 0}}, {"y", {0, 1, 0}}, {"z", {0, 0, 1}}},
                 "The root's own axis that each window turns to the world's X, in the last past frame."),
       Key::Name("offsets", &Options::own_offsets, {{"training", false}, {"own", true}},
                 "Whose offsets from joint to joint are used: the first training file's, or each file's own.")},
      // Check that past, gap and future fit into the windows.
      [](Fields& fields, Options& options) {
        const auto& [past, gap, future, given] = std::tie(options.past, options.gap, options.future, options.given);
        if (past + gap + future <= options.window && past <= options.training_window && given <= future) return;
        fields.Complain(fields.node().place,
                        fmt::format("past {}, gap {} and future {} must fit into a window of {} frames, past into "
                                    "a training window of {}, given {} into future",
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
                                 .WhenAbsent("(none: it must stand, unless `oracle` does)"),
                             Key::Flags("oracle", {{"frames", &Method::knows_frames}},
                                        "`frames`: the hidden frames themselves, what the metrics give the truth.")}};
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
