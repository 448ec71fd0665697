// Lines and words of a panel that lie over its scene.
#pragma once

#include "tools/render/picture.hpp"

namespace gnbv {

/// The panel's lines, then its labels where `has_words`, on the picture of `view` with such layout
/// units.
void draw_place_marks(const Panel& panel, const RenderView& view, double unit_px, bool has_words,
                      Image& image);

}  // namespace gnbv
