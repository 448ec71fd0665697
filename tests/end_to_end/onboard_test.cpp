// Programs of others that link the installed planner (examples/onboard, and onboard/ beside this
// file) get the frames of a mission as they were sensed, and plan the very views that it flew.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "tests/support/flown.hpp"
#include "tests/support/temp_folder.hpp"
#include "tests/support/watch.hpp"
#include "tools/run/iterations_csv.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

/// Flies the mission again and writes what its cameras saw, as examples/onboard/recording.hpp reads
/// it.
void record(const Scenario& scenario, const fs::path& file) {
  std::ofstream out(file, std::ios::binary);
  const auto put = [&](const auto* values, std::size_t count) {
    out.write(reinterpret_cast<const char*>(values),
              static_cast<std::streamsize>(count * sizeof(*values)));
  };
  const auto put_count = [&](std::size_t count) {
    const auto number = static_cast<std::uint32_t>(count);
    put(&number, 1);
  };
  std::vector<DepthFrame> frames;
  Watch watch;
  watch.sensed = [&](const SensedView& sensed) {
    frames.assign(sensed.depth.begin(), sensed.depth.end());
  };
  watch.view = [&](const ViewRecord& record, const Belief&) {
    const ViewPose& pose = record.decision.view;
    put(pose.p_world_m.data(), 3);
    put(&pose.yaw_rad, 1);
    put(&pose.gimbal_pitch_rad, 1);
    put_count(frames.size());
    for (const DepthFrame& frame : frames) {
      put_count(static_cast<std::size_t>(frame.camera));
      put(frame.T_world_camera.data(), 16);
      put_count(frame.depth_m.size());
      put(frame.depth_m.data(), frame.depth_m.size());
    }
  };
  const Flown flown(scenario, {.observers = {&watch}});
}

struct Case {
  std::string program;  // the path of it
  std::string utility;  // that it plans by
};

void PrintTo(const Case& one, std::ostream* out) { *out << one.utility; }

class OnboardProgram : public testing::TestWithParam<Case> {};

TEST_P(OnboardProgram, PlansTheVeryViewsThatTheProgramFlew) {
  const TempFolder temp;
  const fs::path run = temp.path() / "run";
  const std::string fly = GNBV_PROGRAM " run smoke --quiet --utility " + GetParam().utility;
  ASSERT_EQ(std::system((fly + " --out " + run.string()).c_str()), 0);
  const std::vector<ViewRecord> views = read_view_records(run / "iterations.csv");
  ASSERT_GT(views.size(), 5U);
  record(smoke({"planner.utility.name=" + GetParam().utility}), temp.path() / "frames");

  const std::string plan = GetParam().program + " " + (run / "profile.map").string() + " " +
                           (temp.path() / "frames").string();
  ASSERT_EQ(std::system((plan + " > " + (temp.path() / "planned").string()).c_str()), 0);
  std::ifstream lines(temp.path() / "planned");
  for (std::size_t i = 1; i < views.size(); ++i) {
    ViewPose next;
    lines >> next.p_world_m.x() >> next.p_world_m.y() >> next.p_world_m.z() >> next.yaw_rad;
    ASSERT_TRUE(lines) << "only " << i - 1 << " views";
    EXPECT_TRUE(is_same_view(next, views[i].decision.view)) << "view " << i;
  }
  std::string more;
  EXPECT_FALSE(lines >> more) << "it goes on where the mission ended";
}

INSTANTIATE_TEST_SUITE_P(, OnboardProgram,
                         testing::Values(Case{GNBV_ONBOARD_FOLDER "/example/onboard", "proposed"},
                                         Case{GNBV_ONBOARD_FOLDER "/own/own_utility",
                                              "bircher_volume"},
                                         Case{GNBV_ONBOARD_FOLDER "/own/own_utility tour", "tour"}),
                         [](const auto& test) { return test.param.utility; });

}  // namespace
}  // namespace gnbv
