// The layout and the view of a picture of one run.
#pragma once

#include "tools/render/pictures.hpp"

namespace gnbv {

inline PanelLayout layout_of(const PictureKind& kind, RunSource& run,
                             const PictureOptions& options = {}) {
  RunSource* const runs[] = {&run};
  return lay_out(kind, runs, options);
}

inline RenderView view_of(const PictureKind& kind, RunSource& run,
                          const PictureOptions& options = {}) {
  return layout_of(kind, run, options).view;
}

}  // namespace gnbv
