// The view kernels for any processor.
#include "planner/view/view_kernel.hpp"

// the lanes first
#include "sim/core/lanes_scalar.hpp"
#include "sim/core/wide_sums.inl"
// then what is written in terms of them, in this order
#include "planner/map/voxel_word.hpp"
#include "planner/view/view_prepare.inl"
#include "planner/view/view_tally.inl"
#include "planner/view/view_walk.inl"

namespace gnbv {

extern const ViewKernels kViewKernelsScalar = {.prepare = prepare_rays,
                                               .walk_voxels = walk_rays<false>,
                                               .walk_full = walk_rays<true>,
                                               .tally_plane = tally_plane};

}  // namespace gnbv
