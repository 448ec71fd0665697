// Runs of different structures side by side: each is seen from as far away as its size asks. One
// camera is steered, in the world of the page's first run; each pane's own stands in its workspace
// as that one does in the first run's.
import * as three from "three";
import type { RunScene } from "./run_scene";

export class PaneCamera {
  private readonly own = new three.PerspectiveCamera();
  private readonly firstCentre_m: three.Vector3;
  private readonly centre_m: three.Vector3;
  /** Metres of the first run's world for a metre of this one's. */
  readonly scale: number;

  constructor(first: RunScene, scene: RunScene) {
    const [from, to] = [first.flight.workspace(), scene.flight.workspace()];
    [this.firstCentre_m, this.centre_m] = [from.centre, to.centre];
    this.scale = from.size_m / to.size_m;
  }

  /** The steered camera as it stands in this run's world. */
  of(steered: three.PerspectiveCamera): three.PerspectiveCamera {
    if (this.scale === 1 && this.centre_m.equals(this.firstCentre_m)) return steered;
    this.own.copy(steered);
    this.own.position.sub(this.firstCentre_m).divideScalar(this.scale).add(this.centre_m);
    this.own.near /= this.scale;
    this.own.far /= this.scale;
    this.own.updateProjectionMatrix();
    this.own.updateMatrixWorld();
    return this.own;
  }

  /** A place of this run's world in the first one's. */
  inFirst(p_m: three.Vector3): three.Vector3 {
    return p_m.clone().sub(this.centre_m).multiplyScalar(this.scale).add(this.firstCentre_m);
  }

  /** The same of many (x y z each). */
  allInFirst(places_m: Float32Array): Float32Array {
    const [from, to] = [this.centre_m.toArray(), this.firstCentre_m.toArray()];
    return places_m.map((value, i) => to[i % 3] + this.scale * (value - from[i % 3]));
  }
}

const kFilled = 0.86; // of the picture, at most

/**
 * The least distance from `centre` along `back` from which a camera that looks at `centre` sees
 * every point of the outlines; `fov` in degrees, `heightToWidth` of its picture.
 */
export function nearestThatSees(outlines: Float32Array[], centre: three.Vector3,
    back: three.Vector3, fov: number, heightToWidth: number): number {
  const tan = kFilled * Math.tan(three.MathUtils.degToRad(fov) / 2);
  const right = new three.Vector3(-back.y, back.x, 0).normalize();
  const up = back.clone().cross(right);
  const at = new three.Vector3();
  let away = 1;
  for (const outline of outlines) {
    for (let i = 0; i < outline.length; i += 3) {
      at.fromArray(outline, i).sub(centre);
      away = Math.max(away, at.dot(back) + Math.abs(at.dot(up)) / tan,
        at.dot(back) + Math.abs(at.dot(right)) / tan * heightToWidth);
    }
  }
  return away;
}
