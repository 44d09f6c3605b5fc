#include "engine/transitions/joins/join.h"

#include <array>

#include "engine/base/named.h"
#include "engine/transitions/joins/crossfade.h"
#include "engine/transitions/joins/inertialise.h"
#include "engine/transitions/joins/minimum_jerk.h"
#include "engine/transitions/joins/placing.h"
#include "engine/transitions/joins/planted_feet.h"

namespace etude {
namespace {

Blend CutOver(const JoinInput& /*input*/, std::span<const double> /*values*/) {
  return [](const BodyPose& target, int /*frames*/) { return target; };
}

Blend SpringDefaults(const JoinInput& input, std::span<const double> /*values*/) { return InertialiseSpring(input); }

/// Adapts a join with settings to the `begin` function of a table row; the settings are read from `values`.
template <auto Begin, auto Settings>
Blend BeginWith(const JoinInput& input, std::span<const double> values) {
  return Begin(input, Settings().Apply(values));
}

// Returns the table of joins. The table is made on the first call; by then the strings that it uses are initialised.
std::span<const JoinKind> Table() {
  static const std::array kJoins = {
      // Joins of papers and games.
      JoinKind{.name = "cut",
               .description = "paper A's method: a cut; the next frame shown is a frame of the new clip",
               .begin = CutOver},
      JoinKind{.name = "crossfade",
               .description = "the old motion fades into the new one (Kovar 2002)",
               .settings = CrossfadeSettings().Describe(),
               .begin = BeginWith<Crossfade, CrossfadeSettings>},
      JoinKind{
          .name = "inertialised-quintic",
          .description = "the offset from the new motion decays along a quintic that does not overshoot (Bollo 2018)",
          .settings = QuinticSettings().Describe(),
          .begin = BeginWith<InertialiseQuintic, QuinticSettings>},
      JoinKind{.name = "inertialised-spring",
               .description = "the offset from the new motion decays like a critically damped spring (Holden 2020)",
               .begin = SpringDefaults},
      JoinKind{
          .name = "dead-blending",
          .description = "the old motion continues with decaying velocities while the new one fades in (Holden 2023)",
          .settings = DeadSettings().Describe(),
          .begin = BeginWith<DeadBlending, DeadSettings>},
      // Our own joins.
      JoinKind{.name = "minimum-jerk",
               .description =
                   "the offset from the new motion decays along the minimum-jerk quintic, for any initial velocity",
               .settings = MinimumJerkSettings().Describe(),
               .begin = BeginWith<MinimumJerk, MinimumJerkSettings>},
      JoinKind{.name = "planted-feet",
               .description = "like minimum-jerk, but each foot goes from the path of the old motion to the path of "
                              "the new motion in one step",
               .settings = MinimumJerkSettings().Describe(),
               .begin = BeginWith<PlantedFeet, MinimumJerkSettings>,
               .align = AlignOnPlantedFeet},
  };
  return kJoins;
}

}  // namespace

std::span<const JoinKind> AllJoins() { return Table(); }

std::vector<std::string> JoinNames() { return NamesOf(AllJoins()); }
const JoinKind* FindJoin(std::string_view name) { return FindByName(AllJoins(), name); }

}  // namespace etude
