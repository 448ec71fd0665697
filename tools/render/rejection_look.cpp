#include "tools/render/rejection_look.hpp"

#include <array>

namespace gnbv {

std::span<const RejectionLook> rejection_looks() {
  static const std::array<RejectionLook, 10> all = {
      {{Rejection::out_of_bounds, "out of bounds", 0x9aa3ae},
       {Rejection::not_free, "not free", 0x552747},
       {Rejection::collision, "collision", 0xc42d7c},
       {Rejection::path_blocked, "path blocked", 0xffe47c},
       {Rejection::recently_visited, "visited", 0xeab79d},
       {Rejection::cluster_outside_fov, "cluster outside view", 0x75e6f2},
       {Rejection::cluster_hidden, "cluster hidden", 0x4c00c4},
       {Rejection::sees_no_surface, "sees no surface", 0xcb9a2b},
       {Rejection::no_fly, "no-fly box", 0x444500},
       {Rejection::beyond_gimbal, "beyond the gimbal", 0xf12de9}}};
  return all;
}

}  // namespace gnbv
