// A belief as a file; belief.hpp says what stands in it.
#include <array>
#include <bit>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "planner/core/belief.hpp"
#include "planner/core/octomap_belief.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/core/sha256.hpp"

namespace gnbv {
namespace {

static_assert(std::endian::native == std::endian::little && sizeof(Vec3f) == 3 * sizeof(float));

constexpr std::string_view kFirstLine = "gnbv belief 1\n";
constexpr std::size_t kDigestLength = 64;

enum class Run : std::uint8_t { unmeasured = 0, predicted = 1, measured = 2 };

/// All that the numbers of a belief depend on.
std::vector<std::pair<const char*, double>> settings_of(const Belief& belief) {
  const OccupancyConfig& map = belief.grid.config();
  const GridGeometry& grid = belief.grid.geometry();
  const Key& first = grid.min_key();
  return {{"resolution_m", map.resolution_m},
          {"workspace's first voxel along x", 1.0 * first[0]},
          {"workspace's first voxel along y", 1.0 * first[1]},
          {"workspace's first voxel along z", 1.0 * first[2]},
          {"voxels along x", 1.0 * grid.size()[0]},
          {"voxels along y", 1.0 * grid.size()[1]},
          {"voxels along z", 1.0 * grid.size()[2]},
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
  template <typename T>
  T take() {
    if (sizeof(T) > rest_.size()) refuse("the belief ends too early");
    T value;
    std::memcpy(&value, rest_.data(), sizeof(T));
    rest_.remove_prefix(sizeof(T));
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

std::vector<Vec3f> take_points(Reader& in) {
  const auto count = in.take<std::uint64_t>();
  if (count > in.size() / sizeof(Vec3f)) in.refuse("fewer points than it says");
  std::vector<Vec3f> points_m(count);
  for (Vec3f& p_m : points_m) p_m = Vec3f(in.take<std::array<float, 3>>().data());
  return points_m;
}

/// Runs of equal voxels: what they are, how many, and of measured ones the bits of their log-odds.
void put_voxels(const OccupancyGrid& grid, std::string& out) {
  const auto kind_of = [&](VoxelIndex v) {
    const Run run = grid.is_measured(v)    ? Run::measured
                    : grid.is_predicted(v) ? Run::predicted
                                           : Run::unmeasured;
    return std::pair(run, std::bit_cast<std::uint32_t>(grid.log_odds(v)));
  };
  const auto voxels = static_cast<VoxelIndex>(grid.geometry().voxel_count());
  for (VoxelIndex first = 0, end = 0; first < voxels; first = end) {
    const auto [run, bits] = kind_of(first);
    while (end < voxels && kind_of(end) == std::pair(run, bits)) ++end;
    append_bytes(out, static_cast<std::uint8_t>(run));
    put_count(end - first, out);
    if (run == Run::measured) append_bytes(out, bits);
  }
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
    for (auto v = static_cast<VoxelIndex>(first); run != Run::unmeasured && v < end; ++v) {
      if (run == Run::predicted) grid.predict(v);
      if (run == Run::predicted || grid.restore(v, log_odds)) continue;
      in.refuse(fmt::format("log-odds {} are beyond the clamping bounds", log_odds));
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
  if (content.substr(body.size()) != sha256_of(body)) {
    in.refuse("the belief is damaged or cut short: its SHA-256 does not match");
  }
  return body.substr(kFirstLine.size());
}

}  // namespace

void write_belief(const Belief& belief, const std::filesystem::path& path) {
  std::string out(kFirstLine);
  for (const auto& [name, value] : settings_of(belief)) append_bytes(out, value);
  append_bytes(out, static_cast<std::uint8_t>(belief.has_depth_return));
  const std::span<const Vec3f> points_m = belief.cloud.points_world_m();
  append_bytes(out, static_cast<std::uint64_t>(points_m.size()));
  out.append(reinterpret_cast<const char*>(points_m.data()), points_m.size_bytes());
  put_voxels(belief.grid, out);
  put_shadow(belief, out);
  out += sha256_of(out);
  write_file_atomically(path, out);
}

Belief read_belief(const std::filesystem::path& path, const PlannerModel& model,
                   std::vector<std::string>* notes) {
  const std::string extension = extension_of(path);
  if (extension == ".ot" || extension == ".bt") {
    std::vector<std::string> nobodys;
    return belief_of_octomap(path, model, notes != nullptr ? *notes : nobodys);
  }
  const std::string content = read_file(path);
  Reader in(checked_body(content, Reader(content, path)), path);
  Belief belief(model);
  for (const auto& [name, value] : settings_of(belief)) {
    const auto its = in.take<double>();
    if (its == value) continue;
    in.refuse(fmt::format("the belief of another map: {} is {}, not {}", name, its, value));
  }
  belief.has_depth_return = in.take<std::uint8_t>() != 0;
  if (!belief.cloud.restore(take_points(in))) in.refuse("its points are not those of a cloud");
  take_voxels(in, belief.grid);
  take_shadow(in, belief);
  if (in.size() != 0) in.refuse("more than a belief");
  return belief;
}

}  // namespace gnbv
