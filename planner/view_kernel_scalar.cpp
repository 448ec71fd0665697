// The view kernels for any processor.
#include "planner/view_kernel.hpp"

// the lanes first
#include "planner/lanes/scalar.hpp"
// then what is written in terms of them, in this order
#include "planner/lanes/wide_sums.inl"
#include "planner/map/voxel_word.hpp"
#include "planner/view_prepare.inl"
#include "planner/view_tally.inl"
#include "planner/view_walk.inl"

namespace gnbv {

extern const ViewKernels kViewKernelsScalar = {.prepare = prepare_rays,
                                               .walk_voxels = walk_rays<false>,
                                               .walk_full = walk_rays<true>,
                                               .tally_plane = tally_plane};

}  // namespace gnbv
