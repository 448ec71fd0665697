// A ceiling as people and programs read it.
#pragma once

#include <span>
#include <string>

#include "bench/limits/ceiling.hpp"
#include "bench/limits/oracle.hpp"

namespace gnbv {

/// `reaches` are what an oracle planned, if it was asked; it took `wall_s` to find all of it.
std::string ceiling_text(const Ceiling& ceiling, std::span<const OracleReach> reaches,
                         double wall_s);
std::string ceiling_json(const Scenario& scenario, const Ceiling& ceiling,
                         std::span<const OracleReach> reaches, double wall_s);

}  // namespace gnbv
