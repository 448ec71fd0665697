// The renderer of scenes.
#pragma once

#include <memory>

#include "tools/scene/scene.hpp"

namespace gnbv {

/// Draws scenes off screen with Mesa on the CPU, which is loaded here, at run time. Use from one
/// thread.
class Renderer {
 public:
  /// Throws BadInput when Mesa is missing or too old, naming the Debian packages.
  Renderer();
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// The same scene and view give the same bytes. Throws BadInput for a size outside
  /// [1, kMaxSide_px], or of more than kMaxArea_px.
  Image render(const RenderScene& scene, const RenderView& view);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Mesa's largest target is 16384 px and every pixel is drawn as 2 x 2.
constexpr int kMaxSide_px = 8192;
/// An 8K picture: 1 GB of colour and depth while it is drawn.
constexpr std::int64_t kMaxArea_px = 7680 * 4320;

/// One picture with a renderer of its own (about 50 ms dearer than a kept one).
Image render(const RenderScene& scene, const RenderView& view);

}  // namespace gnbv
