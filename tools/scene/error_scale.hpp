// What the colours of errors stand for: those of one run may be millimetres, of another ten times
// that.
#pragma once

#include <span>

namespace gnbv {

struct ErrorScale {
  double most_m = 0.001;  // of the scale of error_colours(), from 0: rounded_up_125()
  double median_m = 0.0;  // half of the errors are no larger
  double within_m = 0.0;  // and 95 % no larger than this
};

/// 95 % of the errors lie within the scale, and it ends at 1 mm at least.
ErrorScale error_scale(std::span<const double> errors_m);

}  // namespace gnbv
