#include "sim/performer/stray.h"

#include <array>

namespace etude {

std::string_view TruthName(Truth truth) {
  constexpr std::array<std::string_view, 3> kNames = {"right", "grey", "wrong"};
  return kNames[static_cast<std::size_t>(truth)];
}

Truth TruthOf(const Stray& stray, const StrayLimits& limits) {
  const auto is_within = [&](const Stray& limit) {
    return stray.limb_deg <= limit.limb_deg && stray.timing_beats <= limit.timing_beats;
  };
  if (is_within(limits.right)) return Truth::kRight;
  return is_within(limits.wrong) ? Truth::kGrey : Truth::kWrong;
}

}  // namespace etude
