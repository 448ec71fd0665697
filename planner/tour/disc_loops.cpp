#include "planner/tour/disc_loops.hpp"

#include "sim/core/lanes.hpp"

namespace gnbv {
namespace {

void draw_row(const Disc& disc, const DepthImage& image, int v) {
  constexpr float kLeastAcross = 1e-3F;  // a disc seen from its edge covers nothing
  const float ray_y = image.ray_y[v];
  const float across_row = disc.normal[1] * ray_y + disc.normal[2];
  float* const row_m = image.depth_m + static_cast<std::ptrdiff_t>(v) * image.width_px;
  for (int u = disc.u0; u <= disc.u1; u += kLanes) {
    const Floats ray_x = load(image.ray_x + u);
    const Floats across = all(disc.normal[0]) * ray_x + all(across_row);
    const Floats z_m = all(disc.along_m) / across;
    const Floats off_x_m = z_m * ray_x - all(disc.p_m[0]);
    const Floats off_y_m = z_m * all(ray_y) - all(disc.p_m[1]);
    const Floats off_z_m = z_m - all(disc.p_m[2]);
    const Floats off_m2 = off_x_m * off_x_m + (off_y_m * off_y_m + off_z_m * off_z_m);
    const Mask is_covered = less(int_ramp(), all(disc.u1 - u + 1)) &
                            less_equal(all(kLeastAcross), hn::Abs(across)) &
                            less_equal(off_m2, all(disc.radius2_m2));
    const Floats before_m = load(row_m + u);
    store(row_m + u, select(is_covered & less(z_m, before_m), z_m, before_m));
  }
}

void draw(const Disc* discs, std::size_t count, const DepthImage& image) {
  for (std::size_t i = 0; i < count; ++i) {
    for (int v = discs[i].v0; v <= discs[i].v1; ++v) draw_row(discs[i], image, v);
  }
}

}  // namespace

namespace GNBV_SIMD_LEVEL {

const DiscKernels kDiscKernels = {draw};

}  // namespace GNBV_SIMD_LEVEL
}  // namespace gnbv
