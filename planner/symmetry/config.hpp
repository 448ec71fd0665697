// The settings of the search for symmetry.
#pragma once

namespace gnbv {

/// Defaults: the released configuration where it works on the two structures of the paper, our own
/// choice elsewhere (FIDELITY.md).
struct SymmetryConfig {
  bool enabled = true;
  double min_support = 0.985;  // share of mirrored points not contradicted by measured free space
  double min_confirmed = 0.4;  // share of them that falls on measured surface
};

}  // namespace gnbv
