// How far a camera has to go back to see everything.
import * as three from "three";

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
