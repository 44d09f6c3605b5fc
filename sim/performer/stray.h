#pragma once

#include <string_view>

namespace etude {

/// How far a performance strays from what the person meant: from the same person's own performance of the move asked
/// for, with the same habits and the same dice, but without a fault. No other person's motion, no taught clip and no
/// recogniser has a part in it.
struct Stray {
  /// The worst limb's: how far its direction, seen from the person's own trunk, is from what was meant; root mean
  /// square over the performance, degrees. Compared at equal shares of the performance, whatever the clock says.
  double limb_deg = 0;
  /// How far the clock is from what was meant: root mean square over the performance, beats of the move.
  double timing_beats = 0;
};

/// What a performance truly is.
enum class Truth {
  kRight,
  kGrey,  ///< neither: reported apart, no method gains or loses by it
  kWrong,
};
/// "right", "grey", "wrong".
std::string_view TruthName(Truth truth);

/// Where right ends and wrong begins (ours).
struct StrayLimits {
  Stray right{.limb_deg = 15, .timing_beats = 0.25};
  Stray wrong{.limb_deg = 30, .timing_beats = 0.5};
};

/// Right: both measures within the first limits. Wrong: one of them beyond the second. Else grey.
Truth TruthOf(const Stray& stray, const StrayLimits& limits = {});

}  // namespace etude
