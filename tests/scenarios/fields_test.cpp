// No config field without a key: the fields of each struct are counted and compared with its keys.
#include "scenarios/fields.hpp"

#include <gtest/gtest.h>

#include <map>
#include <typeindex>
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

/// Counts the keys of each struct, those of the structs in it left out.
class KeyCounter final : public FieldVisitor {
 public:
  std::map<std::type_index, std::size_t> counts;

  void leaf(const Field&, const FieldValue&) override { counts[within_.back()] += 1; }
  std::optional<std::size_t> begin(const Group& group) override {
    if (group.kind != Group::Kind::item) counts[within_.back()] += 1;
    if (group.kind != Group::Kind::list) counts[group.config] = 0;  // some are there several times
    within_.push_back(group.config);
    return 1;  // item in every list
  }
  void end(const Group&) override { within_.pop_back(); }
  Form form_of(std::string_view, bool) override { return Form::both; }

 private:
  std::vector<std::type_index> within_ = {typeid(Scenario)};
};

TEST(Fields, EveryFieldOfEveryConfigHasAKey) {
  Scenario scenario;
  KeyCounter counter;
  fields(Keys(counter), scenario);
  const auto expect = [&]<typename Config>(const Config&, int more = 0) {
    const auto keys = counter.counts.find(typeid(Config));
    ASSERT_NE(keys, counter.counts.end()) << typeid(Config).name();
    EXPECT_EQ(keys->second, field_count<Config>() + more) << typeid(Config).name();
    counter.counts.erase(keys);
  };
  expect(MeshFileConfig{});
  expect(RotorMount{});
  expect(AirframeParameters{});
  expect(PowerParameters{});
  expect(EstimateConfig{});
  expect(VehicleConfig{});
  expect(GuidanceConfig{});
  expect(WindConfig{});
  expect(GnssOutage{});
  expect(GimbalConfig{});
  expect(DepthNoiseConfig{});
  expect(CameraConfig{});
  expect(LidarConfig{});
  expect(OccupancyConfig{});
  expect(CloudConfig{});
  expect(ProfilingConfig{});
  expect(AgvsConfig{});
  expect(FvsConfig{});
  expect(FrontierConfig{});
  expect(ValidityConfig{});
  expect(PathSearchConfig{});
  expect(UtilityConfig{});
  expect(VolumeWeights{});
  expect(ShadowConfig{});
  expect(UserFunctionConfig{});
  expect(TourConfig{});
  expect(SymmetryConfig{});
  expect(RouteConfig{});
  expect(ViewPose{});
  expect(TerminationConfig{});
  expect(PlannerConfig{});
  expect(StructureConfig{});
  expect(ObstacleConfig{});
  expect(ScoreConfig{});
  expect(BenchmarkConfig{});
  expect(AutopilotParameters{}, -1);                  // the commander's are PX4 parameters
  expect(StartConfig{}, 1);                           // pose is two keys
  expect(NoFlyConfig{}, 1);                           // a box is two keys
  expect(Scenario{}, -1);                             // placed_at is no key
  EXPECT_EQ(counter.counts.erase(typeid(Box3)), 1U);  // no struct of ours
  for (const auto& [config, count] : counter.counts) ADD_FAILURE() << config.name() << " is new";
}

}  // namespace
}  // namespace gnbv
