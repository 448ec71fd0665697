// The path of a run around its structure, as Figure 8 of the paper shows it.
#pragma once

#include <filesystem>
#include <string>

#include "tools/record/run_record.hpp"
#include "tools/render/scene.hpp"

namespace gnbv {

struct RunPictureOptions {
  int width_px = 1280;
  int height_px = 720;
  ViewAngles angles;
  int frustum_every = 0;    // a camera pyramid at every n-th view; 0 = about 40 in all
  bool has_caption = true;  // pictures under 320 x 240 px never have one
  std::string title;        // empty: scenario and utility
};

/// Camera that shows the structure, the path and the views, and nothing more.
RenderView run_view(const RunRecord& record, const TriangleMesh& structure,
                    const RunPictureOptions& options);

/// Structure, ground, path (profile flight in grey, planned flight coloured from its first view to
/// its last), a ball at each view and pyramids at some. Lines are as thick as suits `view`.
RenderScene run_scene(const RunRecord& record, const TriangleMesh& structure,
                      const RunPictureOptions& options, const RenderView& view);

/// Title, figures, colour key, and a scale that is true at the structure's depth.
void draw_run_caption(Image& image, const RunRecord& record, const RunPictureOptions& options,
                      const RenderView& view);

/// The picture of a run as a PNG. `structure` is the mesh that its scenario names. Throws BadInput
/// as Renderer and write_png() do.
void render_run(const RunRecord& record, const TriangleMesh& structure,
                const RunPictureOptions& options, const std::filesystem::path& png);

}  // namespace gnbv
