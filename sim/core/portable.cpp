#include "sim/core/portable.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

namespace gnbv {
namespace {

// The features whose functions of glibc's differ, by their names since glibc 2.33 and before.
constexpr const char* kUnfused =
    "glibc.cpu.hwcaps=-FMA,-FMA4,-FMA_Usable,-FMA4_Usable,-AVX2_Usable";

/// A value that glibc computes otherwise where it fuses: seen with glibc 2.36, both ways.
struct Probe {
  double (*function)(double, double);
  double x, y, value;
};

const Probe kProbes[] = {
    {[](double x, double) { return std::sin(x); }, -0x1.a2p+1, 0, 0x1.fabc216c36a15p-4},
    {[](double x, double) { return std::cos(x); }, -0x1.788p+1, 0, -0x1.f5c66e28ef7dep-1},
    {[](double x, double) { return std::asin(x); }, 0x1.d8p-4, 0, 0x1.d90d0803393bap-4},
    {[](double x, double) { return std::exp(x); }, 0x1.dp+1, 0, 0x1.2c32a20e4f854p+5},
    {[](double x, double) { return std::expm1(x); }, 0x1.93p-2, 0, 0x1.edd0697ecea69p-2},
    {[](double x, double) { return std::log1p(x); }, 0x1.008p+1, 0, 0x1.1993eeca6a43ep+0},
    {[](double x, double y) { return std::atan2(x, y); }, 0x1.28p+1, 0x1.6cp+0,
     0x1.04ff28b7a52d5p+0},
    {[](double x, double y) { return std::pow(x, y); }, 0x1.464p+4, -0x1.38p+0,
     0x1.9f7b35d442a62p-6}};

bool is_portable(const Probe& probe) {
  volatile double x = probe.x;  // computed when the program runs
  return probe.function(x, probe.y) == probe.value;
}

}  // namespace

void need_portable_mathematics() {
  static const bool is_met = std::ranges::all_of(kProbes, is_portable);
  if (is_met) return;
  throw UnportableMathematics(fmt::format(
      "portable: the C library computes other digits here than on every processor: the environment "
      "has to hold GLIBC_TUNABLES={} when the program starts, and the library to be glibc 2.28 or "
      "later on x86-64",
      kUnfused));
}

void restart_with_portable_mathematics(char** argv) {
  const char* const set = std::getenv("GLIBC_TUNABLES");
  std::string tunables = set == nullptr ? "" : set;
  if (tunables.find(kUnfused) != tunables.npos) return;
  tunables += tunables.empty() ? "" : ":";
  setenv("GLIBC_TUNABLES", (tunables + kUnfused).c_str(), 1);
  execv("/proc/self/exe", argv);
}

}  // namespace gnbv
