// Runs of different structures side by side: each is seen from as far away as its size asks. One
// camera is steered, in the world of the page's first run; each pane's own stands in its workspace
// as that one does in the first run's.
import * as three from "three";
import type { Flight } from "./flight";

export class PaneCamera {
  private readonly own = new three.PerspectiveCamera();
  /** Metres of the first run's world for a metre of this one's. */
  readonly scale: number;
  readonly toFirst: three.Matrix4; // this run's world into the first one's

  constructor(first: Flight, flight: Flight) {
    this.scale = first.size_m / flight.size_m;
    const [to, from] = [first, flight].map(({ workspace }) =>
      workspace.getCenter(new three.Vector3()));
    this.toFirst = new three.Matrix4().makeScale(this.scale, this.scale, this.scale)
      .setPosition(to.addScaledVector(from, -this.scale));
  }

  /** The steered camera as it stands in this run's world. */
  of(steered: three.PerspectiveCamera): three.PerspectiveCamera {
    this.own.copy(steered);
    this.own.position.applyMatrix4(this.toFirst.clone().invert());
    this.own.near /= this.scale;
    this.own.far /= this.scale;
    this.own.updateProjectionMatrix();
    this.own.updateMatrixWorld();
    return this.own;
  }
}

const kFilled = 0.86; // of the picture, at most

/**
 * The least distance from `centre` along `back` from which a camera that looks at `centre` sees
 * every one of the places (x y z each); `fov` in degrees, `heightToWidth` of its picture.
 */
export function nearestThatSees(places: three.BufferAttribute, centre: three.Vector3,
    back: three.Vector3, fov: number, heightToWidth: number): number {
  const tan = kFilled * Math.tan(three.MathUtils.degToRad(fov) / 2);
  const right = new three.Vector3(-back.y, back.x, 0).normalize();
  const up = back.clone().cross(right);
  const at = new three.Vector3();
  let away = 1;
  for (let i = 0; i < places.count; ++i) {
    at.fromBufferAttribute(places, i).sub(centre);
    away = Math.max(away, at.dot(back) + Math.abs(at.dot(up)) / tan,
      at.dot(back) + Math.abs(at.dot(right)) / tan * heightToWidth);
  }
  return away;
}
