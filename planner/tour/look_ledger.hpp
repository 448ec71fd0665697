// What a view promised and what it brought: how the planner learns whom to believe.
#pragma once

#include <map>
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
  /// Edge of the cubes of which each has a credit of its own, in edges of a small voxel.
  static constexpr double kCreditCube = 20.0;

  /// `detail_m`: edge of a small voxel.
  LookLedger(TourSuccess method, double detail_m)
      : method_(method), cube_m_(kCreditCube * detail_m), success_(method) {}

  const LookSuccess& success() const { return success_; }

  /// Notes what the next view will see. Returns how many small voxels it can be expected to bring.
  double promise(std::span<const SeenPatch> seen, std::span<const Patch> patches,
                 const SurfaceCells& cells);

  /// Compares with what the cells hold since, learns from it, and counts the looks. Nothing is
  /// under way afterwards.
  void settle(SurfaceCells& cells);

  /// Sets each patch's credit: of what looks into its cube promised, what they brought, those of
  /// late more than those long ago. The shares of LookSuccess are of the whole flight and of all
  /// places; what stays to the end is harder, and hard places lie together.
  void give_credit(std::vector<Patch>& patches) const;

  /// Of the last settle(), by kind.
  std::span<const LookOutcome> outcomes() const { return outcomes_; }
  double promised() const;
  double found() const;

 private:
  struct Promise {
    SeenPatch look;
    Patch patch;  // as it was
    float promised = 0.0F;
    std::uint64_t covered_before = 0;  // voxels of the cell that held a point
  };
  void book(const Promise& promise, double found);

  struct Kept {
    double promised = 0.0, found = 0.0;  // small voxels; the promises as they were without credit
  };
  Key cube_of(const Patch& patch) const;

  TourSuccess method_;
  double cube_m_;
  LookSuccess success_;
  std::map<Key, Kept> kept_;  // by cube
  std::vector<Promise> promises_;
  std::vector<LookOutcome> outcomes_;
};

}  // namespace gnbv
