#include "sim/flight/flight.hpp"

#include "sim/core/error.hpp"
#include "sim/flight/ideal_flight.hpp"
#include "sim/flight/quadrotor.hpp"

namespace gnbv {

std::unique_ptr<Flight> make_flight(const VehicleConfig& config, const World& world,
                                    const ViewPose& start, std::uint64_t seed,
                                    const WindConfig& wind) {
  switch (config.kind) {
    case VehicleKind::quadrotor:
      return std::make_unique<Quadrotor>(config, world, start, seed, Px4::Start::airborne_offboard,
                                         wind);
    case VehicleKind::ideal:
      return make_ideal_flight(config, world, start);
  }
  throw BrokenInvariant("vehicle kind outside its enumeration");
}

}  // namespace gnbv
