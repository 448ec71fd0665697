// Runs of different structures side by side: each is seen from as far away as its size asks.
import * as three from "three";
import type { RunScene } from "./run_scene";

function workspace(scene: RunScene): { centre: three.Vector3; size: number } {
  const { min, max } = scene.flight.data.workspace;
  const box = new three.Box3(new three.Vector3(...min), new three.Vector3(...max));
  return { centre: box.getCenter(new three.Vector3()), size: box.getSize(new three.Vector3()).length() };
}

export class PaneCamera {
  private readonly own = new three.PerspectiveCamera();
  private readonly to: { centre: three.Vector3; size: number };

  constructor(scene: RunScene) { this.to = workspace(scene); }

  /** The leading pane's camera, turned alike, where this workspace lies as that one does in its. */
  of(lead: RunScene, camera: three.PerspectiveCamera): three.PerspectiveCamera {
    const from = workspace(lead);
    const times = this.to.size / from.size;
    if (times === 1 && this.to.centre.equals(from.centre)) return camera;
    this.own.copy(camera);
    this.own.position.sub(from.centre).multiplyScalar(times).add(this.to.centre);
    this.own.near *= times;
    this.own.far *= times;
    this.own.updateProjectionMatrix();
    this.own.updateMatrixWorld();
    return this.own;
  }

  /** Points (x y z each) of the scene as they would lie in the leading pane's workspace. */
  inLead(lead: RunScene, points: Float32Array): Float32Array {
    const from = workspace(lead);
    const times = from.size / this.to.size;
    const [to, at] = [this.to.centre.toArray(), from.centre.toArray()];
    return points.map((value, i) => at[i % 3] + times * (value - to[i % 3]));
  }
}
