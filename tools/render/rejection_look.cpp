#include "tools/render/rejection_look.hpp"

#include <array>

namespace gnbv {

std::span<const RejectionLook> rejection_looks() {
  static const std::array<RejectionLook, kRejectionNames.size()> all = {
      {{Rejection::out_of_bounds, "out of bounds", 0x6b7787},
       {Rejection::not_free, "not free", 0x6e3d12},
       {Rejection::collision, "collision", 0xc42d7c},
       {Rejection::path_blocked, "path blocked", 0xffe47c},
       {Rejection::recently_visited, "visited", 0xf2b8c6},
       {Rejection::cluster_outside_fov, "cluster outside view", 0x75e6f2},
       {Rejection::cluster_hidden, "cluster hidden", 0x4c00c4},
       {Rejection::sees_no_surface, "sees no surface", 0x8f9a1e},
       {Rejection::no_fly, "no-fly box", 0x004d3d},
       {Rejection::beyond_gimbal, "beyond the gimbal", 0xf12de9},
       {Rejection::search_limit, "search limit", 0xb08cff}}};
  return all;
}

}  // namespace gnbv
