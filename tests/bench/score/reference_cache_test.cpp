#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "bench/score/content_cache.hpp"
#include "bench/score/surface_reference.hpp"
#include "sim/core/file.hpp"
#include "tests/bench/shapes.hpp"
#include "tests/support/temp_folder.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

class ReferenceCache : public testing::Test {
 protected:
  ReferenceCache() {
    setenv("GNBV_CACHE", temp_.path().c_str(), 1);
    test::add_box(world_.structure, Vec3(-1, -1, 0.5), Vec3(2, 2, 2), false);
    test::add_box(world_.structure, Vec3(-0.6, -0.6, 0.9), Vec3(1.2, 1.2, 1.2));
  }
  ~ReferenceCache() override { unsetenv("GNBV_CACHE"); }

  static SurfaceReference cached(const World& world, const ReferenceConfig& config = {}) {
    return cached_surface_reference(world, RayScene(world), config, 2);
  }
  std::vector<fs::path> files() const {
    std::vector<fs::path> out;
    for (const auto& entry : fs::recursive_directory_iterator(temp_.path())) {
      if (entry.is_regular_file()) out.push_back(entry.path());
    }
    return out;
  }

  TempFolder temp_;
  World world_;
};

TEST_F(ReferenceCache, GivesBackWhatWasComputedAndIsReallyAsked) {
  const SurfaceReference made = make_surface_reference(world_, RayScene(world_), {}, 2);
  EXPECT_EQ(cached(world_), made);
  ASSERT_EQ(files().size(), 1U);
  EXPECT_EQ(cached(world_), made);
  // compact: the points as they lie in memory, of the codes less than half
  const std::size_t points = made.points_world_m.size() + made.samples_world_m.size();
  std::size_t codes = 0;
  for (std::size_t i = 0; i < 3; ++i) codes += made.raw[i].size() + made.counted[i].size();
  EXPECT_LT(fs::file_size(files()[0]), points * sizeof(Vec3f) + codes * sizeof(std::uint64_t) / 2);
  // what it holds is what is returned: put another structure's reference under this key
  World other = world_;
  other.structure.vertices_m[0].x() -= 0.3F;
  const SurfaceReference others = cached(other);
  ASSERT_NE(others, made);
  const std::vector<fs::path> both = files();
  ASSERT_EQ(both.size(), 2U);
  const std::string first = read_file(both[0]);
  write_file_atomically(both[0], read_file(both[1]));
  write_file_atomically(both[1], first);
  EXPECT_EQ(cached(world_), others);
}

TEST_F(ReferenceCache, GivesBackAreaSamples) {
  const ReferenceConfig config{.area_samples = 1000};
  const SurfaceReference made = make_surface_reference(world_, RayScene(world_), config, 2);
  EXPECT_EQ(made.area_samples, 1000U);
  for (int time = 0; time < 2; ++time) EXPECT_EQ(cached(world_, config), made);
  EXPECT_EQ(files().size(), 1U);
}

TEST_F(ReferenceCache, EveryInputHasAKeyOfItsOwn) {
  std::vector<World> worlds(5, world_);
  worlds[1].structure.vertices_m[5].z() += 1e-6F;
  std::swap(worlds[2].structure.faces[3][0], worlds[2].structure.faces[3][1]);
  worlds[3].obstacles = world_.structure;
  worlds[4].terrain = world_.structure;
  for (const World& world : worlds) cached(world);
  ReferenceConfig half;
  half.region_m.max().x() = 0.1;
  for (const ReferenceConfig& config :
       {ReferenceConfig{.floor_z_m = 0.7}, ReferenceConfig{.sample_spacing_m = 0.02},
        ReferenceConfig{.directions = 64}, ReferenceConfig{.escape_near_m = 1e-3},
        ReferenceConfig{.fewest_samples = 1000}, ReferenceConfig{.area_samples = 1000},
        ReferenceConfig{.area_samples = 1001}, half}) {
    cached(world_, config);
  }
  EXPECT_EQ(files().size(), 13U);
  world_.structure.materials[0].rgb = {0.1F, 0.2F, 0.3F};
  cached(world_);
  EXPECT_EQ(files().size(), 13U);
}

TEST_F(ReferenceCache, ComputesAnewWhatIsDamagedOrOfAnotherForm) {
  const SurfaceReference made = cached(world_);
  const fs::path file = files()[0];
  const std::string whole = read_file(file);
  std::ofstream(file, std::ios::binary) << whole.substr(0, whole.size() / 2);
  EXPECT_EQ(cached(world_), made);
  EXPECT_EQ(read_file(file), whole);
  // whole for the cache, and no reference
  const std::string no_voxels(6, '\0');
  for (const std::string& bytes : {std::string(), std::string("\xff"), std::string("\x05\x01"),
                                   std::string("nonsense"), no_voxels + "sample of none"}) {
    store_cached(file.parent_path().filename().string(), file.filename().string(), bytes);
    EXPECT_EQ(cached(world_), made) << bytes;
  }
}

}  // namespace
}  // namespace gnbv
