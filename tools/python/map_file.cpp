#include "tools/python/map_file.hpp"

#include <nanobind/stl/string.h>

#include <bit>
#include <charconv>
#include <cstring>
#include <string>
#include <vector>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/python/arrays.hpp"

namespace gnbv {
namespace {

/// OctoMap's .ot: a text head, then each node before its children: float32 log-odds, and a byte
/// whose bits say which of the eight children follow.
class OtReader {
 public:
  explicit OtReader(std::string path) : path_(std::move(path)), bytes_(read_file(path_)) {
    const std::size_t res = bytes_.find("\nres ");
    const std::size_t data = bytes_.find("\ndata\n");
    if (!bytes_.starts_with("# Octomap OcTree file") || res == std::string::npos ||
        data == std::string::npos) {
      fail("is no OctoMap .ot file");
    }
    // whatever locale Python is in
    const char* const number = bytes_.data() + res + 5;
    const auto [end, error] = std::from_chars(number, bytes_.data() + data, resolution_m_);
    if (error != std::errc{} || !(resolution_m_ > 0.0)) fail("states no resolution");
    at_ = data + 6;
    if (at_ < bytes_.size()) read_node(0, {-kHalf, -kHalf, -kHalf});
    if (at_ < bytes_.size()) fail("has more behind its end");
  }

  /// x, y, z, size, log-odds of each leaf; m, world ENU.
  std::vector<double> rows;

 private:
  static constexpr int kDepth = 16;
  static constexpr std::int32_t kHalf = 1 << (kDepth - 1);
  using Corner = std::array<std::int32_t, 3>;

  [[noreturn]] void fail(const char* what) const {
    throw BadInput(fmt::format("{}: {}", path_, what));
  }

  void read_node(int depth, const Corner& corner) {
    if (at_ + 5 > bytes_.size() || depth > kDepth) fail("is cut short or damaged");
    float log_odds = 0.0F;
    std::memcpy(&log_odds, bytes_.data() + at_, sizeof log_odds);
    const auto children = static_cast<unsigned char>(bytes_[at_ + 4]);
    at_ += 5;
    const std::int32_t size = 1 << (kDepth - depth);
    if (children == 0) {
      const double half_m = 0.5 * size * resolution_m_;
      for (const std::int32_t low : corner) rows.push_back(low * resolution_m_ + half_m);
      rows.push_back(2.0 * half_m);
      rows.push_back(static_cast<double>(log_odds));
      return;
    }
    for (int child = 0; child < 8; ++child) {
      if ((children >> child & 1) == 0) continue;
      Corner at = corner;
      for (std::size_t axis = 0; axis < 3; ++axis) at[axis] += (child >> axis & 1) * (size / 2);
      read_node(depth + 1, at);
    }
  }

  std::string path_;
  std::string bytes_;
  double resolution_m_ = 0.0;
  std::size_t at_ = 0;
};

}  // namespace

void bind_map_file(nanobind::module_& m) {
  m.def(
      "read_map", [](const std::string& path) { return owned_array(OtReader(path).rows, 5); },
      nb::arg("path"), nb::sig("def read_map(path: str) -> numpy.typing.NDArray[numpy.float64]"));
}

}  // namespace gnbv
