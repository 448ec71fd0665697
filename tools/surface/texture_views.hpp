// Which picture shows which face of a surface best.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "sensors/camera_model.hpp"
#include "sensors/ray_scene.hpp"
#include "sim/core/image.hpp"
#include "tools/run/frames_folder.hpp"

namespace gnbv {

using Vec2f = Eigen::Vector2f;

/// A picture's camera, and how far it measured.
struct TextureView {
  Isometry T_camera_world = Isometry::Identity();  // optical frame
  Vec3f p_world_m = Vec3f::Zero();                 // where it was
  FrameCamera camera;
  GreyImage16 depth_steps = {};  // pixel by pixel with the picture; empty when it is not known
  double range_max_m = std::numeric_limits<double>::infinity();  // it measures no depth beyond

  /// Picture coordinates in px, (0, 0) the outer corner of the top left pixel; only for points
  /// before the camera.
  Vec2f pixel_of(const Vec3f& p_world_m_) const;
};

/// The views of all frames, in their order, with their depth images; ranges are those of the
/// cameras of the same name. Throws BadInput naming an image that cannot be read or has another
/// size than its camera.
std::vector<TextureView> texture_views(const FrameRecord& record,
                                       std::span<const CameraConfig> cameras, int threads);

constexpr std::int32_t kNoView = -1;
constexpr std::uint32_t kNoNeighbour = 0xffffffffU;

struct ViewChoiceSettings {
  double texels_per_m = 100.0;  // finer pictures are no better
  double hidden_m = 0.1;        // what a ray meets this far before a face hides it
};

/// The view of each face, kNoView where none shows it.
///
/// A view shows a face when all corners lie in the picture (a pixel off its border), the face turns
/// its front to the camera, and rays from the camera to its middle and past its corners meet
/// nothing of the reconstruction before it. Where the view has a depth image, that agrees at the
/// corners, or the face lies beyond the camera's range: depth jumps at the true outline. Views
/// whose depth agrees come first; others serve no face at the reconstruction's own outline, which
/// the rays pass and where the picture may show the background.
///
/// The quality of a view is the resolution it gives the face (cosine of the angle over the square
/// of the distance), no more than the texture's, times the cosine. Of the views at least 0.6 as
/// good as a face's best, it gets the one that serves the most faces (greedy set cover), so that
/// charts are large and seams are few. `scene` holds `mesh` and nothing else. Deterministic at any
/// number of threads.
std::vector<std::int32_t> choose_views(const TriangleMesh& mesh, const RayScene& scene,
                                       std::span<const TextureView> views,
                                       const ViewChoiceSettings& settings, int threads);

struct ViewCandidate {
  std::uint32_t view = 0;
  float quality = 0.0F;
};

/// The views that show each face, at least 0.6 as good as its best one, best first.
std::vector<std::vector<ViewCandidate>> view_candidates(const TriangleMesh& mesh,
                                                        const RayScene& scene,
                                                        std::span<const TextureView> views,
                                                        const ViewChoiceSettings& settings,
                                                        int threads);

/// For each face the one across its edge from corner k to corner k + 1; kNoNeighbour at a rim and
/// where more than two faces meet.
std::vector<std::array<std::uint32_t, 3>> neighbours_across_edges(const TriangleMesh& mesh);

}  // namespace gnbv
