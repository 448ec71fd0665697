// The module that knows PCL (tools/surface/poisson_module.hpp).
#include <fcntl.h>
#include <pcl/console/print.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/surface/poisson.h>
#include <unistd.h>

#include <cstdio>
#include <type_traits>
#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/lsan_interface.h>
#endif

#include "sim/core/module.hpp"
#include "tools/surface/poisson_module.hpp"

GNBV_MODULE(GNBV_VERSION)

namespace gnbv {
namespace {

/// While it lives, what is written to the stream goes nowhere: PCL's octree prints a line for each
/// edge that it cannot close, its solver one for each system that is solved already, and there is
/// no switch for either.
class Silenced {
 public:
  explicit Silenced(std::FILE* stream) : stream_(stream) {
    std::fflush(stream_);
    kept_ = ::dup(::fileno(stream_));
    const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (nowhere < 0) return;
    ::dup2(nowhere, ::fileno(stream_));
    ::close(nowhere);
  }
  ~Silenced() {
    std::fflush(stream_);
    if (kept_ < 0) return;  // it was closed
    ::dup2(kept_, ::fileno(stream_));
    ::close(kept_);
  }
  Silenced(const Silenced&) = delete;
  Silenced& operator=(const Silenced&) = delete;

 private:
  std::FILE* stream_;
  int kept_ = -1;
};

/// While it lives, leaks are not counted: PCL 1.13's BSplineData never frees its tables of dot
/// products.
struct Forgiven {
#ifdef __SANITIZE_ADDRESS__
  const __lsan::ScopedDisabler tables;
#endif
};

pcl::PointCloud<pcl::PointNormal>::Ptr cloud_of(std::span<const Vec3f> points_m,
                                                std::span<const Vec3f> normals) {
  auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointNormal>>();
  cloud->reserve(points_m.size());
  for (std::size_t i = 0; i < points_m.size(); ++i) {
    pcl::PointNormal point;
    point.getVector3fMap() = points_m[i];
    point.getNormalVector3fMap() = normals[i];
    cloud->push_back(point);
  }
  return cloud;
}

}  // namespace

extern "C" __attribute__((visibility("default"))) void gnbv_poisson_surface(
    std::span<const Vec3f> points_m, std::span<const Vec3f> normals,
    const PoissonSettings& settings, TriangleMesh& mesh) {
  mesh = {};
  if (points_m.empty()) return;
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  pcl::Poisson<pcl::PointNormal> poisson;
  poisson.setInputCloud(cloud_of(points_m, normals));
  poisson.setDepth(settings.depth);
  poisson.setPointWeight(settings.point_weight);
  poisson.setScale(static_cast<float>(kPoissonScale));
  poisson.setSamplesPerNode(1.5F);
  poisson.setThreads(1);
  pcl::PointCloud<pcl::PointNormal> vertices;
  std::vector<pcl::Vertices> polygons;
  {
    const Silenced no_edges(stdout);
    const Silenced no_residuals(stderr);
    [[maybe_unused]] const Forgiven leaks{};
    poisson.reconstruct(vertices, polygons);
  }
  mesh.vertices_m.reserve(vertices.size());
  for (const pcl::PointNormal& vertex : vertices)
    mesh.vertices_m.push_back(vertex.getVector3fMap());
  mesh.faces.reserve(polygons.size());
  for (const pcl::Vertices& polygon : polygons) {
    const auto corner = [&](std::size_t k) {
      return static_cast<std::uint32_t>(polygon.vertices[k]);
    };
    mesh.faces.push_back({corner(0), corner(1), corner(2)});
  }
}

// what poisson_module() takes it for
static_assert(std::is_same_v<decltype(gnbv_poisson_surface), PoissonSurface>);

}  // namespace gnbv
