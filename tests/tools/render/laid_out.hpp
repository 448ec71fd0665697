// What tests of pictures share: a structure that nobody flew, layouts of one run, plain images.
#pragma once

#include "sim/mesh/world.hpp"
#include "tests/support/fault.hpp"
#include "tests/support/made_run.hpp"
#include "tests/support/temp_folder.hpp"
#include "tools/render/pictures.hpp"

namespace gnbv {

/// Of twelve faces, for pictures of runs that never flew.
inline World cube() {
  World world;
  world.structure = box_mesh(Box3(Vec3(-1.0, -1.0, 0.0), Vec3(1.0, 1.0, 2.0)));
  return world;
}

/// The files of write_made_run() and what they hold.
struct MadeRun {
  /// Around that structure, as the record then says.
  RunSource source() const { return {record, cube()}; }

  TempFolder temp;
  RunRecord record = (write_made_run(temp.path()), read_run(temp.path()));
};

inline PanelLayout layout_of(const PictureKind& kind, RunSource& run,
                             const PictureOptions& options = {}) {
  RunSource* const runs[] = {&run};
  return lay_out(kind, runs, options);
}

inline RenderView view_of(const PictureKind& kind, RunSource& run,
                          const PictureOptions& options = {}) {
  return layout_of(kind, run, options).view;
}

inline RenderScene scene_of(const PictureKind& kind, RunSource& run,
                            const PictureOptions& options = {}) {
  return kind.draw(run, options, view_of(kind, run, options)).panels.at(0).scene;
}

/// All of one grey.
inline Image paper(int width_px, int height_px, std::uint8_t level = 255) {
  return {width_px, height_px,
          std::vector<std::uint8_t>(static_cast<std::size_t>(3 * width_px * height_px), level)};
}

}  // namespace gnbv
