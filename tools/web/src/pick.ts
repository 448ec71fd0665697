// What lies under the pointer: a voxel of the true surface, a point, a view; and who saw a place.
import * as three from "three";
import type { RunScene } from "./run_scene";

export interface Picked {
  at: three.Vector3;
  what: string;
  view: number | null; // index of a view to go to
  isView?: boolean; // it is that view itself
}

export const kPointer_px = 9;
export const kAim_px = 60; // of the middle, which a key asks about

/** What lies in front within `near_px` of `x`, `y` of a pane of that size. */
export function pick(scene: RunScene, camera: three.PerspectiveCamera, x: number, y: number,
    width: number, height: number, near_px: number): Picked | null {
  const T = new three.Matrix4().multiplyMatrices(camera.projectionMatrix,
    camera.matrixWorldInverse);
  const at = new three.Vector3();
  let best: { depth: number; of: () => Picked } | null = null;
  const look = (place: three.Vector3, ahead: number, of: () => Picked) => {
    at.copy(place).applyMatrix4(T);
    if (at.z > 1 || at.z < -1) return;
    const away = Math.hypot((at.x + 1) / 2 * width - x, (1 - at.y) / 2 * height - y);
    const depth = at.z - ahead;
    if (away <= near_px && (!best || depth < best.depth)) best = { depth, of };
  };
  for (const thing of scene.things()) look(thing.at, thing.ahead, thing.of);
  return (best as { of: () => Picked } | null)?.of() ?? null;
}

/** Calls with the place of each press that does not move. */
export function listenToClicks(canvas: HTMLElement, call: (x: number, y: number) => void) {
  let from = [0, 0];
  canvas.addEventListener("pointerdown", (event) => { from = [event.clientX, event.clientY]; });
  canvas.addEventListener("pointerup", (event) => {
    if (Math.hypot(event.clientX - from[0], event.clientY - from[1]) > 4) return;
    call(event.offsetX, event.offsetY);
  });
}

/** Keys of the 3D view while it has the focus; false for any other key. */
export function moveByKey(key: string, camera: three.PerspectiveCamera,
    target: three.Vector3): boolean {
  const kTurn = Math.PI / 24;
  const offset = camera.position.clone().sub(target);
  const side = new three.Vector3().crossVectors(camera.up, offset).normalize();
  const pan = (way: three.Vector3, share: number) => {
    const step = way.clone().multiplyScalar(share * offset.length());
    camera.position.add(step);
    target.add(step);
  };
  const turn = (axis: three.Vector3, angle: number) => {
    const turned = offset.clone().applyAxisAngle(axis, angle);
    if (turned.clone().normalize().z < 0.99 && turned.z > -0.15 * turned.length()) {
      camera.position.copy(target).add(turned);
    }
  };
  const actions: Record<string, () => void> = {
    a: () => turn(camera.up, -kTurn), d: () => turn(camera.up, kTurn),
    w: () => turn(side, -kTurn), s: () => turn(side, kTurn),
    "+": () => camera.position.copy(target).addScaledVector(offset, 1 / 1.15),
    "=": () => camera.position.copy(target).addScaledVector(offset, 1 / 1.15),
    "-": () => camera.position.copy(target).addScaledVector(offset, 1.15),
    j: () => pan(side, -0.05), l: () => pan(side, 0.05),
    i: () => pan(camera.up, 0.05), k: () => pan(camera.up, -0.05),
  };
  const action = actions[key.toLowerCase()];
  if (!action) return false;
  action();
  return true;
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
