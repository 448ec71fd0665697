#include "planner/core/belief_file.hpp"

#include <bit>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/core/sha256.hpp"

namespace gnbv {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::string_view kFirstLine = "gnbv belief 1\n";
constexpr std::size_t kDigestLength = 64;

/// What a run of voxels is. Measured ones have a log-odds besides.
enum class Run : std::uint8_t { unmeasured = 0, predicted = 1, measured = 2 };

struct Setting {
  const char* name;
  double value;
};

/// All that the numbers of a belief depend on.
std::vector<Setting> settings_of(const Belief& belief) {
  const OccupancyConfig& map = belief.grid.config();
  const GridGeometry& grid = belief.grid.geometry();
  const auto key = [](std::int32_t k) { return static_cast<double>(k); };
  return {{"resolution_m", map.resolution_m},
          {"workspace's first voxel along x", key(grid.min_key()[0])},
          {"workspace's first voxel along y", key(grid.min_key()[1])},
          {"workspace's first voxel along z", key(grid.min_key()[2])},
          {"voxels along x", key(grid.size()[0])},
          {"voxels along y", key(grid.size()[1])},
          {"voxels along z", key(grid.size()[2])},
          {"prob_hit", map.prob_hit},
          {"prob_miss", map.prob_miss},
          {"clamp_min", map.clamp_min},
          {"clamp_max", map.clamp_max},
          {"occupied_min", map.occupied_min},
          {"free_max", map.free_max},
          {"leaf_m", belief.cloud.config().leaf_m},
          {"profile_leaf_m", belief.cloud.config().profile_leaf_m},
          {"floor_z_m", belief.floor_z_m}};
}

std::string digest_of(std::string_view content) {
  Sha256 sha;
  sha.add(content);
  return sha.hex();
}

/// Appends seven bits a byte, the lowest first; the high bit says that more follow.
void put_count(std::uint64_t count, std::string& out) {
  for (; count >= 0x80; count >>= 7) append_bytes(out, static_cast<std::uint8_t>(count | 0x80));
  append_bytes(out, static_cast<std::uint8_t>(count));
}

/// Takes a file apart, and throws BadInput where it ends too early.
class Reader {
 public:
  Reader(std::string_view bytes, const std::filesystem::path& path) : rest_(bytes), path_(path) {}

  [[noreturn]] void refuse(const std::string& why) const {
    throw BadInput(fmt::format("{}: {}", path_.string(), why));
  }
  std::string_view take_bytes(std::size_t count) {
    if (count > rest_.size()) refuse("the belief ends too early");
    const std::string_view taken = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return taken;
  }
  template <typename T>
  T take() {
    T value;
    std::memcpy(&value, take_bytes(sizeof(T)).data(), sizeof(T));
    return value;
  }
  std::uint64_t take_count() {
    std::uint64_t count = 0;
    for (unsigned shift = 0; shift < 64; shift += 7) {
      const auto byte = take<std::uint8_t>();
      count |= static_cast<std::uint64_t>(byte & 0x7fU) << shift;
      if ((byte & 0x80U) == 0) return count;
    }
    refuse("a count is too large");
  }
  std::size_t size() const { return rest_.size(); }

 private:
  std::string_view rest_;
  const std::filesystem::path& path_;
};

void put_points(std::span<const Vec3f> points_m, std::string& out) {
  append_bytes(out, static_cast<std::uint64_t>(points_m.size()));
  for (const Vec3f& p_m : points_m) {
    for (Eigen::Index a = 0; a < 3; ++a) append_bytes(out, p_m[a]);
  }
}

std::vector<Vec3f> take_points(Reader& in) {
  const auto count = in.take<std::uint64_t>();
  if (count > in.size() / (3 * sizeof(float))) in.refuse("fewer points than it says");
  std::vector<Vec3f> points_m(count);
  for (Vec3f& p_m : points_m) {
    for (Eigen::Index a = 0; a < 3; ++a) p_m[a] = in.take<float>();
  }
  return points_m;
}

Run run_of(const OccupancyGrid& grid, VoxelIndex v) {
  if (grid.is_measured(v)) return Run::measured;
  return grid.is_predicted(v) ? Run::predicted : Run::unmeasured;
}

void put_voxels(const OccupancyGrid& grid, std::string& out) {
  const auto voxels = static_cast<VoxelIndex>(grid.geometry().voxel_count());
  for (VoxelIndex first = 0; first < voxels;) {
    const Run run = run_of(grid, first);
    const auto bits = std::bit_cast<std::uint32_t>(grid.log_odds(first));
    VoxelIndex end = first + 1;
    while (end < voxels && run_of(grid, end) == run &&
           std::bit_cast<std::uint32_t>(grid.log_odds(end)) == bits) {
      ++end;
    }
    append_bytes(out, static_cast<std::uint8_t>(run));
    put_count(end - first, out);
    if (run == Run::measured) append_bytes(out, bits);
    first = end;
  }
}

bool restore_voxel(OccupancyGrid& grid, VoxelIndex v, Run run, float log_odds) {
  return run == Run::measured ? grid.restore(v, log_odds) : grid.predict(v);
}

void take_voxels(Reader& in, OccupancyGrid& grid) {
  const std::size_t voxels = grid.geometry().voxel_count();
  for (std::size_t first = 0; first < voxels;) {
    const auto run = static_cast<Run>(in.take<std::uint8_t>());
    if (run > Run::measured) in.refuse("voxels of an unknown kind");
    const std::uint64_t length = in.take_count();
    if (length == 0 || length > voxels - first) in.refuse("another number of voxels than it says");
    const float log_odds = run == Run::measured ? in.take<float>() : 0.0F;
    const std::size_t end = first + length;
    for (std::size_t v = first; run != Run::unmeasured && v < end; ++v) {
      if (!restore_voxel(grid, static_cast<VoxelIndex>(v), run, log_odds)) {
        in.refuse(fmt::format("log-odds {} are beyond the clamping bounds", log_odds));
      }
    }
    first = end;
  }
}

/// Shaded voxels as distances from one to the next, each with its steps behind the surface.
void put_shadow(const Belief& belief, std::string& out) {
  const auto voxels = static_cast<VoxelIndex>(belief.grid.geometry().voxel_count());
  VoxelIndex last = 0;
  for (VoxelIndex v = 0; v < voxels; ++v) {
    if (!belief.grid.is_shaded(v)) continue;
    append_bytes(out, static_cast<std::uint8_t>(belief.shadow.steps_behind(v)));
    put_count(v - last, out);
    last = v;
  }
  append_bytes(out, std::uint8_t{0});  // steps of none: the end
}

void take_shadow(Reader& in, Belief& belief) {
  std::uint64_t v = 0;
  while (const auto steps = in.take<std::uint8_t>()) {
    const std::uint64_t distance = in.take_count();
    const std::size_t voxels = belief.grid.geometry().voxel_count();
    if (distance >= voxels - v) in.refuse("a shadow beyond the map");
    v += distance;
    if (!belief.shadow.restore(static_cast<VoxelIndex>(v), steps, belief.grid)) {
      in.refuse("a shadow on a measured voxel");
    }
  }
}

/// The text between first line and digest; refuses all that this program did not write.
std::string_view checked_body(std::string_view content, const Reader& in) {
  if (!content.starts_with(kFirstLine)) {
    const bool is_cut = !content.empty() && kFirstLine.starts_with(content);
    in.refuse(is_cut ? "the belief is cut short" : "is not a belief of this version of gnbv");
  }
  if (content.size() < kFirstLine.size() + kDigestLength) in.refuse("the belief is cut short");
  const std::string_view body = content.substr(0, content.size() - kDigestLength);
  if (content.substr(body.size()) != digest_of(body)) {
    in.refuse("the belief is damaged or cut short: its SHA-256 does not match");
  }
  return body.substr(kFirstLine.size());
}

}  // namespace

void write_belief(const Belief& belief, const std::filesystem::path& path) {
  std::string out(kFirstLine);
  for (const Setting& setting : settings_of(belief)) append_bytes(out, setting.value);
  append_bytes(out, static_cast<std::uint8_t>(belief.has_depth_return));
  put_points(belief.cloud.points_world_m(), out);
  put_voxels(belief.grid, out);
  put_shadow(belief, out);
  out += digest_of(out);
  write_file_atomically(path, out);
}

Belief read_belief(const std::filesystem::path& path, const PlannerModel& model) {
  const std::string content = read_file(path);
  Reader in(checked_body(content, Reader(content, path)), path);
  Belief belief(model);
  for (const Setting& setting : settings_of(belief)) {
    const auto value = in.take<double>();
    if (value == setting.value) continue;
    in.refuse(fmt::format("the belief of another map: {} is {}, not {}", setting.name, value,
                          setting.value));
  }
  belief.has_depth_return = in.take<std::uint8_t>() != 0;
  if (!belief.cloud.restore(take_points(in))) in.refuse("its points are not those of a cloud");
  take_voxels(in, belief.grid);
  take_shadow(in, belief);
  if (in.size() != 0) in.refuse("more than a belief");
  return belief;
}

}  // namespace gnbv
