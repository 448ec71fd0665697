// What a view promised and what it brought: how the planner learns whom to believe.
#pragma once

#include <span>
#include <vector>

#include "planner/tour/patch_view.hpp"
#include "planner/tour/success.hpp"

namespace gnbv {

/// What a view promised of one kind of look, and what it brought, in small voxels.
struct LookOutcome {
  PatchSource source = PatchSource::sampled;
  std::size_t looks = 0;      // before; the last bin for that many or more
  std::size_t incidence = 0;  // incidence_bin()
  int patches = 0;
  double missing = 0.0;   // expected to lack a point
  double promised = 0.0;  // of them, by what was learned so far
  double found = 0.0;
};

class LookLedger {
 public:
  explicit LookLedger(TourSuccess method) : success_(method) {}

  const LookSuccess& success() const { return success_; }

  /// Notes what the next view will see. Returns how many small voxels it can be expected to bring.
  double promise(std::span<const SeenPatch> seen, std::span<const Patch> patches,
                 const SurfaceCells& cells);

  /// Compares with what the cells hold since, learns from it, and counts the looks. Nothing is
  /// under way afterwards.
  void settle(SurfaceCells& cells);

  /// What the views of late brought of what they promised, at most 1: the shares of LookSuccess are
  /// of the whole flight, and what stays to the end is harder. `doubt`: small voxels that a promise
  /// has to exceed to tell anything.
  double reality(double doubt) const;

  /// Of the last settle(), by kind.
  std::span<const LookOutcome> outcomes() const { return outcomes_; }
  double promised() const;
  double found() const;

 private:
  struct Promise {
    PatchId patch = 0;
    PatchSource source = PatchSource::sampled;
    std::uint8_t looks = 0, incidence = 0;
    float missing = 0.0F;
    float promised = 0.0F;
    std::uint64_t covered_before = 0;  // voxels of the cell that held a point
  };
  void book(const Promise& promise, double found);

  LookSuccess success_;
  double lately_promised_ = 0.0;  // faded by each settle()
  double lately_found_ = 0.0;
  std::vector<Promise> promises_;
  std::vector<LookOutcome> outcomes_;
};

}  // namespace gnbv
