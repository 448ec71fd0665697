// Which views had a place in their pictures. No run records that: a view counts that had it within
// a camera's pyramid and range, with no face of the structure in between or, where that cannot be
// had, no voxel that holds points. The page's structure may have fewer faces than the true one, and
// points are measured: it is about right, and is called so.
import * as three from "three";
import type { RunScene } from "./run_scene";

const kNear_m = 0.1; // what lies so near the place hides nothing: it is the same surface
const kNear_voxels = 2;

/** Indices of those views, in their order. */
export function viewsThatSaw(place: three.Vector3, scene: RunScene): number[] {
  return Array.from({ length: scene.flight.count }, (_, view) => view)
    .filter((view) => hasInPicture(place, view, scene));
}

function hasInPicture(place: three.Vector3, view: number, scene: RunScene): boolean {
  return scene.flight.camerasInWorld(view).some(({ camera, T }) => {
    const seen = place.clone().applyMatrix4(T.clone().invert());
    if (seen.z <= 0 || seen.length() > camera.range_m) return false;
    if (Math.abs(seen.x) > seen.z * Math.tan(camera.fov_x / 2)
      || Math.abs(seen.y) > seen.z * Math.tan(camera.fov_y / 2)) return false;
    return !isHidden(place, new three.Vector3().setFromMatrixPosition(T), scene);
  });
}

function isHidden(place: three.Vector3, from: three.Vector3,
    { structure, model: { densities } }: RunScene): boolean {
  const way = place.clone().sub(from);
  const away = way.length();
  way.normalize();
  if (structure) return structure.hides(from, way, away - kNear_m);
  if (!densities) return false;
  const far = away - kNear_voxels * densities.voxels.size_m;
  return densities.firstHit(from, way, far, Infinity) < far;
}
