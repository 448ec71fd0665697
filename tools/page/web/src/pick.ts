// What lies under the pointer: a voxel of the true surface, a point, a view.
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
