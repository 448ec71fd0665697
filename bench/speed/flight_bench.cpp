// How much faster than time one vehicle flies, sensors off: rates at 1 kHz, physics at 250 Hz.
#include <benchmark/benchmark.h>

#include "sim/flight/flight.hpp"
#include "sim/flight/guidance.hpp"
#include "sim/flight/vehicle_config.hpp"
#include "sim/mesh/world.hpp"

namespace gnbv {
namespace {

const ViewPose kStart = {Vec3(0, 0, 10), 0.0};

void report(benchmark::State& state, double simulated_s) {
  state.counters["x_real_time"] = benchmark::Counter(simulated_s, benchmark::Counter::kIsRate);
}

void BM_Hover(benchmark::State& state) {
  const auto flight = make_flight({}, World{}, kStart, 1);
  Setpoint hold;
  hold.p_world_m = kStart.p_world_m;
  for (auto _ : state) {
    flight->command(hold);
    flight->step();
  }
  report(state, static_cast<double>(flight->tick()) * kTick_s);
}
BENCHMARK(BM_Hover);

/// There and back along 5 m, turning, with the guidance's setpoints.
void BM_Leg(benchmark::State& state) {
  const VehicleConfig vehicle;
  const auto flight = make_flight(vehicle, World{}, kStart, 1);
  bool is_there = false;
  for (auto _ : state) {
    is_there = !is_there;
    const ViewPose goal = is_there ? ViewPose{Vec3(4, 3, 10), 1.0} : kStart;
    const LegEnd end = fly_leg(*flight, goal, 2.0, GuidanceConfig{}, vehicle, nullptr);
    if (end != LegEnd::arrived) state.SkipWithError("the leg did not arrive");
  }
  report(state, static_cast<double>(flight->tick()) * kTick_s);
}
BENCHMARK(BM_Leg)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace gnbv

BENCHMARK_MAIN();
