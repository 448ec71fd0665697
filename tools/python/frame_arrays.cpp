#include "tools/python/frame_arrays.hpp"

#include <nanobind/stl/string.h>

#include "tools/run/frames_folder.hpp"

namespace gnbv {
namespace {

/// 3 x 3, pixels.
template <typename Camera>
nb::object matrix_of(const Camera& c, double skew_px) {
  return owned_array(
      std::vector<double>{c.fx_px, skew_px, c.cx_px, 0.0, c.fy_px, c.cy_px, 0.0, 0.0, 1.0}, 3);
}

/// 4 x 4, row by row.
nb::object matrix_of(const Isometry& T) {
  const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> rows = T.matrix();
  return owned_array(std::vector<double>(rows.data(), rows.data() + rows.size()), 4);
}

nb::object colours(std::vector<std::uint8_t> rgb, std::size_t width_px) {
  nb::object flat = owned_array(std::move(rgb), 3);
  return flat.attr("reshape")(-1, width_px, 3);
}

/// A run's frame. Depth of a file that says 0 is that of no return or an invalid one: NaN.
nb::tuple read_frame(const FrameRecord& record, std::size_t i) {
  const RecordedFrame& frame = record.frames.at(i);
  const FrameCamera& camera = record.cameras[frame.camera];
  const auto width = static_cast<std::size_t>(camera.width_px);
  std::vector<float> depth_m;
  for (const std::uint16_t steps : read_depth(record, i).values) {
    depth_m.push_back(steps == 0 ? kInvalidRange
                                 : static_cast<float>(steps * camera.depth_scale_m));
  }
  return nb::make_tuple(camera.name, frame.iteration, frame.time_s,
                        owned_array(std::move(depth_m), width),
                        colours(read_colour(record, i).rgb, width),
                        matrix_of(camera, camera.skew_px()), matrix_of(frame.T_world_camera));
}

}  // namespace

nb::list frames_of(const KeptView& view, std::span<const CameraModel> cameras) {
  nb::list out;
  for (const DepthFrame& frame : view.depth) {
    const CameraModel& camera = cameras[static_cast<std::size_t>(frame.camera)];
    const auto width = static_cast<std::size_t>(camera.config.width_px);
    nb::object rgb = nb::none();
    for (const ColourFrame& colour : view.colour) {
      if (colour.camera != frame.camera) continue;
      std::vector<std::uint8_t> bytes;
      for (const auto& pixel : colour.rgb) bytes.insert(bytes.end(), pixel.begin(), pixel.end());
      rgb = colours(std::move(bytes), width);
    }
    out.append(nb::make_tuple(
        camera.config.name, view.iteration, view.time_s, owned_array(frame.depth_m, width), rgb,
        matrix_of(camera, camera.config.skew_px), matrix_of(frame.T_world_camera)));
  }
  return out;
}

void put_top(const GridGeometry& grid, std::vector<float> top, nb::dict& out) {
  const Key& low = grid.min_key();
  const Key& size = grid.size();
  const double voxel_m = grid.resolution_m();
  out["top"] = owned_array(std::move(top), 2 * static_cast<std::size_t>(size[0]));
  out["top_low_m"] = nb::make_tuple(voxel_m * low[0], voxel_m * low[1]);
  out["top_high_m"] = nb::make_tuple(voxel_m * (low[0] + size[0]), voxel_m * (low[1] + size[1]));
}

void bind_frames(nb::module_& m) {
  nb::class_<FrameRecord>(m, "FrameRecord")
      .def("__len__", [](const FrameRecord& record) { return record.frames.size(); })
      .def("read", &read_frame, nb::arg("index"),
           nb::sig("def read(self, index: int) -> tuple[typing.Any, ...]"));
  m.def(
      "read_frames", [](const std::string& run) { return read_frames(run); }, nb::arg("run"));
}

}  // namespace gnbv
