// `cameras.N.pitch_deg`: a number, or a gimbal's min, max and step.
#include <gmock/gmock.h>

#include "scenarios/load.hpp"
#include "tests/scenarios/scenario_text.hpp"

namespace gnbv {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

const std::string kGimbal = "cameras: [{pitch_deg: {min: -12.3, max: 50, step: 15}}]\n";

TEST(GimbalKeys, ANumberIsAFixedMountingAndAMapAGimbal) {
  const CameraConfig fixed = load_text("cameras: [{pitch_deg: 12.3}]").cameras[0];
  EXPECT_EQ(fixed.pitch_rad, deg_to_rad(12.3));
  EXPECT_FALSE(fixed.gimbal);
  const CameraConfig turning = load_text(kGimbal).cameras[0];
  ASSERT_TRUE(turning.gimbal);
  EXPECT_EQ(turning.gimbal->min_rad, deg_to_rad(-12.3));
  EXPECT_EQ(turning.gimbal->max_rad, deg_to_rad(50.0));
  EXPECT_EQ(turning.gimbal->step_rad, deg_to_rad(15.0));
  EXPECT_EQ(turning.pitch_rad, pitches_rad(*turning.gimbal)[1]);  // 2.7 degrees: the most level
}

TEST(GimbalKeys, WrittenAndReadBackAreTheSame) {
  for (const std::string& text : {kGimbal, std::string("cameras: [{pitch_deg: 12.3}]\n")}) {
    const std::string yaml = to_yaml(load_text(text));
    EXPECT_EQ(to_yaml(load_text(yaml)), yaml);
  }
  EXPECT_THAT(to_yaml(load_text("cameras: [{pitch_deg: 12.3}]")),
              HasSubstr("    pitch_deg: 12.3\n"));
  EXPECT_THAT(to_yaml(load_text(kGimbal)),
              HasSubstr("    pitch_deg:\n      min: -12.3\n      max: 50\n      step: 15\n"));
}

TEST(GimbalKeys, OneReplacesTheOther) {
  EXPECT_FALSE(load_text(kGimbal, {"cameras.0.pitch_deg=20"}).cameras[0].gimbal);
  const auto gimbal =
      load_text("cameras: [{pitch_deg: 20}]", {"cameras.0.pitch_deg={max: 40}"}).cameras[0].gimbal;
  ASSERT_TRUE(gimbal);
  EXPECT_EQ(gimbal->max_rad, deg_to_rad(40.0));
  EXPECT_EQ(load_text(kGimbal, {"cameras.0.pitch_deg.step=10"}).cameras[0].gimbal->step_rad,
            deg_to_rad(10.0));
  // a preset of the sensor leaves its mounting alone
  EXPECT_TRUE(load_text(kGimbal, {"cameras.0.preset=zed_mini"}).cameras[0].gimbal);
}

TEST(GimbalKeys, WrongOnesAreRefusedInOneLine) {
  EXPECT_THAT(complaint("cameras: [{pitch_deg: {min: 30, max: 20}}]"),
              StartsWith("s.yaml:1: cameras.0.pitch_deg.max: value '20': cameras.0.pitch_deg.min = "
                         "30 has to be below cameras.0.pitch_deg.max = 20"));
  EXPECT_THAT(complaint("cameras: [{pitch_deg: {min: -91}}]"), HasSubstr("pitch_deg.min"));
  EXPECT_THAT(complaint("cameras: [{pitch_deg: {step: 0}}]"), HasSubstr("pitch_deg.step"));
  EXPECT_THAT(complaint("cameras: [{pitch_deg: {mni: 0}}]"), HasSubstr("did you mean"));
  EXPECT_THAT(complaint("cameras: [{pitch_deg: up}]"), HasSubstr("expects a number"));
  EXPECT_THAT(
      complaint("cameras: [{name: a, pitch_deg: {max: 20}}, {name: b, pitch_deg: {max: 30}}]"),
      HasSubstr("hang on one gimbal"));
  EXPECT_EQ(complaint("cameras: [{name: a, pitch_deg: {max: 20}}, {name: b, pitch_deg: {max: 20}}, "
                      "{name: c, pitch_deg: 5}]"),
            "");
}

}  // namespace
}  // namespace gnbv
