// From where a part of the true surface is to be seen best.
import { Vector3 } from "three";
import { keyOf } from "./densities";
import type { TrueSurface } from "./true_surface";

const kAzimuths = 24;
const kElevations_rad = [0.45, 0.8, 0.1, 1.2]; // the first of equal ones is taken
const kTried = 80; // voxels, at most
const kClear = 2.5; // voxels around one that do not count: its neighbours are surface, too
const kFar = 60; // voxels, beyond which nothing stands in the way

/** A direction from the middle of the voxels, of those from which most are seen. */
export function openSide(surface: TrueSurface, members: number[]): Vector3 {
  const solid = solidCells(surface);
  const every = Math.ceil(members.length / kTried);
  const tried = members.filter((_, i) => i % every === 0);
  let best = { seen: -1, way: new Vector3() };
  for (const elevation of kElevations_rad) {
    for (let i = 0; i < kAzimuths; ++i) {
      const azimuth = 2 * Math.PI * i / kAzimuths;
      const way = new Vector3(Math.cos(elevation) * Math.cos(azimuth),
        Math.cos(elevation) * Math.sin(azimuth), Math.sin(elevation));
      const seen = tried.filter((voxel) => isOpen(surface, solid, voxel, way)).length;
      if (seen > best.seen) best = { seen, way };
    }
  }
  return best.way;
}

function solidCells({ voxels }: TrueSurface): Set<number> {
  const cells = new Set<number>();
  for (let i = 0; i < voxels.length; i += 3) {
    cells.add(keyOf(voxels[i], voxels[i + 1], voxels[i + 2]));
  }
  return cells;
}

function isOpen({ voxels }: TrueSurface, solid: Set<number>, voxel: number, way: Vector3): boolean {
  const at = [0, 1, 2].map((axis) => voxels[3 * voxel + axis]);
  for (let t = kClear; t < kFar; ++t) {
    if (solid.has(keyOf(...way.toArray().map((w, axis) =>
      Math.round(at[axis] + t * w)) as [number, number, number]))) return false;
  }
  return true;
}
