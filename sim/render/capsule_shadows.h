#pragma once

#include <vector>

#include "sim/render/empty_room.h"
#include "sim/render/scene.h"

namespace etude {

/// Draws the shadows that the capsules of figures cast on the empty room. The depth to which the line from the lamp to
/// a pixel runs inside a capsule determines the lamp's remaining light; shadows are softer the farther they fall, and
/// where shadows overlap the darkest counts. In interiors, capsules close to a surface also darken it by contact
/// shadows. Before the call, `view` shows `rows` of the empty room. Shadows of the lamp are labelled kShadow,
/// except on furniture, which keeps its label.
void CastCapsuleShadows(const KeptRoom& kept, const Room& room, const std::vector<Figure>& figures, Targets targets,
                        const RowRange& rows, View& view);

/// Marks the pixels of the overlay that the capsules of figures shadow in the studio's room and that show nothing else.
void MarkCapsuleShadows(const KeptRoom& kept, const std::vector<Figure>& figures, Overlay& overlay);

}  // namespace etude
