// Calibration files of OpenCV, Kalibr and ROS, and what scenario files say of lenses.
#include "scenarios/calibration.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scenarios/scenario_text.hpp"

namespace gnbv {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const std::string kOpenCv = R"(%YAML:1.0
---
calibration_time: "Tue 03 Nov 2026"
image_width: 640
image_height: 480
flags: 0
camera_matrix: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 5.3591573396163199e+02, 0., 3.4228315473308373e+02, 0.,
       5.3591573396163199e+02, 2.3557082909788173e+02, 0., 0., 1. ]
distortion_coefficients: !!opencv-matrix
   rows: 5
   cols: 1
   dt: d
   data: [ -2.6637260909660682e-01, -3.8588898922304653e-02,
       1.7831947042852964e-03, -2.8122100441115472e-04,
       2.3839153080878486e-01 ]
)";

const std::string kOpenCvXml = R"(<?xml version="1.0"?>
<opencv_storage>
<image_width>800</image_width>
<image_height>600</image_height>
<fisheye_model>1</fisheye_model>
<camera_matrix type_id="opencv-matrix">
  <rows>3</rows><cols>3</cols><dt>d</dt>
  <data>
    300. 2.5 400. 0. 310. 299.5 0. 0. 1.</data></camera_matrix>
<distortion_coefficients type_id="opencv-matrix">
  <rows>4</rows><cols>1</cols><dt>d</dt>
  <data> -1.0e-02 2.0e-02 -3.0e-03 4.0e-04</data></distortion_coefficients>
</opencv_storage>
)";

const std::string kKalibr = R"(cam0:
  cam_overlaps: [1]
  camera_model: pinhole
  distortion_coeffs: [-0.29, 0.08, 0.0003, -0.0001]
  distortion_model: radtan
  intrinsics: [461.6, 460.3, 362.6, 248.1]
  resolution: [752, 480]
  rostopic: /cam0/image_raw
cam1:
  T_cn_cnm1:
  - [0.99, 0.0, 0.0, -0.11]
  camera_model: pinhole
  distortion_coeffs: [-0.01, 0.02, -0.03, 0.04]
  distortion_model: equidistant
  intrinsics: [190.9, 190.8, 254.9, 256.8]
  resolution: [512, 512]
)";

const std::string kRos = R"(image_width: 1280
image_height: 720
camera_name: narrow_stereo
camera_matrix:
  rows: 3
  cols: 3
  data: [700.1, 0, 640.2, 0, 701.3, 360.4, 0, 0, 1]
distortion_model: rational_polynomial
distortion_coefficients:
  rows: 1
  cols: 8
  data: [0.1, 0.2, 0.001, -0.002, 0.3, 0.4, 0.5, 0.6]
rectification_matrix: {rows: 3, cols: 3, data: [1, 0, 0, 0, 1, 0, 0, 0, 1]}
)";

/// What a scenario beside such a file reads, or its complaint.
struct Read {
  CameraConfig camera;
  std::string complaint;
};

Read read(const std::string& text, const std::string& which = "", const std::string& keys = "") {
  const ScenarioFile file(fmt::format("cameras: [{{calibration: 'calib{}'{}}}]\n", which, keys));
  file.folder().write("calib", text);
  Read out;
  out.complaint = file.folder().without_path(test::fault_of([&] {
    const Scenario scenario = load_scenario(file.path().string(), {});
    EXPECT_TRUE(repeats(scenario));  // the numbers are the scenario's own from then on
    out.camera = scenario.cameras.at(0);
  }));
  return out;
}

void expect_pinhole(const CameraConfig& c, const std::array<double, 5>& expected) {
  const std::array<double, 5> is = {c.fx_px, c.fy_px, c.cx_px, c.cy_px, c.skew_px};
  EXPECT_EQ(is, expected);
}

TEST(Calibration, OpenCvsYaml) {
  const CameraConfig c = read(kOpenCv).camera;
  EXPECT_EQ(c.width_px, 640);
  EXPECT_EQ(c.height_px, 480);
  // its first pixel's middle is (0, 0), ours (0.5, 0.5)
  expect_pinhole(c, {535.91573396163199, 535.91573396163199, 342.28315473308373 + 0.5,
                     235.57082909788173 + 0.5, 0.0});
  EXPECT_EQ(c.distortion.model, Distortion::brown_conrady);
  EXPECT_EQ(coefficients_of(c.distortion),
            (std::vector{-2.6637260909660682e-01, -3.8588898922304653e-02, 1.7831947042852964e-03,
                         -2.8122100441115472e-04, 2.3839153080878486e-01, 0.0, 0.0, 0.0}));
}

TEST(Calibration, OpenCvsXmlOfAFisheye) {
  const CameraConfig c = read(kOpenCvXml).camera;
  EXPECT_EQ(c.width_px, 800);
  expect_pinhole(c, {300.0, 310.0, 400.5, 300.0, 2.5});
  EXPECT_EQ(c.distortion.model, Distortion::kannala_brandt);
  EXPECT_EQ(coefficients_of(c.distortion), (std::vector{-0.01, 0.02, -0.003, 0.0004}));
}

TEST(Calibration, KalibrsChainByTheCamerasName) {
  const CameraConfig first = read(kKalibr).camera;
  EXPECT_EQ(first.width_px, 752);
  expect_pinhole(first, {461.6, 460.3, 362.6 + 0.5, 248.1 + 0.5, 0.0});
  EXPECT_EQ(first.distortion.model, Distortion::brown_conrady);
  EXPECT_EQ(first.distortion.p2, -0.0001);
  const CameraConfig second = read(kKalibr, "#cam1").camera;
  EXPECT_EQ(second.width_px, 512);
  EXPECT_EQ(second.distortion.model, Distortion::kannala_brandt);
  EXPECT_EQ(coefficients_of(second.distortion), (std::vector{-0.01, 0.02, -0.03, 0.04}));
  EXPECT_THAT(read(kKalibr, "#cam2").complaint, HasSubstr("holds no camera 'cam2'"));
}

TEST(Calibration, RossCameraInfo) {
  const CameraConfig c = read(kRos).camera;
  EXPECT_EQ(c.height_px, 720);
  expect_pinhole(c, {700.1, 701.3, 640.2 + 0.5, 360.4 + 0.5, 0.0});
  EXPECT_EQ(coefficients_of(c.distortion),
            (std::vector{0.1, 0.2, 0.001, -0.002, 0.3, 0.4, 0.5, 0.6}));
}

std::string with(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST(Calibration, RossMessageAsItPrintsItAndARectifiedCamera) {
  const std::string message =
      "header:\n  frame_id: ''\nheight: 720\nwidth: 1280\ndistortion_model: plumb_bob\n"
      "d:\n- 0.1\n- 0.2\n- 0.001\n- -0.002\n- 0.3\n"
      "k:\n- 700.1\n- 0.0\n- 640.2\n- 0.0\n- 701.3\n- 360.4\n- 0.0\n- 0.0\n- 1.0\n";
  const std::string of_ros1 = with(with(message, "\nd:", "\nD:"), "\nk:", "\nK:");
  for (const std::string& text : {message, message + "---\n" + message, of_ros1 + "---\n"}) {
    const CameraConfig c = read(text).camera;
    EXPECT_EQ(c.height_px, 720);
    expect_pinhole(c, {700.1, 701.3, 640.2 + 0.5, 360.4 + 0.5, 0.0});
    EXPECT_EQ(coefficients_of(c.distortion),
              (std::vector{0.1, 0.2, 0.001, -0.002, 0.3, 0.0, 0.0, 0.0}));
  }
  const std::string none = with(kRos, "[0.1, 0.2, 0.001, -0.002, 0.3, 0.4, 0.5, 0.6]", "[]");
  for (const char* model : {"rational_polynomial", "plumb_bob", "''"}) {
    const Read rectified = read(with(none, "rational_polynomial", model));
    EXPECT_EQ(rectified.complaint, "");
    EXPECT_EQ(rectified.camera.fx_px, 700.1);
    EXPECT_EQ(rectified.camera.distortion.model, Distortion::none);
  }
  EXPECT_EQ(read(with(kRos, "0.6]", "0.6, 0, 0, 0, 0, 0, 0]")).camera.distortion.k6, 0.6);
  EXPECT_THAT(read(with(kRos, "0.6]", "0.6, 0, 0, 0, 0, 0.1, 0]")).complaint,
              HasSubstr("calib:9: distortion_coefficients: thin prisms and tilted sensors"));
}

TEST(Calibration, BeginsBehindCommentsAndTheMarkOfADocument) {
  for (const std::string head :
       {"# by hand\n---\n", "\xef\xbb\xbf%YAML 1.2\r\n\n# x\n---\n", "---\n#\n"}) {
    EXPECT_EQ(read(head + kKalibr + "---\ncam0: {}\n").camera.fx_px, 461.6) << head;
  }
  EXPECT_THAT(read("#\n---\n" + with(kKalibr, "radtan", "fov")).complaint, HasSubstr("calib:7: "));
}

TEST(Calibration, KeysBesideItWin) {
  const CameraConfig c = read(kRos, "", ", fx_px: 650, distortion: {k1: 0.05}").camera;
  EXPECT_EQ(c.fx_px, 650.0);
  EXPECT_EQ(c.distortion.k1, 0.05);
  EXPECT_EQ(c.distortion.k2, 0.2);
}

TEST(Calibration, WhatCannotBeReadIsNamedWithFileLineAndKey) {
  EXPECT_THAT(read(with(kRos, "0.3, 0.4", "0.3, x")).complaint,
              HasSubstr("calib:9: distortion_coefficients: 'x' is no number"));
  EXPECT_THAT(read(with(kRos, "rational_polynomial", "thin")).complaint,
              HasSubstr("calib:8: distortion_model: 'thin' is not read"));
  EXPECT_THAT(read(with(kRos, "image_width: 1280\n", "")).complaint,
              HasSubstr("calib: image_width: is missing"));
  EXPECT_THAT(read(with(kRos, "1280", "12.5")).complaint, HasSubstr("12.5 is no image size"));
  EXPECT_THAT(read(with(kKalibr, "camera_model: pinhole", "camera_model: omni")).complaint,
              HasSubstr("calib:3: camera_model: 'omni' is not read"));
  EXPECT_THAT(read(with(kOpenCv, "data: [ -2.66", "data: [ 1., -2.66")).complaint,
              HasSubstr("holds 6 numbers, expects 4 or 5"));
  EXPECT_THAT(read(with(kOpenCv, "5.3591573396163199e+02,", "-1.,")).complaint,
              HasSubstr("focal lengths -1 and"));
  EXPECT_THAT(read(with(kOpenCv, "0., 0., 1. ]", "342., 235., 1. ]")).complaint,
              HasSubstr("calib:7: camera_matrix: its last row is 342 235 1"));
  EXPECT_THAT(read(kRos + "binning_y: 2\n").complaint,
              HasSubstr("calib:14: binning_y: '2' is not read"));
  EXPECT_THAT(read("a: [").complaint, HasSubstr("calib:1: "));
  EXPECT_THAT(read("").complaint, HasSubstr("is empty"));
  EXPECT_THAT(read("[1, 2]").complaint, HasSubstr("holds no map of keys"));
  EXPECT_THAT(complaint("cameras:\n  - {}\n  - name: b\n    calibration: none.yaml\n"),
              AllOf(HasSubstr("s.yaml:4: cameras.1.calibration: value 'none.yaml': "),
                    HasSubstr("none.yaml: there is no such file")));
}

TEST(Calibration, ItsValuesAreInTheRangesOfTheKeysAndAtFaultItself) {
  for (const auto& [was, is, words] : std::vector<std::array<const char*, 3>>{
           {"640.2", "-10", "calib: cx_px: value '-9.5': is out of range"},
           {"700.1", "2e6", "calib: fx_px"},
           {"0.1, 0.2", "0.1, -2e6", "calib: distortion.k2"},
           {"rational_polynomial", "thin", "'thin' is not read"},
           {"640.2", "1300", "cameras.0.calibration: cx_px = 1300.5 lies"}}) {
    const std::string fault = read(with(kRos, was, is)).complaint;
    EXPECT_THAT(fault, AllOf(HasSubstr("s.yaml:1: cameras.0.calibration: "), HasSubstr(words)));
    EXPECT_EQ(fault.find('\n'), fault.npos) << fault;  // nothing of half a calibration
  }
}

TEST(CameraKeys, OneFieldOfViewAloneMakesSquarePixels) {
  const auto model = [](const std::string& camera) {
    return make_camera_model(load_text("cameras: [{" + camera + "}]\n").cameras.at(0));
  };
  const CameraModel by_x = model("width_px: 640, height_px: 480, fov_x_deg: 70");
  EXPECT_NEAR(by_x.fx_px, 320.0 / std::tan(deg_to_rad(35.0)), 1e-9);
  EXPECT_NEAR(by_x.fy_px, by_x.fx_px, 1e-9);
  const CameraModel by_y = model("preset: zed_mini, fov_y_deg: 50");
  EXPECT_NEAR(by_y.fy_px, by_y.fx_px, 1e-9);
  const CameraModel both = model("fov_x_deg: 60, fov_y_deg: 45");
  EXPECT_EQ(both.config.fov_y_rad, deg_to_rad(45.0));
  EXPECT_EQ(load_text(kMinimal).cameras.at(0).fov_y_rad, deg_to_rad(45.0));
  EXPECT_EQ(load_scenario("aircraft", {"cameras.0.fov_x_deg=90"}).cameras[0].fov_y_rad,
            deg_to_rad(45.0));
  EXPECT_TRUE(repeats(load_text("cameras: [{width_px: 333, height_px: 217, fov_x_deg: 71.3}]\n")));
  const std::string tall = "cameras: [{width_px: 10, height_px: 1000, fov_x_deg: 60";
  for (const std::string& text : {tall + "}]\n", std::string("cameras: [{fov_x_deg: 1}]\n")}) {
    EXPECT_THAT(complaint(text), HasSubstr("square pixels make the other field of view"));
  }
  EXPECT_TRUE(repeats(load_text(tall + ", fx_px: 9}]\n"))) << "where no angle counts";
}

TEST(CameraKeys, TheGreatestAngleIsOfAModelAndWithoutOneHasNoEffect) {
  for (const std::string keys : {"", "fx_px: 320, cx_px: 300, "}) {
    for (const std::string model : {"none", "brown_conrady", "kannala_brandt"}) {
      const std::string distortion = "distortion: {model: " + model + ", max_angle_deg: 20}";
      const CameraModel camera =
          make_camera_model(load_text("cameras: [{" + keys + distortion + "}]\n").cameras.at(0));
      const Vec3 off_m(std::tan(deg_to_rad(-21.0)), 0.0, 1.0);
      EXPECT_EQ(camera.has_in_image(off_m), model == "none") << keys;
    }
  }
}

TEST(CameraKeys, ALensThatShowsNothingIsRefused) {
  EXPECT_THAT(complaint("cameras: [{width_px: 640, fx_px: 500, cx_px: 641}]\n"),
              AllOf(HasSubstr("s.yaml:1: cameras.0.cx_px"), HasSubstr("lies outside the image")));
  EXPECT_THAT(complaint("cameras:\n  - distortion: {model: brown_conrady, k1: -90000}\n"),
              AllOf(HasSubstr("s.yaml:2: cameras.0.distortion.k1"), HasSubstr("folds")));
}

TEST(StartKeys, AScenarioOfOnesOwnStartsWhereItSays) {
  EXPECT_EQ(load_text(kMinimal).start.jitter_m, Vec3::Zero());
  EXPECT_NE(load_scenario("aircraft", {}).start.jitter_m, Vec3::Zero());
}

}  // namespace
}  // namespace gnbv
