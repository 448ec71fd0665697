// Files of version 0.1 are read: what was removed since is passed over at its former default.
#include <gmock/gmock.h>

#include "scenarios/load.hpp"
#include "tests/scenarios/scenario_text.hpp"

namespace gnbv {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// What loading says on stderr.
std::string said_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  testing::internal::CaptureStderr();
  load_text(text, overrides);
  return testing::internal::GetCapturedStderr();
}

TEST(OldKeys, AtTheirFormerDefaultsAreOneLineOnStderr) {
  const std::string said = said_of(kMinimal +
                                   "vehicle:\n"
                                   "  autopilot:\n"
                                   "    commander: {offboard_loss_s: 1, jerk_m_s3: 4.0,\n"
                                   "      offboard_loss_action: position, land_speed_m_s: 0.7}\n");
  EXPECT_THAT(said, AllOf(HasSubstr("s.yaml: "),
                          HasSubstr("vehicle.autopilot.commander.offboard_loss_s and 3 more: ")));
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1);
  EXPECT_EQ(said_of(kMinimal), "");
  EXPECT_THAT(said_of(kMinimal, {"vehicle.autopilot.commander.spool_up_s=1"}),
              HasSubstr("--set vehicle.autopilot.commander.spool_up_s=1: "));
}

TEST(OldKeys, LeaveTheConfigurationOfAFileWhatItIs) {
  const ScenarioFile file(kMinimal + "vehicle: {autopilot: {commander: {spool_up_s: 1}}}\n");
  const Scenario scenario = load_text(kMinimal);
  EXPECT_TRUE(is_written_in(file.path().string(), scenario));
  EXPECT_FALSE(is_written_in(file.path().string(), load_text(kMinimal, {"seed=2"})));
  EXPECT_FALSE(is_written_in(ScenarioFile("nonsense").path().string(), scenario));
}

TEST(OldKeys, WithAnyOtherValueAreRefusedByName) {
  EXPECT_EQ(complaint(kMinimal + "vehicle:\n  autopilot: {commander: {offboard_loss_s: 2}}\n"),
            "s.yaml:3: vehicle.autopilot.commander.offboard_loss_s: value '2': the key was removed "
            "after version 0.1; only its former default, 1, is still read");
  EXPECT_THAT(complaint(kMinimal, {"vehicle.autopilot.commander={spool_up_s: 3}"}),
              HasSubstr("vehicle.autopilot.commander.spool_up_s: value '3': "));
}

TEST(OldKeys, OfTheCommanderAreWhatTheVehiclesPresetHad) {
  const std::string kPx19 =
      "vehicle: {preset: iris_sitl_2019, autopilot: {commander: {offboard_loss_s: 0.5, "
      "offboard_loss_action: rtl, offboard_loss_hold_s: 5}}}\n";
  EXPECT_EQ(complaint(kMinimal + kPx19), "");
  EXPECT_THAT(complaint(kMinimal + "vehicle: {preset: iris_sitl_2019, autopilot: {commander: "
                                   "{offboard_loss_s: 1}}}\n"),
              HasSubstr("only its former default, 0.5, is still read"));
  EXPECT_EQ(complaint(kMinimal + "vehicle: {preset: authors, autopilot: {commander: "
                                 "{tilt_max_on_ground_deg: 15}}}\n"),
            "");
}

TEST(OldKeys, AreNoSectionOfUnknownKeys) {
  EXPECT_THAT(complaint(kMinimal + "vehicle: {autopilot: {commander: {offboard_los_s: 1}}}\n"),
              HasSubstr("vehicle.autopilot.commander.offboard_los_s: is no known key"));
}

}  // namespace
}  // namespace gnbv
