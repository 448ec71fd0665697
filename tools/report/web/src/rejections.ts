// What the reasons mean for which a candidate was refused, by their numbers (planner/motion/free_space.hpp).

const kMeans = [
  "Outside the workspace, or below the lowest height at which the vehicle may fly",
  "The voxel in which it stands is not known to be free: occupied, or never seen",
  "Something occupied lies within the vehicle's radius of safety there",
  "On the way from the view before, something occupied lies within the radius of safety, or no way "
    + "through known free space was found",
  "A view before stood there and looked the same way",
  "The middle of the frontier that it was to look at is in no camera's picture",
  "Something occupied hides the frontier that it was to look at",
  "The utility refuses it: none of its rays meets a surface",
  "In a box where nobody may fly, or too near to it",
  "No gimbal of the vehicle reaches its pitch",
  "The search for a way around ended at its limit and had found none"];

export const rejectionMeans = (reason: number) => kMeans[reason] ?? "";
