// What lies under the pointer: a voxel of the true surface, a point, a view; and who saw a place.
import * as three from "three";
import type { RunScene } from "./run_scene";

/** What a pointer can name. */
export interface Thing {
  at: three.Vector3;
  ahead: number; // of what lies in front of it by that depth
  view: number | null; // index of a view to go to
  isView?: boolean; // it is that view itself
  what(): string;
}

/** What lies in front within `near_px` of `x`, `y` of a pane of that size. */
export function pick(scene: RunScene, camera: three.Camera, x: number, y: number, width: number,
    height: number, near_px: number): Thing | null {
  let best: Thing | null = null;
  let depth = Infinity;
  const seen = new three.Vector3();
  for (const thing of scene.things()) {
    seen.copy(thing.at).project(camera);
    const away_px = Math.hypot((seen.x + 1) / 2 * width - x, (1 - seen.y) / 2 * height - y);
    if (Math.abs(seen.z) > 1 || away_px > near_px || seen.z - thing.ahead >= depth) continue;
    depth = seen.z - thing.ahead;
    best = { ...thing, at: thing.at.clone() };
  }
  return best;
}

const kNear_m = 0.1; // what lies so near the place hides nothing: it is the same surface
const kNear_voxels = 2;

/**
 * Indices of the views that had a place in their pictures. No run records that: a view counts that
 * had it within a camera's pyramid and range, with no face of the structure in between or, where
 * that cannot be had, no voxel that holds points. The page's structure may have fewer faces than the
 * true one, and points are measured: it is about right, and is called so.
 */
export function viewsThatSaw(place: three.Vector3, scene: RunScene): number[] {
  return [...Array(scene.flight.count).keys()].filter((view) =>
    scene.flight.camerasInWorld(view).some(({ camera, T }) => {
      const { x, y, z } = place.clone().applyMatrix4(T.clone().invert());
      return z > 0 && Math.hypot(x, y, z) <= camera.range_m
        && Math.abs(x) <= z * Math.tan(camera.fov_x / 2)
        && Math.abs(y) <= z * Math.tan(camera.fov_y / 2)
        && !isHidden(place, new three.Vector3().setFromMatrixPosition(T), scene);
    }));
}

function isHidden(place: three.Vector3, from: three.Vector3,
    { structure, model: { densities } }: RunScene): boolean {
  const way = place.clone().sub(from).normalize();
  const away = place.distanceTo(from);
  if (structure) return structure.hides(from, way, away - kNear_m);
  if (!densities) return false;
  const far = away - kNear_voxels * densities.voxels.size_m;
  return densities.firstHit(from, way, far, Infinity) < far;
}
