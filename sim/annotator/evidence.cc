#include "sim/annotator/evidence.h"

#include <utility>

#include "sim/annotator/regions.h"

namespace etude {
namespace {

LimbRegions ByStroke(Regions regions) {
  LimbRegions limbs{.width = regions.width,
                    .height = regions.height,
                    .trunk = std::move(regions.parts[static_cast<std::size_t>(Part::kTrunk)]),
                    .limbs = {},
                    .borders = std::move(regions.borders)};
  for (std::size_t i = 0; i < kStrokeCount; ++i) {
    limbs.limbs[i] = std::move(regions.parts[static_cast<std::size_t>(kLimbParts[i].limb)]);
  }
  return limbs;
}

}  // namespace

PictureEvidence SeePicture(const AnnotatedPicture& picture, const EvidenceOptions& options) {
  const LimbRegions regions = ByStroke(FindRegions(picture.labels, picture.colours, picture.person, options.margin_px));
  return FindLimbEvidence(regions, options.look);
}

}  // namespace etude
