// No config field without a key: the fields of each struct are counted and compared with its keys.
#include "scenarios/fields.hpp"

#include <gtest/gtest.h>

#include <utility>

namespace gnbv {
namespace {

/// Converts to any field's type, so that T{Any, Any, ...} compiles up to the number of fields.
struct Any {
  template <typename T>
  operator T() const;  // NOLINT: has to be implicit; never called
};

template <typename T, std::size_t... i>
constexpr bool takes(std::index_sequence<i...>) {
  return requires { T{(static_cast<void>(i), Any{})...}; };
}

template <typename T, std::size_t count = 0>
constexpr std::size_t field_count() {
  if constexpr (takes<T>(std::make_index_sequence<count + 1>{})) {
    return field_count<T, count + 1>();
  } else {
    return count;
  }
}

struct Three {
  double a = 1.0;
  Vec3 b = Vec3::Zero();
  std::string c = "c";
};
static_assert(field_count<Three>() == 3);

/// Counts the keys of one struct, those of the structs in it left out.
class KeyCounter final : public FieldVisitor {
 public:
  std::size_t count = 0;

 private:
  void leaf(const Field&, const FieldValue&) override { count += depth_ == 0 ? 1 : 0; }
  void begin_section(std::string_view, std::string_view) override { enter(); }
  void end_section() override { depth_ -= 1; }
  std::optional<std::size_t> begin_list(std::string_view, std::size_t, const ListSize&,
                                        std::string_view) override {
    enter();
    return std::nullopt;
  }
  void end_list() override { depth_ -= 1; }
  void begin_item(std::size_t) override {}
  void end_item() override {}
  void enter() {
    count += depth_ == 0 ? 1 : 0;
    depth_ += 1;
  }

  int depth_ = 0;
};

template <typename Config>
std::size_t key_count() {
  Config config;
  KeyCounter counter;
  fields(counter, config);
  return counter.count;
}

TEST(Fields, EveryFieldOfEveryConfigHasAKey) {
  EXPECT_EQ(key_count<MeshFileConfig>(), field_count<MeshFileConfig>());
  EXPECT_EQ(key_count<RotorMount>(), field_count<RotorMount>());
  EXPECT_EQ(key_count<AirframeParameters>(), field_count<AirframeParameters>());
  EXPECT_EQ(key_count<AutopilotParameters>() + 1, field_count<AutopilotParameters>())
      << "the commander's are PX4 parameters";
  EXPECT_EQ(key_count<PowerParameters>(), field_count<PowerParameters>());
  EXPECT_EQ(key_count<EstimateConfig>(), field_count<EstimateConfig>());
  EXPECT_EQ(key_count<VehicleConfig>(), field_count<VehicleConfig>());
  EXPECT_EQ(key_count<GuidanceConfig>(), field_count<GuidanceConfig>());
  EXPECT_EQ(key_count<WindConfig>(), field_count<WindConfig>());
  EXPECT_EQ(key_count<GnssOutage>(), field_count<GnssOutage>());
  EXPECT_EQ(key_count<GimbalConfig>(), field_count<GimbalConfig>());
  EXPECT_EQ(key_count<DepthNoiseConfig>(), field_count<DepthNoiseConfig>());
  EXPECT_EQ(key_count<CameraConfig>() + 1, field_count<CameraConfig>())
      << "pitch or gimbal: one key";
  EXPECT_EQ(key_count<LidarConfig>(), field_count<LidarConfig>());
  EXPECT_EQ(key_count<OccupancyConfig>(), field_count<OccupancyConfig>());
  EXPECT_EQ(key_count<CloudConfig>(), field_count<CloudConfig>());
  EXPECT_EQ(key_count<ProfilingConfig>(), field_count<ProfilingConfig>());
  EXPECT_EQ(key_count<AgvsConfig>(), field_count<AgvsConfig>());
  EXPECT_EQ(key_count<ValidityConfig>(), field_count<ValidityConfig>());
  EXPECT_EQ(key_count<UtilityConfig>(), field_count<UtilityConfig>());
  EXPECT_EQ(key_count<TourConfig>(), field_count<TourConfig>());
  EXPECT_EQ(key_count<RouteConfig>(), field_count<RouteConfig>());
  EXPECT_EQ(key_count<TerminationConfig>(), field_count<TerminationConfig>());
  EXPECT_EQ(key_count<PlannerConfig>(), field_count<PlannerConfig>());
  EXPECT_EQ(key_count<StructureConfig>(), field_count<StructureConfig>());
  EXPECT_EQ(key_count<ObstacleConfig>(), field_count<ObstacleConfig>());
  EXPECT_EQ(key_count<NoFlyConfig>(), field_count<NoFlyConfig>() + 1) << "a box is two keys";
  EXPECT_EQ(key_count<ScoreConfig>(), field_count<ScoreConfig>());
  EXPECT_EQ(key_count<StartConfig>(), field_count<StartConfig>() + 1) << "pose is two keys";
  EXPECT_EQ(key_count<BenchmarkConfig>(), field_count<BenchmarkConfig>());
  EXPECT_EQ(key_count<Scenario>() + 1, field_count<Scenario>()) << "placed_at is no key";
}

}  // namespace
}  // namespace gnbv
